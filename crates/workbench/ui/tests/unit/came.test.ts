import assert from "node:assert/strict";
import { test } from "node:test";
import { odds, shift } from "../../src/bench/came";
import type { Diagnosis } from "../../src/wire";

const weighed = (first: number, second: number) =>
  ({
    candidates: [first, second].map((probability, k) => ({ term: "ab"[k], probability, indistinguishable: [] })),
  }) as unknown as Diagnosis;

test("what came is the shift of the odds, not the odds", () => {
  assert.ok(Math.abs((shift(weighed(0.9, 0.1), weighed(0.99, 0.01), "a", "b") ?? 0) - Math.log10(11)) < 1e-12);
  assert.ok((shift(weighed(0.9, 0.1), weighed(0.5, 0.5), "a", "b") ?? 0) < 0);
  assert.equal(shift(weighed(0.9, 0.1), weighed(0.9, 0), "a", "b"), null);
});

test("odds are read as people say them", () => {
  assert.equal(odds(1), "10 : 1");
  assert.equal(odds(-1), "1 : 10");
  assert.equal(odds(65), "> 10 000 : 1");
});
