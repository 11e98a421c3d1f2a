/** A rectangle drawn over a chart with the mouse, and the points in it. */
import type { Instance, Option } from "./echarts";
import { pointAt } from "./series";

/** A place in the chart, px from its upper left corner. */
export type Place = [number, number];

/** From so many px on a press is a rectangle, no click. */
const FEWEST_PX = 5;

/** What is told of a rectangle: that one begins, and where it lies when it is done; `more` with the Shift key. */
export interface Brushing {
  begin: () => void;
  take: (from: Place, to: Place, more: boolean) => void;
}

/** Lets rectangles be drawn over a chart; fingers scroll the page. Ends with the signal. */
export function brush(box: HTMLElement, signal: AbortSignal, told: Brushing): void {
  let from: Place | null = null;
  let area: HTMLElement | null = null;
  const place = (event: PointerEvent): Place => {
    const { left, top } = box.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  const end = () => {
    area?.remove();
    from = area = null;
  };
  const begin = (event: PointerEvent) => {
    if (event.button === 0 && event.pointerType !== "touch") from = place(event);
  };
  const draw = (event: PointerEvent) => {
    if (from === null) return;
    const to = place(event);
    if (area === null) {
      if (Math.hypot(to[0] - from[0], to[1] - from[1]) < FEWEST_PX) return;
      // From here on the chart sees no pointer.
      box.setPointerCapture(event.pointerId);
      area = document.createElement("div");
      area.className = "brush";
      box.append(area);
      told.begin();
    }
    const [left, top] = [Math.min(from[0], to[0]), Math.min(from[1], to[1])];
    Object.assign(area.style, {
      left: `${left}px`,
      top: `${top}px`,
      width: `${Math.abs(to[0] - from[0])}px`,
      height: `${Math.abs(to[1] - from[1])}px`,
    });
  };
  const finish = (event: PointerEvent) => {
    if (from !== null && area !== null) told.take(from, place(event), event.shiftKey);
    end();
  };
  box.addEventListener("pointerdown", begin, { signal });
  box.addEventListener("pointermove", draw, { signal });
  box.addEventListener("pointerup", finish, { signal });
  box.addEventListener("pointercancel", end, { signal });
}

/** Indices of the points between two places, each once: those of every series that can be seen and clicked on. */
export function pointsIn(chart: Instance, option: Option, from: Place, to: Place): number[] {
  const { legend } = chart.getOption() as { legend?: { selected?: Record<string, boolean> }[] };
  const shown = legend?.[0]?.selected ?? {};
  const found = new Set<number>();
  for (const { type, silent, name, data, xAxisIndex } of option.series as Series[]) {
    if (type !== "scatter" || silent === true || shown[name] === false) continue;
    const axes = { xAxisIndex, yAxisIndex: xAxisIndex };
    const [a = [], b = []] = [from, to].map((corner) => chart.convertFromPixel(axes, corner) as number[]);
    const count = data instanceof Float64Array ? data.length / 2 : data.length;
    for (let index = 0; index < count; index++) {
      const [x, y] = pointAt(data, index);
      if (isBetween(x, a[0], b[0]) && isBetween(y, a[1], b[1])) found.add(index);
    }
  }
  return [...found];
}

interface Series {
  type: string;
  silent?: boolean;
  name: string;
  data: number[][] | Float64Array;
  xAxisIndex: number;
}

function isBetween(value: number | undefined, a: number | undefined, b: number | undefined): boolean {
  if (value === undefined || a === undefined || b === undefined) return false;
  return value >= Math.min(a, b) && value <= Math.max(a, b);
}
