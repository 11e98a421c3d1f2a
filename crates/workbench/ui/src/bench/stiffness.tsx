/** Leg stiffnesses beside each other, with bars of two standard uncertainties. */
import { Chart } from "../charts/chart";
import type { Looks } from "../charts/looks";
import { drawing, type Sheet } from "../charts/panels";
import { line, points } from "../charts/series";
import { digits } from "../format";
import type { Leg } from "../wire";

const SPRINGS = "springs alone";
const NOW = "now";
const NOMINAL = "nominal";
/** Expanded uncertainty: two standard deviations. */
const COVERAGE = 2;
const ASIDE = 0.14;

export function StiffnessChart({ springs, now }: { springs: Leg[]; now: Leg[] }) {
  return (
    <Chart
      name="stiffness"
      shape="stiffness"
      label="Stiffness of the six legs with uncertainty: springs alone, now, nominal"
      draw={(width, looks) => drawing(sheet(springs, now, looks), width, looks)}
    />
  );
}

function sheet(springs: Leg[], now: Leg[], looks: Looks): Sheet {
  const series = [
    points(
      NOMINAL,
      values(now, 0, ({ nominal }) => nominal),
      { colour: looks.grey, symbol: "diamond", size: 9 },
    ),
    points(
      SPRINGS,
      values(springs, -ASIDE, ({ stiffness }) => stiffness),
      { colour: looks.before, symbol: "rect" },
    ),
    line(SPRINGS, bars(springs, -ASIDE), looks.before),
    points(
      NOW,
      values(now, ASIDE, ({ stiffness }) => stiffness),
      { colour: looks.now },
    ),
    line(NOW, bars(now, ASIDE), looks.now),
  ];
  const nominal = now.some((leg) => leg.nominal !== null);
  return {
    panels: [{ title: "stiffness (N/um)", series }],
    x: `leg (bars: ${COVERAGE} standard uncertainties)`,
    across: 1,
    legend: nominal ? [SPRINGS, NOW, NOMINAL] : [SPRINGS, NOW],
    tooltip: (name, _, x, y) => `leg ${Math.round(x)}, ${name}: ${digits(y, 4)} N/um`,
  };
}

function values(legs: Leg[], aside: number, of: (leg: Leg) => number | null): number[][] {
  return legs.flatMap((leg, i) => {
    const value = of(leg);
    return value === null ? [] : [[i + 1 + aside, value]];
  });
}

/** Bars as one line with gaps. */
function bars(legs: Leg[], aside: number): (number | null)[][] {
  return legs.flatMap(({ stiffness, std }, i) => {
    if (stiffness === null || std === null) return [];
    const x = i + 1 + aside;
    return [
      [x, stiffness - COVERAGE * std],
      [x, stiffness + COVERAGE * std],
      [null, null],
    ];
  });
}
