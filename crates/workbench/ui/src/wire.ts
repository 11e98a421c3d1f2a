/**
 * What page and server say to each other. Units are in the names; numbers are in the frames of the files.
 *
 * Written from crates/workbench/src/wire.rs; to change it, change that file and run
 * HEXBENCH_BLESS=1 cargo test -p hexbench-workbench --lib wire
 */

/** Six numbers: a coordinate, a load component or a leg each. */
export type Six = [number, number, number, number, number, number];

/** Three numbers: a point or a direction. */
export type Three = [number, number, number];

/** Answer to `GET /api/catalogue`: what there is to choose from. */
export type Catalogue = {
  /** Version of the program. */
  version: string;
  /** Terms of the model, in the order of the catalogue. */
  terms: Array<TermCard>;
  /** Chapters of the catalogue, in the order in which they are shown. */
  chapters: Array<string>;
  /** Bundled measurements. */
  cases: Array<Choice>;
  /** Families of machines that can be simulated. */
  machines: Array<Choice>;
  /** Plans of a simulated campaign. */
  plans: Array<Choice>;
  /** Effects that can be put into a simulated machine; those outside the catalogue begin with `out:`. */
  effects: Array<Choice>;
  /** The files named on the command line, when there are any; opened by `{"from": "given"}`. */
  given: Choice | null;
  /** What a formula of one's own may use. */
  formula: FormulaHelp;
  /** What the server accepts. */
  limits: ServerLimits;
};

/** Something to choose. */
export type Choice = {
  /** What is sent back. */
  id: string;
  /** What people read. */
  title: string;
  /** A sentence more; may be empty. */
  text: string;
};

/** What a formula may use. */
export type FormulaHelp = {
  /** Names and meanings, with units. */
  variables: Array<Choice>;
  /** Names of functions. */
  functions: Array<string>;
  /** Units a parameter may have. */
  units: Array<string>;
  /** A term file to begin with. */
  example: string;
};

/** A name and a unit. */
export type NamedUnit = {
  /** Name. */
  name: string;
  /** Unit. */
  unit: string;
};

/** What the server accepts. */
export type ServerLimits = {
  /** Bytes of a request. */
  bytes: number;
  /** Readings of a file. */
  rows: number;
  /** Terms of one's own in a request. */
  own_terms: number;
  /** Bytes of a term of one's own. */
  term_bytes: number;
  /** Benches kept; the one unused for longest gives way. */
  benches: number;
};

/** A term of the model. */
export type TermCard = {
  /** Kebab-case id. */
  id: string;
  /** A few words. */
  title: string;
  /** One of `Catalogue::chapters`. */
  chapter: string;
  /** One or two sentences. */
  physics: string;
  /** First-order equation. */
  equation: string;
  /** What the data must contain for it to show. */
  shows: string;
  /** True when it has a richer form, asked for by `:richer` behind the id. */
  richer: boolean;
  /** Names of its parameters with their units. */
  parameters: Array<NamedUnit>;
};

/** Body of `POST /api/benches`. */
export type Open = {
  "from": "case";
  /** One of `Catalogue::cases`. */
  id: string;
} | {
  "from": "given";
} | {
  "from": "files";
  /** hexapod.toml */
  hexapod: FileText;
  /** measurements.csv */
  data: FileText;
  /** holdout.csv */
  holdout: FileText | null;
} | {
  "from": "more";
  /** How the others are opened. */
  base: Open;
  /** Readings of the same kind, with the same columns. */
  readings: FileText;
} | {
  "from": "read-as";
  /** How it is opened. */
  base: Open;
  /** Changes as `--read-as` takes them, applied in their order. */
  changes: Array<string>;
} | {
  "from": "simulation";
  /** One of `Catalogue::machines`. */
  machine: string;
  /** One of `Catalogue::plans`. */
  plan: string;
  /** Ids of `Catalogue::effects`. */
  effects: Array<string>;
  /** How far each effect stands out of what the springs can absorb, in units of the noise; none: its usual size. */
  distance: number | null;
  /** Decides machine, plan and noise; none: drawn. */
  seed: number | null;
} | {
  "from": "game";
  /** How hard. */
  level: GameLevel;
  /** Decides everything; none: drawn. */
  seed: number | null;
};

/** A file as text. */
export type FileText = {
  /** Its name, for messages; never used to find a file. */
  name: string;
  /** What is in it. */
  text: string;
};

/** How hard a game is. */
export type GameLevel = "easy" | "hard" | "honest";

/** A model that was asked about: its terms, and the readings it is fitted to. */
export type Selection = {
  /** Ids in the order of ticking, of the catalogue and of one's own; `:richer` behind an id asks for the richer form. */
  terms: Array<string>;
  /** Term files (term/1) of one's own, as text. */
  own: Array<string>;
  /** Lines of the measurements that are left out of the fit. */
  exclude: Array<number>;
};

