/** Something under way, shown when it lasts, wherever the page is scrolled to: what, for how long, and a way to end it. */
import { useEffect, useState } from "preact/hooks";
import type { Busy, State } from "./state";
import type { Store } from "./store";

/** What is done sooner is not announced. */
const LASTS_MS = 400;
const SECOND_MS = 1000;

const WORDS: Record<Busy, string> = {
  opening: "Loading and fitting the springs",
  checking: "Checking the files",
  fitting: "Fitting",
  following: "Testing what the residuals follow",
  picturing: "Drawing the current step",
  diagnosing: "Comparing all explanations",
  planning: "Computing what the readings promise",
  discovering: "Searching for a law",
  exporting: "Writing the file",
  revealing: "Opening the envelope",
  trying: "Trying each term",
  resuming: "Fitting the steps of the session",
};

export function BusyLine({ store, state }: { store: Store; state: State }) {
  const busy = state.busy.at(-1) ?? null;
  const seconds = useLasting(busy);
  const shown = busy !== null && seconds !== null;
  return (
    <aside class={shown ? "busy shown" : "busy"} aria-label="Under way" data-testid="busy">
      {/* Always there: what comes into it is spoken. */}
      <p role="status">{shown ? `${WORDS[busy]} ...` : ""}</p>
      {shown && (
        <>
          <Progress what={WORDS[busy]} progress={busy === "resuming" ? state.progress : null} />
          <span class="seconds">{seconds} s</span>
          <button type="button" data-testid="cancel" onClick={() => store.cancel(busy)}>
            Cancel
          </button>
        </>
      )}
    </aside>
  );
}

/** A bar that is filled as far as is known, or only moves. */
function Progress({ what, progress }: { what: string; progress: State["progress"] }) {
  if (progress === null) return <progress aria-label={what} />;
  return <progress aria-label={what} value={progress.done} max={progress.of} />;
}

/** Whole seconds since this began; null until it has lasted. */
function useLasting(busy: Busy | null): number | null {
  const [seconds, setSeconds] = useState<number | null>(null);
  useEffect(() => {
    setSeconds(null);
    if (busy === null) return;
    const since = performance.now();
    const tell = () => setSeconds(Math.floor((performance.now() - since) / SECOND_MS));
    const timers = [setTimeout(tell, LASTS_MS), setInterval(tell, SECOND_MS)];
    return () => timers.forEach(clearTimeout);
  }, [busy]);
  return seconds;
}
