/** Readings left out of the fit, and those that are picked, among the points of a chart. */
import { allOf } from "../picks";
import type { Bench } from "../state";
import type { ConditionLists } from "../wire";
import type { Option } from "./echarts";
import type { Looks } from "./looks";
import type { Which } from "./readings";
import { points } from "./series";

export const LEFT_OUT = "left out of the fit";
const CROSS = "path://M0 1L1 0L5 4L9 0L10 1L6 5L10 9L9 10L5 6L1 10L0 9L4 5Z";

/** Rings that cover each other. */
const MANY = 60;

export interface Marks {
  /** Is a condition without any reading that counts? */
  out: boolean[];
  picked: number[];
  /** Changes where the series of a chart do. */
  shape: string;
}

/** Marks of the readings shown. */
export function marksOf({ wanted, picked, opened }: Bench, which: Which): Marks {
  const { lines } = which === "fitted" ? opened.conditions : { lines: [] };
  const excluded = new Set(wanted.exclude);
  const out = lines.map((of) => of.every((line) => excluded.has(line)));
  const here = allOf(picked, which);
  return { out, picked: here, shape: `${out.includes(true)} ${here.length > 0}` };
}

/** Points as series: those that count, those left out, rings about those picked. An index is that of its condition in all of them. */
export function marked(
  name: string,
  data: number[][],
  look: { colour: string; size?: number; symbol?: string },
  marks: Marks,
  looks: Looks,
): Option[] {
  const only = (shown: (i: number) => boolean) => data.map((point, i) => (shown(i) ? point : [point[0] ?? 0, Number.NaN]));
  if (!marks.out.includes(true)) return [points(name, data, look), ...rings(data, marks, looks)];
  return [
    points(
      name,
      only((i) => !marks.out[i]),
      look,
    ),
    points(
      LEFT_OUT,
      only((i) => marks.out[i] === true),
      { colour: looks.ink, symbol: CROSS, size: 8 },
    ),
    ...rings(data, marks, looks),
  ];
}

function rings(data: number[][], { picked }: Marks, looks: Looks): Option[] {
  const around = picked.flatMap((index) => data.slice(index, index + 1));
  if (around.length === 0) return [];
  const [size, borderWidth] = ringOf(around.length);
  const series = points("selected", around, { colour: looks.ink, size });
  const itemStyle = { color: "transparent", borderColor: looks.ink, borderWidth };
  // As one path rings would lose their rim.
  return [{ ...series, itemStyle, large: false, silent: true, z: 5 }];
}

/** Size and rim of a ring, px: many rings let their points be seen. */
function ringOf(count: number): [number, number] {
  if (count === 1) return [16, 2];
  return count <= MANY ? [11, 1.5] : [7, 1];
}

/** Names in a legend. */
export function legendOf(names: string[], marks: Marks): string[] {
  return marks.out.includes(true) ? [...names, LEFT_OUT] : names;
}

/** `measurements.csv, lines 12, 13`. */
export function place(conditions: ConditionLists, index: number): string {
  const lines = conditions.lines[index] ?? [];
  return `${conditions.file}, line${lines.length === 1 ? "" : "s"} ${lines.join(", ")}`;
}
