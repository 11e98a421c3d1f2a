/** Leg stiffnesses beside each other, with bars of two standard uncertainties, as share of what the springs alone say. */
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
/** Legs stand at whole numbers; what belongs to one leg stands beside each other. */
const ASIDE = 0.14;

const LABEL = "Stiffness of the six legs with uncertainty, as percent change from the springs alone: springs alone, now, nominal";

export function StiffnessChart({ springs, now }: { springs: Leg[]; now: Leg[] }) {
  return (
    <Chart
      name="stiffness"
      of={[springs, now]}
      shape="stiffness"
      label={LABEL}
      draw={(width, looks) => drawing(sheet(springs, now, looks), width, looks)}
    />
  );
}

/** Where a leg's value stands: percent beside the springs alone. */
interface Mark {
  x: number;
  percent: number;
  half: number;
}

function sheet(springs: Leg[], now: Leg[], looks: Looks): Sheet {
  const before = marks(springs, springs, -ASIDE, ({ stiffness }) => stiffness);
  const after = marks(springs, now, ASIDE, ({ stiffness }) => stiffness);
  const nominal = marks(springs, now, 0, (leg) => leg.nominal);
  const at = (list: Mark[]) => list.map(({ x, percent }) => [x, percent]);
  const series = [
    points(NOMINAL, at(nominal), { colour: looks.grey, symbol: "diamond", size: 9 }),
    points(SPRINGS, at(before), { colour: looks.before, symbol: "rect", size: 7 }),
    line(SPRINGS, bars(before), looks.before),
    points(NOW, at(after), { colour: looks.now, size: 7 }),
    line(NOW, bars(after), looks.now),
  ];
  return {
    panels: [{ title: "change from the springs alone (%)", series, span: [0, 7] }],
    x: `leg (bars: ${COVERAGE} standard uncertainties)`,
    across: 1,
    legend: nominal.length > 0 ? [SPRINGS, NOW, NOMINAL] : [SPRINGS, NOW],
    tooltip: (name, _, x, y) => `leg ${Math.round(x)}, ${name}: ${digits(y)} % from the springs alone`,
  };
}

function marks(springs: Leg[], legs: Leg[], aside: number, of: (leg: Leg) => number | null): Mark[] {
  return legs.flatMap((leg, i) => {
    const unit = springs[i]?.stiffness ?? null;
    const value = of(leg);
    if (unit === null || value === null) return [];
    return [{ x: i + 1 + aside, percent: 100 * (value / unit - 1), half: (100 * COVERAGE * (leg.std ?? 0)) / unit }];
  });
}

/** Bars as one line with gaps. */
function bars(list: Mark[]): (number | null)[][] {
  return list.flatMap(({ x, percent, half }) => [
    [x, percent - half],
    [x, percent + half],
    [null, null],
  ]);
}
