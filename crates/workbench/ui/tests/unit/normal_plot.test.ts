import assert from "node:assert/strict";
import { test } from "node:test";
import { onCurve } from "../../src/charts/normal_plot";

const CURVE = [
  [-2, -3],
  [0, 0],
  [1, 0],
  [2, 4],
];

test("a residual stands on the curve of all of them", () => {
  assert.equal(onCurve(CURVE, -1.5), -1);
  assert.equal(onCurve(CURVE, 2), 1.5);
  assert.equal(onCurve(CURVE, 0), 0);
});

test("what is farther out than the curve stands at its end", () => {
  assert.equal(onCurve(CURVE, -9), -2);
  assert.equal(onCurve(CURVE, 9), 2);
});
