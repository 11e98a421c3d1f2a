import assert from "node:assert/strict";
import { test } from "node:test";
import { legNoise } from "../../src/charts/leg_noise";
import { displaced } from "../../src/machine/displaced";
import type { Opened, Six, Three } from "../../src/wire";

const BASE: Three = [200, 0, -300];
const JOINT: Three = [100, 50, 10];
const ORIGIN: Three = [5, -3, 8];

/** Change of length, um, for a motion (um, urad): finite difference over the geometry the page draws. */
function stretched(motion: Six): number {
  const length = ([x, y, z]: Three) => 1000 * Math.hypot(x - BASE[0], y - BASE[1], z - BASE[2]);
  const [after] = displaced([JOINT], ORIGIN, motion, 1);
  return length(after ?? JOINT) - length(JOINT);
}

test("noise of a leg is that of its change of length", () => {
  const noise = { translation_um: 0.5, rotation_urad: 3, source: "" };
  const conditions = { pose: [[...ORIGIN, 0, 0, 0]], platform_joints_mm: [[JOINT]] };
  const [found = 0] = legNoise({ base_joints_mm: [BASE], noise, conditions } as unknown as Opened);
  const variance = [0, 1, 2, 3, 4, 5].map((k) => {
    const sigma = k < 3 ? noise.translation_um : noise.rotation_urad;
    return stretched([0, 1, 2, 3, 4, 5].map((j) => (j === k ? sigma : 0)) as Six) ** 2;
  });
  const expected = Math.sqrt(variance.reduce((a, b) => a + b, 0));
  // Curvature of the length over micrometres: parts in a million.
  assert.ok(Math.abs(found / expected - 1) < 1e-5, `found ${found}, expected ${expected}`);
});
