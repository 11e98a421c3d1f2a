/** Platform joints after a small motion, drawn too large. */
import type { Six, Three } from "../wire";

/**
 * Joints (mm, fixed frame) of a platform that moved by `motion` (um, urad, at `origin`, fixed axes), `factor` times too large:
 * `p + factor (v + w x (p - origin))`.
 */
export function displaced(joints: Three[], origin: Three, motion: Six, factor: number): Three[] {
  const [x, y, z, rx, ry, rz] = motion;
  return joints.map(([px, py, pz]) => {
    const [dx, dy, dz] = [px - origin[0], py - origin[1], pz - origin[2]];
    return [
      px + factor * (x * 1e-3 + (ry * dz - rz * dy) * 1e-6),
      py + factor * (y * 1e-3 + (rz * dx - rx * dz) * 1e-6),
      pz + factor * (z * 1e-3 + (rx * dy - ry * dx) * 1e-6),
    ];
  });
}
