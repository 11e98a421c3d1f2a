/** The search for a law that no catalogue has: offered where something outside is told, added as a term by one click. */
import { discover } from "../asks";
import { digits } from "../format";
import { addLaw } from "../own/acts";
import { idOf, titleOf } from "../own/term_file";
import { Said } from "../page/said";
import type { Discovered } from "../wire";
import type { BenchProps } from "./screen";

export function Discovery({ store, bench, state }: BenchProps) {
  const { discovered } = bench;
  const running = state.busy.includes("discovering");
  return (
    <>
      <div class="row">
        <button type="button" data-testid="discover" disabled={running} onClick={() => void discover(store)}>
          {discovered === null ? "Search for a law" : "Search again"}
        </button>
        <span class="hint">
          {running
            ? "Comparing laws with each other and with the catalogue; this may take a few seconds."
            : "Tests about a hundred thousand laws of force, length, direction, temperature and time on what the catalogue leaves unexplained."}
        </span>
      </div>
      {discovered && <Answer answer={discovered.answer} add={(text, beside) => addLaw(store, text, beside)} />}
    </>
  );
}

interface AnswerProps {
  answer: Discovered;
  add: (text: string, beside: string[]) => void;
}

function Answer({ answer, add }: AnswerProps) {
  const { law, beside } = answer;
  const [verdict, ...rest] = answer.page.sections;
  return (
    <div aria-live="polite" data-testid="discovered">
      {verdict && <Said sections={[verdict]} />}
      {law !== null && (
        <button type="button" class="main" data-testid="add-law" title={titleOf(law)} onClick={() => add(law, beside)}>
          Add the law as a term: {[...beside, idOf(law)].join(", ")}
        </button>
      )}
      <Said sections={rest} />
      <p class="hint">Computed in {digits(answer.milliseconds / 1000, 2)} s.</p>
    </div>
  );
}
