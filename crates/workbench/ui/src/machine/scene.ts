/** Draws the machine with WebGL. Lengths in mm, z upwards. */
import {
  AmbientLight, ArrowHelper, BufferGeometry, Color, CylinderGeometry, DirectionalLight, DoubleSide, Group, Line, LineBasicMaterial, LineDashedMaterial, LineLoop, type Material,
  Mesh, MeshBasicMaterial, MeshLambertMaterial, type Object3D, PerspectiveCamera, Scene, SphereGeometry, Vector3, WebGLRenderer,
} from "three";
import type { Looks } from "../charts/looks";
import type { Six, Three } from "../wire";
import { displaced } from "./displaced";
import { Orbit } from "./orbit";

/** What is drawn. */
export interface Shown {
  base: Three[];
  platform: Three[];
  origin: Three;
  /** Change of the wrench. */
  force: Six | null;
  /** Motions: um, urad. */
  measured: Six | null;
  predicted: Six | null;
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
    const { base, platform, measured, predicted } = shown;
    const radius = Math.max(...base.map(([x, y]) => Math.hypot(x, y)), 1);
    const moved = measured && displaced(platform, shown.origin, measured, shown.factor);
    const foreseen = predicted && displaced(platform, shown.origin, predicted, shown.factor);
    this.machine.add(plate(base, looks.grey, 0.16), outline(base, looks.grey, false), outline(platform, looks.grey, true));
    this.machine.add(...legs(base, moved ?? platform, shown, radius, looks));
    if (moved) this.machine.add(plate(moved, looks.ink, 0.18), outline(moved, looks.ink, false));
    if (foreseen) this.machine.add(outline(foreseen, looks.now, false), ...joints(foreseen, radius / 60, looks.now));
    if (shown.force) this.machine.add(...arrow(shown.force, shown.origin, radius, looks));
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

function legs(base: Three[], platform: Three[], { residual, reach }: Shown, radius: number, looks: Looks): Object3D[] {
  return base.flatMap((from, i) => {
    const to = platform[i];
    if (to === undefined) return [];
    const colour = shade((residual[i] ?? 0) / reach, looks);
    return [rod(from, to, radius / 45, colour), ...joints([from, to], radius / 30, looks.grey)];
  });
}

/** Longer than predicted: the colour of the springs; shorter: the third; nothing left: grey. */
function shade(share: number, looks: Looks): Color {
  const end = new Color(share > 0 ? looks.before : looks.third);
  return new Color(looks.grid).lerp(end, Math.min(1, Math.abs(share)));
}

function rod(from: Three, to: Three, radius: number, colour: Color): Mesh {
  const a = new Vector3(...from);
  const along = new Vector3(...to).sub(a);
  const mesh = new Mesh(new CylinderGeometry(radius, radius, along.length(), 16), new MeshLambertMaterial({ color: colour }));
  mesh.position.copy(a).addScaledVector(along, 0.5);
  mesh.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), along.normalize());
  return mesh;
}

function joints(places: Three[], radius: number, colour: string): Mesh[] {
  return places.map((place) => {
    const mesh = new Mesh(new SphereGeometry(radius, 16, 12), new MeshLambertMaterial({ color: colour }));
    mesh.position.set(...place);
    return mesh;
  });
}

/** Joints in the order of their angle, so that the outline does not cross itself. */
function around(places: Three[]): Vector3[] {
  const [x, y] = middle(places);
  return [...places].sort((p, q) => Math.atan2(p[1] - y, p[0] - x) - Math.atan2(q[1] - y, q[0] - x)).map((place) => new Vector3(...place));
}

function outline(places: Three[], colour: string, dashed: boolean): Line {
  const geometry = new BufferGeometry().setFromPoints(around(places));
  const loop = new LineLoop(geometry, dashed ? new LineDashedMaterial({ color: colour, dashSize: 8, gapSize: 6 }) : new LineBasicMaterial({ color: colour }));
  loop.computeLineDistances();
  return loop;
}

function plate(places: Three[], colour: string, opacity: number): Mesh {
  const points = around(places);
  const geometry = new BufferGeometry().setFromPoints(points);
  geometry.setIndex(points.slice(2).flatMap((_, i) => [0, i + 1, i + 2]));
  return new Mesh(geometry, new MeshBasicMaterial({ color: colour, opacity, transparent: true, side: DoubleSide, depthWrite: false }));
}

/** The change of the force at the mobile origin; its moment is not drawn. */
function arrow([x, y, z]: Six, origin: Three, radius: number, looks: Looks): Object3D[] {
  const force = new Vector3(x, y, z);
  if (force.length() === 0) return [];
  return [new ArrowHelper(force.normalize(), new Vector3(...origin), 0.6 * radius, looks.ink, 0.12 * radius, 0.07 * radius)];
}

function middle(places: Three[]): Three {
  const sum = places.reduce(([a, b, c], [x, y, z]) => [a + x, b + y, c + z] as Three, [0, 0, 0] as Three);
  return sum.map((value) => value / Math.max(places.length, 1)) as Three;
}

function clear(group: Group): void {
  group.traverse((object) => {
    const { geometry, material } = object as Mesh;
    geometry?.dispose();
    (material as Material | undefined)?.dispose();
  });
  group.clear();
}
