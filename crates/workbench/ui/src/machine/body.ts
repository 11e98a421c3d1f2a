/** The machine under a load as shapes. Lengths in mm, z upwards. */
import type { Looks } from "../charts/looks";
import type { Part } from "../state";
import type { Six, Three } from "../wire";
import { displaced } from "./displaced";
import type { Target } from "./hover";
import { axes, joints, legs, load, middle, numbers, outline, plate, tips } from "./parts";
import type { Painted } from "./scene";

/** A moved platform: its motion (um, urad), its colour. */
export interface Moved {
  motion: Six;
  colour: string;
}

/** What is drawn. */
export interface Shown {
  base: Three[];
  platform: Three[];
  /** Mobile origin. */
  origin: Three;
  /** Change of the wrench, and the largest force and moment of all conditions (N, N m). */
  wrench: Six | null;
  largest: [number, number];
  /** The first one carries the legs. */
  moved: Moved[];
  factor: number;
  /** What is said of each leg, and of the load. */
  legs: string[];
  load: string;
  /** Parts that are picked or pointed at. */
  marked: Part[];
  /** Elongations left, um, and the magnitude that gets the full colour. */
  residual: Six;
  reach: number;
}

export function painted(shown: Shown, looks: Looks): Painted<Part> {
  const { base, platform, origin, wrench, largest, moved } = shown;
  const radius = Math.max(...base.map(([x, y]) => Math.hypot(x, y)), 1);
  const places = moved.map(({ motion }) => displaced(platform, origin, motion, shown.factor));
  const platforms = places.flatMap((place, i) => {
    const colour = moved[i]?.colour ?? looks.ink;
    return [plate(place, colour, 0.18), ...outline(place, colour, radius / 90), ...joints(place, radius / 45, colour)];
  });
  const ends = places[0] ?? platform;
  const thick = shown.marked.some(({ kind }) => kind === "load") ? 2.2 : 1;
  const shapes = [
    plate(base, looks.grey, 0.16),
    ...outline(base, looks.grey, radius / 150),
    ...outline(platform, looks.grey, 0),
    ...legs(base, ends, shown, radius, looks),
    ...platforms,
    ...(wrench ? load(wrench, largest, origin, radius, looks, { thick }) : []),
    ...axes(base, radius, looks),
    ...numbers(base, radius, looks),
  ];
  return {
    shapes,
    targets: targetsOf(shown, ends, radius),
    about: middle([...base, ...platform]),
    radius,
    scale: { factor: shown.factor, ink: looks.ink },
  };
}

/** The arrows of the load, and legs with their joints. */
function targetsOf({ base, legs, load, wrench, largest, origin }: Shown, ends: Three[], radius: number): Target<Part>[] {
  const ofLegs = base.map((from, leg): Target<Part> => ({ of: { kind: "leg", leg }, from, to: ends[leg] ?? from, text: legs[leg] ?? "" }));
  const arrows = wrench === null ? [] : tips(wrench, largest, origin, radius);
  return [...arrows.map((to): Target<Part> => ({ of: { kind: "load" }, from: origin, to, text: load })), ...ofLegs];
}