/** Answer to `POST /api/benches/{id}/view`: springs and the selected terms, fitted to the data. */
export type View = {
  /** The selection, in its order. */
  terms: Array<string>;
  /** Error on the readings fitted. */
  fitted: ErrorSummary;
  /** Error on held-out readings; absent where none can be held out. */
  holdout: ErrorSummary | null;
  /** `holdout file` or `poses left out in turn`. */
  held_out: string;
  /** Held-out error (else fitted) as a multiple of the noise. */
  times_noise: number;
  /** Standard deviation of that multiple where the noise is all there is; it is then one on the average. */
  band: number;
  /**
   * Chance of a held-out error as large as this if the model is right; absent where nothing could be held out or the noise is not
   * known apart from the residuals.
   */
  chance: number | null;
  /** True when that is what the noise gives, and errors of the inputs within their tolerances. */
  at_the_noise: boolean;
  /** True when it is that, and more than the noise alone gives. */
  by_tolerances: boolean;
  /** Numbers of the terms. */
  parameters: Array<Estimate>;
  /** Leg stiffness, N/um. */
  legs: [Leg, Leg, Leg, Leg, Leg, Leg];
  /** Names of what the data leave open. */
  not_determined: Array<string>;
  /** Pairs of numbers that can hardly be told apart. */
  look_alikes: Array<LookAlike>;
  /** Elongation of each leg the model leaves, um, per condition shown. */
  residual_um: Array<Six>;
  /** Prediction in measured coordinates, um and urad, per condition shown. */
  predicted: Array<Six>;
  /** Prediction as motion of the platform, um and urad, per condition shown. */
  predicted_motion: Array<Six>;
  /** The same of the readings of the holdout file; absent without one. */
  held_out_readings: HeldOutReadings | null;
  /** Are the residuals noise? */
  scatter: ReadingResiduals;
  /** Time taken on the server, ms. */
  milliseconds: number;
};

/** Size of a set of residuals. */
export type ErrorSummary = {
  /** Sum of squared whitened residuals per degree of freedom (per number for held-out data). */
  chi2_reduced: number;
  /** Root mean square of the residuals. */
  rms: Rms;
  /** Root mean square of each coordinate: um for translations, urad for rotations. */
  per_coordinate: Six;
  /** Scalar residuals behind it. */
  count: number;
};

/** One number of a fitted model. */
export type Estimate = {
  /** `leg-1.stiffness`, `base-compliance.rotation-x`, ... */
  name: string;
  /** Value. */
  value: number;
  /** Standard uncertainty (k = 1). */
  std: number;
  /** Unit of both. */
  unit: string;
};

/** Readings of the holdout file beside the model, one entry per condition of `Opened::held_out`. */
export type HeldOutReadings = {
  /** Elongation of each leg the model leaves, um. */
  residual_um: Array<Six>;
  /** Prediction in measured coordinates, um and urad. */
  predicted: Array<Six>;
  /** Measured, in the frames of the model: um and urad. */
  measured: Array<Six>;
};

/** Stiffness of one leg, N/um; absent where the data leave it open. */
export type Leg = {
  /** Stiffness. */
  stiffness: number | null;
  /** Standard uncertainty (k = 1). */
  std: number | null;
  /** As the machine's file states it. */
  nominal: number | null;
};

/** Two numbers with correlated estimates. */
export type LookAlike = {
  /** One. */
  a: string;
  /** The other. */
  b: string;
  /** Correlation of the estimates. */
  correlation: number;
};

/** Residuals of single readings in units of the noise. */
export type ReadingResiduals = {
  /** Outline of the histogram: residual, share per unit. */
  histogram: Array<[number, number]>;
  /** Normal plot: expected of noise, found. */
  quantiles: Array<[number, number]>;
  /** Per condition shown, the number farthest from zero of its readings that are fitted; null where none of them is. */
  extremes: Array<number | null>;
};

/** Root mean square in the units people read. */
export type Rms = {
  /** Over translations, and lengths that sensors read, um; none where none was read. */
  translation_um: number | null;
  /** Over rotations, and angles that sensors read, urad; none where none was read. */
  rotation_urad: number | null;
};

/** Answer to `POST /api/benches` (201). */
export type Opened = {
  /** Names it in later requests. */
  id: string;
  /** Name of the machine. */
  title: string;
  /** A line each: files, readings, noise. */
  about: Array<string>;
  /** What a simulation was made from, to make it again. */
  seed: number | null;
  /** What was put in, unless it is hidden; empty when nothing was, absent for measurements. */
  contains: Array<Hidden> | null;
  /** True for a game: what is in it is told by `reveal` only. */
  sealed: boolean;
  /** True for absolute poses, false for deflections. */
  absolute: boolean;
  /** Readings fitted. */
  readings: number;
  /** How the files are read differently from what they say, as `--read-as` takes it; empty: as they are written. */
  read_as: Array<string>;
  /** Standard deviation of one reading. */
  noise: NoiseLevels;
  /** Why a term cannot be tested with these data; terms not listed can. */
  untestable: Array<UntestableTerm>;
  /** Base joints, mm, fixed frame. */
  base_joints_mm: [Three, Three, Three, Three, Three, Three];
  /** Where and how was measured. */
  conditions: ConditionLists;
  /** The same of the holdout file; absent without one. */
  held_out: ConditionLists | null;
  /** The springs alone. */
  view: View;
};

/**
 * Conditions (readings averaged where all that was set is equal), one entry per condition shown in every list. Deflections are
 * loaded minus reference; of an absolute pose what is measured beside what is commanded.
 */
