/** A chart on a canvas, drawn before the next frame. */
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Picking } from "../picks";
import { useDark } from "../theme";
import { brush, type Place, pointsIn } from "./brush";
import { echarts, type Instance, type Option } from "./echarts";
import { type Looks, looks } from "./looks";

/** A chart for a width: its options, and the height it needs (px). */
export interface Drawing {
  option: Option;
  height: number;
}

interface Props {
  name: string;
  /** What it shows, for those who do not see it. */
  label: string;
  /** Charts of the same shape only change their data, which is quicker than a new chart. */
  shape: string;
  /** What is drawn: nothing is drawn again while all of this is the same. */
  of: unknown[];
  draw: (width: number, looks: Looks) => Drawing;
  /** What a click on a point, a rectangle and keys do; indices are those of points in their series. */
  pick?: Picking;
}

/** Keys that pick the condition behind or before. */
const STEPS: Record<string, 1 | -1> = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };
const KEYS = "Arrow keys select a condition, Shift and arrow keys several; Escape clears the selection.";

export function Chart({ name, label, shape, of, draw, pick }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const chart = useRef<{ instance: Instance; option: Option; shape: string; size: string } | null>(null);
  const picks = useRef(pick);
  picks.current = pick;
  const [width, setWidth] = useState(0);
  const dark = useDark();
  useLayoutEffect(() => {
    const element = box.current;
    if (element === null) return;
    const measure = () => setWidth(element.clientWidth);
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    const off = new AbortController();
    const take = (from: Place, to: Place, more: boolean) => {
      if (chart.current === null) return;
      picks.current?.many(pointsIn(chart.current.instance, chart.current.option, from, to), more);
    };
    // A tooltip would lie over the rectangle.
    const begin = () => chart.current?.instance.dispatchAction({ type: "hideTip" });
    if (picks.current !== undefined) brush(element, off.signal, { begin, take });
    return () => {
      off.abort();
      observer.disconnect();
      chart.current?.instance.dispose();
      chart.current = null;
    };
  }, []);
  useLayoutEffect(() => {
    if (box.current === null || width === 0) return;
    const { option, height } = draw(width, looks(dark));
    const size = `${width} ${height}`;
    const kind = `${shape} ${size} ${dark}`;
    box.current.style.height = `${height}px`;
    if (chart.current === null) {
      const instance = echarts.init(box.current, null, { renderer: "canvas", width, height });
      instance.on("click", ({ dataIndex, event }) => picks.current?.one(dataIndex, isShift(event?.event)));
      chart.current = { instance, option, shape: "", size };
    }
    // To resize is to draw what was there once more.
    if (chart.current.size !== size) chart.current.instance.resize({ width, height });
    chart.current.instance.setOption(option, { notMerge: chart.current.shape !== kind, silent: true });
    chart.current.instance.getZr().flush();
    Object.assign(chart.current, { option, shape: kind, size });
  }, [width, dark, shape, ...of]);
  if (pick === undefined) return <div ref={box} class="chart" role="img" aria-label={label} data-testid={`chart-${name}`} />;
  return (
    <div
      ref={box}
      class="chart pickable"
      role="img"
      aria-label={`${label}. ${KEYS}`}
      data-testid={`chart-${name}`}
      // biome-ignore lint/a11y/noNoninteractiveTabindex: keys pick conditions.
      tabIndex={0}
      onKeyDown={(event) => {
        const by = STEPS[event.key];
        if (by === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        pick.next(by, event.shiftKey);
      }}
    />
  );
}

function isShift(event: unknown): boolean {
  return event instanceof MouseEvent && event.shiftKey;
}
