/** A chart on a canvas, drawn before the next frame. */
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { useDark } from "../theme";
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
  /** A click on a point: its index in its series. */
  pick?: (index: number) => void;
}

export function Chart({ name, label, shape, of, draw, pick }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const chart = useRef<{ instance: Instance; shape: string } | null>(null);
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
    return () => {
      observer.disconnect();
      chart.current?.instance.dispose();
      chart.current = null;
    };
  }, []);
  useLayoutEffect(() => {
    if (box.current === null || width === 0) return;
    const { option, height } = draw(width, looks(dark));
    const kind = `${shape} ${width} ${height} ${dark}`;
    box.current.style.height = `${height}px`;
    if (chart.current === null) {
      const instance = echarts.init(box.current, null, { renderer: "canvas", width, height });
      instance.on("click", ({ dataIndex }) => picks.current?.(dataIndex));
      chart.current = { instance, shape: "" };
    }
    if (chart.current.shape !== kind) chart.current.instance.resize({ width, height });
    chart.current.instance.setOption(option, { notMerge: chart.current.shape !== kind, silent: true });
    chart.current.instance.getZr().flush();
    chart.current.shape = kind;
  }, [width, dark, shape, ...of]);
  return <div ref={box} class="chart" role="img" aria-label={label} data-testid={`chart-${name}`} />;
}
