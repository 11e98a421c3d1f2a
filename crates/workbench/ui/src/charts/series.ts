/** Series of the page's charts. */
import type { Option } from "./echarts";

/** From so many points on they are drawn as one path, which is much quicker. */
const LARGE_FROM = 300;

interface Look {
  colour: string;
  symbol?: string;
  size?: number;
  opacity?: number;
}

/** Points; the second rank is drawn small and pale. */
export function points(name: string, data: number[][], look: Look): Option {
  return {
    type: "scatter",
    name,
    data: data.length > LARGE_FROM ? inOneArray(data) : data,
    symbol: look.symbol ?? "circle",
    symbolSize: look.size ?? 6,
    itemStyle: { color: look.colour, opacity: look.opacity ?? 0.85 },
    large: data.length > LARGE_FROM,
    largeThreshold: LARGE_FROM,
    emphasis: { disabled: true },
  };
}

/** x and y of all points one after the other: ECharts copies and reads lists of many points slowly. */
function inOneArray(data: number[][]): Float64Array {
  const all = new Float64Array(2 * data.length);
  data.forEach(([x = Number.NaN, y = Number.NaN], i) => {
    all[2 * i] = x;
    all[2 * i + 1] = y;
  });
  return all;
}

/** A point of a series. */
export function pointAt(data: number[][] | Float64Array, index: number): (number | undefined)[] {
  return data instanceof Float64Array ? [data[2 * index], data[2 * index + 1]] : (data[index] ?? []);
}

/** A line without markers; null breaks it. */
export function line(name: string, data: (number | null)[][], colour: string, dash: "solid" | "dashed" | number[] = "solid"): Option {
  return {
    type: "line",
    name,
    data,
    symbol: "none",
    silent: true,
    lineStyle: { color: colour, width: 1.5, type: dash },
    itemStyle: { color: colour },
    emphasis: { disabled: true },
  };
}

/** A band between two heights, for the noise. */
export function band(half: number, colour: string): Option {
  return { markArea: { silent: true, itemStyle: { color: colour }, data: [[{ yAxis: -half }, { yAxis: half }]] } };
}

/** Means with twice their standard uncertainty to both sides: a mark and a bar for each `[x, mean, std]`. */
export function means(name: string, bins: number[][], colour: string): Option[] {
  const bars = bins.flatMap(([x = 0, mean = 0, std = 0]) => [
    [x, mean - 2 * std],
    [x, mean + 2 * std],
    [x, null],
  ]);
  const marks = points(
    name,
    bins.map(([x = 0, mean = 0]) => [x, mean]),
    { colour, symbol: "diamond", size: 9, opacity: 1 },
  );
  return [{ ...marks, silent: true }, line(name, bars, colour)];
}
