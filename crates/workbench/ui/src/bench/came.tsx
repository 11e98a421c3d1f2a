/** What readings were foreseen to tell, beside what they told when they came. */

import { chance, digits } from "../format";
import { Scroll } from "../scroll";
import type { Bench } from "../state";
import type { Diagnosis, DiagnosisBefore } from "../wire";

/** Powers of ten beyond which odds say no more than "overwhelming". */
const OVERWHELMING = 4;
/** Most rivals that are named. */
const MOST_RIVALS = 3;
const [FIRST, SECOND] = ["predicted if the first is present", "predicted if the second is present"];
export const RIGHT = "chance of the right answer";
const OBTAINED = "obtained";

export function Came({ bench }: { bench: Bench }) {
  const { foreseen, diagnosed } = bench;
  if (foreseen === null) return null;
  const { before, readings } = foreseen;
  const now = diagnosed?.answer.diagnosis ?? null;
  return (
    <section data-testid="came" aria-live="polite">
      <h3>Predicted and obtained odds</h3>
      <p>
        {readings === 1 ? "1 reading" : `${readings} readings`} added. Before: <strong>{said(before)}</strong>; now:{" "}
        <strong>{now === null ? "diagnose again to see" : said(now)}</strong>.
      </p>
      <Scroll label="Predicted and obtained odds" stacks>
        <table>
          <thead>
            <tr>
              <th scope="col">candidates</th>
              <th scope="col" class="words">
                {FIRST}
              </th>
              <th scope="col" class="words">
                {SECOND}
              </th>
              <th scope="col">{RIGHT}</th>
              <th scope="col" class="words">
                {OBTAINED}
              </th>
            </tr>
          </thead>
          <tbody>
            {before.separation.map(({ between: [a, b], log10_bayes_factor: [first, second], right }) => (
              <tr key={`${a} ${b}`}>
                <th scope="row">
                  {a} or {b}
                </th>
                <td class="words" data-title={FIRST}>
                  {odds(first)} for {a}
                </td>
                <td class="words" data-title={SECOND}>
                  {odds(second)} for {b}
                </td>
                <td data-title={RIGHT}>{chance(right)}</td>
                <td class="words" data-title={OBTAINED}>
                  {now === null ? "" : came(shift(before, now, a, b), a, b)}
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </Scroll>
      <p class="hint">Odds: how far the new readings favor one candidate over the other. Predicted odds are averages over the noise.</p>
    </section>
  );
}

type Said = Pick<Diagnosis, "verdict" | "added" | "credible_set">;
type Weighed = Pick<DiagnosisBefore, "candidates">;

/** `ambiguous (creep or metrology-drift)`. */
function said({ verdict, added, credible_set }: Said): string {
  if (verdict === "named") return `named (${added.join(", ")})`;
  if (verdict !== "ambiguous") return verdict;
  const more = credible_set.length - MOST_RIVALS;
  return `ambiguous (${credible_set.slice(0, MOST_RIVALS).join(" or ")}${more > 0 ? ` or ${more} more` : ""})`;
}

/** Decimal logarithm of the Bayes factor that came, for the first against the second; none where one is not weighed. */
export function shift(before: Weighed, now: Weighed, a: string, b: string): number | null {
  const ratio = ({ candidates }: Weighed) => {
    const of = (term: string) => candidates.find((one) => one.term === term)?.probability ?? 0;
    return Math.log10(of(a) / of(b));
  };
  const value = ratio(now) - ratio(before);
  return Number.isFinite(value) ? value : null;
}

function came(log10: number | null, a: string, b: string): string {
  if (log10 === null) return "no longer compared";
  return `${odds(Math.abs(log10))} for ${log10 < 0 ? b : a}`;
}

/** A power of ten as odds. */
export function odds(log10: number): string {
  if (log10 > OVERWHELMING) return "> 10 000 : 1";
  if (log10 < -OVERWHELMING) return "< 1 : 10 000";
  return log10 < 0 ? `1 : ${digits(10 ** -log10, 2)}` : `${digits(10 ** log10, 2)} : 1`;
}

/** What is kept of a diagnosis, to be compared with a later one. */
export function beforeOf({ verdict, added, credible_set, candidates, separation }: Diagnosis): DiagnosisBefore {
  return {
    verdict,
    added,
    credible_set,
    candidates: candidates.map(({ term, probability }) => ({ term, probability })),
    separation: separation.map(({ between, log10_bayes_factor, right }) => ({ between, log10_bayes_factor, right })),
  };
}
