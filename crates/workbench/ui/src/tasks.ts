/** What is under way: each kind once, the newest wins, and all of it can be called off. */
import type { Busy } from "./state";

export class Tasks {
  private readonly running = new Map<Busy, AbortController>();

  /** `tell` is given how the list of what is under way changes. */
  constructor(private readonly tell: (change: (busy: Busy[]) => Busy[]) => void) {}

  /** Something is under way; the same thing begun before is called off. */
  begin(busy: Busy): AbortSignal {
    this.running.get(busy)?.abort();
    const control = new AbortController();
    this.running.set(busy, control);
    this.tell((all) => [...all.filter((other) => other !== busy), busy]);
    return control.signal;
  }

  /** It has come to its end, unless a newer one has taken its place. */
  end(busy: Busy, signal: AbortSignal): void {
    if (this.running.get(busy)?.signal !== signal) return;
    this.running.delete(busy);
    this.tell((all) => all.filter((other) => other !== busy));
  }

  /** Calls off what is under way, or one thing of it. */
  callOff(only?: Busy): void {
    for (const [busy, control] of this.running) if (only === undefined || busy === only) control.abort();
  }
}
