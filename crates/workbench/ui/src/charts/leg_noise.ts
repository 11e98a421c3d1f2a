/** Noise of one reading seen as elongation of a leg. */
import type { Opened, Three } from "../wire";

/**
 * Standard deviation of the elongation of each leg, um, root mean square over the conditions shown: a leg's rate is `n . v + (r x n) . w`,
 * so its variance is `s_t^2 + s_r^2 |r x n|^2` (n direction of the leg, r platform joint from the mobile origin).
 */
export function legNoise(opened: Opened): number[] {
  const { conditions, noise } = opened;
  const count = conditions.pose.length;
  return opened.base_joints_mm.map((base, leg) => {
    let sum = 0;
    for (let i = 0; i < count; i++) {
      const joint = conditions.platform_joints_mm[i]?.[leg] ?? [0, 0, 0];
      const [a = 0, b = 0, c = 0] = conditions.pose[i] ?? [];
      // um of a lever in mm under urad: thousandths.
      const lever = length(cross(minus(joint, [a, b, c]), unit(minus(joint, base)))) / 1000;
      sum += noise.translation_um ** 2 + (noise.rotation_urad * lever) ** 2;
    }
    return Math.sqrt(sum / Math.max(count, 1));
  });
}

function minus(a: Three, b: Three): Three {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function cross(a: Three, b: Three): Three {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function length(a: Three): number {
  return Math.hypot(...a);
}

function unit(a: Three): Three {
  const size = length(a) || 1;
  return [a[0] / size, a[1] / size, a[2] / size];
}
