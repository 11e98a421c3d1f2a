/** Readings that a part of the machine stands for. */
import { legNoise } from "../charts/leg_noise";
import { withPart } from "../picks";
import type { Bench, Part } from "../state";
import type { Store } from "../store";
import type { Opened, Six, View } from "../wire";

/** The leg that is missed most, and by how many times its noise. */
export function worstLeg(residual: Six, noise: number[]): { leg: number; times: number } {
  const sizes = residual.map((value, leg) => Math.abs(value) / (noise[leg] || 1));
  const times = Math.max(...sizes);
  return { leg: sizes.indexOf(times), times };
}

/**
 * Conditions that a part stands for, the one to look at last. Of a leg: those in which it is missed more than the other legs, else the
 * one in which it is missed most; the largest residual is looked at. Of the load: those under the load of the condition shown.
 */
export function conditionsOf(part: Part, opened: Opened, { residual_um }: View, shown: number): number[] {
  if (part.kind === "load") {
    const load = JSON.stringify(opened.conditions.wrench[shown]);
    const same = opened.conditions.wrench.flatMap((wrench, i) => (i !== shown && JSON.stringify(wrench) === load ? [i] : []));
    return [...same, shown];
  }
  const noise = legNoise(opened);
  const sizeOf = (index: number) => Math.abs(residual_um[index]?.[part.leg] ?? 0);
  const bySize = residual_um.map((_, index) => index).sort((a, b) => sizeOf(a) - sizeOf(b));
  const missed = bySize.filter((index) => worstLeg(residual_um[index] as Six, noise).leg === part.leg);
  return missed.length > 0 ? missed : bySize.slice(-1);
}

/** Picks the readings of a part, or takes them back. */
export function pickPart(store: Store, bench: Bench, part: Part, view: View, shown: number): void {
  store.pick(withPart(bench.picked, part, conditionsOf(part, bench.opened, view, shown)));
}

/** What is said of readings picked by a part. */
export function partWords(part: Part): string {
  return part.kind === "leg" ? `missed most in leg ${part.leg + 1}` : "under the same load";
}
