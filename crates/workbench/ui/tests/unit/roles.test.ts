import assert from "node:assert/strict";
import { test } from "node:test";
import { missing, withFiles } from "../../src/start/roles";

const MACHINE = { name: "machine.txt", text: 'format = "hexapod/1"\nname = "m"\n' };
const roles = (...files: { name: string; text: string }[]) => withFiles([], files).map(({ role }) => role);

test("files are told apart by content, then by name", () => {
  assert.deepEqual(roles(MACHINE, { name: "measurements.csv", text: "pose,a_mm" }, { name: "holdout.csv", text: "pose,a_mm" }), [
    "hexapod",
    "data",
    "holdout",
  ]);
  assert.deepEqual(roles({ name: "one.csv", text: "pose,a_mm" }, { name: "two.csv", text: "pose,a_mm" }), ["data", "holdout"]);
  assert.deepEqual(roles({ name: "mine.toml", text: 'format = "term/1"' }), ["term"]);
  assert.deepEqual(roles({ name: "session.json", text: '{"format":"session/1","program":"hexbench"}' }), ["session"]);
  assert.deepEqual(roles({ name: "picture.png", text: "PNG" }), ["none"]);
});

test("what is missing or given twice is said", () => {
  assert.match(missing(withFiles([], [MACHINE])), /measurements are missing/);
  assert.match(missing(withFiles([], [{ name: "m.csv", text: "," }])), /machine file is missing/);
  assert.match(missing(withFiles([], [MACHINE, { ...MACHINE, name: "other.toml" }, { name: "m.csv", text: "," }])), /Two files/);
  assert.equal(missing(withFiles([], [MACHINE, { name: "m.csv", text: "," }])), "");
});

test("a file chosen again replaces the old one", () => {
  const files = withFiles(withFiles([], [MACHINE]), [{ ...MACHINE, text: `${MACHINE.text}# new` }]);
  assert.equal(files.length, 1);
  assert.match(files[0]?.text ?? "", /# new/);
});
