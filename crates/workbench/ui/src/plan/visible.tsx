/** The smallest effects that show now, and with the readings of a plan. */
import { digits, unitName } from "../format";
import { Scroll } from "../scroll";
import type { VisibleSize } from "../wire";

/** Effects that the plan brings forward most are shown at once. */
const FIRST = 5;

export function Visible({ sizes, stale }: { sizes: VisibleSize[]; stale: boolean }) {
  const gained = sizes.filter((size) => share(size) < 1).sort((a, b) => share(a) - share(b));
  return (
    <div class={stale ? "old" : ""} data-testid="plan-visible" data-stale={stale}>
      {gained.length === 0 ? (
        <p class="hint">These readings make no smaller effect show.</p>
      ) : (
        <Sizes label="Smallest effects that show" sizes={gained.slice(0, FIRST)} />
      )}
      <details>
        <summary>All {sizes.length} parameters</summary>
        <Sizes label="Smallest effects of all parameters" sizes={sizes} />
      </details>
      <p class="hint">A size that a test with 1 % false alarms sees with 90 % probability.</p>
    </div>
  );
}

const PLANNED = "with these readings";

function Sizes({ label, sizes }: { label: string; sizes: VisibleSize[] }) {
  return (
    <Scroll label={label} stacks>
      <table>
        <thead>
          <tr>
            <th scope="col" class="words">
              effect
            </th>
            <th scope="col">now</th>
            <th scope="col">{PLANNED}</th>
            <th scope="col">unit</th>
          </tr>
        </thead>
        <tbody>
          {sizes.map(({ term, parameter, unit, now, planned }) => (
            <tr key={`${term} ${parameter}`}>
              <th scope="row" class="words">
                {term}, {parameter}
              </th>
              <td data-title="now">{size(now)}</td>
              <td data-title={PLANNED}>{size(planned)}</td>
              <td data-title="unit">{unitName(unit)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </Scroll>
  );
}

function size(value: number | null): string {
  return value === null ? "none shows" : digits(value, 2);
}

/** What is left of the size that shows now. */
function share({ now, planned }: VisibleSize): number {
  if (planned === null) return 1;
  return now === null ? 0 : planned / now;
}
