/** What page and server say to each other; the same shapes as `crates/workbench/src/wire.rs`. Units are in the names. */

/** Six numbers: a coordinate, a load component or a leg each. */
export type Six = [number, number, number, number, number, number];
export type Three = [number, number, number];

export interface Choice {
  id: string;
  title: string;
  text: string;
}

export interface TermCard {
  id: string;
  title: string;
  physics: string;
  equation: string;
  shows: string;
  /** True when it has a richer form, asked for by `:richer` behind the id. */
  richer: boolean;
  parameters: { name: string; unit: string }[];
}

export interface FormulaHelp {
  variables: Choice[];
  functions: string[];
  units: string[];
  example: string;
}

export interface Limits {
  bytes: number;
  rows: number;
  own_terms: number;
  term_bytes: number;
  benches: number;
}

export interface Catalogue {
  version: string;
  terms: TermCard[];
  cases: Choice[];
  machines: Choice[];
  plans: Choice[];
  effects: Choice[];
  formula: FormulaHelp;
  limits: Limits;
  /** The files of the command line, when there are any. */
  given: Choice | null;
}

export interface FileText {
  name: string;
  text: string;
}

export type Level = "easy" | "hard" | "honest";

export type Open =
  | { from: "case"; id: string }
  | { from: "given" }
  | { from: "files"; hexapod: FileText; data: FileText; holdout: FileText | null }
  | { from: "simulation"; machine: string; plan: string; effects: string[]; distance: number | null; seed: number | null }
  | { from: "game"; level: Level; seed: number | null };

export interface Noise {
  translation_um: number;
  rotation_urad: number;
  source: string;
}

export interface Hidden {
  id: string;
  title: string;
}

/** One entry per condition shown, in every list. */
export interface Conditions {
  of: number;
  /** a, b, c (mm), alpha, beta, gamma (deg). */
  pose: Six[];
  /** Change of the wrench: N, N m. */
  wrench: Six[];
  leg_force_n: Six[];
  leg_length_mm: Six[];
  elapsed_s: number[];
  delta_t_k: number[];
  approach: number[];
  platform_joints_mm: Three[][];
  /** a, b, c (um), alpha, beta, gamma (urad). */
  measured: Six[];
  /** Motion of the platform at its origin, fixed axes: um, urad. */
  measured_motion: Six[];
}

export interface Opened {
  id: string;
  title: string;
  about: string[];
  seed: number | null;
  contains: Hidden[] | null;
  sealed: boolean;
  absolute: boolean;
  readings: number;
  noise: Noise;
  untestable: { term: string; why: string }[];
  base_joints_mm: Three[];
  conditions: Conditions;
  view: View;
}

/** What is fitted: ids in the order of ticking, and term files of one's own. */
export interface Selection {
  terms: string[];
  own: string[];
}

export interface ErrorSummary {
  chi2_reduced: number;
  rms: { translation_um: number; rotation_urad: number };
  per_coordinate: Six;
  count: number;
}

export interface Estimate {
  name: string;
  value: number;
  std: number;
  unit: string;
}

/** N/um; null where the data leave it open. */
export interface Leg {
  stiffness: number | null;
  std: number | null;
  nominal: number | null;
}

export interface LookAlike {
  a: string;
  b: string;
  correlation: number;
}

export interface View {
  terms: string[];
  fitted: ErrorSummary;
  holdout: ErrorSummary | null;
  held_out: string;
  times_noise: number;
  at_the_noise: boolean;
  parameters: Estimate[];
  legs: Leg[];
  not_determined: string[];
  look_alikes: LookAlike[];
  residual_um: Six[];
  predicted: Six[];
  predicted_motion: Six[];
  scatter: { histogram: [number, number][]; quantiles: [number, number][] };
  milliseconds: number;
}

export interface Diagnosed {
  word: "named" | "ambiguous" | "adequate" | "outside";
  sentences: string[];
  probabilities: { id: string; title: string; probability: number; alike: string[] }[];
  /** What to tick to see the model it settled on. */
  tick: string[];
  next: string[];
  diagnosis: Record<string, unknown>;
  milliseconds: number;
}

export type What = "model" | "report" | "diagnosis" | "hexapod" | "measurements" | "holdout";

export interface Exported {
  name: string;
  media: string;
  text: string;
}

export interface Revealed {
  right: boolean;
  hidden: Hidden[];
  leg_stiffness: number[];
}
