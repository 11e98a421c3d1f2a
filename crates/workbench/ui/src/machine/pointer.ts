/** Pointing at what is drawn: a note beside the pointer, and a click that picks. */
import type { Camera } from "./camera";
import { Note, nearest, type Target } from "./hover";

/** A press that moves so far turns the machine and picks nothing, px. */
const TURN_PX = 5;

/** Acts on what the pointer is at; null: at nothing. */
export interface Pointed<T> {
  pick: (of: T) => void;
  hover: (of: T | null) => void;
}

export class Pointer<T> {
  targets: Target<T>[] = [];
  private readonly note: Note;
  private readonly off = new AbortController();
  private pressed: [number, number] | null = null;
  private at: T | null = null;

  constructor(
    private readonly box: HTMLElement,
    private readonly camera: () => Camera,
    private readonly told: Pointed<T>,
  ) {
    this.note = new Note(box);
    const { signal } = this.off;
    box.addEventListener("pointermove", (event) => this.move(event), { signal });
    box.addEventListener("pointerleave", () => this.leave(), { signal });
    box.addEventListener("pointerdown", ({ clientX, clientY }) => (this.pressed = [clientX, clientY]), { signal });
    box.addEventListener("pointerup", (event) => this.release(event), { signal });
  }

  dispose(): void {
    this.off.abort();
    this.note.dispose();
  }

  private find({ clientX, clientY }: PointerEvent): { found: Target<T> | null; x: number; y: number } {
    const { left, top } = this.box.getBoundingClientRect();
    const [x, y] = [clientX - left, clientY - top];
    return { found: nearest(this.targets, this.camera(), x, y), x, y };
  }

  private move(event: PointerEvent): void {
    const { found, x, y } = this.find(event);
    // While the machine is turned nothing is said.
    const target = event.buttons === 0 ? found : null;
    this.note.show(target?.text ?? null, x, y);
    this.tell(target?.of ?? null);
  }

  private release(event: PointerEvent): void {
    const from = this.pressed;
    this.pressed = null;
    if (from === null || event.button !== 0 || Math.hypot(event.clientX - from[0], event.clientY - from[1]) > TURN_PX) return;
    const { found } = this.find(event);
    if (found !== null) this.told.pick(found.of);
  }

  private leave(): void {
    this.note.show(null, 0, 0);
    this.tell(null);
  }

  private tell(of: T | null): void {
    this.box.classList.toggle("at-target", of !== null);
    if (JSON.stringify(of) === JSON.stringify(this.at)) return;
    this.at = of;
    this.told.hover(of);
  }
}