export type ConditionLists = {
  /** How many there are; those shown are evenly chosen. */
  of: number;
  /** a, b, c (mm), alpha, beta, gamma (deg). */
  pose: Array<Six>;
  /** Change of the wrench: N, N m. */
  wrench: Array<Six>;
  /** Change of the leg forces, N, tension positive. */
  leg_force_n: Array<Six>;
  /** Leg lengths, mm. */
  leg_length_mm: Array<Six>;
  /** Time since the reference, s. */
  elapsed_s: Array<number>;
  /** Temperature since the reference, K. */
  delta_t_k: Array<number>;
  /** 1 or -1. */
  approach: Array<number>;
  /** The file they come from. */
  file: string;
  /** Lines of the file that hold its readings. */
  lines: Array<Array<number>>;
  /** Platform joints before the load, mm, fixed frame. */
  platform_joints_mm: Array<[Three, Three, Three, Three, Three, Three]>;
  /** Measured: a, b, c (um), alpha, beta, gamma (urad). */
  measured: Array<Six>;
  /** The same as motion of the platform at its origin, fixed axes: um, urad (rotation vector). */
  measured_motion: Array<Six>;
};

/** An effect in a simulated machine. */
export type Hidden = {
  /** Its id; `out:...` when the catalogue lacks it. */
  id: string;
  /** In words. */
  title: string;
};

/** Noise of one reading. */
export type NoiseLevels = {
  /** Of a translation, um. */
  translation_um: number;
  /** Of a rotation, urad. */
  rotation_urad: number;
  /** Where it comes from. */
  source: string;
};

/** A term the data cannot speak about. */
export type UntestableTerm = {
  /** Its id. */
  term: string;
  /** Why. */
  why: string;
};

/** Body of `POST /api/benches/{id}/trials`: each of some terms beside a model. */
export type Try = {
  /** Ids of the terms tried. */
  each: Array<string>;
  /** Ids in the order of ticking, of the catalogue and of one's own; `:richer` behind an id asks for the richer form. */
  terms: Array<string>;
  /** Term files (term/1) of one's own, as text. */
  own: Array<string>;
  /** Lines of the measurements that are left out of the fit. */
  exclude: Array<number>;
};

/** Answer to `POST /api/benches/{id}/trials`. */
export type Tried = {
  /** Terms that could be fitted; the one with which held-out readings are foreseen best comes first. */
  trials: Array<TermTrial>;
  /** Time taken on the server, ms. */
  milliseconds: number;
};

/** A term tried. */
export type TermTrial = {
  /** Its id. */
  term: string;
  /** Held-out error with it (else that of the readings fitted) as a multiple of the noise. */
  times_noise: number;
  /**
   * What it gains in the logarithm of the predictive density of the held-out readings, nats: what the terms are sorted by; absent
   * where nothing is held out.
   */
  gain: number | null;
  /**
   * Chance that the best of as many useless terms takes as much off what the model leaves of the readings fitted; absent where they
   * cannot tell.
   */
  chance: number | null;
  /** True when that chance is not believed in, and the readings held out are better foreseen as well. */
  better: boolean;
};

/** Answer to `POST /api/benches/{id}/followed`: what the residuals of a selection follow. */
export type Followed = {
  /** The most significant first, one for each thing followed; empty where nothing is followed significantly. */
  panels: Array<FollowedPanel>;
  /** False where the readings do not determine the elongation of every leg: nothing is asked then. */
  seen: boolean;
  /** Time taken on the server, ms. */
  milliseconds: number;
};

/** A variable that residual elongations follow. */
export type Association = {
  /** Leg from 1; absent for all legs together. */
  leg: number | null;
  /** The variable. */
  variable: string;
  /** `length` when the elongation itself follows it, `compliance` when elongation per force change does. */
  of: string;
  /** Spearman's rank correlation. */
  rank_correlation: number;
  /** F of the linear and quadratic columns. */
  f: number;
  /** Chance by noise, corrected for the number of questions asked. */
  p: number;
};

/** Residual elongations over what they follow. */
export type FollowedPanel = {
  /** What is followed, and how significantly. */
  association: Association;
  /** Words for what is followed. */
  title: string;
  /** Its unit; empty for the approach. */
  unit: string;
  /** Per condition shown and leg: where it stands, and what its elongation in um is divided by; null where the panel leaves it out. */
  places: Array<[[number, number] | null, [number, number] | null, [number, number] | null, [number, number] | null, [number, number] | null, [number, number] | null]>;
  /** Means of bins: what is followed, mean residual, its standard uncertainty. */
  bins: Array<Three>;
  /** The course that the test asks about; empty for the approach. */
  course: Array<[number, number]>;
};

/** Answer to `POST /api/benches/{id}/picture`: the model of a selection beside the springs alone, in one picture. */
export type Pictured = {
  /** The machine with what the terms explain; null where the readings do not determine the motion of the platform. */
  picture: StoryChart | null;
  /** Time taken on the server, ms. */
  milliseconds: number;
};

