/** Draws the machine. Lengths in mm, z upwards. */
import type { Looks } from "../charts/looks";
import type { Six, Three } from "../wire";
import { displaced } from "./displaced";
import { type Leg, Note, nearest } from "./hover";
import { Orbit } from "./orbit";
import { paint, type Shape } from "./paint";
import { axes, joints, legs, load, middle, numbers, outline, plate } from "./parts";
import { drawScale } from "./scale_bar";
import type { ViewName } from "./views";

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
  /** What is said of each leg. */
  legs: string[];
  /** Elongations left, um, and the magnitude that gets the full colour. */
  residual: Six;
  reach: number;
}

export class MachineScene {
  private readonly canvas = document.createElement("canvas");
  private readonly orbit: Orbit;
  private readonly observer: ResizeObserver;
  private readonly note: Note;
  private legs: Leg[] = [];
  private shapes: Shape[] = [];
  private scale = { factor: 1, ink: "" };

  constructor(private readonly box: HTMLElement) {
    box.append(this.canvas);
    this.orbit = new Orbit(box, () => this.render());
    this.observer = new ResizeObserver(() => this.render());
    this.observer.observe(box);
    this.note = new Note(box);
    box.addEventListener("pointermove", this.hover);
    box.addEventListener("pointerleave", this.leave);
  }

  draw(shown: Shown, looks: Looks): void {
    const { base, platform, origin, wrench, largest, moved } = shown;
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
      ...(wrench ? load(wrench, largest, origin, radius, looks) : []),
      ...axes(base, radius, looks),
      ...numbers(base, radius, looks),
    ];
    const ends = places[0] ?? platform;
    this.legs = base.map((from, i) => ({ from, to: ends[i] ?? from, text: shown.legs[i] ?? "" }));
    this.scale = { factor: shown.factor, ink: looks.ink };
    this.orbit.about(middle([...base, ...platform]), 4 * radius);
    this.render();
  }

  /** Looks from a usual side. */
  look(from: ViewName): void {
    this.orbit.look(from);
  }

  dispose(): void {
    this.observer.disconnect();
    this.orbit.dispose();
    this.box.removeEventListener("pointermove", this.hover);
    this.box.removeEventListener("pointerleave", this.leave);
    this.note.dispose();
    this.canvas.remove();
  }

  private readonly hover = (event: PointerEvent): void => {
    const { left, top, width, height } = this.box.getBoundingClientRect();
    const [x, y] = [event.clientX - left, event.clientY - top];
    // While the machine is turned nothing is said.
    const leg = event.buttons === 0 ? nearest(this.legs, this.orbit.camera({ width, height }), x, y) : null;
    this.note.show(leg?.text ?? null, x, y);
  };

  private readonly leave = (): void => this.note.show(null, 0, 0);

  private render(): void {
    const { clientWidth: width, clientHeight: height } = this.box;
    const on = this.canvas.getContext("2d");
    if (on === null || width === 0 || height === 0) return;
    this.canvas.width = Math.round(width * devicePixelRatio);
    this.canvas.height = Math.round(height * devicePixelRatio);
    on.scale(devicePixelRatio, devicePixelRatio);
    const camera = this.orbit.camera({ width, height });
    paint(on, this.shapes, camera);
    drawScale(on, camera.see(this.orbit.centre).scale, this.scale, height);
  }
}
