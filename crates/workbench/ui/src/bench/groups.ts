/** The catalogue in groups, as a bench is built. */
import type { TermCard } from "../wire";

const GROUPS: [string, string[]][] = [
  ["Structure", ["base-compliance", "platform-compliance"]],
  ["Legs", ["leg-length-compliance", "leg-nonlinearity", "leg-asymmetry", "leg-backlash", "creep", "thermal-expansion"]],
  ["Joints and brackets", ["joint-friction", "joint-rotation-stiffness", "bracket-compliance", "leg-coupling"]],
  ["Load", ["load-offset", "load-tilt"]],
  ["Metrology", ["metrology-drift", "target-offset"]],
  ["Absolute poses", ["joint-geometry", "leg-offset", "actuator-scale", "actuator-pitch", "leg-weight"]],
];
const OTHERS = "Others";

export interface Group {
  title: string;
  terms: TermCard[];
}

/** Groups that have terms; what no group names comes last. */
export function grouped(terms: TermCard[]): Group[] {
  const known = GROUPS.flatMap(([, ids]) => ids);
  const all: Group[] = GROUPS.map(([title, ids]) => ({ title, terms: terms.filter(({ id }) => ids.includes(id)) }));
  all.push({ title: OTHERS, terms: terms.filter(({ id }) => !known.includes(id)) });
  return all.filter((group) => group.terms.length > 0);
}
