/** The number that has to fall. */
import { digits, times } from "../format";
import * as History from "../history";
import type { Bench, Tick } from "../state";

export function HeldOut({ bench, tick }: { bench: Bench; tick: Tick | null }) {
  const { view } = History.now(bench.history);
  const { noise } = bench.opened;
  const error = view.holdout ?? view.fitted;
  const sizes = [
    { unit: "um", error: error.rms.translation_um, noise: noise.translation_um },
    { unit: "urad", error: error.rms.rotation_urad, noise: noise.rotation_urad },
  ];
  // Of what nobody has read there is no error.
  const read = sizes.flatMap((size) => (size.error === null ? [] : [{ ...size, error: size.error }]));
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
            {read.map((size) => (
              <th scope="col" key={size.unit}>
                {size.unit}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          <tr>
            <th scope="row">error</th>
            {read.map((size) => (
              <td key={size.unit}>{digits(size.error)}</td>
            ))}
          </tr>
          <tr>
            <th scope="row">noise</th>
            {read.map((size) => (
              <td key={size.unit}>{digits(size.noise)}</td>
            ))}
          </tr>
        </tbody>
      </table>
      <p class="hint">
        <span class="narrow-only">
          {read.map((size) => `${digits(size.error)} ${size.unit}`).join(", ")}; noise{" "}
          {read.map((size) => `${digits(size.noise)} ${size.unit}`).join(", ")}
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
