/** Work that leaves the page and comes back: a session saved and opened again, readings taken by a run sheet. */
import { examine } from "./asks";
import { beforeOf } from "./bench/came";
import { download } from "./download";
import * as History from "./history";
import { readLike } from "./read_as";
import type { Store } from "./store";
import type { FileText, SessionForm } from "./wire";

/** Saves the session as a file or as a page. */
export async function keep(store: Store, form: SessionForm): Promise<void> {
  const bench = store.get().bench;
  if (bench === null) return;
  const { steps, at } = bench.history;
  const taken = steps.map(({ selection, view }) => ({ selection, times_noise: view.times_noise }));
  await store.during(
    "exporting",
    "page",
    () => keep(store, form),
    async (signal) => {
      const session = { form, steps: taken, at, notes: bench.notes, foreseen: bench.foreseen };
      const file = await store.onBench((id, api) => api.keep(id, session, signal), signal);
      download(file.name, file.media, file.text);
    },
  );
}

/** Goes on with a saved session: its steps are fitted again. */
export async function resume(store: Store, file: FileText): Promise<void> {
  if (store.get().bench === null) return;
  store.tasks.callOff();
  await store.during(
    "resuming",
    "page",
    () => resume(store, file),
    async (signal) => {
      const { read_as, steps, at, notes, foreseen } = await store.onBench((id, api) => api.resume(id, file, signal), signal);
      await readLike(store, read_as, signal);
      const done: History.Step[] = [];
      for (const { selection } of steps) {
        store.set({ progress: { done: done.length, of: steps.length } });
        done.push({ selection, view: await store.viewOf(selection, signal) });
      }
      const history = { steps: done, at };
      store.setBench({ history, wanted: History.now(history).selection });
      store.note(notes);
      store.foresee(foreseen);
      store.looked(steps.map(({ selection }) => selection));
    },
  );
  void examine(store);
}

/** Fits readings that were taken since with the others; like everything that is opened, they are diagnosed at once. */
export async function append(store: Store, readings: FileText): Promise<void> {
  const bench = store.get().bench;
  if (bench === null) return;
  const { opened, notes, diagnosed, plan } = bench;
  await store.open({ from: "more", base: bench.open, readings }, History.now(bench.history).selection, bench.looks);
  const now = store.get().bench;
  if (now === null || now.opened === opened || now.open.from !== "more") return;
  store.note(notes);
  const came = now.opened.readings - opened.readings;
  if (diagnosed !== null) {
    const { diagnosis } = diagnosed.answer;
    const separation = plan?.answer.separation ?? diagnosis.separation;
    store.foresee({ before: beforeOf({ ...diagnosis, separation }), readings: came });
  }
}

/** A file that is of no use here. */
export function refuseFile(store: Store, name: string): void {
  store.set({
    problem: { place: "page", message: `${name} is not a session file.`, next: "Open a session.json file that the workbench saved." },
  });
}
