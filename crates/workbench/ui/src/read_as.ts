/** Files read differently from what they say, as a finding names it, or as they are written again. */
import type { Bench } from "./state";
import type { Store } from "./store";
import type { Open } from "./wire";

/** Reads the files with these changes; like everything that is opened, they are diagnosed at once. */
export async function readAs(store: Store, changes: string[]): Promise<void> {
  const { bench } = store.get();
  if (bench !== null) await again(store, bench, { from: "read-as", base: bench.open, changes });
}

/** Reads the files as they are written. */
export async function readAsWritten(store: Store): Promise<void> {
  const { bench } = store.get();
  if (bench?.open.from === "read-as") await again(store, bench, bench.open.base);
}

/** Reads the files as a session does; nothing of what was done stays. */
export async function readLike(store: Store, changes: string[], signal: AbortSignal): Promise<void> {
  const { bench } = store.get();
  if (bench === null || changes.join() === bench.opened.read_as.join()) return;
  const base = asWritten(bench.open);
  const open: Open = changes.length === 0 ? base : { from: "read-as", base, changes };
  const opened = await store.onBench((_, api) => api.open(open, signal), signal);
  if (!signal.aborted) store.show(opened, open, []);
}

/** The same files without the ways in which they are read differently. */
function asWritten(open: Open): Open {
  if (open.from === "read-as") return asWritten(open.base);
  return open.from === "more" ? { ...open, base: asWritten(open.base) } : open;
}

/** Formulas, readings left out and notes stay; ticked terms were an answer to other readings. */
async function again(store: Store, before: Bench, open: Open): Promise<void> {
  await store.open(open, { ...before.wanted, terms: [] });
  if (store.get().bench?.opened === before.opened) return;
  store.note(before.notes);
}
