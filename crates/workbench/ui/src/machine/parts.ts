/** Parts of the machine as shapes. Lengths in mm. */
import type { Looks } from "../charts/looks";
import type { Six, Three } from "../wire";
import { mixed, type Shape } from "./paint";
import type { Shown } from "./scene";
import { along, length, unit } from "./vectors";

/** Legs coloured by what the model leaves in them. */
export function legs(base: Three[], platform: Three[], { residual, reach }: Shown, radius: number, looks: Looks): Shape[] {
  return base.flatMap((from, i): Shape[] => {
    const to = platform[i];
    if (to === undefined) return [];
    const colour = shade((residual[i] ?? 0) / reach, looks);
    return [{ kind: "rod", from, to, radius: radius / 45, colour }, ...joints([from], radius / 30, looks.grey)];
  });
}

/** Longer than predicted: one end of the scale; shorter: the other; nothing left: grey. */
function shade(share: number, looks: Looks): string {
  return mixed(looks.grid, share > 0 ? looks.before : looks.third, Math.min(1, Math.abs(share)));
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

/** The change of the load at the mobile origin: its force as an arrow, its moment as one with two heads along its axis (right hand). */
export function load([fx, fy, fz, mx, my, mz]: Six, origin: Three, radius: number, looks: Looks): Shape[] {
  const arrow = (vector: Three, shares: number[]) => (length(vector) > 0 ? shares.flatMap((share) => drawn(unit(vector), share)) : []);
  const drawn = (direction: Three, share: number): Shape[] => {
    const [neck, tip] = [along(origin, direction, (share - 0.12) * radius), along(origin, direction, share * radius)];
    return [
      { kind: "rod", from: origin, to: neck, radius: radius / 150, colour: looks.ink },
      { kind: "head", from: neck, to: tip, radius: 0.04 * radius, colour: looks.ink },
    ];
  };
  return [...arrow([fx, fy, fz], [0.6]), ...arrow([mx, my, mz], [0.5, 0.4])];
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
