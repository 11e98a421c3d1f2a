/** The reading picked in a chart or in the table: where it stands in its file, how it was taken, whether it counts. */
import { place } from "../charts/marks";
import { readings } from "../charts/readings";
import { digits, unitName } from "../format";
import * as History from "../history";
import type { Bench } from "../state";
import type { Store } from "../store";
import type { Six } from "../wire";

export function Picked({ store, bench }: { store: Store; bench: Bench }) {
  const { picked, opened, history, wanted } = bench;
  if (picked === null) return <p class="hint">Click on a point to see its line in the file, and to leave it out of the fit.</p>;
  const { index, which } = picked;
  const { conditions, residual_um } = readings(which, opened, History.now(history).view);
  const lines = conditions.lines[index] ?? [];
  return (
    <div class="picked" data-testid="picked" aria-live="polite">
      <p>
        <strong>{place(conditions, index)}</strong>: pose [{six(conditions.pose[index])}] mm, deg; load [{six(conditions.wrench[index])}] N,
        N m; left in the legs [{six(residual_um[index])}] {unitName("um")}.
      </p>
      <div class="row">
        {which === "held-out" ? (
          <span class="hint">Held out: no fit has seen it.</span>
        ) : (
          lines.map((line) => {
            const counts = !wanted.exclude.includes(line);
            return (
              <button
                key={line}
                type="button"
                data-testid={`count-${line}`}
                onClick={(event) => store.countReadings([line], !counts, event.timeStamp)}
              >
                {counts ? `Leave line ${line} out` : `Put line ${line} back`}
              </button>
            );
          })
        )}
        <button type="button" class="quiet" onClick={() => store.pick(null)}>
          Close
        </button>
      </div>
    </div>
  );
}

function six(values: Six | undefined): string {
  return (values ?? []).map((value) => digits(value)).join(", ");
}
