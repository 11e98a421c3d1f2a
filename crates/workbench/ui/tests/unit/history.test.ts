import assert from "node:assert/strict";
import { test } from "node:test";
import {
  add,
  begin,
  changed,
  goTo,
  isRicher,
  isTicked,
  now,
  otherForm,
  SPRINGS,
  type Step,
  toggled,
  withReadings,
} from "../../src/history";
import type { View } from "../../src/wire";

const step = (...terms: string[]): Step => ({ selection: { ...SPRINGS, terms }, view: { terms } as View });

test("what is undone can be done again until something new is done", () => {
  let history = add(add(begin(step()), step("a")), step("a", "b"));
  history = goTo(history, 1);
  assert.deepEqual(now(history).selection.terms, ["a"]);
  history = goTo(history, 2);
  assert.deepEqual(now(history).selection.terms, ["a", "b"]);
  history = add(goTo(history, 1), step("a", "c"));
  assert.equal(history.steps.length, 3);
  assert.deepEqual(goTo(history, 3), history);
  assert.deepEqual(goTo(history, -1), history);
});

test("a step is named by what it adds and removes", () => {
  assert.equal(changed(undefined, step().selection), "springs alone");
  assert.equal(changed(step("a").selection, step("a", "b").selection), "+ b");
  assert.equal(changed(step("a", "b").selection, step("b", "c").selection), "+ c \u2212 a");
  assert.equal(changed(step("a").selection, step().selection), "springs alone");
});

test("ticking keeps the order of ticking", () => {
  assert.deepEqual(toggled({ ...SPRINGS, terms: ["b"] }, "a").terms, ["b", "a"]);
  assert.deepEqual(toggled({ ...SPRINGS, terms: ["b", "a"] }, "b").terms, ["a"]);
});

test("a term keeps its place when its form changes, and is unticked in either form", () => {
  const selection = { ...SPRINGS, terms: ["a", "b"] };
  const richer = otherForm(selection, "a");
  assert.deepEqual(richer.terms, ["a:richer", "b"]);
  assert.ok(isTicked(richer, "a") && isRicher(richer, "a") && !isRicher(selection, "a"));
  assert.deepEqual(otherForm(richer, "a").terms, ["a", "b"]);
  assert.deepEqual(toggled(richer, "a").terms, ["b"]);
});

test("readings are left out and put back, and the step says how many", () => {
  const out = withReadings(SPRINGS, [7, 3], false);
  assert.deepEqual(out.exclude, [3, 7]);
  assert.equal(changed(SPRINGS, out), "2 readings left out");
  const one = withReadings(out, [7], true);
  assert.deepEqual(one.exclude, [3]);
  assert.equal(changed(out, toggled(one, "a")), "+ a, 1 reading put back");
  assert.equal(changed(toggled(SPRINGS, "a"), SPRINGS), "springs alone");
});
