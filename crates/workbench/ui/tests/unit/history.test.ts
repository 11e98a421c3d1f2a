import assert from "node:assert/strict";
import { test } from "node:test";
import { add, begin, changed, goTo, isRicher, isTicked, now, otherForm, type Step, toggled } from "../../src/history";
import type { View } from "../../src/wire";

const step = (...terms: string[]): Step => ({ selection: { terms, own: [] }, view: { terms } as View });

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
  assert.deepEqual(toggled({ terms: ["b"], own: [] }, "a").terms, ["b", "a"]);
  assert.deepEqual(toggled({ terms: ["b", "a"], own: [] }, "b").terms, ["a"]);
});

test("a term keeps its place when its form changes, and is unticked in either form", () => {
  const selection = { terms: ["a", "b"], own: [] };
  const richer = otherForm(selection, "a");
  assert.deepEqual(richer.terms, ["a:richer", "b"]);
  assert.ok(isTicked(richer, "a") && isRicher(richer, "a") && !isRicher(selection, "a"));
  assert.deepEqual(otherForm(richer, "a").terms, ["a", "b"]);
  assert.deepEqual(toggled(richer, "a").terms, ["b"]);
});
