/** Files read differently from what they say, as a finding names it, or as they are written again. */
import { diagnose } from "./asks";
import type { Bench } from "./state";
import type { Store } from "./store";
import type { Open } from "./wire";

/** Reads the files with these changes, and weighs everything again. */
export async function readAs(store: Store, changes: string[]): Promise<void> {
  const { bench } = store.get();
  if (bench !== null) await again(store, bench, { from: "read-as", base: bench.open, changes });
}

/** Reads the files as they are written. */
export async function readAsWritten(store: Store): Promise<void> {
  const { bench } = store.get();
  if (bench?.open.from === "read-as") await again(store, bench, bench.open.base);
}

/** Formulas, readings left out and notes stay; ticked terms were an answer to other readings. */
async function again(store: Store, before: Bench, open: Open): Promise<void> {
  await store.open(open, { ...before.wanted, terms: [] });
  if (store.get().bench?.opened === before.opened) return;
  store.note(before.notes);
  await diagnose(store);
}
