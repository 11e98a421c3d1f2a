/** Draws the machine with WebGL. Lengths in mm, z upwards. */
import { AmbientLight, DirectionalLight, Group, type Material, type Mesh, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import type { Looks } from "../charts/looks";
import type { Six, Three } from "../wire";
import { displaced } from "./displaced";
import { Orbit } from "./orbit";
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
  private readonly renderer = new WebGLRenderer({ antialias: true, alpha: true });
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(35, 1, 1, 1e5);
  private readonly machine = new Group();
  private readonly orbit: Orbit;
  private readonly observer: ResizeObserver;

  /** Fails where the browser has no WebGL. */
  constructor(private readonly box: HTMLElement) {
    this.camera.up.set(0, 0, 1);
    const sun = new DirectionalLight(0xffffff, 2);
    sun.position.set(1, -2, 3);
    this.scene.add(new AmbientLight(0xffffff, 1.4), sun, this.machine);
    box.append(this.renderer.domElement);
    this.orbit = new Orbit(box, () => this.render());
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(box);
    this.resize();
  }

  draw(shown: Shown, looks: Looks): void {
    clear(this.machine);
    const { base, platform, origin } = shown;
    const radius = Math.max(...base.map(([x, y]) => Math.hypot(x, y)), 1);
    const places = shown.moved.map(({ motion }) => displaced(platform, origin, motion, shown.factor));
    this.machine.add(plate(base, looks.grey, 0.16), outline(base, looks.grey, radius / 150), outline(platform, looks.grey, 0));
    this.machine.add(...legs(base, places[0] ?? platform, shown, radius, looks));
    places.forEach((place, i) => {
      const colour = shown.moved[i]?.colour ?? looks.ink;
      this.machine.add(plate(place, colour, 0.18), outline(place, colour, radius / 90), ...joints(place, radius / 45, colour));
    });
    for (const part of shown.wrench ? load(shown.wrench, origin, radius, looks) : []) this.machine.add(part);
    this.orbit.about(middle([...base, ...platform]), 3.6 * radius);
    this.render();
  }

  dispose(): void {
    this.observer.disconnect();
    this.orbit.dispose();
    clear(this.machine);
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.renderer.domElement.remove();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.box;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(devicePixelRatio);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  private render(): void {
    this.orbit.place(this.camera);
    this.renderer.render(this.scene, this.camera);
  }
}

function clear(group: Group): void {
  group.traverse((object) => {
    const { geometry, material } = object as Mesh;
    geometry?.dispose();
    (material as Material | undefined)?.dispose();
  });
  group.clear();
}
