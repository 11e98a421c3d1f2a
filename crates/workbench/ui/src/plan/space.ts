/** The readings of a plan in space. Lengths in mm. */
import type { Looks } from "../charts/looks";
import { setting } from "../format";
import type { Target } from "../machine/hover";
import type { Shape } from "../machine/paint";
import { axes, joints, load, middle, numbers, outline, plate, tips } from "../machine/parts";
import type { Painted } from "../machine/scene";
import type { NextReport, Opened, Six, Three } from "../wire";
import { loadOf, type Plan, repeatsOf } from "./choice";

/** The machine at the reading picked (else the first one), the platforms and loads of the others, and where was measured already. */
export function painted(opened: Opened, plan: Plan, pointed: number | null, looks: Looks): Painted<number> {
  const base = opened.base_joints_mm;
  const radius = Math.max(...base.map(([x, y]) => Math.hypot(x, y)), 1);
  const { next, platform_joints_mm: platforms } = plan.answer;
  const repeats = repeatsOf(plan);
  const front = pointed ?? plan.picked ?? 0;
  const largest = largestOf(next);
  const shapes: Shape[] = [
    plate(base, looks.grey, 0.16),
    ...outline(base, looks.grey, radius / 150),
    ...joints(base, radius / 30, looks.grey),
    ...joints(measuredAt(opened), radius / 70, looks.grey),
    ...legs(base, platforms[front] ?? [], radius, looks),
    ...axes(base, radius, looks),
    ...numbers(base, radius, looks),
  ];
  const targets: Target<number>[] = [];
  next.forEach((reading, k) => {
    const [platform, origin] = [platforms[k] ?? [], originOf(reading)];
    const isFront = k === front;
    const taken = (repeats[k] ?? 0) > 0;
    const colour = taken ? looks.now : looks.grey;
    const marked = k === pointed || k === plan.picked;
    shapes.push(...outline(platform, colour, isFront ? radius / 90 : taken ? radius / 220 : 0));
    if (isFront) shapes.push(plate(platform, colour, 0.18), ...joints(platform, radius / 45, colour));
    shapes.push(...joints([origin], radius / (marked ? 24 : 40), colour));
    const look = { colour: marked ? looks.before : looks.ink, thick: marked ? 2.2 : 1, words: isFront };
    if (taken || isFront) shapes.push(...load(loadOf(reading), largest, origin, radius, looks, look));
    const ends = tips(loadOf(reading), largest, origin, radius);
    const text = wordsOf(reading, k, repeats[k] ?? 0);
    for (const to of ends.length > 0 ? ends : [origin]) targets.push({ of: k, from: origin, to, text });
  });
  return { shapes, targets, about: middle([...base, ...platforms.flat()]), radius, scale: { factor: 0, ink: looks.ink } };
}

function legs(base: Three[], platform: Three[], radius: number, looks: Looks): Shape[] {
  return base.flatMap((from, i): Shape[] => {
    const to = platform[i];
    return to === undefined ? [] : [{ kind: "rod", from, to, radius: radius / 60, colour: looks.grid }];
  });
}

/** Mobile origins of the conditions measured, each once. */
export function measuredAt({ conditions }: Opened): Three[] {
  const places = conditions.pose.map((pose) => pose.slice(0, 3) as Three);
  return [...new Map(places.map((place) => [place.map((value) => value.toFixed(2)).join(), place])).values()];
}

function originOf({ pose }: NextReport): Three {
  return pose.slice(0, 3) as Three;
}

/** Largest force and moment: N, N m. */
function largestOf(next: NextReport[]): [number, number] {
  const most = (from: number) => Math.max(1e-9, ...next.map((reading) => Math.hypot(...loadOf(reading).slice(from, from + 3))));
  return [most(0), most(3)];
}

function wordsOf(reading: NextReport, k: number, repeats: number): string {
  const set = (values: Six) => values.map((value) => setting(value)).join(", ");
  const often = repeats === 0 ? "left out" : repeats === 1 ? "once" : `${repeats} times`;
  return `reading ${k + 1}, ${often}: pose [${set(reading.pose)}] mm, deg; change of load [${set(loadOf(reading))}] N, N m`;
}
