/** Small charts side by side in one canvas. */
import type { Option } from "./echarts";
import type { Looks } from "./looks";

export interface Panel {
  title: string;
  /** One or more series; axes are set here. */
  series: Option[];
  /** Title of its own x axis. */
  x?: string;
  /** Half height of an axis about zero; none: as the data are. */
  reach?: number | undefined;
  /** Ends of the x axis; none: as the data are. */
  span?: [number, number];
}

export interface Sheet {
  panels: Panel[];
  /** Title of the x axes. */
  x: string;
  /** Panels side by side where there is room. */
  across: number;
  /** Colours of series by name, for the legend. */
  legend: string[];
  tooltip: (series: string, panel: number, x: number, y: number, index: number) => string;
  /** Same axis for x and y of a panel. */
  square?: boolean;
  /** Higher panels. */
  tall?: boolean;
}

const NARROWEST_PX = 150;
const ROW_PX = 190;
const LONE_ROW_PX = 360;
/** Each panel with a title of its own x axis. */
const OWN_ROW_PX = 250;
const OWN_NARROWEST_PX = 240;
/** Widest panel of those with axes of their own: few of them do not fill the window. */
const OWN_WIDEST_PX = 640;
const OWN_LONE_ROW_PX = 320;
/** Above the first row of the legend, and each of its rows. */
const TOP_PX = 14;
const LEGEND_ROW_PX = 20;
const BOTTOM_PX = 24;
const LEFT_PX = 46;
const TITLE_PX = 26;
const GAP_PX = 14;

/** Options and height of a sheet of panels. */
export function drawing(sheet: Sheet, width: number, looks: Looks): { option: Option; height: number } {
  const own = sheet.panels.some(({ x }) => x !== undefined);
  const narrowest = own ? OWN_NARROWEST_PX : NARROWEST_PX;
  const columns = Math.max(1, Math.min(sheet.across, sheet.panels.length, Math.floor(width / narrowest)));
  const rows = Math.ceil(sheet.panels.length / columns);
  const rowHeight = heightOf(sheet, own);
  const top = TOP_PX + LEGEND_ROW_PX * legendRows(sheet.legend, width - LEFT_PX);
  const height = top + rows * rowHeight + (own ? 0 : BOTTOM_PX);
  const cell = own ? Math.min(width / columns, OWN_WIDEST_PX) : width / columns;
  const places = sheet.panels.map((_, index) => ({
    left: Math.round((index % columns) * cell),
    top: top + Math.floor(index / columns) * rowHeight,
    last: index + columns >= sheet.panels.length,
  }));
  // A title of the x axes that is wider than a panel stands once, below all of them.
  const isShared = !own && LETTER_PX * sheet.x.length > cell;
  const axes = {
    nameTextStyle: { color: looks.ink },
    nameMoveOverlap: false,
    axisLabel: { color: looks.grey, fontSize: 11, hideOverlap: true },
    axisLine: { onZero: false, lineStyle: { color: looks.grey } },
    splitLine: { lineStyle: { color: looks.grid } },
  };
  const option: Option = {
    animation: false,
    textStyle: { fontFamily: "system-ui, sans-serif", color: looks.ink },
    legend: {
      data: sheet.legend.map((name) => legendEntry(name, sheet)),
      top: 0,
      left: LEFT_PX,
      itemWidth: LEGEND_MARK_PX,
      itemHeight: 10,
      itemGap: LEGEND_GAP_PX,
      textStyle: { color: looks.ink },
      inactiveColor: looks.grid,
    },
    tooltip: {
      trigger: "item",
      renderMode: "richText",
      confine: true,
      backgroundColor: looks.paper,
      borderColor: looks.grey,
      textStyle: { color: looks.ink, fontSize: 12 },
      formatter: (hit: { seriesName: string; seriesIndex: number; value: number[]; dataIndex: number }) =>
        sheet.tooltip(hit.seriesName, panelOf(sheet, hit.seriesIndex), hit.value[0] ?? 0, hit.value[1] ?? 0, hit.dataIndex),
    },
    title: [
      ...sheet.panels.map(({ title }, index) => ({
        text: title,
        left: (places[index]?.left ?? 0) + LEFT_PX,
        top: places[index]?.top ?? 0,
        textStyle: { fontSize: 12, fontWeight: "bold", color: looks.ink },
        padding: [6, 0],
      })),
      ...(isShared
        ? [{ text: sheet.x, left: "center", bottom: 2, textStyle: { fontSize: 12, fontWeight: "normal", color: looks.ink } }]
        : []),
    ],
    grid: places.map(({ left, top }) => ({
      left: left + LEFT_PX,
      top: top + TITLE_PX,
      width: Math.round(cell) - LEFT_PX - GAP_PX,
      height: rowHeight - TITLE_PX - (own ? 44 : 22),
      containLabel: false,
      outerBoundsMode: "none",
    })),
    xAxis: sheet.panels.map((panel, index) => ({
      ...axes,
      type: "value",
      scale: true,
      gridIndex: index,
      splitNumber: 4,
      name: panel.x ?? (places[index]?.last && !isShared ? sheet.x : ""),
      nameLocation: "middle",
      nameGap: 26,
      ...(panel.span ? { min: panel.span[0], max: panel.span[1], interval: 1 } : range(sheet.square ? panel.reach : undefined)),
    })),
    yAxis: sheet.panels.map((panel, index) => ({
      ...axes,
      type: "value",
      scale: true,
      gridIndex: index,
      splitNumber: 4,
      ...range(panel.reach),
    })),
    series: sheet.panels.flatMap(({ series }, index) => series.map((one) => ({ ...one, xAxisIndex: index, yAxisIndex: index }))),
  };
  return { option, height };
}

