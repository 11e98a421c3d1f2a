/** What the diagnosis says, first of all: the verdict, how sure, what to do next. It is asked for when the files are opened. */
import { diagnose, isStale } from "../asks";
import { Inline } from "../page/inline";
import { Said } from "../page/said";
import type { Bench, Busy, State } from "../state";
import type { Store } from "../store";
import type { Diagnosed, Mood, Section } from "../wire";
import { isMisread, untitled } from "./file_check";
import { Next } from "./next";
import type { SheetName } from "./sheets";

/** Most explanations named with their probability. */
const MOST = 3;

/** What the answer waits for; what a tab had ticked before a reload is fitted before the files are checked. */
const RUNNING: Busy[] = ["resuming", "checking", "diagnosing"];

interface Props {
  store: Store;
  state: State;
  bench: Bench;
  open: (sheet: SheetName) => void;
}

export function Answer(props: Props) {
  const { store, state, bench } = props;
  const { diagnosed } = bench;
  const running = state.busy.some((busy) => RUNNING.includes(busy)) || (bench.checked === null && state.busy.includes("fitting"));
  // In a game the player asks for it, or not; of misread files everything is said above.
  if (diagnosed === null ? bench.opened.sealed : isMisread(bench)) return null;
  const old = diagnosed !== null && isStale(diagnosed.asked, bench.wanted);
  const verdict = diagnosed && verdictOf(diagnosed.answer);
  const again = (
    <button type="button" data-testid="answer-diagnose" onClick={() => void diagnose(store)}>
      {diagnosed === null ? "Diagnose" : "Diagnose again"}
    </button>
  );
  return (
    <section
      class={`lead-card answer ${old ? "old" : (verdict?.mood ?? "")}`}
      aria-label="Diagnosis in short"
      aria-live="polite"
      aria-busy={running}
      data-testid="answer"
      data-word={diagnosed?.answer.word ?? ""}
      data-old={old}
    >
      {verdict && (
        <p class={`verdict ${verdict.mood}`} data-testid="answer-verdict">
          <strong>{verdict.word}</strong> <Inline text={verdict.text} />
        </p>
      )}
      {diagnosed && <Rest {...props} answer={diagnosed.answer} old={old} />}
      {diagnosed === null && (
        <p>{running ? "Checking the files and comparing all explanations ..." : "These readings are not diagnosed yet."}</p>
      )}
      {old && <p>This answer is of the readings and formulas before your last change. {!running && again}</p>}
      {diagnosed === null && !running && again}
    </section>
  );
}

/** How sure, single readings that seem wrong, what to do. */
function Rest({ answer, old, ...props }: Props & { answer: Diagnosed; old: boolean }) {
  const sure = sureOf(answer);
  return (
    <>
      {sure !== "" && (
        <p data-testid="answer-sure">
          <b>Probability:</b> <Inline text={sure} />
        </p>
      )}
      <Said sections={sectionsOf(answer, "findings").map(untitled)} name="answer" />
      {!old && <Next {...props} answer={answer} />}
    </>
  );
}

function sectionsOf({ page }: Diagnosed, id: string): Section[] {
  return page.sections.filter((section) => section.id === id);
}

/** The verdict as every medium says it; what they list below it is in a view here. */
function verdictOf(answer: Diagnosed): { word: string; mood: Mood; text: string } | null {
  const blocks = sectionsOf(answer, "verdict").flatMap((section) => section.blocks);
  const block = blocks.find((one) => one.kind === "verdict");
  if (block === undefined) return null;
  return { word: block.word, mood: block.mood, text: block.sentences.join(" ").replaceAll("listed below", "listed in the view Diagnosis") };
}

/** `base-compliance 91 %, leg-coupling 10 %`: the first rows of the table that every medium has. */
function sureOf(answer: Diagnosed): string {
  const table = sectionsOf(answer, "confidence")
    .flatMap((section) => section.blocks)
    .find((block) => block.kind === "table");
  if (table === undefined) return "";
  const words = table.rows.slice(0, MOST).map(([what, chance]) => `${what} ${chance}`);
  return `${words.join(", ")}${table.rows.length > MOST ? ", ..." : ""}`;
}
