/** Something drawn in space on a canvas. Lengths in mm, z upwards. */
import type { Three } from "../wire";
import type { Target } from "./hover";
import { Orbit } from "./orbit";
import { paint, type Shape } from "./paint";
import { type Pointed, Pointer } from "./pointer";
import { drawScale } from "./scale_bar";
import type { ViewName } from "./views";

/** What is drawn, and what of it can be picked. */
export interface Painted<T> {
  shapes: Shape[];
  targets: Target<T>[];
  /** What it is looked at about, and the radius of the machine. */
  about: Three;
  radius: number;
  /** How many times too large motions are drawn, for the bar of scale; zero for none. */
  scale: { factor: number; ink: string };
}

/** Distance of the eye, over the radius of the machine. */
const FAR = 4;

export class Scene<T> {
  private readonly canvas = document.createElement("canvas");
  private readonly orbit: Orbit;
  private readonly observer: ResizeObserver;
  private readonly pointer: Pointer<T>;
  private shapes: Shape[] = [];
  private scale = { factor: 0, ink: "" };

  constructor(
    private readonly box: HTMLElement,
    pointed: Pointed<T>,
  ) {
    box.append(this.canvas);
    this.orbit = new Orbit(box, () => this.render());
    this.observer = new ResizeObserver(() => this.render());
    this.observer.observe(box);
    this.pointer = new Pointer(box, () => this.orbit.camera({ width: box.clientWidth, height: box.clientHeight }), pointed);
  }

  draw({ shapes, targets, about, radius, scale }: Painted<T>): void {
    this.shapes = shapes;
    this.pointer.targets = targets;
    this.scale = scale;
    this.orbit.about(about, FAR * radius);
    this.render();
  }

  /** Looks from a usual side. */
  look(from: ViewName): void {
    this.orbit.look(from);
  }

  dispose(): void {
    this.observer.disconnect();
    this.orbit.dispose();
    this.pointer.dispose();
    this.canvas.remove();
  }

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
