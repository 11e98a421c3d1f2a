import assert from "node:assert/strict";
import { test } from "node:test";
import { reachOf } from "../../src/charts/panels";

test("an axis reaches just beyond the largest value", () => {
  for (const value of [1e-7, 0.031, 0.99, 1, 1.19, 7.9, 9.99, 123, 99999]) {
    const reach = reachOf([value, -0.2 * value]);
    assert.ok(reach >= value * 1.02 && reach <= value * 1.75, `${reach} for ${value}`);
  }
  assert.equal(reachOf([]), 1);
});