function heightOf({ panels, tall }: Sheet, own: boolean): number {
  const lone = panels.length === 1;
  if (own) return lone ? OWN_LONE_ROW_PX : OWN_ROW_PX;
  return tall || lone ? LONE_ROW_PX : ROW_PX;
}

const LEGEND_MARK_PX = 16;
const LEGEND_GAP_PX = 12;
/** Width of a letter of the legend, px, rather too large. */
const LETTER_PX = 6.8;

/** Rows that the names of a legend fill. */
export function legendRows(names: string[], width: number): number {
  let rows = 1;
  let filled = 0;
  for (const name of names) {
    const entry = LEGEND_MARK_PX + 5 + LETTER_PX * name.length + LEGEND_GAP_PX;
    if (filled > 0 && filled + entry > width) {
      rows += 1;
      filled = 0;
    }
    filled += entry;
  }
  return rows;
}

const SOLID = "path://M0 4H16V6H0Z";
const DASHED = "path://M0 4H4.5V6H0Z M6 4H10V6H6Z M11.5 4H16V6H11.5Z";

/** A line is a line in the legend too; points have the mark of their series. */
function legendEntry(name: string, { panels }: Sheet): Option {
  const series = panels.flatMap((panel) => panel.series).find((one) => one.name === name);
  if (series?.type !== "line") return { name };
  const { type } = series.lineStyle as { type: string | number[] };
  return { name, icon: type === "solid" ? SOLID : DASHED };
}

function panelOf(sheet: Sheet, series: number): number {
  let before = 0;
  return sheet.panels.findIndex((panel) => {
    before += panel.series.length;
    return series < before;
  });
}

/** Limits of an axis about zero; null hands an axis back to the data. */
function range(reach: number | undefined): Option {
  return reach === undefined ? { min: null, max: null, interval: null } : { min: -reach, max: reach, interval: reach / 2 };
}

/** A round number not below the largest magnitude. */
export function reachOf(values: Iterable<number>): number {
  let largest = 0;
  for (const value of values) largest = Math.max(largest, Math.abs(value));
  if (largest === 0) return 1;
  const power = 10 ** Math.floor(Math.log10(largest));
  const steps = [1, 1.2, 1.6, 2, 2.4, 3, 4, 5, 6, 8, 10];
  return power * (steps.find((step) => step * power >= largest * 1.02) ?? 12);
}
