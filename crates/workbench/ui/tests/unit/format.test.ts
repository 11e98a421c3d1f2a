import assert from "node:assert/strict";
import { test } from "node:test";
import { chance, digits, setting, unitName, withUncertainty } from "../../src/format";

test("numbers keep their significant digits", () => {
  assert.equal(digits(1.5234), "1.52");
  assert.equal(digits(-0.0012345), "\u22120.00123");
  assert.equal(digits(123456), "123000");
  assert.equal(digits(9.999), "10.0");
  assert.equal(digits(0), "0");
});

test("a value ends where its uncertainty ends", () => {
  assert.deepEqual(withUncertainty(3.72159, 0.00951), { value: "3.7216", std: "0.0095" });
  assert.deepEqual(withUncertainty(-5432.1, 120), { value: "\u22125430", std: "120" });
  assert.deepEqual(withUncertainty(0.00001, 0.2), { value: "0.00", std: "0.20" });
});

test("a chance is never nothing and never sure", () => {
  assert.deepEqual([0, 0.0123, 0.31, 1].map(chance), ["< 0.1 %", "1 %", "31 %", "> 99 %"]);
});

test("units are written as people write them", () => {
  assert.deepEqual(["um", "urad", "N/um", "mm", "1/K"].map(unitName), ["\u00b5m", "\u00b5rad", "N/\u00b5m", "mm", "1/K"]);
});

test("what was set has no digits that say nothing", () => {
  assert.deepEqual(
    [0, 10, 100, 7.1, -0.5, 1 / 3, 1e9].map((value) => setting(value)),
    ["0", "10", "100", "7.1", "\u22120.5", "0.333", "1.00e+9"],
  );
});
