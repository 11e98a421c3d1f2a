/** What the pointer is at: the nearest of the things drawn that can be picked, with what is said of it beside the pointer. */
import type { Three } from "../wire";
import type { Camera } from "./camera";

/** Something drawn along a line, or at a point, and what is said of it. */
export interface Target<T> {
  of: T;
  from: Three;
  to: Three;
  text: string;
}

/** Farthest from a target, px. */
const NEAR_PX = 9;
const ASIDE_PX = 14;

/** The target nearest to a place on the canvas; none where none is near. */
export function nearest<T>(targets: Target<T>[], camera: Camera, x: number, y: number): Target<T> | null {
  let found: Target<T> | null = null;
  let least = NEAR_PX;
  for (const target of targets) {
    const [from, to] = [camera.see(target.from), camera.see(target.to)];
    const distance = toSegment(x, y, from, to);
    if (distance < least) [found, least] = [target, distance];
  }
  return found;
}

/** Distance of a place from the line between two others, px. */
function toSegment(x: number, y: number, a: { x: number; y: number }, b: { x: number; y: number }): number {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const square = dx * dx + dy * dy || 1;
  const share = Math.min(1, Math.max(0, ((x - a.x) * dx + (y - a.y) * dy) / square));
  return Math.hypot(x - a.x - share * dx, y - a.y - share * dy);
}

/** A note that follows the pointer over the machine. */
export class Note {
  private readonly note = document.createElement("div");

  constructor(private readonly box: HTMLElement) {
    this.note.className = "leg-note";
    this.note.hidden = true;
    box.append(this.note);
  }

  show(text: string | null, x: number, y: number): void {
    this.note.hidden = text === null;
    if (text === null) return;
    this.note.textContent = text;
    const right = x > this.box.clientWidth / 2;
    Object.assign(this.note.style, {
      left: right ? "" : `${x + ASIDE_PX}px`,
      right: right ? `${this.box.clientWidth - x + ASIDE_PX}px` : "",
      top: `${y}px`,
    });
  }

  dispose(): void {
    this.note.remove();
  }
}
