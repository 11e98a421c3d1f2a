/** What a residual may follow. */
import type { ConditionLists } from "../wire";

export interface Variable {
  id: string;
  title: string;
  unit: string;
  /** Value at a condition, for a leg (from zero). */
  value: (conditions: ConditionLists, index: number, leg: number) => number;
}

const COORDINATES = ["a", "b", "c", "alpha", "beta", "gamma"] as const;
const COMPONENTS = ["fx", "fy", "fz", "mx", "my", "mz"] as const;

export const VARIABLES: Variable[] = [
  { id: "leg-force", title: "change of leg force", unit: "N", value: (at, i, leg) => at.leg_force_n[i]?.[leg] ?? Number.NaN },
  { id: "leg-length", title: "leg length", unit: "mm", value: (at, i, leg) => at.leg_length_mm[i]?.[leg] ?? Number.NaN },
  ...COORDINATES.map((title, k) => ({
    id: title,
    title: `pose ${title}`,
    unit: k < 3 ? "mm" : "deg",
    value: (at: ConditionLists, i: number) => at.pose[i]?.[k] ?? Number.NaN,
  })),
  ...COMPONENTS.map((title, k) => ({
    id: title,
    title: `change of ${title}`,
    unit: k < 3 ? "N" : "N m",
    value: (at: ConditionLists, i: number) => at.wrench[i]?.[k] ?? Number.NaN,
  })),
  { id: "elapsed", title: "time since the reference", unit: "s", value: (at, i) => at.elapsed_s[i] ?? Number.NaN },
  { id: "delta-t", title: "change of temperature", unit: "K", value: (at, i) => at.delta_t_k[i] ?? Number.NaN },
  { id: "approach", title: "approach (load, or load and back)", unit: "1", value: (at, i) => at.approach[i] ?? Number.NaN },
  { id: "order", title: "condition", unit: "in file order", value: (_, i) => i + 1 },
];

/** Does it take more than one value in these data? */
export function varies(variable: Variable, conditions: ConditionLists): boolean {
  const count = conditions.pose.length;
  const first = variable.value(conditions, 0, 0);
  for (let i = 0; i < count; i++) {
    for (let leg = 0; leg < 6; leg++) {
      if (Math.abs(variable.value(conditions, i, leg) - first) > 1e-9) return true;
    }
  }
  return false;
}
