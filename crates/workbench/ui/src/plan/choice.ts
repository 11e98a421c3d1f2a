/** Which of the proposed readings are taken, and what they promise. */
import { aborted } from "../api";
import { problemOf } from "../problem";
import type { Bench } from "../state";
import type { Store } from "../store";
import type { MeasuringPace, NextReport, PlannedReadings, ReadingChoice } from "../wire";

/** A plan of the diagnosis shown. */
export interface Plan {
  wanted: ReadingChoice;
  /** The newest answer and the choice it belongs to. */
  answer: PlannedReadings;
  of: ReadingChoice;
  /** The reading that is picked, in the table and in the machine. */
  picked: number | null;
}

/** As the diagnosis proposes. */
export const AS_PROPOSED: ReadingChoice = { number: null, repeats: [] };
/** Readings of a plan at most; the server accepts no more. */
export const MOST_READINGS = 60;
/** Hours for a plan at most. */
export const MOST_HOURS = 10000;
/** What measuring takes until somebody says otherwise. */
export const USUAL_PACE: MeasuringPace = { reading_s: 40, load_change_s: 30, pose_change_s: 120 };

/** How often each of the readings is taken as things are wanted. */
export function repeatsOf({ wanted, answer }: Pick<Plan, "wanted" | "answer">): number[] {
  return answer.next.map(({ repeats }, k) => wanted.repeats[k] ?? repeats);
}

export function totalOf(repeats: number[]): number {
  return repeats.reduce((sum, one) => sum + one, 0);
}

/** The choice with a reading taken once more or once less. */
export function withOneMore(plan: Plan, reading: number, by: 1 | -1): ReadingChoice {
  const repeats = repeatsOf(plan).map((count, k) => (k === reading ? Math.max(0, count + by) : count));
  return { ...plan.wanted, repeats };
}

/** Is what is shown not yet what is wanted? */
export function isStale({ wanted, of }: Plan): boolean {
  return JSON.stringify(wanted) !== JSON.stringify(of);
}

/** Asks what readings promise; the newest choice wins, and what was shown stays until then. */
export function choose(store: Store, wanted: ReadingChoice): Promise<void> {
  return ask(store, wanted, null);
}

/** Takes as many readings as fit in so many hours. */
export function chooseWithin(store: Store, hours: number): Promise<void> {
  return ask(store, AS_PROPOSED, hours);
}

async function ask(store: Store, wanted: ReadingChoice, hours: number | null): Promise<void> {
  const bench = store.get().bench;
  const asked = bench?.diagnosed?.asked;
  if (bench === null || asked === undefined) return;
  if (bench.plan !== null) store.setBench({ plan: { ...bench.plan, wanted } });
  const signal = store.tasks.begin("planning");
  try {
    const answer = await store.onBench((id, api) => api.plan(id, { ...asked, choice: wanted, pace: bench.pace, hours }, signal), signal);
    const now = store.get().bench;
    if (signal.aborted || now?.diagnosed?.asked !== asked) return;
    const picked = now.plan?.picked ?? null;
    const of = hours === null ? wanted : { number: totalOf(answer.next.map(({ repeats }) => repeats)), repeats: [] };
    store.setBench({ plan: { wanted: of, answer, of, picked: picked !== null && picked < answer.next.length ? picked : null } });
  } catch (error) {
    if (aborted(error)) return;
    const plan = store.get().bench?.plan ?? null;
    // What cannot be had is not wanted any more.
    if (plan !== null) store.setBench({ plan: { ...plan, wanted: plan.of } });
    store.set({ problem: problemOf(error, "page", () => void ask(store, wanted, hours)) });
  } finally {
    store.tasks.end("planning", signal);
  }
}

/** Picks a reading, or takes it back. */
export function pickReading(store: Store, bench: Bench, reading: number): void {
  const { plan } = bench;
  if (plan !== null) store.setBench({ plan: { ...plan, picked: plan.picked === reading ? null : reading } });
}

/** The change of the load of a reading: N, N m. */
export function loadOf({ wrench, reference }: NextReport): NextReport["wrench"] {
  return wrench.map((value, k) => value - (reference[k] ?? 0)) as NextReport["wrench"];
}
