/** Places in a normal plot. */

/** Where a value that was found stands on a curve of `[expected, found]` in ascending order: its expected value; the ends beyond them. */
export function onCurve(curve: readonly (readonly number[])[], found: number): number {
  const at = curve.findIndex((point) => (point[1] ?? 0) >= found);
  if (at === -1) return curve.at(-1)?.[0] ?? Number.NaN;
  const [x1 = Number.NaN, y1 = 0] = curve[at] ?? [];
  const [x0 = x1, y0 = y1] = curve[at - 1] ?? [];
  return y1 > y0 ? x0 + ((x1 - x0) * (found - y0)) / (y1 - y0) : x1;
}
