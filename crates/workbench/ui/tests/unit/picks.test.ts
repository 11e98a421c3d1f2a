import assert from "node:assert/strict";
import { test } from "node:test";
import { allOf, leadOf, stepped, turned, withMany, withOne, withPart } from "../../src/picks";

const picked = (...all: number[]) => ({ which: "fitted" as const, all });

test("a click picks one condition, with shift it comes to the others or leaves them", () => {
  assert.deepEqual(withOne(picked(1, 2), "fitted", 5, false), picked(5));
  assert.deepEqual(withOne(picked(1, 2), "fitted", 5, true), picked(1, 2, 5));
  assert.deepEqual(withOne(picked(1, 2), "fitted", 1, true), picked(2));
  assert.equal(withOne(picked(1), "fitted", 1, true), null);
});

test("a rectangle picks what is in it and nothing else, with shift beside the others", () => {
  assert.deepEqual(withMany(picked(9), "fitted", [3, 4], false), picked(3, 4));
  assert.deepEqual(withMany(picked(4, 9), "fitted", [3, 4], true), picked(4, 9, 3));
  assert.equal(withMany(picked(9), "fitted", [], false), null);
});

test("readings held out and fitted are never picked together", () => {
  assert.deepEqual(withOne(picked(1, 2), "held-out", 0, true), { which: "held-out", all: [0] });
  assert.deepEqual(allOf(picked(1), "held-out"), []);
  assert.equal(leadOf(picked(1, 2), "fitted"), 2);
});

test("a key goes to the next condition, with shift it takes more and gives back what it took", () => {
  assert.deepEqual(stepped(null, "fitted", 8, 1, false), picked(0));
  assert.deepEqual(stepped(null, "fitted", 8, -1, true), picked(7));
  assert.deepEqual(stepped(picked(3, 4), "fitted", 8, 1, false), picked(5));
  assert.deepEqual(stepped(picked(3, 4), "fitted", 8, 1, true), picked(3, 4, 5));
  assert.deepEqual(stepped(picked(3, 4, 5), "fitted", 8, -1, true), picked(3, 4));
  assert.deepEqual(stepped(picked(7), "fitted", 8, 1, true), picked(7), "there is no more");
  assert.equal(stepped(null, "fitted", 0, 1, false), null);
});

test("each of those picked is looked at in turn", () => {
  let turning = picked(1, 2, 3);
  const seen = [0, 1, 2].map(() => {
    turning = turned(turning) as typeof turning;
    return leadOf(turning, "fitted");
  });
  assert.deepEqual(seen, [1, 2, 3]);
});

test("a part of the machine picks its readings, and the same part takes them back", () => {
  const leg = { kind: "leg" as const, leg: 2 };
  const picked = withPart(null, leg, [4, 1]);
  assert.deepEqual(picked, { which: "fitted", all: [4, 1], part: leg });
  assert.equal(withPart(picked, { kind: "leg", leg: 2 }, [4, 1]), null);
  assert.deepEqual(withPart(picked, { kind: "load" }, [3])?.all, [3]);
  assert.equal(withOne(picked, "fitted", 7, true)?.part, undefined, "what is added by hand belongs to no part");
});
