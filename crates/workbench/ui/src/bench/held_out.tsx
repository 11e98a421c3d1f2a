/** The number that has to fall. */
import { isStale } from "../asks";
import { chance, digits, times, unitName } from "../format";
import * as History from "../history";
import { readAsWritten } from "../read_as";
import type { Bench, Tick } from "../state";
import type { Store } from "../store";
import type { View } from "../wire";
import { isMisread } from "./file_check";

/** So many models judged by the same readings: the best of them owes something to chance. */
const OFTEN = 10;
/** Most lines named in a sentence. */
const MOST_LINES = 8;

/** Whether anything is left to explain. */
function state(view: View, doubt: string | null): string {
  if (!view.at_the_noise) return "\u2717 not yet at the noise";
  if (doubt !== null) return `? at the noise, but ${doubt}`;
  return view.by_tolerances ? "\u2713 no more than noise and input tolerances can cause" : "\u2713 at the noise";
}

export function HeldOut({ store, bench, tick }: { store: Store; bench: Bench; tick: Tick | null }) {
  const { view, selection } = History.now(bench.history);
  const { noise } = bench.opened;
  const { looks } = bench;
  // Ahead of the history while an answer is awaited, and where none came.
  const old = bench.wanted !== selection;
  const doubt = doubtOf(bench);
  const error = view.holdout ?? view.fitted;
  const sizes = [
    { unit: "um", error: error.rms.translation_um, noise: noise.translation_um },
    { unit: "urad", error: error.rms.rotation_urad, noise: noise.rotation_urad },
  ];
  // Of what nobody has read there is no error.
  const read = sizes.flatMap((size) => (size.error === null ? [] : [{ ...size, error: size.error }]));
  return (
    <section
      class={`held-out ${view.at_the_noise && doubt === null ? "good" : ""} ${old || isMisread(bench) ? "old" : ""}`}
      aria-label="Held-out error"
      aria-busy={old}
      data-testid="held-out-box"
    >
      <div aria-live="polite" aria-atomic="true">
        <h2>{view.holdout === null ? "Error on fitted readings" : "Held-out error"}</h2>
        <p class="number">
          <strong data-testid="held-out" data-value={view.times_noise}>
            {times(view.times_noise)}
          </strong>{" "}
          times the noise
        </p>
        <p class="band" data-testid="held-out-band">
          noise alone: {bandOf(view.band)} for {error.count} numbers
        </p>
        <p class="state" data-testid="held-out-state">
          {state(view, doubt)}
          {view.chance !== null && ` (chance ${chance(view.chance)})`}
        </p>
        <Beside bench={bench} />
        <LeftOut store={store} bench={bench} />
        <ReadAs store={store} bench={bench} />
      </div>
      <table class="small">
        <thead>
          <tr>
            <td />
            {read.map((size) => (
              <th scope="col" key={size.unit}>
                {unitName(size.unit)}
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
          {read.map((size) => `${digits(size.error)} ${unitName(size.unit)}`).join(", ")}; noise{" "}
          {read.map((size) => `${digits(size.noise)} ${unitName(size.unit)}`).join(", ")}
        </span>
        <span class="wide-only">
          {view.held_out}; root mean square of {error.count} numbers
        </span>
        {view.holdout !== null && (
          <>
            <br />
            <span data-testid="looks">
              {looks.length === 1 ? "viewed for 1 model" : `viewed for ${looks.length} models`}
              {looks.length >= OFTEN && ": the smallest of so many errors is optimistic; confirm the model with new readings"}
            </span>
          </>
        )}
        {old && (
          <>
            <br />
            <strong data-testid="old">this number belongs to the previous step</strong>
          </>
        )}
        {tick && !old && (
          <>
            <br />
            <span data-testid="tick">
              last tick {Math.round(tick.total)} ms, including {Math.round(tick.server)} ms in the server
            </span>
          </>
        )}
      </p>
    </section>
  );
}

/** Which readings the fit is without, and how many. */
function LeftOut({ store, bench }: { store: Store; bench: Bench }) {
  const { exclude } = bench.wanted;
  if (exclude.length === 0) return null;
  return (
    <p class="left-out" data-testid="left-out">
      <strong>{History.readingsOf(exclude.length)} left out of the fit</strong> (line{exclude.length === 1 ? "" : "s"} {shortened(exclude)}){" "}
      <button type="button" class="quiet" data-testid="count-all" onClick={() => store.countAll()}>
        Put back
      </button>
    </p>
  );
}

/** How the files are read where that is not what they say. */
function ReadAs({ store, bench }: { store: Store; bench: Bench }) {
  const { read_as } = bench.opened;
  if (read_as.length === 0) return null;
  return (
    <p class="left-out" data-testid="read-as">
      <strong>files read as {read_as.join(", then ")}</strong>{" "}
      {bench.open.from === "read-as" && (
        <button type="button" class="quiet" data-testid="read-as-written" onClick={() => void readAsWritten(store)}>
          Read as written
        </button>
      )}
    </p>
  );
}

function shortened(lines: number[]): string {
  return lines.length > MOST_LINES ? `${lines.slice(0, MOST_LINES).join(", ")}, ...` : lines.join(", ");
}

/** What noise alone gives, one standard deviation either way. */
function bandOf(band: number): string {
  return `${(1).toFixed(2)} \u00b1 ${band < 0.01 ? digits(band, 1) : band.toFixed(2)}`;
}

/** Why an error at the noise proves nothing: what the diagnosis of the same readings and formulas says against it. */
function doubtOf(bench: Bench): string | null {
  const { diagnosed, wanted } = bench;
  if (isMisread(bench)) return "the files seem misread";
  if (diagnosed === null || isStale(diagnosed.asked, wanted)) return null;
  return diagnosed.answer.word === "outside" ? "no term of the catalogue is the cause" : null;
}

/** What the diagnosis of these readings says, where the model ticked is another: a number alone can look well by chance. */
function Beside({ bench }: { bench: Bench }) {
  const { diagnosed, wanted } = bench;
  if (diagnosed === null) return null;
  const { word, diagnosis } = diagnosed.answer;
  const old = isStale(diagnosed.asked, wanted);
  const same = History.sameTerms(diagnosis.add, wanted.terms);
  const rest = same ? diagnosis.add.join(", ") : `${diagnosis.add.join(", ")} (not the model you ticked)`;
  return (
    <p class={`beside ${old ? "old" : ""}`} data-testid="beside">
      {old ? "Diagnosis before your last change" : "Diagnosis"}: <strong>{word.toUpperCase()}</strong>{" "}
      {word === "outside" ? "(no term in the catalogue explains the readings)" : rest}
    </p>
  );
}
