/** What a tab remembers over a reload: what is loaded, what is ticked, games played. */
import type { Score } from "./state";
import type { Open, Selection } from "./wire";

const BENCH = "hexbench-bench";
const SCORES = "hexbench-scores";

export interface Remembered {
  open: Open;
  selection: Selection;
}

export function rememberBench(bench: Remembered | null): void {
  if (bench === null) sessionStorage.removeItem(BENCH);
  else keep(BENCH, bench);
}

export function rememberedBench(): Remembered | null {
  return read<Remembered>(BENCH);
}

export function rememberScores(scores: Score[]): void {
  keep(SCORES, scores);
}

export function rememberedScores(): Score[] {
  return read<Score[]>(SCORES) ?? [];
}

function keep(key: string, value: unknown): void {
  try {
    sessionStorage.setItem(key, JSON.stringify(value));
  } catch {
    // Too large for the browser's store: a reload then begins at the start screen.
    sessionStorage.removeItem(key);
  }
}

function read<T>(key: string): T | null {
  try {
    return JSON.parse(sessionStorage.getItem(key) ?? "null") as T | null;
  } catch {
    return null;
  }
}
