/** Draws the machine. Lengths in mm, z upwards. */
import type { Looks } from "../charts/looks";
import type { Six, Three } from "../wire";
import { displaced } from "./displaced";
import { Orbit } from "./orbit";
import { paint, type Shape } from "./paint";
import { joints, legs, load, middle, outline, plate } from "./parts";

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
  /** Change of the wrench. */
  wrench: Six | null;
  /** The first one carries the legs. */
  moved: Moved[];
  factor: number;
  /** Elongations left, um, and the magnitude that gets the full colour. */
  residual: Six;
  reach: number;
}

export class MachineScene {
  private readonly canvas = document.createElement("canvas");
  private readonly orbit: Orbit;
  private readonly observer: ResizeObserver;
  private shapes: Shape[] = [];

  constructor(private readonly box: HTMLElement) {
    box.append(this.canvas);
    this.orbit = new Orbit(box, () => this.render());
    this.observer = new ResizeObserver(() => this.render());
    this.observer.observe(box);
  }

  draw(shown: Shown, looks: Looks): void {
    const { base, platform, origin, wrench, moved } = shown;
    const radius = Math.max(...base.map(([x, y]) => Math.hypot(x, y)), 1);
    const places = moved.map(({ motion }) => displaced(platform, origin, motion, shown.factor));
    const platforms = places.flatMap((place, i) => {
      const colour = moved[i]?.colour ?? looks.ink;
      return [plate(place, colour, 0.18), ...outline(place, colour, radius / 90), ...joints(place, radius / 45, colour)];
    });
    this.shapes = [
      plate(base, looks.grey, 0.16),
      ...outline(base, looks.grey, radius / 150),
      ...outline(platform, looks.grey, 0),
      ...legs(base, places[0] ?? platform, shown, radius, looks),
      ...platforms,
      ...(wrench ? load(wrench, origin, radius, looks) : []),
    ];
    this.orbit.about(middle([...base, ...platform]), 4 * radius);
    this.render();
  }

  dispose(): void {
    this.observer.disconnect();
    this.orbit.dispose();
    this.canvas.remove();
  }

  private render(): void {
    const { clientWidth: width, clientHeight: height } = this.box;
    const on = this.canvas.getContext("2d");
    if (on === null || width === 0 || height === 0) return;
    this.canvas.width = Math.round(width * devicePixelRatio);
    this.canvas.height = Math.round(height * devicePixelRatio);
    on.scale(devicePixelRatio, devicePixelRatio);
    paint(on, this.shapes, this.orbit.camera({ width, height }));
  }
}