/** A picture in the colors of the page it stands in: CSS variables (`--ink`, `--grey`, `--grid`, `--paper`, `--blue`, `--red`). */
export type StoryChart = {
  /** Its heading. */
  title: string;
  /** SVG: the machine, and bars on its right. */
  wide: string;
  /** SVG for a narrow window: the bars below the machine. */
  narrow: string;
  /** What it shows. */
  caption: string;
  /** Its bars in words, a sentence for each group. */
  words: Array<string>;
};

/** Body of `POST /api/benches/{id}/diagnosis` and of `POST /api/benches/{id}/discovery`. */
export type Ask = {
  /** Term files of one's own that compete. */
  own: Array<string>;
  /** Lines of the measurements that are left out. */
  exclude: Array<number>;
};

/** Answer to `POST /api/benches/{id}/check`, whose body is that of a diagnosis: what is wrong with the files, before any effect is compared. */
export type CheckedFiles = {
  /** True when nothing has to be put right first. */
  ready: boolean;
  /** What is wrong and what looks odd, with what to do, as `hexbench check` says it; empty where there is neither. */
  sections: Array<Section>;
  /** Ways to read the files that findings name, each as changes that `--read-as` takes. */
  ways: Array<Array<string>>;
  /** Time taken on the server, ms. */
  milliseconds: number;
};

/** Part of a section. */
export type Block = {
  "kind": "verdict";
  /** The word. */
  word: string;
  /** Its color. */
  mood: Mood;
  /** One paragraph each. */
  sentences: Array<string>;
} | {
  "kind": "paragraph";
  /** The text. */
  text: string;
  /** Its color, if any. */
  mood: Mood | null;
} | {
  "kind": "list";
  /** The lines. */
  items: Array<string>;
} | {
  "kind": "entries";
  /** Number of a numbered group of entries. */
  number: number | null;
  /** The entries. */
  entries: Array<Definition>;
} | {
  "kind": "code";
  /** The lines. */
  text: string;
} | {
  "kind": "table"
} & Table | {
  "kind": "figure"
} & Figure;

/** A cell. */
export type Cell = string | {
  /** Its length. */
  bar: number;
  /** Its color, if any. */
  mood: Mood | null;
  /** Where a line crosses the column, 0 to 1, if one does. */
  mark: number | null;
};

/** A name and what is said of it. */
export type Definition = {
  /** The name. */
  label: string;
  /** What is said. */
  text: string;
};

/** A chart, drawn by `crate::plot`. */
export type Figure = {
  /** Its name within the section, as in the names of files; empty for the only one. */
  name: string;
  /** The chart; empty where only the file is named. */
  svg: string;
  /** The same for a narrow window, where it is laid out anew instead of being shrunk. */
  narrow: string | null;
  /** Its panels one by one, for pages that put as many beside each other as there is room for; empty: the chart as it is. */
  pieces: Array<string>;
  /** The legend of the panels. */
  legend: string | null;
  /** Width of one of them where there is room, px. */
  piece_px: number;
  /** The file of the chart beside the page, for media that only name it. */
  file: string | null;
  /** What it shows. */
  caption: string;
};

/** Color of a word, a bar or a line. */
export type Mood = "good" | "doubt" | "bad";

/** A column. */
export type PageColumn = {
  /** Its heading. */
  title: string;
  /** Words are set left and may wrap, numbers right. */
  words: boolean;
  /** Left out where there is little room. */
  detail: boolean;
};

/** A titled part of a page. */
export type Section = {
  /** Anchor within the page: lower-case letters and hyphens. */
  id: string;
  /** Depth of its heading below the title: 1, or 2 within a section. */
  depth: number;
  /** Heading; empty for what stands right below the title. */
  title: string;
  /** Small print beside the heading; may be empty. */
  remark: string;
  /** Left out where there is little room. */
  detail: boolean;
  /** Closed until it is opened, where a page can be; open on paper. */
  folded: boolean;
  /** What it says. */
  blocks: Array<Block>;
};

/** Columns and rows; a title may stand above. */
export type Table = {
  /** What stands above it; empty for none. */
  title: string;
  /** The columns. */
  columns: Array<PageColumn>;
  /** Cells, row by row; cells missing at the end of a row are empty. */
  rows: Array<Array<Cell>>;
  /** Rows that every medium shows, the others are detail; none: all. */
  brief: number | null;
};

/** Answer to `POST /api/benches/{id}/diagnosis`. */
export type Diagnosed = {
  /** The verdict. */
  word: Verdict;
  /** Everything the diagnosis says, as every other medium says it. */
  page: Page;
  /**
   * The machine with what was found, of misread files as the springs alone see them; null where the readings do not determine the
   * motion of the platform.
   */
  picture: StoryChart | null;
  /** Ways to read the files that findings name, each as changes that `--read-as` takes. */
  ways: Array<Array<string>>;
  /** Everything, as `diagnose --json` writes it. */
  diagnosis: Diagnosis;
  /** Time taken on the server, ms. */
  milliseconds: number;
};

/** Bias of the leg stiffnesses without a term. */
export type AbsorbedReport = {
  /** The term. */
  term: string;
  /** Stiffness without it over stiffness with it, minus one, percent; absent where not determined. */
  bias_of_leg_stiffness_percent: [number | null, number | null, number | null, number | null, number | null, number | null];
};

