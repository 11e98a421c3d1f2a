/** Residual sheet: elongation of each leg that the model leaves, against anything it may follow. */
import { useMemo, useState } from "preact/hooks";
import { Chart } from "../charts/chart";
import { legNoise } from "../charts/leg_noise";
import { type Looks, MARKERS } from "../charts/looks";
import { legendOf, type Marks, marked, marksOf, place } from "../charts/marks";
import { drawing, type Panel, reachOf, type Sheet } from "../charts/panels";
import { hasHeldOut, readings, WHICH, type Which } from "../charts/readings";
import { band, points } from "../charts/series";
import { VARIABLES, type Variable, varies } from "../charts/variables";
import { digits, setting, unitName } from "../format";
import * as History from "../history";
import { picking } from "../picks";
import type { ConditionLists, Six } from "../wire";
import { Options } from "./options";
import { Picked } from "./picked";
import type { BenchProps } from "./screen";
import { Story } from "./story";

type Quantity = "left" | "explained";
type Layout = "each" | "all";

const SPRINGS = "springs alone";
const NAMES: Record<Quantity, string> = { left: "current model", explained: "explained by the ticked terms" };
const TITLES: Record<Quantity, string> = { left: "residuals", explained: "part explained by the ticked terms" };
const UM = unitName("um");
const LEGS = [0, 1, 2, 3, 4, 5];

export function ResidualSheet(props: BenchProps) {
  const [open, setOpen] = useState(false);
  return (
    <>
      <Story {...props} />
      <details open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
        <summary data-testid="any-variable">Every leg against any variable</summary>
        {open && <AnyVariable {...props} />}
      </details>
      <Picked store={props.store} bench={props.bench} />
    </>
  );
}

function AnyVariable({ store, bench }: BenchProps) {
  const { opened, history } = bench;
  const [x, setX] = useState("leg-force");
  const [quantity, setQuantity] = useState<Quantity>("left");
  const [layout, setLayout] = useState<Layout>("each");
  const [which, setWhich] = useState<Which>(bench.picked?.which ?? "fitted");
  const before = readings(which, opened, History.springs(history).view);
  const { conditions } = before;
  const variable = VARIABLES.find(({ id }) => id === x) ?? (VARIABLES[0] as Variable);
  const choices = useMemo(
    () => VARIABLES.map((one) => ({ id: one.id, title: `${one.title} (${one.unit})`, disabled: !varies(one, conditions) })),
    [conditions],
  );
  const noise = useMemo(() => legNoise(opened), [opened]);
  const springs = before.residual_um;
  const left = readings(which, opened, History.now(history).view).residual_um;
  const front = quantity === "left" ? left : explained(springs, left);
  const reach = useMemo(() => reachOf(springs.flat()), [springs]);
  const title = `${TITLES[quantity]}: leg elongation in ${UM} against ${variable.title} (${variable.unit})`;
  const marks = marksOf(bench, which);
  const draw = (width: number, looks: Looks) => {
    const data = {
      conditions,
      variable,
      springs,
      front,
      noise,
      marks,
      picked: bench.picked?.part?.kind === "leg" ? bench.picked.part.leg : null,
      name: NAMES[quantity],
      reach: Math.max(reach, reachOf(left.flat())),
    };
    return drawing(layout === "each" ? eachLeg(data, looks) : allLegs(data, looks), width, looks);
  };
  return (
    <>
      <div class="row">
        <Options label="against" name="variable" value={x} options={choices} set={setX} />
        <Options
          label="show"
          name="quantity"
          value={quantity}
          options={[
            { id: "left", title: "residuals" },
            { id: "explained", title: "the part explained by the ticked terms" },
          ]}
          set={setQuantity}
        />
        <Options
          label="legs"
          name="layout"
          value={layout}
          options={[
            { id: "each", title: "separate" },
            { id: "all", title: "all in one" },
          ]}
          set={setLayout}
        />
        {hasHeldOut(opened) && <Options label="of" name="residuals-of" value={which} options={WHICH} set={setWhich} />}
      </div>
      <Chart
        name="residuals"
        of={[springs, left, bench.wanted.exclude, bench.picked]}
        shape={`${layout} ${x} ${quantity} ${which} ${marks.shape}`}
        label={title}
        draw={draw}
        pick={picking(store, which, conditions.pose.length)}
      />
      <p class="hint">
        Leg elongation in {UM} that the model does not predict{shown(conditions)}; the band shows the noise of one reading in that leg.
      </p>
    </>
  );
}

