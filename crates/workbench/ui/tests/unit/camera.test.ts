import assert from "node:assert/strict";
import { test } from "node:test";
import { Camera } from "../../src/machine/camera";
import { mixed } from "../../src/machine/paint";

const SIZE = { width: 800, height: 600 };
const near = (a: number, b: number) => assert.ok(Math.abs(a - b) < 1e-9, `${a} ${b}`);

test("what is looked at stands in the middle, and z points upwards", () => {
  const camera = new Camera([10, 20, 30], 1000, -0.9, 0.35, SIZE);
  const middle = camera.see([10, 20, 30]);
  near(middle.x, 400);
  near(middle.y, 300);
  near(middle.depth, 1000);
  const above = camera.see([10, 20, 40]);
  near(above.x, 400);
  assert.ok(above.y < middle.y);
});

test("from the front, x points to the right, and what is nearer is larger", () => {
  const camera = new Camera([0, 0, 0], 1000, -Math.PI / 2, 0, SIZE);
  assert.ok(camera.see([10, 0, 0]).x > 400);
  const [close, far] = [camera.see([0, -100, 0]), camera.see([0, 100, 0])];
  assert.ok(close.depth < far.depth && close.scale > far.scale);
  near(camera.see([0, 0, 0]).scale, 600 / (2 * Math.tan((17.5 * Math.PI) / 180) * 1000));
});

test("colours are mixed by their shares", () => {
  assert.equal(mixed("#000000", "#ffffff", 0), "#000000");
  assert.equal(mixed("#000000", "#ff8000", 0.5), "#804000");
});
