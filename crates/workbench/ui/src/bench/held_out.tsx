/** The number that has to fall. */
import { digits, times } from "../format";
import * as History from "../history";
import type { Bench, Tick } from "../state";

export function HeldOut({ bench, tick }: { bench: Bench; tick: Tick | null }) {
  const { view } = History.now(bench.history);
  const { noise } = bench.opened;
  const error = view.holdout ?? view.fitted;
  return (
    <section class={view.at_the_noise ? "held-out good" : "held-out"} aria-label="Held-out error">
      <div aria-live="polite" aria-atomic="true">
        <h2>{view.holdout === null ? "Error on the readings fitted" : "Held-out error"}</h2>
        <p class="number">
          <strong data-testid="held-out" data-value={view.times_noise}>
            {times(view.times_noise)}
          </strong>{" "}
          times the noise
        </p>
        <p class="state" data-testid="held-out-state">
          {view.at_the_noise ? "\u2713 at the noise" : "\u2717 not yet at the noise"}
        </p>
      </div>
      <table class="small">
        <thead>
          <tr>
            <td />
            <th scope="col">um</th>
            <th scope="col">urad</th>
          </tr>
        </thead>
        <tbody>
          <tr>
            <th scope="row">error</th>
            <td>{digits(error.rms.translation_um)}</td>
            <td>{digits(error.rms.rotation_urad)}</td>
          </tr>
          <tr>
            <th scope="row">noise</th>
            <td>{digits(noise.translation_um)}</td>
            <td>{digits(noise.rotation_urad)}</td>
          </tr>
        </tbody>
      </table>
      <p class="hint">
        <span class="narrow-only">
          {digits(error.rms.translation_um)} um, {digits(error.rms.rotation_urad)} urad; noise {digits(noise.translation_um)} um,{" "}
          {digits(noise.rotation_urad)} urad
        </span>
        <span class="wide-only">
          {view.held_out}; root mean square of {error.count} numbers
        </span>
        {tick && (
          <>
            <br />
            <span data-testid="tick">
              last tick {Math.round(tick.total)} ms, of it server {Math.round(tick.server)} ms
            </span>
          </>
        )}
      </p>
    </section>
  );
}