/** What a diagnosis of the same readings says when those that were found wrong are treated the other way. */
export type Alternative = {
  /** Lines of the readings concerned: kept here where the answer leaves them out, left out here where it keeps them. */
  rows: Array<number>;
  /** The verdict. */
  verdict: Verdict;
  /** Effects named. */
  added: Array<string>;
  /** Stiffness of every leg; absent where the data do not determine it. */
  stiffness: [Estimate | null, Estimate | null, Estimate | null, Estimate | null, Estimate | null, Estimate | null];
  /** Chi-square per degree of freedom of the last step, on the readings fitted. */
  chi2_reduced: number;
};

/** One candidate. */
export type CandidateReport = {
  /** Id of the term, `outside` or `none`. */
  term: string;
  /** Probability as the first addition. */
  probability: number;
  /** Terms whose signature is the same in these data. */
  indistinguishable: Array<string>;
};

/** One measured coordinate, or one number of a sensor; um or urad. */
export type Coordinate = {
  /** Name: that of its column, without unit. */
  name: string;
  /** Unit of the numbers. */
  unit: string;
  /** How often it was read. */
  readings: number;
  /** Root mean square residual of single readings. */
  rms: number;
  /** Standard deviation of one reading. */
  noise: number;
  /** Mean residual over conditions. */
  bias: number;
  /** Bias over its standard error, from the scatter of the conditions. */
  t: number | null;
  /** Chance of a bias this far from zero by scatter alone. */
  p: number | null;
};

/**
 * Smallest size of one parameter at which a diagnosis no longer finds the model without it more probable, with the wanted power; of a law
 * with a shape, in the middle of the shapes it may have.
 */
export type Detectable = {
  /** Id of the term. */
  term: string;
  /** The parameter. */
  parameter: string;
  /** Unit of the size. */
  unit: string;
  /** The size; absent when no size shows at all. */
  size_at_90_percent_power: number | null;
};

/** Result of `diagnose`. */
export type Diagnosis = {
  /** `diagnosis/1`. */
  format: string;
  /** The verdict. */
  verdict: Verdict;
  /** Effects named, in the order in which they were added. */
  added: Array<string>;
  /** Terms of the fitted model the numbers below belong to; for a named verdict `added` and `small` together. */
  model: Array<string>;
  /** Effects that are sure and take too little off the held-out error to be named, in the order in which they were added. */
  small: Array<string>;
  /** Terms of the model that needed their richer form. */
  richer: Array<string>;
  /** What a fit is asked to add for this model: `model`, with `:richer` behind the terms that need that form. */
  add: Array<string>;
  /** Probability of every first addition, of `outside` and of `none`. */
  candidates: Array<CandidateReport>;
  /** Probability that an effect is present at all, alone or beside others. */
  present: {
    [key in string]: number
  };
  /** How good the Gaussian behind these probabilities is, for the leading sets of effects; empty with more than 300 conditions and for absolute poses. */
  gaussian_checks: Array<GaussianCheck>;
  /** Smallest set of effects that holds 95 % of the probability. */
  credible_set: Array<string>;
  /** Error per step of the model, springs alone first. */
  steps: Array<StepReport>;
  /** Error on poses left out in turn, of the fit and of the choice of terms; absent with a holdout file and where none can be left out. */
  nested: NestedReport | null;
  /** How the held-out error was obtained. */
  holdout: string;
  /** The noise level used. */
  noise: NoiseReport;
  /** Numbers of the fitted model. */
  parameters: Array<Estimate>;
  /** Names of parameters that the data do not determine. */
  not_determined: Array<string>;
  /** Terms that the file cannot test. */
  untestable: Array<UntestableReport>;
  /** Smallest sizes this campaign would show. */
  detectable: Array<Detectable>;
  /** Readings that would separate the rivals. */
  next: Array<NextReport>;
  /** What those readings promise, pair by pair. */
  separation: Array<SeparationReport>;
  /** What an effect does to the leg stiffnesses when it is left out. */
  absorbed: Array<AbsorbedReport>;
  /** What the fitted model leaves of every sensor; empty where full poses were read. */
  sensors: Array<Coordinate>;
  /** Readings far from every prediction. */
  suspects: Array<SuspiciousReading>;
  /** The unexplained pattern. */
  outside: OutsideReport | null;
  /** What the fitted model leaves of the legs beyond the noise; absent where noise explains it, and where full poses were not read. */
  remainder: RemainderReport | null;
  /** Things to know before trusting the numbers. */
  warnings: Array<string>;
  /** Faults of the data, in the order in which they were found. */
  findings: Array<Finding>;
  /** Lines that were left out because somebody asked for it. */
  excluded: Array<number>;
  /** Readings that were found wrong took part in the fit because somebody asked for it. */
  keep_all: boolean;
  /** What the file was read as meaning otherwise than it says because somebody asked for it, as `KIND=VALUE`. */
  read_as: Array<string>;
  /** The answer the other way, where findings leave readings out or would do so. */
  alternative: Alternative | null;
};

/** One fault of the data. */
export type Finding = {
  /** What is wrong. */
  kind: FindingKind;
  /** Probability against readings as stated, and against physics without a name. */
  probability: number;
  /** Lines of the file; empty for a statement about all of them. */
  rows: Array<number>;
  /** How large, with its unit. */
  size: string;
  /** A sentence. */
  text: string;
  /** What to do. */
  next: string;
};

