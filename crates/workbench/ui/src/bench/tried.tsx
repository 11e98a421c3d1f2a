/** What each term gains beside those ticked: the most on held-out readings first, only what is more than chance marked. */
import { chance, digits, times } from "../format";
import { now } from "../history";
import type { Bench } from "../state";
import type { Store } from "../store";
import type { TermTrial } from "../wire";

/** Terms shown at least, however little they gain. */
const FEWEST = 3;

export function Tried({ store, bench }: { store: Store; bench: Bench }) {
  const { trials, history } = bench;
  if (trials === null || trials.step !== now(history)) return null;
  const better = trials.found.filter((trial) => trial.better).length;
  const first = trials.found.slice(0, Math.max(FEWEST, better));
  const rest = trials.found.slice(first.length);
  return (
    <div class="tried" data-testid="tried" aria-live="polite">
      <p>
        {better === 0
          ? `None of ${trials.found.length} terms gives a significant gain.`
          : `${better} of ${trials.found.length} terms ${better === 1 ? "gives" : "give"} a significant gain; this alone does not prove a cause.`}{" "}
        Gain: how much better the held-out readings are predicted (logarithm of their density); then the error over the noise.
      </p>
      <Rows trials={first} store={store} />
      {rest.length > 0 && (
        <details>
          <summary>Other terms</summary>
          <Rows trials={rest} store={store} />
        </details>
      )}
    </div>
  );
}

/** What the terms are sorted by. */
function gained({ gain }: TermTrial): string {
  return gain === null ? "" : `gain ${digits(gain, 2)}; `;
}

function Rows({ trials, store }: { trials: TermTrial[]; store: Store }) {
  return (
    <ol>
      {trials.map((trial) => (
        <li key={trial.term} class={trial.better ? "trial good" : "trial"} data-testid={`trial-${trial.term}`}>
          <button type="button" class="quiet" title="Tick it" onClick={(event) => store.toggle(trial.term, event.timeStamp)}>
            {trial.term}
          </button>
          <span>
            {gained(trial)}
            {times(trial.times_noise)} ×{trial.better ? ` better (chance ${chance(trial.chance ?? 0)})` : ""}
          </span>
        </li>
      ))}
    </ol>
  );
}
