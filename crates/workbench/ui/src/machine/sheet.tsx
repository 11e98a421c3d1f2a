/** The machine in three dimensions. */
import { useMemo, useState } from "preact/hooks";
import { Options } from "../bench/options";
import { Picked } from "../bench/picked";
import { StepPicture } from "../bench/pictures";
import type { BenchProps } from "../bench/screen";
import { type Looks, looks } from "../charts/looks";
import { reachOf } from "../charts/panels";
import { digits, setting, unitName } from "../format";
import * as History from "../history";
import { allOf, leadOf, picking, turned } from "../picks";
import type { Part } from "../state";
import { useDark } from "../theme";
import type { Opened, Six, View } from "../wire";
import type { Moved, Shown } from "./body";
import { Key } from "./key";
import { pickPart } from "./part";
import { Stage } from "./stage";

/** Deflections, or what the model misses of them. */
export type Quantity = "deflections" | "missed";

const LARGEST_EXPONENT = 5.5;
const ZERO: Six = [0, 0, 0, 0, 0, 0];

export function MachineSheet({ store, bench }: BenchProps) {
  const { opened, history } = bench;
  const springs = History.springs(history).view;
  const view = History.now(history).view;
  const dark = useDark();
  const worst = useMemo(() => worstOf(springs.residual_um), [springs]);
  const reach = useMemo(() => reachOf(springs.residual_um.flat()), [springs]);
  const index = leadOf(bench.picked, "fitted") ?? worst;
  const several = allOf(bench.picked, "fitted").length;
  const [pictured, setPictured] = useState(false);
  const [quantity, setQuantity] = useState<Quantity>("deflections");
  const [exponent, setExponent] = useState<Record<Quantity, number>>(() => ({
    deflections: usualExponent(opened, opened.conditions.measured_motion),
    missed: usualExponent(opened, missed(opened, springs)),
  }));
  const [pointed, point] = useState<Part | null>(null);
  const { conditions } = opened;
  const setIndex = (condition: number) => picking(store, "fitted", conditions.pose.length).one(condition, false);
  const residual = view.residual_um[index] ?? ZERO;
  const shown: Shown = {
    base: opened.base_joints_mm,
    platform: conditions.platform_joints_mm[index] ?? [],
    origin: (conditions.pose[index] ?? ZERO).slice(0, 3) as [number, number, number],
    wrench: conditions.wrench[index] ?? null,
    largest: useMemo(() => largestOf(conditions.wrench), [conditions]),
    legs: legTexts(opened, residual, index),
    load: `load [${set(conditions.wrench[index])}] N, N m`,
    marked: [bench.picked?.part, pointed].filter((part) => part != null),
    moved: moved(quantity, opened, springs, view, index, looks(dark)),
    factor: 10 ** exponent[quantity],
    residual,
    reach,
  };
  return (
    <>
      <div class="row">
        <Options
          label="show"
          name="machine"
          value={quantity}
          options={[
            { id: "deflections", title: "deflection, measured and predicted" },
            { id: "missed", title: "residual: measured minus predicted" },
          ]}
          set={setQuantity}
        />
        <Slider
          name="condition"
          title={`condition ${index + 1} of ${conditions.pose.length}`}
          range={[0, conditions.pose.length - 1, 1]}
          value={index}
          set={setIndex}
        />
        <Slider
          name="factor"
          title={`motion enlarged ${digits(shown.factor, 2)} times`}
          range={[0, LARGEST_EXPONENT, 0.05]}
          value={exponent[quantity]}
          set={(value) => setExponent({ ...exponent, [quantity]: value })}
        />
        <button type="button" class="quiet" onClick={() => setIndex(worst)}>
          Largest residual of the springs
        </button>
        {several > 1 && bench.picked && (
          <button type="button" data-testid="next-picked" onClick={() => bench.picked && store.pick(turned(bench.picked))}>
            Next of the {several} selected
          </button>
        )}
      </div>
      <Stage
        shown={shown}
        of={[view, index, quantity, exponent, bench.picked, pointed]}
        dark={dark}
        picked={bench.picked}
        parts={{ pick: (part) => pickPart(store, bench, part, view, index), hover: point }}
      />
      <Key quantity={quantity} reach={reach} />
      <p class="hint" data-testid="machine-text">
        Pose [{set(conditions.pose[index])}] mm, deg; load [{set(conditions.wrench[index])}] N, N m. Leg residuals, {unitName("um")}:{" "}
        {six(residual)}.
      </p>
      <Picked store={store} bench={bench} inChart={false} />
      <details onToggle={(event) => setPictured(event.currentTarget.open)}>
        <summary data-testid="step-picture">The current step in one picture</summary>
        {pictured && <StepPicture store={store} bench={bench} />}
      </details>
    </>
  );
}

