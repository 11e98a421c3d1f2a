/** Are the residuals noise? Histogram and normal plot of single readings. */
import { Chart } from "../charts/chart";
import type { Looks } from "../charts/looks";
import { drawing, type Panel, reachOf } from "../charts/panels";
import { line, points } from "../charts/series";
import { digits } from "../format";
import * as History from "../history";
import type { View } from "../wire";
import type { BenchProps } from "./screen";

const SPRINGS = "springs alone";
const NOW = "current model";
const NOISE = "noise alone";

export function ScatterSheet({ bench }: BenchProps) {
  const springs = History.springs(bench.history).view.scatter;
  const now = History.now(bench.history).view.scatter;
  const draw = (width: number, looks: Looks) => {
    const panels = [histogram(springs, now, looks), quantiles(springs, now, looks)];
    const tooltip = (series: string, _: number, x: number, y: number) => `${series}: expected ${digits(x)}, observed ${digits(y)}`;
    const half = Math.floor(width / 2) > 300 ? 2 : 1;
    return drawing({ panels, x: "times the noise", across: half, legend: [NOISE, SPRINGS, NOW], tooltip, tall: true }, width, looks);
  };
  return (
    <>
      <Chart
        name="scatter"
        of={[springs, now]}
        shape="scatter"
        label="Histogram and normal plot of the residuals of single readings, in units of the noise"
        draw={draw}
      />
      <p class="hint">Residuals of single readings divided by their noise. Noise alone follows the dashed lines.</p>
    </>
  );
}

type Scatter = View["scatter"];

function histogram(springs: Scatter, now: Scatter, looks: Looks): Panel {
  const reach = reachOf([...springs.histogram, ...now.histogram].map(([x]) => x));
  return {
    title: "density",
    series: [
      line(NOISE, bell(reach), looks.grey, "dashed"),
      line(SPRINGS, springs.histogram, looks.before),
      { ...line(NOW, now.histogram, looks.now), areaStyle: { color: looks.now, opacity: 0.12 } },
    ],
  };
}

function quantiles(springs: Scatter, now: Scatter, looks: Looks): Panel {
  const reach = reachOf([...springs.quantiles, ...now.quantiles].map(([x]) => x));
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
      points(SPRINGS, springs.quantiles, { colour: looks.before, symbol: "rect", size: 4, opacity: 0.6 }),
      points(NOW, now.quantiles, { colour: looks.now, size: 5 }),
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
