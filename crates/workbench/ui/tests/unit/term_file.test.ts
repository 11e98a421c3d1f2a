import assert from "node:assert/strict";
import { test } from "node:test";
import { idOf, type OwnTerm, offsetOf, parsed, placeIn, pointedAt, written } from "../../src/own/term_file";

const TERM: OwnTerm = {
  id: "my-effect",
  title: 'Legs "soften"',
  elongation: "size * (q - q_home) * df",
  parameters: [{ name: "size", unit: "1", scale: "0.5", perSi: "1e6", positive: true }],
};

test("the form writes a file that it reads back", () => {
  assert.deepEqual(parsed(written(TERM)), TERM);
  assert.equal(idOf(written(TERM)), "my-effect");
});

test("comments are read over, and a file that says more than the form is left alone", () => {
  assert.deepEqual(parsed(`# mine\n${written(TERM)}  # end\n`), TERM);
  assert.equal(parsed(`${written(TERM)}\n[shape]\nname = "p"\n`), null);
  assert.equal(parsed('format = "term/1"\nwrench = ["", ""]\n'), null);
  assert.equal(parsed(`${written(TERM)}\nbroken =\n`), null);
});

test("the place that a message names is found in the text", () => {
  const place = placeIn("my-effect.toml, line 3, column 9: unknown name");
  assert.deepEqual(place, { line: 3, column: 9 });
  assert.equal(placeIn("no place"), null);
  assert.equal("ab\ncd\nefghijklmnop".charAt(offsetOf("ab\ncd\nefghijklmnop", place ?? { line: 1, column: 1 })), "m");
});

test("a message without a place points at the words it quotes", () => {
  const text = 'id = "a"\nelongation = "size * nonsense"\n';
  const [from, to] = pointedAt(text, "`nonsense` is not a known variable, parameter or function") ?? [0, 0];
  assert.equal(text.slice(from, to), "nonsense");
  assert.equal(pointedAt(text, "`elsewhere` is unknown"), null);
  assert.deepEqual(pointedAt(text, "line 99, column 99"), [text.length, text.length]);
});
