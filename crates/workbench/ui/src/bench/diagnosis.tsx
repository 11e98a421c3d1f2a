/** The diagnosis: what every other medium says, and the terms it names to tick. */
import { diagnose, isStale } from "../asks";
import { digits } from "../format";
import { Said } from "../page/said";
import { totalOf } from "../plan/choice";
import type { Diagnosed } from "../wire";
import { Came } from "./came";
import { Discovery } from "./discovery";
import { Pictures } from "./pictures";
import { RunSheet } from "./run_sheet";
import type { BenchProps } from "./screen";
import { Ways } from "./ways";

export function DiagnosisSheet(props: BenchProps) {
  const { store, bench, state } = props;
  const { diagnosed } = bench;
  const running = state.busy.includes("diagnosing");
  const found = diagnosed?.answer.picture;
  const picture = found && <Pictures store={store} bench={bench} found={found} />;
  // What is wrong with the files comes before anything that rests on them.
  const isMisread = diagnosed !== null && diagnosed.answer.ways.length > 0 && !bench.opened.sealed;
  const asksFor = totalOf((diagnosed?.answer.diagnosis.next ?? []).map(({ repeats }) => repeats));
  return (
    <>
      <div class="row">
        <button type="button" class="main" data-testid="diagnose" disabled={running} onClick={() => void diagnose(store)}>
          {diagnosed === null ? "Diagnose" : "Diagnose again"}
        </button>
        <span class="hint">
          {running
            ? "Comparing all explanations; this may take a few seconds."
            : "Compares every term, alone and in combination, with the readings and their noise."}
        </span>
      </div>
      {diagnosed && isStale(diagnosed.asked, bench.wanted) && (
        <p class="hint">Your formulas or the readings left out have changed since this diagnosis; diagnose again.</p>
      )}
      {!isMisread && picture}
      <div aria-live="polite">{diagnosed && <Answer answer={diagnosed.answer} tick={(ids) => store.tickNamed(ids)} />}</div>
      {isMisread && <Ways store={store} ways={diagnosed.answer.ways} />}
      {isMisread && picture}
      {diagnosed?.answer.word === "outside" && <Discovery {...props} />}
      <Came bench={bench} />
      {asksFor > 0 && <RunSheet store={store} bench={bench} count={asksFor} />}
      {diagnosed && <Said sections={diagnosed.answer.page.sections.slice(leading(diagnosed.answer))} />}
      {diagnosed && <p class="hint">Computed in {digits(diagnosed.answer.milliseconds / 1000, 2)} s.</p>}
    </>
  );
}

/** How many sections come first: the verdict, and what is wrong with the data before it. */
function leading({ page }: Diagnosed): number {
  return page.sections.findIndex(({ id }) => id === "verdict") + 1;
}

interface AnswerProps {
  answer: Diagnosed;
  tick: (ids: string[]) => void;
}

function Answer({ answer, tick }: AnswerProps) {
  const named = answer.diagnosis.add;
  const sections = answer.page.sections.slice(0, leading(answer));
  return (
    <>
      <Said sections={sections} />
      {named.length > 0 && (
        <button type="button" data-testid="tick-named" onClick={() => tick(named)}>
          {answer.word === "named" ? "Tick the named terms" : "Tick the best-fitting terms"}: {named.join(", ")}
        </button>
      )}
    </>
  );
}
