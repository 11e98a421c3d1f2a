/** The diagnosis: verdict, how sure, what to measure next. */
import { digits, percent } from "../format";
import type { Diagnosed, TermCard } from "../wire";
import type { BenchProps } from "./screen";

/** Explanations less probable than this are summed up. */
const SHOWN_FROM = 0.01;
const SHOWN_AT_LEAST = 3;

export function DiagnosisSheet({ store, bench, state, catalogue }: BenchProps) {
  const { diagnosed } = bench;
  const running = state.busy.includes("diagnosing");
  return (
    <>
      <div class="row">
        <button type="button" class="main" data-testid="diagnose" disabled={running} onClick={() => void store.diagnose()}>
          {diagnosed === null ? "Diagnose" : "Diagnose again"}
        </button>
        <span class="hint">
          {running
            ? "Weighing all explanations; this may take some seconds."
            : "Weighs every term, alone and together, against the readings and the noise."}
        </span>
      </div>
      {diagnosed && diagnosed.own.join() !== bench.wanted.own.join() && (
        <p class="hint">Your formulas have changed since: diagnose again to weigh them.</p>
      )}
      {diagnosed && <Answer answer={diagnosed.answer} terms={catalogue.terms} tick={(ids) => store.tickNamed(ids)} />}
    </>
  );
}

interface AnswerProps {
  answer: Diagnosed;
  terms: TermCard[];
  tick: (ids: string[]) => void;
}

function Answer({ answer, terms, tick }: AnswerProps) {
  const named = answer.tick;
  return (
    <div aria-live="polite">
      <p class="verdict" data-testid="verdict" data-word={answer.word}>
        <strong>{answer.word.toUpperCase()}</strong> {answer.sentences.join(" ")}
      </p>
      {named.length > 0 && (
        <button type="button" data-testid="tick-named" onClick={() => tick(named)}>
          {answer.word === "named" ? "Tick what it names" : "Tick what fits best"}: {named.join(", ")}
        </button>
      )}
      <Probabilities answer={answer} terms={terms} />
      {answer.next.length > 0 && (
        <>
          <h3>What to measure next</h3>
          <ul data-testid="next">
            {answer.next.map((sentence) => (
              <li key={sentence}>{sentence}</li>
            ))}
          </ul>
        </>
      )}
      <p class="hint">Took {digits(answer.milliseconds / 1000, 2)} s.</p>
    </div>
  );
}

function Probabilities({ answer, terms }: Omit<AnswerProps, "tick">) {
  const words = (id: string, title: string) => terms.find((term) => term.id === id)?.title ?? title;
  const shown = answer.probabilities.filter(({ probability }, index) => probability >= SHOWN_FROM || index < SHOWN_AT_LEAST);
  return (
    <table class="probabilities" data-testid="probabilities">
      <caption>How sure: probability that each is at work, alone or with others</caption>
      <tbody>
        {shown.map(({ id, title, probability, alike }) => (
          <tr key={id}>
            <th scope="row">
              {words(id, title)} {words(id, title) !== id && <code>{id}</code>}
            </th>
            <td>{percent(probability)}</td>
            <td class="wide">
              <span class="track">
                <span class="bar" style={{ width: `${100 * probability}%` }} />
              </span>
              {alike.length > 0 && <small>looks like {alike.join(", ")} in these data</small>}
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
