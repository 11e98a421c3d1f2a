/** Readings left out of the fit, and the one that is picked, among the points of a chart. */
import type { Bench } from "../state";
import type { ConditionLists } from "../wire";
import type { Option } from "./echarts";
import type { Looks } from "./looks";
import type { Which } from "./readings";
import { points } from "./series";

export const LEFT_OUT = "left out of the fit";
const CROSS = "path://M0 1L1 0L5 4L9 0L10 1L6 5L10 9L9 10L5 6L1 10L0 9L4 5Z";

export interface Marks {
  /** Is a condition without any reading that counts? */
  out: boolean[];
  picked: number | null;
  /** Changes where the series of a chart do. */
  shape: string;
}

/** Marks of the readings shown. */
export function marksOf({ wanted, picked, opened }: Bench, which: Which): Marks {
  const { lines } = which === "fitted" ? opened.conditions : { lines: [] };
  const excluded = new Set(wanted.exclude);
  const out = lines.map((of) => of.every((line) => excluded.has(line)));
  const here = picked?.which === which ? picked.index : null;
  return { out, picked: here, shape: `${out.includes(true)} ${here !== null}` };
}

/** Points as series: those that count, those left out, a ring about the one picked. An index is that of its condition in all of them. */
export function marked(
  name: string,
  data: number[][],
  look: { colour: string; size?: number; symbol?: string },
  marks: Marks,
  looks: Looks,
): Option[] {
  const only = (shown: (i: number) => boolean) => data.map((point, i) => (shown(i) ? point : [point[0] ?? 0, Number.NaN]));
  if (!marks.out.includes(true)) return [points(name, data, look), ...ring(data, marks, looks)];
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
    ...ring(data, marks, looks),
  ];
}

function ring(data: number[][], { picked }: Marks, looks: Looks): Option[] {
  const point = picked === null ? undefined : data[picked];
  if (point === undefined) return [];
  const series = points("picked", [point], { colour: looks.ink, size: 16 });
  const itemStyle = { color: "transparent", borderColor: looks.ink, borderWidth: 2 };
  return [{ ...series, itemStyle, silent: true, z: 5 }];
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
