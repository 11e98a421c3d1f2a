import assert from "node:assert/strict";
import { test } from "node:test";
import { looks } from "../../src/charts/looks";
import { Camera } from "../../src/machine/camera";
import { nearest } from "../../src/machine/hover";
import { load } from "../../src/machine/parts";
import { roundLength } from "../../src/machine/scale_bar";
import { VIEWS } from "../../src/machine/views";
import type { Three } from "../../src/wire";

const SIZE = { width: 800, height: 600 };

function camera({ azimuth, elevation }: { azimuth: number; elevation: number }): Camera {
  return new Camera([0, 0, 0], 1000, azimuth, elevation, SIZE);
}

test("usual sides: x to the right from the front and from above, y from the side", () => {
  const across = (view: keyof typeof VIEWS, point: Three) => camera(VIEWS[view]).see(point).x - SIZE.width / 2;
  assert.ok(across("front", [100, 0, 0]) > 50 && Math.abs(across("front", [0, 100, 0])) < 1e-6);
  assert.ok(across("side", [0, 100, 0]) > 50 && Math.abs(across("side", [100, 0, 0])) < 1e-6);
  const above = camera(VIEWS.above).see([0, 100, 0]);
  assert.ok(across("above", [100, 0, 0]) > 50 && above.y < SIZE.height / 2 - 50, "y is up");
});

test("a bar of scale is 1, 2 or 5 times a power of ten", () => {
  assert.deepEqual(
    [0.9, 1, 2.5, 4.9, 5, 73, 0.02].map(roundLength).map((x) => Number(x.toPrecision(6))),
    [0.5, 1, 2, 2, 5, 50, 0.02],
  );
});

test("the pointer finds the leg it is at, and none where none is near", () => {
  const front = camera(VIEWS.front);
  const leg = (x: number, text: string) => ({ of: x, from: [x, 0, -100] as Three, to: [x, 0, 100] as Three, text });
  const legs = [leg(-50, "leg 1"), leg(50, "leg 2")];
  const { x, y } = front.see([50, 0, 20]);
  assert.equal(nearest(legs, front, x + 3, y)?.text, "leg 2");
  assert.equal(nearest(legs, front, SIZE.width / 2, y), null);
});

test("a load is drawn to scale, with its size beside it", () => {
  const arrow = (force: number) => load([force, 0, 0, 0, 0, 0], [200, 1], [0, 0, 0], 100, looks(false));
  const tip = (force: number) => {
    const head = arrow(force).find((shape) => shape.kind === "head");
    return head?.kind === "head" ? head.to[0] : 0;
  };
  assert.ok(Math.abs(tip(200) / tip(100) - 2) < 1e-9, `${tip(200)} ${tip(100)}`);
  assert.ok(arrow(100).some((shape) => shape.kind === "text" && shape.text === "100 N"));
  assert.deepEqual(arrow(0), []);
});