interface Data {
  conditions: ConditionLists;
  variable: Variable;
  springs: Six[];
  front: Six[];
  noise: number[];
  marks: Marks;
  /** The leg that the readings were picked by. */
  picked: number | null;
  name: string;
  reach: number;
}

function eachLeg(data: Data, looks: Looks): Sheet {
  const panels = LEGS.map(
    (leg): Panel => ({
      title: `leg ${leg + 1} (${UM})${leg === data.picked ? ", selected" : ""}`,
      reach: data.reach,
      series: [
        {
          ...points(SPRINGS, along(data, data.springs, leg), { colour: looks.before, symbol: "rect", size: 4, opacity: 0.6 }),
          ...band(data.noise[leg] ?? 0, looks.band),
        },
        ...marked(data.name, along(data, data.front, leg), { colour: looks.now }, data.marks, looks),
      ],
    }),
  );
  return { ...sheet(data), panels, across: 3, legend: legendOf([SPRINGS, data.name], data.marks) };
}

function allLegs(data: Data, looks: Looks): Sheet {
  const mean = Math.sqrt(data.noise.reduce((sum, sigma) => sum + sigma ** 2, 0) / data.noise.length);
  const back = LEGS.flatMap((leg) => along(data, data.springs, leg));
  const legs = LEGS.flatMap((leg) => {
    const look = { colour: looks.legs[leg] ?? looks.ink, symbol: MARKERS[leg] ?? "circle", size: 7 };
    return marked(`leg ${leg + 1}`, along(data, data.front, leg), look, data.marks, looks);
  });
  const series = [{ ...points(SPRINGS, back, { colour: looks.grey, size: 3, opacity: 0.4 }), ...band(mean, looks.band) }, ...legs];
  const legend = legendOf([SPRINGS, ...LEGS.map((leg) => `leg ${leg + 1}`)], data.marks);
  return { ...sheet(data), panels: [{ title: `all legs (${UM})`, reach: data.reach, series }], across: 1, legend };
}

function sheet({ variable, conditions }: Data): Pick<Sheet, "x" | "tooltip"> {
  const count = conditions.pose.length;
  return {
    x: `${variable.title} (${variable.unit})`,
    tooltip: (series, _, x, y, index) =>
      `${series}: ${digits(y)} ${UM}\n${variable.title} ${digits(x, 4)} ${variable.unit}\n${where(conditions, index % count)}`,
  };
}

function along({ conditions, variable }: Data, residual: Six[], leg: number): number[][] {
  return residual.map((six, i) => [variable.value(conditions, i, leg), six[leg] ?? 0]);
}

function explained(springs: Six[], left: Six[]): Six[] {
  return springs.map((six, i) => six.map((value, leg) => value - (left[i]?.[leg] ?? 0)) as Six);
}

/** Pose, load and lines of a condition. */
export function where(conditions: ConditionLists, index: number): string {
  const six = (list: Six[]) => (list[index] ?? []).map((value) => setting(value)).join(", ");
  return `pose [${six(conditions.pose)}] mm, deg\nload [${six(conditions.wrench)}] N, N m\n${place(conditions, index)}`;
}

function shown(conditions: ConditionLists): string {
  const count = conditions.pose.length;
  return conditions.of > count ? `, ${count} of ${conditions.of} conditions, evenly spaced` : "";
}
