/** Parts of the machine as shapes. Lengths in mm. */
import type { Looks } from "../charts/looks";
import { setting } from "../format";
import type { Six, Three } from "../wire";
import type { Shown } from "./body";
import { mixed, type Shape } from "./paint";
import { along, length, minus, unit } from "./vectors";

/** Legs coloured by what the model leaves in them; one that is picked or pointed at has a rim. */
export function legs(base: Three[], platform: Three[], shown: Shown, radius: number, looks: Looks): Shape[] {
  const { residual, reach, marked: marks } = shown;
  const marked = (leg: number) => marks.some((part) => part.kind === "leg" && part.leg === leg);
  return base.flatMap((from, i): Shape[] => {
    const to = platform[i];
    if (to === undefined) return [];
    const colour = shade((residual[i] ?? 0) / reach, looks);
    // A rim, painted before the leg itself at the same depth.
    const rim: Shape[] = marked(i) ? [{ kind: "rod", from, to, radius: radius / 24, colour: looks.ink }] : [];
    return [
      ...rim,
      { kind: "rod", from, to, radius: radius / 45, colour },
      ...joints([from], radius / 30, marked(i) ? looks.ink : looks.grey),
    ];
  });
}

/** Longer than predicted: one end of the scale; shorter: the other; nothing left: grey. */
function shade(share: number, looks: Looks): string {
  return mixed(looks.grid, share > 0 ? looks.longer : looks.shorter, Math.min(1, Math.abs(share)));
}

export function joints(places: Three[], radius: number, colour: string): Shape[] {
  return places.map((at) => ({ kind: "ball", at, radius, colour }));
}

/** Outline of a plate with rods of a radius; thin dashed lines for none. */
export function outline(places: Three[], colour: string, radius: number): Shape[] {
  const corners = around(places);
  return corners.map((from, i) => {
    const to = corners[(i + 1) % corners.length] ?? from;
    return radius > 0 ? { kind: "rod", from, to, radius, colour } : { kind: "dashes", from, to, colour };
  });
}

export function plate(places: Three[], colour: string, opacity: number): Shape {
  return { kind: "face", corners: around(places), colour, opacity };
}

/** How an arrow is drawn: its colour, how many times thicker, whether its size stands beside it. */
export interface ArrowLook {
  colour?: string;
  thick?: number;
  words?: boolean;
}

/** Tips of the arrows of a load: force, moment; none where it is zero. */
export function tips(wrench: Six, largest: [number, number], origin: Three, radius: number): Three[] {
  return [0, 3].flatMap((first, k): Three[] => {
    const vector = wrench.slice(first, first + 3) as Three;
    const size = length(vector);
    return size === 0 ? [] : [along(origin, unit(vector), shareOf(size, largest[k] ?? size) * radius)];
  });
}

/** Length of an arrow over the radius of the base. */
function shareOf(size: number, most: number): number {
  return Math.max(SHORTEST, LONGEST * Math.min(1, size / most));
}

/** Length of the arrow of the largest load, and the shortest one on which a head is seen, over the radius of the base. */
const LONGEST = 0.75;
const SHORTEST = 0.2;
const HEAD = 0.12;

/**
 * The change of the load at the mobile origin: its force as an arrow, its moment as one with two heads along its axis (right hand);
 * lengths are shares of the largest of the campaign (N, N m).
 */
export function load(wrench: Six, largest: [number, number], origin: Three, radius: number, looks: Looks, look: ArrowLook = {}): Shape[] {
  const { colour = looks.ink, thick = 1, words = true } = look;
  const [fx, fy, fz, mx, my, mz] = wrench;
  const arrow = (vector: Three, most: number, heads: number, unitOf: string): Shape[] => {
    const size = length(vector);
    if (size === 0) return [];
    const share = shareOf(size, most);
    const direction = unit(vector);
    const at = (part: number) => along(origin, direction, part * radius);
    const tips = Array.from({ length: heads }, (_, k) => share - 0.8 * HEAD * k);
    return [
      { kind: "rod", from: origin, to: at(share - HEAD), radius: (thick * radius) / 150, colour },
      ...tips.map((tip): Shape => ({ kind: "head", from: at(tip - HEAD), to: at(tip), radius: 0.04 * thick * radius, colour })),
      ...(words ? [label(`${setting(size)} ${unitOf}`, at(share + 0.1), colour, looks)] : []),
    ];
  };
  return [...arrow([fx, fy, fz], largest[0], 1, "N"), ...arrow([mx, my, mz], largest[1], 2, "N m")];
}

function label(text: string, at: Three, colour: string, { paper }: Looks): Shape {
  return { kind: "text", at, text, colour, halo: paper };
}

/** Numbers of the legs, outside of their base joints. */
export function numbers(base: Three[], radius: number, looks: Looks): Shape[] {
  const centre = middle(base);
  return base.map((joint, i) => label(String(i + 1), along(joint, unit(minus(joint, centre)), 0.13 * radius), looks.ink, looks));
}

/** Directions of the fixed axes, at the middle of the base. */
export function axes(base: Three[], radius: number, looks: Looks): Shape[] {
  const from = middle(base);
  const directions: [string, Three][] = [
    ["x", [1, 0, 0]],
    ["y", [0, 1, 0]],
    ["z", [0, 0, 1]],
  ];
  return directions.flatMap(([name, direction]): Shape[] => {
    const [neck, tip] = [along(from, direction, 0.18 * radius), along(from, direction, 0.24 * radius)];
    return [
      { kind: "rod", from, to: neck, radius: radius / 200, colour: looks.grey },
      { kind: "head", from: neck, to: tip, radius: 0.025 * radius, colour: looks.grey },
      label(name, along(from, direction, 0.31 * radius), looks.grey, looks),
    ];
  });
}

/** Joints in the order of their angle, so that the outline does not cross itself. */
function around(places: Three[]): Three[] {
  const [x, y] = middle(places);
  const angle = (place: Three) => Math.atan2(place[1] - y, place[0] - x);
  return [...places].sort((p, q) => angle(p) - angle(q));
}

export function middle(places: Three[]): Three {
  const sum: Three = [0, 0, 0];
  for (const [x, y, z] of places) {
    sum[0] += x;
    sum[1] += y;
    sum[2] += z;
  }
  const count = Math.max(places.length, 1);
  return [sum[0] / count, sum[1] / count, sum[2] / count];
}