/** Kind of a fault of the data; the words are those of `diagnosis.json`. */
export type FindingKind = "blunder" | "pose" | "load" | "contradiction" | "inconsistent" | "noise-level" | "heavy-tails" | "shared-reference" | "reference-record" | "setup-error" | "load-noise" | "drift" | "resolution" | "tolerance" | "deflection-sign" | "wrench-sign" | "states-exchanged" | "rotation-sign" | "moment-sign" | "unit" | "axes" | "leg-order" | "joints-exchanged" | "origin" | "geometry" | "wrench-frame" | "deflection-frame" | "angle-convention" | "rotation-convention" | "reference-missing" | "row-order" | "idle-column" | "copies" | "holdout" | "sensor-sign" | "sensor-factor" | "sensor-place" | "sensor-gain" | "sensors-exchanged" | "zero-error" | "dead-band" | "measured-pose" | "commanded-pose";

/** Whether held-out readings show an effect. */
export type GainOutcome = "shown" | "open" | "refuted";

/** What the draws say of one set. */
export type GaussianCheck = {
  /** Effects of the set. */
  terms: Array<string>;
  /** Draws that were weighed. */
  draws: number;
  /** Shape of the tail of their weights (Pareto k); absent where all weights are alike. */
  pareto_k: number | null;
  /** What the logarithm of the evidence lacks, by their mean. */
  log_evidence_change: number;
};

/**
 * What held-out readings say of an effect that was added to a model.
 * For every condition `k` held out (averaged readings at one pose under one load) both models state a predictive density
 * (`Foreseen`); `d_k` is the difference of their logarithms, above zero where the larger model foresees better. Conditions at one
 * pose share what the pose has of its own, so that sums over poses are what counts:
 * ```text
 * D_p = sum over the conditions of pose p of d_k,    D = sum D_p,    S^2 = n / (n - 1) sum (D_p - D / n)^2
 * chance          one-sided, Student's t with n - 1 degrees of freedom, of a D like this one when the larger model gains nothing
 * E, s            mean and standard deviation of D if the larger model is right as fitted, its parameters uncertain
 * chance if real  Phi((D - E) / max(s, S)): of a gain as small as this one if the effect is there as fitted
 * ```
 * - shown: the chance is at most 5 %;
 * - refuted: `D` is not above zero, and the chance if real is at most 5 %: the gain would have shown, and did not;
 * - open: these readings cannot tell. The evidence `P` of the readings fitted stands where they lean towards the effect; where they
 * lean against it, `P e^D / (1 - P + P e^D)` has to be 99 % still, or 95 % where `E` is below three nats.
 * So a useless effect is shown in 5 % at most, and a real one refuted in 5 % at most. A useless one that seems sure in the readings
 * fitted survives as open where these promise little; where it promises nine nats or more, in 5 % at most.
 * Source: predictive densities of what was left out, Geisser and Eddy (1979), Journal of the American Statistical Association 74;
 * their paired differences, Vehtari, Gelman and Gabry (2017), Statistics and Computing 27, section 5.
 */
export type HeldOutGain = {
  /** What it comes to. */
  outcome: GainOutcome;
  /** `D`, nats. */
  nats: number;
  /** `E`, nats. */
  expected_nats: number;
  /** Chance of a gain like this one from an effect that gains nothing; absent with fewer than two poses. */
  chance: number | null;
  /** Chance of a gain as small as this one if the effect is there as fitted. */
  chance_if_real: number;
};

/** What remains of one leg, root mean square. */
export type LegRemainder = {
  /** Leg from 1. */
  leg: number;
  /** Elongation that nothing in the model explains, um. */
  elongation_um: number;
  /** The same relative to the elongation of the leg's spring, percent; as large a part of the stiffness is open. */
  percent_of_spring: number;
};

/** Errors on poses left out of the choice of terms and of the fit. */
export type NestedReport = {
  /** Terms chosen without each part of the poses, in the order of their names. */
  chosen: Array<Array<string>>;
  /** Sum of squared whitened residuals per degree of freedom (per number for held-out data). */
  chi2_reduced: number;
  /** Root mean square of the residuals. */
  rms: Rms;
  /** Root mean square of each coordinate: um for translations, urad for rotations. */
  per_coordinate: Six;
  /** Scalar residuals behind it. */
  count: number;
};

/** A proposed reading. */
export type NextReport = {
  /** `[a, b, c]` in mm, `[alpha, beta, gamma]` in deg. */
  pose: Six;
  /** `[fx, fy, fz]` in N, `[mx, my, mz]` in N m. */
  wrench: Six;
  /** Reference wrench, same units. */
  reference: Six;
  /** +1 or -1. */
  approach: number;
  /** Wait before the loaded reading, s. */
  elapsed_s: number;
  /** Temperature of the structure against the reference reading, K. */
  delta_T_K: number;
  /** How often to read it. */
  repeats: number;
  /** The rivals it separates most. */
  separates: [string, string];
  /**
   * What it adds to the expected logarithm of the Bayes factor between them, under the one of the two for which that is less;
   * nats.
   */
  gain: number;
  /** What sort of reading it is, in words. */
  text: string;
};

