/** Readings beside the model: those it is fitted to, or those of the holdout file. */
import type { ConditionLists, Opened, Six, View } from "../wire";

export type Which = "fitted" | "held-out";

export const WHICH: { id: Which; title: string }[] = [
  { id: "fitted", title: "fitted readings" },
  { id: "held-out", title: "held-out readings" },
];

/** A model beside such readings, an entry per condition in every list. */
export interface Readings {
  conditions: ConditionLists;
  measured: Six[];
  predicted: Six[];
  residual_um: Six[];
}

/** Are readings of a holdout file there to be shown? */
export function hasHeldOut({ held_out }: Opened): boolean {
  return held_out !== null;
}

export function readings(which: Which, opened: Opened, view: View): Readings {
  const held = view.held_out_readings;
  if (which === "held-out" && opened.held_out !== null && held !== null) return { conditions: opened.held_out, ...held };
  const { conditions } = opened;
  return { conditions, measured: conditions.measured, predicted: view.predicted, residual_um: view.residual_um };
}
