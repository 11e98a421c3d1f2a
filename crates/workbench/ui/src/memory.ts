/** What a tab remembers over a reload: what is loaded, what is ticked, games played. */
import { SPRINGS } from "./history";
import type { Score } from "./state";
import type { Open, Selection, SessionForesight } from "./wire";

const OPEN = "hexbench-open";
const SELECTION = "hexbench-selection";
const SCORES = "hexbench-scores";
const LOOKS = "hexbench-looks";
const NOTES = "hexbench-notes";
const FORESEEN = "hexbench-foreseen";

export interface Remembered {
  open: Open;
  selection: Selection;
}

/** What is loaded; may be large, hence apart from what changes with every tick. */
export function rememberOpen(open: Open): void {
  keep(OPEN, open);
}

export function rememberSelection(selection: Selection): void {
  keep(SELECTION, selection);
}

export function forgetBench(): void {
  sessionStorage.removeItem(OPEN);
  sessionStorage.removeItem(SELECTION);
}

/** Models whose held-out error has been seen, of the readings that are loaded. */
export function rememberLooks(looks: readonly string[]): void {
  keep(LOOKS, looks);
}

export function rememberedLooks(): string[] {
  return read<string[]>(LOOKS) ?? [];
}

/** What the user wrote beside what is loaded. */
export function rememberNotes(notes: string): void {
  keep(NOTES, notes);
}

export function rememberedNotes(): string {
  return read<string>(NOTES) ?? "";
}

/** What readings that came were foreseen to tell. */
export function rememberForesight(foreseen: SessionForesight | null): void {
  keep(FORESEEN, foreseen);
}

export function rememberedForesight(): SessionForesight | null {
  return read<SessionForesight>(FORESEEN);
}

export function rememberedBench(): Remembered | null {
  const open = read<Open>(OPEN);
  return open && { open, selection: read<Selection>(SELECTION) ?? SPRINGS };
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
