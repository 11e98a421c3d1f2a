/** Parts of the machine as shapes. Lengths in mm. */
import {
  ArrowHelper,
  BufferGeometry,
  Color,
  CylinderGeometry,
  DoubleSide,
  Group,
  LineDashedMaterial,
  LineLoop,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  type Object3D,
  SphereGeometry,
  Vector3,
} from "three";
import type { Looks } from "../charts/looks";
import type { Six, Three } from "../wire";
import type { Shown } from "./scene";

/** Legs coloured by what the model leaves in them. */
export function legs(base: Three[], platform: Three[], { residual, reach }: Shown, radius: number, looks: Looks): Object3D[] {
  return base.flatMap((from, i) => {
    const to = platform[i];
    if (to === undefined) return [];
    const colour = shade((residual[i] ?? 0) / reach, looks);
    return [rod(new Vector3(...from), new Vector3(...to), radius / 45, colour), ...joints([from], radius / 30, looks.grey)];
  });
}

/** Longer than predicted: one end of the scale; shorter: the other; nothing left: grey. */
function shade(share: number, looks: Looks): Color {
  const end = new Color(share > 0 ? looks.before : looks.third);
  return new Color(looks.grid).lerp(end, Math.min(1, Math.abs(share)));
}

function rod(from: Vector3, to: Vector3, radius: number, colour: Color | string): Mesh {
  const along = to.clone().sub(from);
  const mesh = new Mesh(new CylinderGeometry(radius, radius, along.length(), 16), new MeshLambertMaterial({ color: colour }));
  mesh.position.copy(from).addScaledVector(along, 0.5);
  mesh.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), along.normalize());
  return mesh;
}

export function joints(places: Three[], radius: number, colour: string): Mesh[] {
  return places.map((place) => {
    const mesh = new Mesh(new SphereGeometry(radius, 16, 12), new MeshLambertMaterial({ color: colour }));
    mesh.position.set(...place);
    return mesh;
  });
}

/** Outline of a plate with rods of a radius; a thin dashed line for none. */
export function outline(places: Three[], colour: string, radius: number): Object3D {
  const corners = around(places);
  if (radius > 0) {
    const group = new Group();
    corners.forEach((from, i) => {
      group.add(rod(from, corners[(i + 1) % corners.length] ?? from, radius, colour));
    });
    return group;
  }
  const loop = new LineLoop(
    new BufferGeometry().setFromPoints(corners),
    new LineDashedMaterial({ color: colour, dashSize: 8, gapSize: 6 }),
  );
  loop.computeLineDistances();
  return loop;
}

export function plate(places: Three[], colour: string, opacity: number): Mesh {
  const corners = around(places);
  const geometry = new BufferGeometry().setFromPoints(corners);
  geometry.setIndex(corners.slice(2).flatMap((_, i) => [0, i + 1, i + 2]));
  const material = new MeshBasicMaterial({ color: colour, opacity, transparent: true, side: DoubleSide, depthWrite: false });
  return new Mesh(geometry, material);
}

/** The change of the load at the mobile origin: its force as an arrow, its moment as one with two heads along its axis (right hand). */
export function load([fx, fy, fz, mx, my, mz]: Six, origin: Three, radius: number, looks: Looks): Object3D[] {
  const force = new Vector3(fx, fy, fz);
  const moment = new Vector3(mx, my, mz);
  const drawn = (along: Vector3, share: number) =>
    new ArrowHelper(along, new Vector3(...origin), share * radius, looks.ink, 0.12 * radius, 0.07 * radius);
  const all: Object3D[] = [];
  if (force.length() > 0) all.push(drawn(force.normalize(), 0.6));
  if (moment.length() > 0) {
    moment.normalize();
    all.push(drawn(moment, 0.5), drawn(moment, 0.4));
  }
  return all;
}

/** Joints in the order of their angle, so that the outline does not cross itself. */
function around(places: Three[]): Vector3[] {
  const [x, y] = middle(places);
  const angle = (place: Three) => Math.atan2(place[1] - y, place[0] - x);
  return [...places].sort((p, q) => angle(p) - angle(q)).map((place) => new Vector3(...place));
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
