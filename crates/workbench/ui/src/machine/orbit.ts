/** Turns the camera about a point: mouse or finger, wheel, arrow keys, + and -. */
import type { Three } from "../wire";
import { Camera } from "./camera";
import { STEEPEST, VIEWS, type ViewName } from "./views";

const TURN_PER_PX = 0.008;
const TURN_PER_KEY = 0.12;
const ZOOM_PER_KEY = 1.15;

export class Orbit {
  private azimuth = VIEWS.usual.azimuth;
  private elevation = VIEWS.usual.elevation;
  private zoom = 1;
  private target: Three = [0, 0, 0];
  private distance = 1;
  private readonly off = new AbortController();

  constructor(
    private readonly box: HTMLElement,
    private readonly changed: () => void,
  ) {
    const { signal } = this.off;
    box.addEventListener("pointerdown", (event) => box.setPointerCapture(event.pointerId), { signal });
    box.addEventListener("pointermove", (event) => this.drag(event), { signal });
    box.addEventListener("wheel", (event) => this.wheel(event), { signal, passive: false });
    box.addEventListener("keydown", (event) => this.key(event), { signal });
  }

  /** Looks at a point (mm) from a distance. */
  about(target: Three, distance: number): void {
    this.target = target;
    this.distance = distance;
  }

  /** What it is looked at about, mm. */
  get centre(): Three {
    return this.target;
  }

  /** Looks from a usual side, from the usual distance. */
  look(from: ViewName): void {
    const { azimuth, elevation } = VIEWS[from];
    Object.assign(this, { azimuth, elevation, zoom: 1 });
    this.changed();
  }

  camera(size: { width: number; height: number }): Camera {
    // A narrow window needs more distance for the same width.
    const distance = (this.distance / this.zoom) * Math.max(1, size.height / size.width);
    return new Camera(this.target, distance, this.azimuth, this.elevation, size);
  }

  dispose(): void {
    this.off.abort();
  }

  private drag(event: PointerEvent): void {
    if (!this.box.hasPointerCapture(event.pointerId)) return;
    this.turn(-event.movementX * TURN_PER_PX, event.movementY * TURN_PER_PX);
  }

  /** Only once the machine has the focus: else the wheel scrolls the page. */
  private wheel(event: WheelEvent): void {
    if (document.activeElement !== this.box) return;
    event.preventDefault();
    this.come(Math.exp(-event.deltaY * 1e-3));
  }

  private key(event: KeyboardEvent): void {
    const turns: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const turn = turns[event.key];
    if (turn !== undefined) this.turn(turn[0] * TURN_PER_KEY, turn[1] * TURN_PER_KEY);
    else if (event.key === "+" || event.key === "=") this.come(ZOOM_PER_KEY);
    else if (event.key === "-") this.come(1 / ZOOM_PER_KEY);
    else return;
    event.preventDefault();
  }

  private turn(azimuth: number, elevation: number): void {
    this.azimuth += azimuth;
    this.elevation = Math.min(STEEPEST, Math.max(-STEEPEST, this.elevation + elevation));
    this.changed();
  }

  private come(factor: number): void {
    this.zoom = Math.min(8, Math.max(0.3, this.zoom * factor));
    this.changed();
  }
}
