/** Numbers as people read them. */

const MINUS = "\u2212";
const MICRO = "\u00b5";

/** A number with so many significant digits, no exponent in the usual range. */
export function digits(value: number, significant = 3): string {
  if (value === 0) return "0";
  const size = sizeOf(value, significant);
  if (size < -4 || size > 6) return sign(value.toExponential(significant - 1));
  return sign(rounded(value, significant - 1 - size));
}

/** A number that was set: no more digits than it needs. */
export function setting(value: number, significant = 3): string {
  const text = digits(value, significant);
  return text.includes(".") && !text.includes("e") ? text.replace(/\.?0+$/, "") : text;
}

/** A value to the place of the second digit of its uncertainty, and the uncertainty. */
export function withUncertainty(value: number, std: number): { value: string; std: string } {
  if (!(std > 0)) return { value: digits(value, 4), std: "0" };
  const place = 1 - sizeOf(std, 2);
  if (place > 6 || place < -6) return { value: digits(value, 3), std: digits(std, 2) };
  return { value: sign(rounded(value, place)), std: rounded(std, place) };
}

/** A multiple of the noise. */
export function times(value: number): string {
  return value < 10 ? value.toFixed(2) : digits(value);
}

/** A probability in per cent: never 0 %, never 100 %. */
export function chance(probability: number): string {
  if (probability < 0.001) return "< 0.1 %";
  if (probability > 0.99) return "> 99 %";
  return `${probability < 0.1 ? digits(100 * probability, 1) : Math.round(100 * probability)} %`;
}

/** A unit as people read it; files say um and urad. */
export function unitName(unit: string): string {
  return unit.replace(/\bu(?=(m|rad)\b)/g, MICRO);
}

/** Power of ten of the first digit after rounding. */
function sizeOf(value: number, significant: number): number {
  return Number(value.toExponential(significant - 1).split("e")[1]);
}

/** Rounds to a place right (positive) or left (negative) of the point. */
function rounded(value: number, place: number): string {
  if (place >= 0) return value.toFixed(place);
  const step = 10 ** -place;
  return String(Math.round(value / step) * step);
}

function sign(text: string): string {
  return /^-[0.]*$/.test(text) ? text.slice(1) : text.replace("-", MINUS);
}
