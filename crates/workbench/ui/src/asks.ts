/** What is asked about the bench beside a view of what is ticked: diagnosis, law, trials, pictures, files, the envelope. */
import { type Api, aborted } from "./api";
import { download } from "./download";
import * as History from "./history";
import * as memory from "./memory";
import { AS_PROPOSED } from "./plan/choice";
import { problemOf } from "./problem";
import type { Busy } from "./state";
import { drawn } from "./stopwatch";
import type { Store } from "./store";
import type { Ask, Followed, Pictured, Selection, What } from "./wire";

/** What the residuals of a step follow, and its picture, kept so that going back asks for nothing. */
const follows = new WeakMap<History.Step, Followed>();
const pictures = new WeakMap<History.Step, Pictured>();

/** Judges what was opened before anybody asks; in a game that is the player's to ask for. */
export async function examine(store: Store): Promise<void> {
  const { bench } = store.get();
  if (bench === null || bench.opened.sealed) return;
  await check(store);
  const now = store.get().bench;
  // Called off, or something else was opened.
  if (now === null || now.open !== bench.open || now.checked === null) return;
  if (now.diagnosed === null || isStale(now.diagnosed.asked, now.wanted)) await diagnose(store, false);
}

/** Have formulas or the readings left out changed since this was asked? */
export function isStale(asked: Ask, wanted: Selection): boolean {
  return JSON.stringify(asked) !== JSON.stringify(askedOf(wanted));
}

/** Asks what is wrong with the files. */
async function check(store: Store): Promise<void> {
  const { bench } = store.get();
  if (bench === null || bench.checked !== null) return;
  await store.during(
    "checking",
    "page",
    () => examine(store),
    async (signal) => {
      const checked = await store.onBench((id, api) => api.check(id, askedOf(bench.wanted), signal), signal);
      store.setBench({ checked });
    },
    false,
  );
}

/** Weighs all explanations. */
export async function diagnose(store: Store, isAsked = true): Promise<void> {
  const { bench } = store.get();
  if (bench === null) return;
  const asked = askedOf(bench.wanted);
  await store.during(
    "diagnosing",
    "page",
    () => diagnose(store),
    async (signal) => {
      const answer = await store.onBench((id, api) => api.diagnose(id, asked, signal), signal);
      store.setBench({ diagnosed: { answer, asked }, plan: null });
    },
    isAsked,
  );
}

/** Searches the law that no catalogue has. */
export async function discover(store: Store): Promise<void> {
  const { bench } = store.get();
  if (bench === null) return;
  const asked = askedOf(bench.wanted);
  await store.during(
    "discovering",
    "page",
    () => discover(store),
    async (signal) => {
      const answer = await store.onBench((id, api) => api.discover(id, asked, signal), signal);
      store.setBench({ discovered: { answer } });
    },
  );
}

/** Asks for the held-out error of every term that could be ticked as well. */
export async function tryEach(store: Store, ids: string[]): Promise<void> {
  const { bench } = store.get();
  if (bench === null) return;
  const step = History.now(bench.history);
  await store.during(
    "trying",
    "page",
    () => tryEach(store, ids),
    async (signal) => {
      const { trials } = await store.onBench((id, api) => api.tryEach(id, ids, step.selection, signal), signal);
      store.setBench({ trials: { step, found: trials } });
      store.looked(trials.map(({ term }) => History.toggled(step.selection, term)));
    },
  );
}

/** Asks what the residuals of the step shown follow. */
export function follow(store: Store): Promise<void> {
  const tell = (step: History.Step, answer: Followed) => store.setBench({ followed: { step, answer } });
  return ofStep(store, "following", follows, (id, api, of, signal) => api.followed(id, of, signal), tell);
}

/** Asks for the picture of the step shown. */
export function picture(store: Store): Promise<void> {
  const tell = (step: History.Step, answer: Pictured) => store.setBench({ pictured: { step, answer } });
  return ofStep(store, "picturing", pictures, (id, api, of, signal) => api.picture(id, of, signal), tell);
}

/** Asks for something about the step shown, unless it is known; only the newest question is answered. */
async function ofStep<T>(
  store: Store,
  busy: Busy,
  known: WeakMap<History.Step, T>,
  ask: (id: string, api: Api, of: Selection, signal: AbortSignal) => Promise<T>,
  tell: (step: History.Step, answer: T) => void,
): Promise<void> {
  const { bench } = store.get();
  if (bench === null) return;
  const step = History.now(bench.history);
  const before = known.get(step);
  if (before !== undefined) {
    store.tasks.callOff(busy);
    return tell(step, before);
  }
  const signal = store.tasks.begin(busy);
  try {
    // First the step is drawn: to draw and to compute at once would take turns on the same cores.
    await drawn();
    if (signal.aborted) return;
    const answer = await store.onBench((id, api) => ask(id, api, step.selection, signal), signal);
    known.set(step, answer);
    if (!signal.aborted && store.get().bench?.open === bench.open) tell(step, answer);
  } catch (error) {
    if (!aborted(error)) store.set({ problem: problemOf(error, "page", () => void ofStep(store, busy, known, ask, tell)) });
  } finally {
    store.tasks.end(busy, signal);
  }
}

/** Takes a file home. */
export async function takeHome(store: Store, what: What): Promise<void> {
  const { bench } = store.get();
  if (bench === null) return;
  await store.during(
    "exporting",
    "page",
    () => takeHome(store, what),
    async (signal) => {
      const file = await store.onBench((id, api) => api.export(id, what, bench.plan?.wanted ?? AS_PROPOSED, bench.wanted, signal), signal);
      download(file.name, file.media, file.text);
    },
  );
}

/** Ends a game. */
export async function reveal(store: Store, guess: string[]): Promise<void> {
  const { bench } = store.get();
  if (bench === null || bench.open.from !== "game") return;
  const { level } = bench.open;
  await store.during(
    "revealing",
    "page",
    () => reveal(store, guess),
    async (signal) => {
      const answer = await store.onBench((id, api) => api.reveal(id, guess, signal), signal);
      const scores = [...store.get().scores, { level, right: answer.right, helped: bench.diagnosed !== null }];
      memory.rememberScores(scores);
      store.setBench({ revealed: { answer, guess } });
      store.set({ scores });
    },
  );
}

/** What a diagnosis weighs. */
function askedOf({ own, exclude }: Selection): Ask {
  return { own, exclude };
}
