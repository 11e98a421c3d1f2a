/** The held-out error step by step, with the noise as a line. */
import { useLayoutEffect, useRef } from "preact/hooks";
import { times } from "../format";
import * as History from "../history";
import type { Bench } from "../state";
import type { Store } from "../store";

/** The noise line always has this much room beyond it. */
const WIDEST_AT_LEAST = 1.25;

export function Ladder({ store, bench }: { store: Store; bench: Bench }) {
  const { steps, at } = bench.history;
  const widest = Math.max(WIDEST_AT_LEAST, ...steps.map(({ view }) => view.times_noise));
  const share = (multiple: number) => `${(100 * multiple) / widest}%`;
  const list = useRef<HTMLOListElement>(null);
  useLayoutEffect(() => showStep(list.current, at), [at]);
  return (
    <section class="card ladder">
      <div class="row spread">
        <h2>The error step by step</h2>
        <div class="row">
          <button type="button" data-testid="undo" disabled={at === 0} title="Ctrl+Z" onClick={() => store.undo()}>
            Undo
          </button>
          <button type="button" data-testid="redo" disabled={at === steps.length - 1} title="Ctrl+Shift+Z" onClick={() => store.redo()}>
            Redo
          </button>
          <button type="button" data-testid="springs-alone" disabled={bench.wanted.terms.length === 0} onClick={() => store.springsAlone()}>
            Springs alone
          </button>
        </div>
      </div>
      <ol data-testid="history" ref={list}>
        {steps.map((step, index) => (
          <li key={index} class={index > at ? "undone" : ""}>
            <button type="button" class="step" aria-current={index === at ? "step" : undefined} onClick={() => store.goTo(index)}>
              <span class="what">{History.changed(steps[index - 1]?.selection, step.selection)}</span>
              <span class="times">{times(step.view.times_noise)} ×</span>
              <span class="track">
                <span class={step.view.at_the_noise ? "bar good" : "bar"} style={{ width: share(step.view.times_noise) }} />
                <span class="noise-line" style={{ left: share(1) }} />
              </span>
            </button>
          </li>
        ))}
      </ol>
      <p class="hint">
        Bars: held-out error in multiples of the noise of one reading. The vertical line marks the noise. Click a step to return to it.
      </p>
    </section>
  );
}

/** Scrolls the list, not the page, to a step. */
function showStep(list: HTMLOListElement | null, at: number): void {
  const step = list?.children[at] as HTMLElement | undefined;
  if (list === null || step === undefined) return;
  const top = step.offsetTop - list.offsetTop;
  if (top < list.scrollTop) list.scrollTop = top;
  else list.scrollTop = Math.max(list.scrollTop, top + step.offsetHeight - list.clientHeight);
}
