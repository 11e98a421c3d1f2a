import assert from "node:assert/strict";
import { test } from "node:test";
import { here } from "../../src/page/here";

test("a way to read files is a button with its name, a full stop behind it or not", () => {
  const add = "to see the result with this correction, add ";
  const click = 'to see the result with this correction, click "Read as ';
  assert.equal(here(`${add}--read-as deflection-sign=reversed.`), `${click}deflection-sign=reversed".`);
  assert.equal(here(`${add}--read-as wrench-force=0.001`), `${click}wrench-force=0.001"`);
  assert.equal(here(`${add}--read-as a=b --read-as c=1.5; and`), `${click}a=b, then c=1.5"; and`);
});

test("an option is a place of the page, and nothing else changes", () => {
  assert.equal(here("To do: remove --read-as unit=0.001."), 'To do: click "Read as written".');
  assert.equal(here("leave a line out with `--exclude LINE`"), "leave a line out in the view Readings");
  assert.equal(
    here("m.csv is not the file of the session: its SHA-256 is 0a1b, not 2c3d"),
    "m.csv is not the file of the session: it holds other data than when the session was saved",
  );
  assert.equal(here("The springs alone explain these measurements."), "The springs alone explain these measurements.");
});
