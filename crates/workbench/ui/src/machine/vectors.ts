/** Vectors of three numbers. */
import type { Three } from "../wire";

export function minus(a: Three, b: Three): Three {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function dot(a: Three, b: Three): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Three, b: Three): Three {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function length(a: Three): number {
  return Math.hypot(...a);
}

export function unit(a: Three): Three {
  const size = length(a) || 1;
  return [a[0] / size, a[1] / size, a[2] / size];
}

/** The point that lies `far` from another in a direction. */
export function along(from: Three, direction: Three, far: number): Three {
  return [from[0] + far * direction[0], from[1] + far * direction[1], from[2] + far * direction[2]];
}

/** The point at a share of the way. */
export function between(from: Three, to: Three, share: number): Three {
  return along(from, minus(to, from), share);
}
