/** Are the residuals noise? Histogram and normal plot of single readings, with each condition at its largest residual. */
import { Chart } from "../charts/chart";
import type { Looks } from "../charts/looks";
import { type Marks, marked, marksOf } from "../charts/marks";
import { onCurve } from "../charts/normal_plot";
import { drawing, type Panel, reachOf } from "../charts/panels";
import { line, points } from "../charts/series";
import { digits } from "../format";
import * as History from "../history";
import { picking } from "../picks";
import type { View } from "../wire";
import { Picked } from "./picked";
import { where } from "./residuals";
import type { BenchProps } from "./screen";

const SPRINGS = "springs alone";
const NOW = "current model";
const NOISE = "noise alone";
const CONDITIONS = "a condition, at its largest residual";

export function ScatterSheet({ store, bench }: BenchProps) {
  const springs = History.springs(bench.history).view.scatter;
  const now = History.now(bench.history).view.scatter;
  const { conditions } = bench.opened;
  // A condition without any reading that counts has no residual, hence no place.
  const marks = { ...marksOf(bench, "fitted"), out: [] };
  const draw = (width: number, looks: Looks) => {
    const panels = [histogram(springs, now, marks, looks), quantiles(springs, now, marks, looks)];
    const tooltip = (series: string, _: number, x: number, y: number, index: number) =>
      series === CONDITIONS
        ? `largest residual ${digits(y)} times the noise\n${where(conditions, index)}`
        : `${series}: expected ${digits(x)}, observed ${digits(y)}`;
    const half = Math.floor(width / 2) > 300 ? 2 : 1;
    const legend = [NOISE, SPRINGS, NOW, CONDITIONS];
    return drawing({ panels, x: "times the noise", across: half, legend, tooltip, tall: true }, width, looks);
  };
  return (
    <>
      <Chart
        name="scatter"
        of={[springs, now, bench.picked]}
        shape={`scatter ${marks.shape}`}
        label="Histogram and normal plot of the residuals of single readings, in units of the noise"
        draw={draw}
        pick={picking(store, "fitted", conditions.pose.length)}
      />
      <Picked store={store} bench={bench} />
      <p class="hint">Residuals of single readings divided by their noise. Noise alone follows the dashed lines.</p>
    </>
  );
}

type Scatter = View["scatter"];

function histogram(springs: Scatter, now: Scatter, marks: Marks, looks: Looks): Panel {
  const reach = reachOf([...springs.histogram, ...now.histogram].map(([x]) => x));
  const feet = now.extremes.map((value) => [value ?? Number.NaN, 0]);
  // Only those picked are seen here, at the foot.
  const [, ...rings] = marked(CONDITIONS, feet, { colour: looks.now }, marks, looks);
  return {
    title: "density",
    series: [
      line(NOISE, bell(reach), looks.grey, "dashed"),
      line(SPRINGS, springs.histogram, looks.before),
      { ...line(NOW, now.histogram, looks.now), areaStyle: { color: looks.now, opacity: 0.12 } },
      ...rings,
    ],
  };
}

function quantiles(springs: Scatter, now: Scatter, marks: Marks, looks: Looks): Panel {
  const reach = reachOf([...springs.quantiles, ...now.quantiles].map(([x]) => x));
  const conditions = now.extremes.map((value) => [value === null ? Number.NaN : onCurve(now.quantiles, value), value ?? Number.NaN]);
  return {
    title: "observed against expected quantile",
    series: [
      line(
        NOISE,
        [
          [-reach, -reach],
          [reach, reach],
        ],
        looks.grey,
        "dashed",
      ),
      { ...points(SPRINGS, springs.quantiles, { colour: looks.before, symbol: "rect", size: 4, opacity: 0.6 }), silent: true },
      line(NOW, now.quantiles, looks.now),
      ...marked(CONDITIONS, conditions, { colour: looks.now, size: 6 }, marks, looks),
    ],
  };
}

/** The standard normal density. */
function bell(reach: number): number[][] {
  const steps = 80;
  return Array.from({ length: steps + 1 }, (_, i) => {
    const x = -reach + (2 * reach * i) / steps;
    return [x, Math.exp(-0.5 * x * x) / Math.sqrt(2 * Math.PI)];
  });
}
