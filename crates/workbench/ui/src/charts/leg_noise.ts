/** Noise of one reading seen as elongation of a leg. */
import { cross, length, minus, unit } from "../machine/vectors";
import type { Opened } from "../wire";

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
