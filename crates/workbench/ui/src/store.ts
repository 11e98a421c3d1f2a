/** Holds the state, and changes what is loaded and what is ticked; what is asked about it is in asks.ts and session.ts, formulas in own/acts.ts. */
import { type Api, aborted, Refusal } from "./api";
import { examine } from "./asks";
import * as History from "./history";
import * as memory from "./memory";
import { USUAL_PACE } from "./plan/choice";
import { OPEN_ADDRESS, problemOf } from "./problem";
import { type Bench, type Busy, EMPTY, type Pick, type Problem, type State } from "./state";
import { untilDrawn } from "./stopwatch";
import { Tasks } from "./tasks";
import type { Open, Opened, Selection, SessionForesight, View } from "./wire";

const { SPRINGS } = History;

export class Store {
  private state: State = { ...EMPTY, scores: memory.rememberedScores() };
  private readonly listeners = new Set<() => void>();
  readonly tasks = new Tasks((change) => this.set({ busy: change(this.state.busy) }));

  constructor(private readonly api: Api | null) {
    if (api === null) {
      this.state.locked = true;
      this.state.problem = { place: "page", message: "This page has no access key.", next: OPEN_ADDRESS };
    }
  }

  get = (): State => this.state;

  subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };

  set(change: Partial<State>): void {
    this.state = { ...this.state, ...change };
    for (const listener of this.listeners) listener();
  }

  setBench(change: Partial<Bench>): void {
    if (this.state.bench === null) return;
    this.set({ bench: { ...this.state.bench, ...change } });
    if (change.wanted !== undefined) memory.rememberSelection(change.wanted);
  }

  /** Loads the catalogue, and what this tab had open before a reload. */
  async start(): Promise<void> {
    if (this.api === null) return;
    try {
      this.set({ catalogue: await this.api.catalogue(), problem: null });
    } catch (error) {
      this.set({ problem: problemOf(error, "page", () => void this.start()) });
      return;
    }
    const before = memory.rememberedBench();
    if (before !== null) {
      // What cannot be opened again is not tried at every reload.
      memory.forgetBench();
      const [notes, foreseen] = [memory.rememberedNotes(), memory.rememberedForesight()];
      await this.open(before.open, before.selection, memory.rememberedLooks());
      this.note(notes);
      this.foresee(foreseen);
    } else if (this.state.catalogue?.given) await this.open({ from: "given" });
  }

  /** Opens a bench; `selection` is ticked at once. What is open stays until the new one is there. */
  async open(open: Open, selection: Selection = SPRINGS, looks: readonly string[] = []): Promise<void> {
    const api = this.api;
    if (api === null) return;
    const before = this.state.bench;
    this.tasks.callOff();
    await this.during(
      "opening",
      "page",
      () => this.open(open, selection, looks),
      async (signal) => {
        const opened = await api.open(open, signal);
        this.show(opened, { ...open, ...seedOf(open, opened) } as Open, looks);
      },
    );
    const { bench } = this.state;
    if (bench === null || bench === before || this.state.problem !== null) return;
    const more = selection.terms.length + selection.own.length + selection.exclude.length > 0;
    if (more) await this.select(selection);
    void examine(this);
  }

  /** Shows what was opened. */
  show(opened: Opened, open: Open, looks: readonly string[]): void {
    const history = History.begin({ selection: SPRINGS, view: opened.view });
    this.set({
      bench: {
        opened,
        open,
        history,
        wanted: SPRINGS,
        checked: null,
        diagnosed: null,
        plan: null,
        pace: USUAL_PACE,
        discovered: null,
        revealed: null,
        trials: null,
        followed: null,
        pictured: null,
        looks,
        picked: null,
        notes: "",
        foreseen: null,
      },
      tick: null,
      problem: null,
    });
    memory.rememberOpen(open);
    memory.rememberSelection(SPRINGS);
    memory.rememberNotes("");
    memory.rememberForesight(null);
    this.looked([SPRINGS]);
  }

  /** Held-out errors of these models have been seen. */
  looked(models: Selection[]): void {
    const bench = this.state.bench;
    if (bench === null) return;
    const looks = [...new Set([...bench.looks, ...models.map(History.modelOf)])];
    this.setBench({ looks });
    memory.rememberLooks(looks);
  }

  /** Back to the start screen. */
  close(): void {
    this.tasks.callOff();
    memory.forgetBench();
    this.set({ bench: null, problem: null });
  }

  dismiss = (): void => this.set({ problem: null });

  /** Ticks or unticks a term. */
  toggle(id: string, start = performance.now()): void {
    const bench = this.state.bench;
    if (bench !== null) void this.select(History.toggled(bench.wanted, id), "page", start);
  }

  /** Asks for a ticked term in its richer or its ideal form. */
  changeForm(id: string, start = performance.now()): void {
    const bench = this.state.bench;
    if (bench !== null) void this.select(History.otherForm(bench.wanted, id), "page", start);
  }

  /** Unticks all. */
  springsAlone(): void {
    const bench = this.state.bench;
    if (bench !== null && bench.wanted.terms.length > 0) void this.select({ ...bench.wanted, terms: [] });
  }

  /** Asks for the view of a selection; the newest wins. True when it was drawn. */
  async select(selection: Selection, place: Problem["place"] = "page", start = performance.now()): Promise<boolean> {
    const signal = this.tasks.begin("fitting");
    this.setBench({ wanted: selection });
    this.set({ problem: null });
    try {
      const view = await this.viewOf(selection, signal);
      this.draw(selection, view, start);
      return true;
    } catch (error) {
      if (!aborted(error)) this.refuse(error, place, () => void this.select(selection, place));
      return false;
    } finally {
      this.tasks.end("fitting", signal);
    }
  }

  private draw(selection: Selection, view: View, start: number): void {
    const bench = this.state.bench;
    if (bench === null) return;
    this.setBench({ history: History.add(bench.history, { selection, view }), wanted: selection });
    this.looked([selection]);
    void untilDrawn(start, view.milliseconds, (total) => this.set({ tick: { total, server: view.milliseconds } }));
  }

  /** A selection that cannot be fitted is taken back; one that only got no answer stays wanted. */
  private refuse(error: unknown, place: Problem["place"], again: () => void): void {
    const bench = this.state.bench;
    if (bench !== null && error instanceof Refusal && error.status < 500) {
      this.setBench({ wanted: History.now(bench.history).selection });
    }
    this.set({ problem: problemOf(error, place, again) });
  }

  /** View of a selection; a bench the server no longer keeps is loaded again. */
  viewOf(selection: Selection, signal: AbortSignal): Promise<View> {
    return this.onBench((id, api) => api.view(id, selection, signal), signal);
  }

  async onBench<T>(ask: (id: string, api: Api) => Promise<T>, signal?: AbortSignal): Promise<T> {
    const { bench } = this.state;
    if (bench === null || this.api === null) throw new Error("no bench is open");
    try {
      return await ask(bench.opened.id, this.api);
    } catch (error) {
      if (!(error instanceof Refusal) || error.status !== 410) throw error;
      const opened = await this.api.open(bench.open, signal);
      this.setBench({ opened: { ...bench.opened, id: opened.id } });
      return ask(opened.id, this.api);
    }
  }

  undo(): void {
    this.step(-1);
  }

  redo(): void {
    this.step(1);
  }

  private step(by: number): void {
    const history = this.state.bench?.history;
    if (history !== undefined) this.goTo(history.at + by);
  }

  /** Shows a step of the history; nothing is asked, the answer is kept. */
  goTo(at: number): void {
    const bench = this.state.bench;
    if (bench === null) return;
    this.tasks.callOff("fitting");
    const history = History.goTo(bench.history, at);
    this.setBench({ history, wanted: History.now(history).selection });
  }

  /** Ticks what the diagnosis names. */
  tickNamed(ids: string[]): void {
    const bench = this.state.bench;
    if (bench !== null) void this.select({ ...bench.wanted, terms: ids });
  }

  /** Looks at some conditions, or at none. */
  pick(picked: Pick | null): void {
    if (picked !== (this.state.bench?.picked ?? null)) this.setBench({ picked });
  }

  /** Leaves readings out of the fit, by their lines, or puts them back. */
  countReadings(lines: number[], counted: boolean, start = performance.now()): void {
    const bench = this.state.bench;
    if (bench !== null) void this.select(History.withReadings(bench.wanted, lines, counted), "page", start);
  }

  /** Puts all readings back. */
  countAll(): void {
    const bench = this.state.bench;
    if (bench !== null) void this.select({ ...bench.wanted, exclude: [] });
  }

  /** Notes of the user. */
  note(notes: string): void {
    this.setBench({ notes });
    memory.rememberNotes(notes);
  }

  /** Keeps what readings that came were foreseen to tell. */
  foresee(foreseen: SessionForesight | null): void {
    this.setBench({ foreseen });
    memory.rememberForesight(foreseen);
  }

  /** Runs something slow: one at a time, with its failure shown; what nobody asked for takes no other problem off the page. */
  async during(
    busy: Busy,
    place: Problem["place"],
    again: () => Promise<void>,
    work: (signal: AbortSignal) => Promise<void>,
    isAsked = true,
  ): Promise<void> {
    const signal = this.tasks.begin(busy);
    if (isAsked) this.set({ problem: null });
    try {
      await work(signal);
    } catch (error) {
      if (!aborted(error)) this.set({ problem: problemOf(error, place, () => void again()) });
    } finally {
      this.tasks.end(busy, signal);
    }
  }

  /** The user does not want to wait any longer: what is shown stays, and what is ticked is what is shown. */
  cancel(busy: Busy): void {
    this.tasks.callOff(busy);
    const bench = this.state.bench;
    if (busy === "fitting" && bench !== null) this.setBench({ wanted: History.now(bench.history).selection });
  }
}

/** A simulation or game is remembered with the seed it was made from, so that it can be made again. */
function seedOf(open: Open, opened: Opened): { seed?: number } {
  const seeded = open.from === "simulation" || open.from === "game";
  return seeded && opened.seed !== null ? { seed: opened.seed } : {};
}
