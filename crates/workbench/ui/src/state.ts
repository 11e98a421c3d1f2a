/** All the page knows. */
import type { Which } from "./charts/readings";
import type { History, Step } from "./history";
import type { Plan } from "./plan/choice";
import type {
  Ask,
  Catalogue,
  CheckedFiles,
  Diagnosed,
  Discovered,
  Followed,
  GameLevel,
  MeasuringPace,
  Open,
  Opened,
  Pictured,
  Revealed,
  Selection,
  SessionForesight,
  TermTrial,
} from "./wire";

/** Something that went wrong, with what to do. */
export interface Problem {
  /** Where it is shown: at the top of the page, or at the form of a formula. */
  place: "page" | "formula";
  message: string;
  next: string;
  /** Offered as a button. */
  again?: () => void;
}

/** Times of the last tick, ms. */
export interface Tick {
  total: number;
  server: number;
}

/** Conditions among those shown, at least one; the last of them is the one looked at. */
export interface Pick {
  which: Which;
  all: number[];
  /** The part of the machine that they were picked by, until something else changes them. */
  part?: Part;
}

/** A part of the machine that stands for readings: a leg (from 0) for those of which it is missed most, the load for those under it. */
export type Part = { kind: "leg"; leg: number } | { kind: "load" };

/** A loaded bench. */
export interface Bench {
  opened: Opened;
  /** What was asked for, to load it again. */
  open: Open;
  history: History;
  /** What is ticked; ahead of the history while an answer is awaited. */
  wanted: Selection;
  /** What is wrong with the files; asked once, when they are opened. */
  checked: CheckedFiles | null;
  /** Diagnosis and what it was asked. */
  diagnosed: { answer: Diagnosed; asked: Ask } | null;
  /** Which of the readings asked for are taken, and what they promise; belongs to the diagnosis. */
  plan: Plan | null;
  /** What the parts of measuring take on this machine. */
  pace: MeasuringPace;
  /** What a search for a law found. */
  discovered: { answer: Discovered } | null;
  revealed: { answer: Revealed; guess: string[] } | null;
  /** What each term would give if ticked as well, the largest gain first; belongs to one step. */
  trials: { step: Step; found: TermTrial[] } | null;
  /** What the residuals of a step follow; the newest answer. */
  followed: { step: Step; answer: Followed } | null;
  /** A step in one picture; the newest answer. */
  pictured: { step: Step; answer: Pictured } | null;
  /** Models whose held-out error has been seen, each once. */
  looks: readonly string[];
  /** The diagnosis before readings were brought back, and how many came; absent where none were. */
  foreseen: SessionForesight | null;
  /** What is picked, the same in every chart, table and in the machine: places in the lists of those fitted or held out. */
  picked: Pick | null;
  /** What the user wrote beside it. */
  notes: string;
}

/** Games played in this tab. */
export interface Score {
  level: GameLevel;
  right: boolean;
  /** The diagnosis was asked before the guess. */
  helped: boolean;
}

export type Busy =
  | "opening"
  | "checking"
  | "fitting"
  | "following"
  | "picturing"
  | "diagnosing"
  | "planning"
  | "discovering"
  | "exporting"
  | "revealing"
  | "trying"
  | "resuming";

export interface State {
  catalogue: Catalogue | null;
  bench: Bench | null;
  /** What is under way, the newest last. */
  busy: Busy[];
  /** How much of it is done, where that is known. */
  progress: { done: number; of: number } | null;
  problem: Problem | null;
  scores: Score[];
  tick: Tick | null;
  /** No token: nothing can be asked. */
  locked: boolean;
}

export const EMPTY: State = {
  catalogue: null,
  bench: null,
  busy: [],
  progress: null,
  problem: null,
  scores: [],
  tick: null,
  locked: false,
};
