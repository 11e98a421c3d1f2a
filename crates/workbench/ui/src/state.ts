/** All the page knows. */
import type { History } from "./history";
import type { Catalogue, Diagnosed, Level, Open, Opened, Revealed, Selection } from "./wire";

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

/** A loaded bench. */
export interface Bench {
  opened: Opened;
  /** What was asked for, to load it again. */
  open: Open;
  history: History;
  /** What is ticked; ahead of the history while an answer is awaited. */
  wanted: Selection;
  /** Diagnosis and the formulas it weighed. */
  diagnosed: { answer: Diagnosed; own: string[] } | null;
  revealed: { answer: Revealed; guess: string[] } | null;
  /** Held-out error if a term were ticked as well, by id; belongs to one place of the history. */
  trials: { at: number; error: Record<string, number> } | null;
}

/** Games played in this tab. */
export interface Score {
  level: Level;
  right: boolean;
  /** The diagnosis was asked before the guess. */
  helped: boolean;
}

export type Busy = "opening" | "fitting" | "diagnosing" | "exporting" | "revealing" | "trying";

export interface State {
  catalogue: Catalogue | null;
  bench: Bench | null;
  /** Shown only when it takes longer than a blink. */
  busy: Busy | null;
  problem: Problem | null;
  scores: Score[];
  tick: Tick | null;
  /** No token: nothing can be asked. */
  locked: boolean;
}

export const EMPTY: State = {
  catalogue: null,
  bench: null,
  busy: null,
  problem: null,
  scores: [],
  tick: null,
  locked: false,
};
