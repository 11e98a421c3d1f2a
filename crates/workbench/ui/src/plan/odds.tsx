/** What the readings of a plan promise, pair by pair. */
import { odds, RIGHT } from "../bench/came";
import { chance } from "../format";
import { Scroll } from "../scroll";
import type { SeparationReport } from "../wire";

const [FIRST, SECOND] = ["odds if the first is present", "odds if the second is present"];
const NEEDED = "readings until 20:1";

export function Odds({ separation, stale }: { separation: SeparationReport[]; stale: boolean }) {
  return (
    <div class={stale ? "old" : ""} data-testid="plan-odds" data-stale={stale} aria-busy={stale} aria-live="polite">
      {separation.length === 0 ? (
        <p class="hint">No reading is chosen, so nothing is separated.</p>
      ) : (
        <Scroll label="Predicted odds" stacks>
          <table>
            <thead>
              <tr>
                <th scope="col">candidates</th>
                <th scope="col">{FIRST}</th>
                <th scope="col">{SECOND}</th>
                <th scope="col">{RIGHT}</th>
                <th scope="col">{NEEDED}</th>
              </tr>
            </thead>
            <tbody>
              {separation.map(({ between: [a, b], log10_bayes_factor: [first, second], right, readings_needed }) => (
                <tr key={`${a} ${b}`}>
                  <th scope="row">
                    {a} or {b}
                  </th>
                  <td data-odds={first} data-title={FIRST}>
                    {odds(first)}
                  </td>
                  <td data-title={SECOND}>{odds(second)}</td>
                  <td data-title={RIGHT}>{chance(right)}</td>
                  <td data-title={NEEDED}>{readings_needed ?? "more than these"}</td>
                </tr>
              ))}
            </tbody>
          </table>
        </Scroll>
      )}
    </div>
  );
}