/** Noise of one reading. */
export type NoiseReport = {
  /** Of a length, um; none where none is read. */
  translation_um: number | null;
  /** Of an angle, urad; none where none is read. */
  rotation_urad: number | null;
  /** Where it comes from. */
  source: string;
  /** Degrees of freedom from which the readings tell it; absent where it is that of the files. */
  dof: number | null;
};

/** An unexplained pattern. */
export type OutsideReport = {
  /** Leg from 1; absent when all legs follow it. */
  leg: number | null;
  /** What it follows. */
  variable: string | null;
  /**
   * `linear`, `quadratic`, `step`, `periodic`; `stiffness-beside-the-legs`, `unstated-load`,
   * `other-leg`, `moving-frame`.
   */
  pattern: string | null;
  /** Period in mm. */
  period: number | null;
  /** A sentence. */
  text: string;
};

/** A page of sections. */
export type Page = {
  /** Its title. */
  title: string;
  /** What it is about: machine, files, noise. */
  subject: Array<Definition>;
  /** From top to bottom. */
  sections: Array<Section>;
};

/** What remains. */
export type RemainderReport = {
  /** Error on held-out poses (else on the readings fitted) without what the noise gives, over the noise. */
  times_noise: number;
  /** Legs in which something remains, the largest share first. */
  legs: Array<LegRemainder>;
  /** What it follows, the surest first. */
  follows: Array<Association>;
};

/** What the proposed readings promise for two rivals. */
export type SeparationReport = {
  /** The rivals. */
  between: [string, string];
  /** Expected decimal logarithm of the Bayes factor for the truth, when the first is true and when the second is. */
  log10_bayes_factor: [number, number];
  /** Chance that the readings favor the truth. */
  right: number;
  /** Readings after which the wrong one is on average excluded at 20:1; absent when more are needed. */
  readings_needed: number | null;
};

/** One step of the model. */
export type StepReport = {
  /** Terms beside the springs. */
  terms: Array<string>;
  /** Error on held-out poses. */
  holdout: ErrorSummary | null;
  /**
   * Chance of an error on held-out poses as large as this if the model is right, with all that is known of noise, tolerances and
   * parameters; absent where nothing could be held out or the noise is not known apart from the residuals.
   */
  chance: number | null;
  /** What held-out poses say of the effect added last; absent where nothing was added, or nothing could be held out. */
  gain: HeldOutGain | null;
  /** Share of the held-out error which that effect takes off; absent likewise. */
  worth: Worth | null;
  /** Sum of squared whitened residuals per degree of freedom (per number for held-out data). */
  chi2_reduced: number;
  /** Root mean square of the residuals. */
  rms: Rms;
  /** Root mean square of each coordinate: um for translations, urad for rotations. */
  per_coordinate: Six;
  /** Scalar residuals behind it. */
  count: number;
};

/** A suspicious reading. */
export type SuspiciousReading = {
  /** Line of the file. */
  row: number;
  /** Largest whitened residual. */
  z: number;
};

/** A term that cannot be tested. */
export type UntestableReport = {
  /** Its id. */
  term: string;
  /** The reason. */
  why: string;
};

/** What the data say. */
export type Verdict = "adequate" | "named" | "ambiguous" | "outside" | "measurement" | "undecided";

/**
 * Share of the held-out error that an effect takes off: whitened root mean square, noise included.
 * ```text
 * share = 1 - sqrt(chi2 after / chi2 before),   expected: chi2 before = chi2 after + sum delta^2 / numbers
 * ```
 */
export type Worth = {
  /** As measured; below zero where the error grows. */
  share: number;
  /** As the fitted effect promises for these readings. */
  expected_share: number;
};

/** Body of `POST /api/benches/{id}/plan`: the readings to take next. */
export type PlanReadings = {
  /** Term files of one's own that compete. */
  own: Array<string>;
  /** Lines of the measurements that are left out. */
  exclude: Array<number>;
  /** Which readings. */
  choice: ReadingChoice;
  /** What measuring takes; nothing unless said. */
  pace: MeasuringPace;
  /** As many readings as fit in so many hours, instead of a choice. */
  hours: number | null;
};

/** What the parts of measuring take. */
export type MeasuringPace = {
  /** Time to read once the load rests, s. */
  reading_s: number;
  /** Time of one change of load, s. */
  load_change_s: number;
  /** Time of one change of pose, s. */
  pose_change_s: number;
};

/** Which of the readings that would separate the explanations left are taken. */
export type ReadingChoice = {
  /** Readings proposed, with their repeats; null: as many as the diagnosis asks for. */
  number: number | null;
  /** How often each of them is read, zero for one that is left out; empty: as proposed. */
  repeats: Array<number>;
};

