/** What is picked in a chart, in the table or in the machine: where it stands in its file, how it was taken, whether it counts. */
import { place } from "../charts/marks";
import { readings } from "../charts/readings";
import { digits, setting, unitName } from "../format";
import * as History from "../history";
import { partWords } from "../machine/part";
import type { Bench, Pick } from "../state";
import type { Store } from "../store";
import type { ConditionLists, Six } from "../wire";

/** Conditions that are named where several are picked. */
const MOST_NAMED = 4;

interface Props {
  store: Store;
  bench: Bench;
}

/** `inChart`: there are points to click on, above. */
export function Picked({ store, bench, inChart = true }: Props & { inChart?: boolean }) {
  const { picked } = bench;
  return (
    <>
      {/* Always there: what comes into it is spoken. */}
      <p class="count" role="status" data-testid="picked-count">
        {picked === null ? "" : counted(bench, picked)}
      </p>
      {picked === null && inChart && (
        <p class="hint screen-only">
          Click a point, or draw a rectangle around several, to see their lines in the file and to leave them out of the fit; hold Shift to
          add to the selection. Keyboard: arrow keys on a chart select a condition, Shift and arrow keys several; Escape clears the
          selection.
        </p>
      )}
      {picked !== null && <What store={store} bench={bench} picked={picked} />}
    </>
  );
}

function What({ store, bench, picked }: Props & { picked: Pick }) {
  const { which, all } = picked;
  const { conditions, residual_um } = readings(which, bench.opened, History.now(bench.history).view);
  return (
    <div class="picked" data-testid="picked">
      {all.length === 1 ? (
        all.map((index) => (
          <p key={index}>
            <strong>{place(conditions, index)}</strong>: pose [{set(conditions.pose[index])}] mm, deg; load [{set(conditions.wrench[index])}
            ] N, N m; leg residuals [{six(residual_um[index])}] {unitName("um")}.
          </p>
        ))
      ) : (
        <p>{named(conditions, all)}</p>
      )}
      <div class="row">
        {which === "held-out" ? (
          <span class="hint">Held out: no fit has seen {all.length === 1 ? "it" : "them"}.</span>
        ) : (
          <Count store={store} bench={bench} all={all} />
        )}
        <button type="button" class="quiet" data-testid="pick-none" title="Escape" onClick={() => store.pick(null)}>
          Clear selection
        </button>
      </div>
    </div>
  );
}

/** Buttons that leave readings out or put them back: line by line for one condition, and all at once. */
function Count({ store, bench, all }: Props & { all: number[] }) {
  const lines = linesOf(bench.opened.conditions, all);
  const excluded = new Set(bench.wanted.exclude);
  const inside = lines.filter((line) => !excluded.has(line));
  const outside = lines.filter((line) => excluded.has(line));
  return (
    <>
      {all.length === 1 &&
        lines.map((line) => {
          const counts = !excluded.has(line);
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
        })}
      {lines.length > 1 && inside.length > 0 && (
        <button type="button" data-testid="leave-picked-out" onClick={(event) => store.countReadings(inside, false, event.timeStamp)}>
          Leave {History.readingsOf(inside.length)} out
        </button>
      )}
      {lines.length > 1 && outside.length > 0 && (
        <button type="button" data-testid="put-picked-back" onClick={(event) => store.countReadings(outside, true, event.timeStamp)}>
          Put {History.readingsOf(outside.length)} back
        </button>
      )}
    </>
  );
}

/** `3 conditions picked: 5 readings, 2 of them left out`. */
function counted({ opened, wanted }: Bench, { which, all, part }: Pick): string {
  const conditions = which === "held-out" && opened.held_out !== null ? opened.held_out : opened.conditions;
  const lines = linesOf(conditions, all);
  const out = which === "fitted" ? lines.filter((line) => wanted.exclude.includes(line)).length : 0;
  const many = all.length === 1 ? "1 condition selected" : `${all.length} conditions selected`;
  const by = part === undefined ? "" : `, ${partWords(part)}`;
  const held = which === "held-out" ? ", held out" : "";
  return `${many}: ${History.readingsOf(lines.length)}${by}${held}${out > 0 ? `, ${out} of them left out of the fit` : ""}`;
}

function linesOf({ lines }: ConditionLists, all: number[]): number[] {
  return all.flatMap((index) => lines[index] ?? []).sort((a, b) => a - b);
}

/** The file and the first lines. */
function named(conditions: ConditionLists, all: number[]): string {
  const lines = linesOf(conditions, all);
  const more = lines.length - MOST_NAMED;
  return `${conditions.file}, lines ${lines.slice(0, MOST_NAMED).join(", ")}${more > 0 ? ` and ${more} more` : ""}.`;
}

function set(values: Six | undefined): string {
  return (values ?? []).map((value) => setting(value)).join(", ");
}

function six(values: Six | undefined): string {
  return (values ?? []).map((value) => digits(value)).join(", ");
}
