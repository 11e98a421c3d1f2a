/** Every reading of the fit, the worst explained first: what is left of it, and whether it counts. */

import { useMemo, useState } from "preact/hooks";
import { legNoise } from "../charts/leg_noise";
import { setting, times } from "../format";
import * as History from "../history";
import { worstLeg } from "../machine/part";
import { allOf, picking } from "../picks";
import { Scroll } from "../scroll";
import type { Six } from "../wire";
import { Picked } from "./picked";
import type { BenchProps } from "./screen";

const FIRST = 20;
const [COUNTS, LINE, RESIDUAL, LEG, POSE, LOAD] = [
  "in the fit",
  "line",
  "residual, times the noise",
  "leg",
  "pose (mm, deg)",
  "load (N, N m)",
];

export function ReadingsSheet({ store, bench }: BenchProps) {
  const { opened, history, wanted } = bench;
  const { conditions } = opened;
  const [all, showAll] = useState(false);
  const noise = useMemo(() => legNoise(opened), [opened]);
  const { residual_um } = History.now(history).view;
  const rows = useMemo(() => {
    const missed = residual_um.map((six, index) => ({ index, ...worstLeg(six, noise) }));
    return missed.sort((a, b) => b.times - a.times);
  }, [residual_um, noise]);
  const excluded = new Set(wanted.exclude);
  const chosen = new Set(allOf(bench.picked, "fitted"));
  const pick = picking(store, "fitted", conditions.pose.length);
  /** Arrow keys go to the row above or below and pick it, with Shift beside those picked. */
  const onKey = (event: KeyboardEvent, row: number) => {
    const by = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    const [from, to] = [rows[row], rows[row + by]];
    const button = (event.currentTarget as HTMLElement).closest("tbody")?.rows[row + by]?.querySelector("button");
    if (by === 0 || from === undefined || to === undefined || !button) return;
    event.preventDefault();
    if (event.shiftKey) pick.many([from.index, to.index], true);
    else pick.one(to.index, false);
    button.focus();
  };
  return (
    <>
      <Picked store={store} bench={bench} />
      <Scroll label="Readings of the fit" stacks>
        <table class="readings" data-testid="readings">
          <thead>
            <tr>
              {[COUNTS, LINE, RESIDUAL, LEG, POSE, LOAD].map((title) => (
                <th key={title} scope="col">
                  {title}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {rows.slice(0, all ? rows.length : FIRST).map(({ index, leg, times: left }, row) => {
              const lines = conditions.lines[index] ?? [];
              const counted = lines.filter((line) => !excluded.has(line)).length;
              const named = `line${lines.length === 1 ? "" : "s"} ${lines.join(", ")}`;
              const isPicked = chosen.has(index);
              return (
                <tr key={index} class={`${counted === 0 ? "out" : ""} ${isPicked ? "chosen" : ""}`}>
                  <td data-name={`${COUNTS} `}>
                    <input
                      type="checkbox"
                      checked={counted > 0}
                      aria-label={`${named} in the fit`}
                      data-testid={`counts-${lines[0]}`}
                      onChange={(event) => store.countReadings(lines, counted === 0, event.timeStamp)}
                    />
                    {counted > 0 && counted < lines.length && ` ${counted} of ${lines.length}`}
                  </td>
                  <td data-title={LINE}>
                    <button
                      type="button"
                      class="quiet"
                      data-testid={`pick-${lines[0]}`}
                      aria-pressed={isPicked}
                      onClick={(event) => pick.one(index, event.shiftKey)}
                      onKeyDown={(event) => onKey(event, row)}
                    >
                      {lines.join(", ")}
                    </button>
                  </td>
                  <td data-title={RESIDUAL}>{times(left)}</td>
                  <td data-title={LEG}>{leg + 1}</td>
                  <td data-title={POSE}>{six(conditions.pose[index])}</td>
                  <td data-title={LOAD}>{six(conditions.wrench[index])}</td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </Scroll>
      {!all && rows.length > FIRST && (
        <button type="button" data-testid="all-readings" onClick={() => showAll(true)}>
          Show all {rows.length}
        </button>
      )}
      <p class="hint">
        Sorted by the largest leg residual, in multiples of the noise of one reading; readings under the same condition share a row. To
        select several, hold Shift while you click line numbers or press arrow keys. Leave a reading out for a reason found at the machine,
        not for its size, and write that reason into the notes.
      </p>
    </>
  );
}

function six(values: Six | undefined): string {
  return (values ?? []).map((value) => setting(value)).join(", ");
}
