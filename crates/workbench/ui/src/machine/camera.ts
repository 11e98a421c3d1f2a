/** Where the machine is looked at from, and where a point is seen. Lengths in mm, z upwards. */
import type { Three } from "../wire";
import { along, cross, dot, minus, unit } from "./vectors";

/** Height of the picture at distance 1. */
const OPENING = 2 * Math.tan((35 / 2) * (Math.PI / 180));
const UPWARDS: Three = [0, 0, 1];

/** A point on the canvas, px from its left upper corner. */
export interface Seen {
  x: number;
  y: number;
  /** Distance from the eye along its view, mm. */
  depth: number;
  /** Pixels of a millimetre there. */
  scale: number;
}

export class Camera {
  private readonly eye: Three;
  private readonly forward: Three;
  private readonly right: Three;
  private readonly up: Three;

  /** Looks at `target` from a distance, turned by two angles (rad), on a canvas of a size (px). */
  constructor(
    target: Three,
    distance: number,
    azimuth: number,
    elevation: number,
    private readonly size: { width: number; height: number },
  ) {
    const flat = Math.cos(elevation);
    const out: Three = [flat * Math.cos(azimuth), flat * Math.sin(azimuth), Math.sin(elevation)];
    this.eye = along(target, out, distance);
    this.forward = [-out[0], -out[1], -out[2]];
    this.right = unit(cross(this.forward, UPWARDS));
    this.up = cross(this.right, this.forward);
  }

  see(point: Three): Seen {
    const from = minus(point, this.eye);
    // Nothing is drawn behind the eye.
    const depth = Math.max(1, dot(from, this.forward));
    const scale = this.size.height / (OPENING * depth);
    return {
      x: this.size.width / 2 + scale * dot(from, this.right),
      y: this.size.height / 2 - scale * dot(from, this.up),
      depth,
      scale,
    };
  }
}
