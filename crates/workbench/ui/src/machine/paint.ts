/** Paints shapes in space onto a canvas, the farthest first. */
import type { Three } from "../wire";
import type { Camera, Seen } from "./camera";
import { between } from "./vectors";

export type Shape =
  | { kind: "rod"; from: Three; to: Three; radius: number; colour: string }
  | { kind: "ball"; at: Three; radius: number; colour: string }
  | { kind: "face"; corners: Three[]; colour: string; opacity: number }
  | { kind: "dashes"; from: Three; to: Three; colour: string }
  | { kind: "head"; from: Three; to: Three; radius: number; colour: string }
  | { kind: "text"; at: Three; text: string; colour: string; halo: string };

export const LETTERS = "600 13px system-ui, sans-serif";
/** A rod is painted in so many pieces, each in its place among what is before and behind it. */
const PIECES = 12;

interface Stroke {
  depth: number;
  paint: (on: CanvasRenderingContext2D) => void;
}

export function paint(on: CanvasRenderingContext2D, shapes: Shape[], camera: Camera): void {
  const strokes = shapes.flatMap((shape) => strokesOf(shape, camera));
  strokes.sort((a, b) => b.depth - a.depth);
  for (const stroke of strokes) stroke.paint(on);
}

function strokesOf(shape: Shape, camera: Camera): Stroke[] {
  switch (shape.kind) {
    case "rod":
      return pieces(shape.from, shape.to).map(([from, to]) => rod(camera.see(from), camera.see(to), shape.radius, shape.colour));
    case "ball":
      return [ball(camera.see(shape.at), shape.radius, shape.colour)];
    case "face":
      return [
        face(
          shape.corners.map((corner) => camera.see(corner)),
          shape.colour,
          shape.opacity,
        ),
      ];
    case "dashes":
      return [dashes(camera.see(shape.from), camera.see(shape.to), shape.colour)];
    case "head":
      return [head(camera.see(shape.from), camera.see(shape.to), shape.radius, shape.colour)];
    case "text":
      return [letters(camera.see(shape.at), shape.text, shape.colour, shape.halo)];
  }
}

function pieces(from: Three, to: Three): [Three, Three][] {
  return Array.from({ length: PIECES }, (_, k) => [between(from, to, k / PIECES), between(from, to, (k + 1) / PIECES)]);
}

/** A round bar: dark at its edges, with a light along it. */
function rod(from: Seen, to: Seen, radius: number, colour: string): Stroke {
  const width = radius * (from.scale + to.scale);
  const lines: [string, number][] = [
    [mixed(colour, "#000000", 0.28), width],
    [colour, 0.72 * width],
    [mixed(colour, "#ffffff", 0.3), 0.25 * width],
  ];
  return {
    depth: (from.depth + to.depth) / 2,
    paint: (on) => {
      on.lineCap = "butt";
      for (const [ink, wide] of lines) {
        on.strokeStyle = ink;
        on.lineWidth = Math.max(0.5, wide);
        line(on, from, beyond(from, to));
      }
    },
  };
}

/** A little beyond the end, so that no gap is seen before the next piece. */
function beyond(from: Seen, to: Seen): { x: number; y: number } {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const size = Math.hypot(dx, dy) || 1;
  return { x: to.x + dx / size, y: to.y + dy / size };
}

function ball(at: Seen, radius: number, colour: string): Stroke {
  const wide = radius * at.scale;
  return {
    // Before the ends of the bars that it joins.
    depth: at.depth - radius,
    paint: (on) => {
      const light = on.createRadialGradient(at.x - wide / 3, at.y - wide / 3, wide / 8, at.x, at.y, wide);
      light.addColorStop(0, mixed(colour, "#ffffff", 0.4));
      light.addColorStop(1, mixed(colour, "#000000", 0.25));
      on.fillStyle = light;
      on.beginPath();
      on.arc(at.x, at.y, wide, 0, 2 * Math.PI);
      on.fill();
    },
  };
}

function face(corners: Seen[], colour: string, opacity: number): Stroke {
  return {
    depth: corners.reduce((sum, { depth }) => sum + depth, 0) / Math.max(1, corners.length),
    paint: (on) => {
      on.globalAlpha = opacity;
      fill(on, corners, colour);
      on.globalAlpha = 1;
    },
  };
}

function dashes(from: Seen, to: Seen, colour: string): Stroke {
  return {
    depth: (from.depth + to.depth) / 2,
    paint: (on) => {
      on.lineCap = "butt";
      on.strokeStyle = colour;
      on.lineWidth = 1.2;
      on.setLineDash([6, 4]);
      line(on, from, to);
      on.setLineDash([]);
    },
  };
}

/** The head of an arrow, as a cone looks from the side. */
function head(from: Seen, to: Seen, radius: number, colour: string): Stroke {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const size = Math.hypot(dx, dy) || 1;
  const wide = (radius * from.scale) / size;
  const corners = [{ x: from.x - wide * dy, y: from.y + wide * dx }, to, { x: from.x + wide * dy, y: from.y - wide * dx }];
  return { depth: Math.min(from.depth, to.depth), paint: (on) => fill(on, corners, colour) };
}

/** Letters before everything else, with a rim that parts them from what is behind. */
function letters(at: Seen, text: string, colour: string, halo: string): Stroke {
  return {
    depth: Number.NEGATIVE_INFINITY,
    paint: (on) => {
      on.font = LETTERS;
      on.textAlign = "center";
      on.textBaseline = "middle";
      on.lineJoin = "round";
      on.strokeStyle = halo;
      on.lineWidth = 4;
      on.strokeText(text, at.x, at.y);
      on.fillStyle = colour;
      on.fillText(text, at.x, at.y);
    },
  };
}

function line(on: CanvasRenderingContext2D, from: { x: number; y: number }, to: { x: number; y: number }): void {
  on.beginPath();
  on.moveTo(from.x, from.y);
  on.lineTo(to.x, to.y);
  on.stroke();
}

function fill(on: CanvasRenderingContext2D, corners: { x: number; y: number }[], colour: string): void {
  on.fillStyle = colour;
  on.beginPath();
  for (const { x, y } of corners) on.lineTo(x, y);
  on.closePath();
  on.fill();
}

/** A colour (`#rrggbb`) with a share of another in it. */
export function mixed(colour: string, other: string, share: number): string {
  const [from, to] = [colour, other].map((text) => [1, 3, 5].map((at) => Number.parseInt(text.slice(at, at + 2), 16)));
  const parts = (from ?? []).map((value, k) => Math.round(value + share * ((to?.[k] ?? value) - value)));
  return `#${parts.map((value) => value.toString(16).padStart(2, "0")).join("")}`;
}
