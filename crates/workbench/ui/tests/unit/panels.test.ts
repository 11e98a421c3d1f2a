import assert from "node:assert/strict";
import { test } from "node:test";
import { looks } from "../../src/charts/looks";
import { drawing, legendRows, reachOf } from "../../src/charts/panels";

test("an axis reaches just beyond the largest value", () => {
  for (const value of [1e-7, 0.031, 0.99, 1, 1.19, 7.9, 9.99, 123, 99999]) {
    const reach = reachOf([value, -0.2 * value]);
    assert.ok(reach >= value * 1.02 && reach <= value * 1.75, `${reach} for ${value}`);
  }
  assert.equal(reachOf([]), 1);
});

test("a legend that does not fit in a row takes more, and the panels make room", () => {
  const names = ["springs alone leave", "the model leaves", "mean of a bin", "course asked about"];
  assert.deepEqual(
    [2000, 400, 150].map((width) => legendRows(names, width)),
    [1, 2, 4],
  );
  const top = (width: number) => {
    const sheet = { panels: [{ title: "", series: [] }], x: "", across: 1, legend: names, tooltip: () => "" };
    const { option } = drawing(sheet, width, looks(false));
    return (option.title as { top: number }[])[0]?.top ?? 0;
  };
  assert.ok(top(300) > top(2000));
});
