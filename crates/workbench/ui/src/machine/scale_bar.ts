/** How long a micrometre of motion is drawn. */
import { digits, unitName } from "../format";
import { LETTERS } from "./paint";

/** Longest bar, px. */
const LONGEST_PX = 120;
const MARGIN_PX = 12;
const END_PX = 4;

/** 1, 2 or 5 times a power of ten, the largest that is not above a length. */
export function roundLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  return ([5, 2, 1].find((step) => step * power <= most * (1 + 1e-9)) ?? 1) * power;
}

/** A bar in the lower left corner; `scale`: px of a millimetre in the middle of the machine. */
export function drawScale(on: CanvasRenderingContext2D, scale: number, of: { factor: number; ink: string }, height: number): void {
  const pxOfOne = (scale * of.factor) / 1000;
  if (!(pxOfOne > 0)) return;
  const um = roundLength(LONGEST_PX / pxOfOne);
  const [left, right, y] = [MARGIN_PX, MARGIN_PX + um * pxOfOne, height - MARGIN_PX];
  on.strokeStyle = on.fillStyle = of.ink;
  on.lineWidth = 1.6;
  on.beginPath();
  for (const [x0, y0, x1, y1] of [
    [left, y, right, y],
    [left, y - END_PX, left, y + END_PX],
    [right, y - END_PX, right, y + END_PX],
  ] as const) {
    on.moveTo(x0, y0);
    on.lineTo(x1, y1);
  }
  on.stroke();
  on.font = LETTERS;
  on.textAlign = "left";
  on.textBaseline = "middle";
  on.fillText(`${digits(um, 1)} ${unitName("um")} of motion`, right + 8, y);
}