interface SliderProps {
  name: string;
  title: string;
  /** From, to, step. */
  range: [number, number, number];
  value: number;
  set: (value: number) => void;
}

function Slider({ name, title, range: [min, max, step], value, set }: SliderProps) {
  return (
    <label class="slider">
      <span>{title}</span>
      <input
        type="range"
        min={min}
        max={max}
        step={step}
        value={value}
        data-testid={name}
        onInput={(event) => set(Number(event.currentTarget.value))}
      />
    </label>
  );
}

/** Platforms drawn at a condition; the first carries the legs. */
function moved(quantity: Quantity, opened: Opened, springs: View, view: View, index: number, looks: Looks): Moved[] {
  const measured = opened.conditions.measured_motion[index] ?? ZERO;
  const predicted = view.predicted_motion[index] ?? ZERO;
  if (quantity === "deflections") {
    return [
      { motion: measured, colour: looks.ink },
      { motion: predicted, colour: looks.now },
    ];
  }
  return [
    { motion: minus(measured, predicted), colour: looks.now },
    { motion: minus(measured, springs.predicted_motion[index] ?? ZERO), colour: looks.before },
  ];
}

function missed({ conditions }: Opened, view: View): Six[] {
  return conditions.measured_motion.map((motion, i) => minus(motion, view.predicted_motion[i] ?? ZERO));
}

function minus(a: Six, b: Six): Six {
  return a.map((value, k) => value - (b[k] ?? 0)) as Six;
}

/** Largest force and moment of all conditions: N, N m. */
function largestOf(wrenches: Six[]): [number, number] {
  const most = (from: number) => Math.max(1e-9, ...wrenches.map((six) => Math.hypot(...six.slice(from, from + 3))));
  return [most(0), most(3)];
}

/** What is said of each leg where the pointer is at it. */
function legTexts({ conditions }: Opened, residual: Six, index: number): string[] {
  return residual.map((left, leg) => {
    const [force, size] = [conditions.leg_force_n[index]?.[leg] ?? 0, conditions.leg_length_mm[index]?.[leg] ?? 0];
    return `leg ${leg + 1}: ${digits(left)} ${unitName("um")} left; force change ${digits(force)} N; length ${digits(size, 4)} mm`;
  });
}

/** The condition with the largest residual. */
function worstOf(residual: Six[]): number {
  const sizes = residual.map((six) => Math.hypot(...six));
  return Math.max(0, sizes.indexOf(Math.max(...sizes)));
}

/** Power of ten that makes the largest motion a good part of the machine's width. */
function usualExponent({ base_joints_mm }: Opened, motions: Six[]): number {
  const radius_um = 1000 * Math.max(1, ...base_joints_mm.map(([x, y]) => Math.hypot(x, y)));
  const size = ([x, y, z, rx, ry, rz]: Six) => Math.hypot(x, y, z) + radius_um * 0.5e-6 * Math.hypot(rx, ry, rz);
  const largest_um = Math.max(1e-3, ...motions.map(size));
  return Math.min(LARGEST_EXPONENT, Math.max(0, Math.log10((0.35 * radius_um) / largest_um)));
}

function set(values: Six | undefined): string {
  return (values ?? []).map((value) => setting(value)).join(", ");
}

function six(values: Six | undefined): string {
  return (values ?? []).map((value) => digits(value)).join(", ");
}