/** Answer to `POST /api/benches/{id}/plan`. */
export type PlannedReadings = {
  /** The readings proposed, in the order in which they were chosen; those left out without repeats. */
  next: Array<NextReport>;
  /** Platform joints at each of them before the load, mm, fixed frame. */
  platform_joints_mm: Array<[Three, Three, Three, Three, Three, Three]>;
  /** What they promise, pair by pair; empty without readings, and where nothing is in doubt. */
  separation: Array<SeparationReport>;
  /** The smallest effects that show now and with these readings, beside those of the diagnosis. */
  visible: Array<VisibleSize>;
  /** Different poses among the readings taken. */
  poses: number;
  /** Time that they take, s. */
  seconds: number;
  /** Time taken on the server, ms. */
  milliseconds: number;
};

/** The smallest size of an effect that shows in nine of ten campaigns. */
export type VisibleSize = {
  /** Id of the effect. */
  term: string;
  /** Its parameter. */
  parameter: string;
  /** Unit of the sizes. */
  unit: string;
  /** With the measurements alone; null when no size shows. */
  now: number | null;
  /** With the readings taken beside them. */
  planned: number | null;
};

/** Answer to `POST /api/benches/{id}/discovery`, whose body is that of a diagnosis. */
export type Discovered = {
  /** Everything the search says, as every other medium says it. */
  page: Page;
  /** The law as a term file (term/1); absent where none was found. */
  law: string | null;
  /** Effects of the catalogue that stand beside it. */
  beside: Array<string>;
  /** Time taken on the server, ms. */
  milliseconds: number;
};

/** Body of `POST /api/benches/{id}/export`. */
export type Export = {
  /** What. */
  what: What;
  /** The readings of a run sheet. */
  plan: ReadingChoice;
  /** Ids in the order of ticking, of the catalogue and of one's own; `:richer` behind an id asks for the richer form. */
  terms: Array<string>;
  /** Term files (term/1) of one's own, as text. */
  own: Array<string>;
  /** Lines of the measurements that are left out of the fit. */
  exclude: Array<number>;
};

/** What can be taken home. */
export type What = "model" | "report" | "diagnosis" | "hexapod" | "measurements" | "holdout" | "run-sheet" | "run-sheet-page";

/** Answer to `POST /api/benches/{id}/export`. */
export type Exported = {
  /** Name for the file. */
  name: string;
  /** Media type. */
  media: string;
  /** What is in it. */
  text: string;
};

/** Body of `POST /api/benches/{id}/session`: what was done, to be kept. */
export type KeepSession = {
  /** As a file to be opened again, or as a page to be read. */
  form: SessionForm;
  /** Every step, the springs alone first. */
  steps: Array<SessionStep>;
  /** The step that is shown, from zero. */
  at: number;
  /** What somebody wrote beside it. */
  notes: string;
  /** What readings that were brought back were foreseen to tell; absent where none were. */
  foreseen: SessionForesight | null;
};

/** An explanation of then. */
export type CandidateBefore = {
  /** Its id, `outside` or `none`. */
  term: string;
  /** Its probability. */
  probability: number;
};

/** What a diagnosis said, and what it foresaw. */
export type DiagnosisBefore = {
  /** Its verdict. */
  verdict: Verdict;
  /** Terms it named. */
  added: Array<string>;
  /** Explanations it did not exclude. */
  credible_set: Array<string>;
  /** Explanations with their probability. */
  candidates: Array<CandidateBefore>;
  /** Pairs of rivals, and what the readings it asked for were to tell of them. */
  separation: Array<SeparationBefore>;
};

/** Two rivals of then. */
export type SeparationBefore = {
  /** The rivals. */
  between: [string, string];
  /** Expected decimal logarithm of the Bayes factor for the truth, when the first is true and when the second is. */
  log10_bayes_factor: [number, number];
  /** Chance that the readings favor the truth. */
  right: number;
};

/** The diagnosis before readings were brought back, as far as it is compared with the one after. */
export type SessionForesight = {
  /** What was said. */
  before: DiagnosisBefore;
  /** Readings that came since. */
  readings: number;
};

/** In what form a session is kept. */
export type SessionForm = "file" | "report";

/** A model of a session, and what it gave. */
export type SessionStep = {
  /** The model. */
  selection: Selection;
  /** Held-out error (else fitted) as a multiple of the noise. */
  times_noise: number;
};

/** Answer to `POST /api/benches/{id}/resume`, whose body is the file: what was done with these very measurements. */
export type Resumed = {
  /** How the session reads the files differently from what they say; to be gone on with, they are opened so. */
  read_as: Array<string>;
  /** Every step, the springs alone first. */
  steps: Array<SessionStep>;
  /** The step that was shown, from zero. */
  at: number;
  /** What somebody wrote beside it. */
  notes: string;
  /** What readings that were brought back were foreseen to tell; null where none were. */
  foreseen: SessionForesight | null;
};

/** Body of `POST /api/benches/{id}/reveal`. */
export type Guess = {
  /** Ids of terms; `outside` for something the catalogue does not know; empty: nothing is hidden. */
  guess: Array<string>;
};

/** Answer to `POST /api/benches/{id}/reveal`. */
export type Revealed = {
  /** True when the guess names all that is hidden and nothing else. */
  right: boolean;
  /** What is hidden. */
  hidden: Array<Hidden>;
  /** True leg stiffness, N/um. */
  leg_stiffness: Six;
};

/** Body of every refusal. */
export type Refused = {
  /** What is wrong. */
  error: string;
  /** What to do. */
  next: string;
};
