/** Steps of a bench: what was ticked and what it gave, with a place that undo and redo move. */
import type { Selection, View } from "./wire";

export interface Step {
  selection: Selection;
  view: View;
}

/** Steps are never lost before the place; those after it go when something new is done. */
export interface History {
  steps: Step[];
  at: number;
}

/** Leg springs alone, fitted to every reading: where a bench begins. */
export const SPRINGS: Selection = { terms: [], own: [], exclude: [] };

export function begin(step: Step): History {
  return { steps: [step], at: 0 };
}

/** Adds a step after the place. */
export function add(history: History, step: Step): History {
  const steps = [...history.steps.slice(0, history.at + 1), step];
  return { steps, at: steps.length - 1 };
}

/** Moves the place; outside the steps nothing changes. */
export function goTo(history: History, at: number): History {
  return at >= 0 && at < history.steps.length ? { ...history, at } : history;
}

export function now(history: History): Step {
  return history.steps[history.at] as Step;
}

/** Springs alone: where every bench begins. */
export function springs(history: History): Step {
  return history.steps[0] as Step;
}

/** Are these the same terms, in whatever order? */
export function sameTerms(a: string[], b: string[]): boolean {
  return [...a].sort().join() === [...b].sort().join();
}

/** What changed from one selection to the next, in words. */
export function changed(from: Selection | undefined, to: Selection): string {
  if (from === undefined) return "springs alone";
  const readings = readingsChanged(from.exclude, to.exclude);
  if (to.terms.length === 0 && (from.terms.length > 0 || readings.length === 0)) return ["springs alone", ...readings].join(", ");
  const added = to.terms.filter((id) => !from.terms.includes(id)).map((id) => `+ ${id}`);
  const removed = from.terms.filter((id) => !to.terms.includes(id)).map((id) => `\u2212 ${id}`);
  const words = [[...added, ...removed].join(" "), ...readings].filter((word) => word !== "");
  return words.length === 0 ? "formula changed" : words.join(", ");
}

function readingsChanged(from: number[], to: number[]): string[] {
  const out = to.filter((line) => !from.includes(line)).length;
  const back = from.filter((line) => !to.includes(line)).length;
  return [...(out > 0 ? [`${readingsOf(out)} left out`] : []), ...(back > 0 ? [`${readingsOf(back)} put back`] : [])];
}

/** `1 reading`, `3 readings`. */
export function readingsOf(count: number): string {
  return count === 1 ? "1 reading" : `${count} readings`;
}

/** The same text for the same model, in whatever order its terms were ticked. */
export function modelOf({ terms, own, exclude }: Selection): string {
  return JSON.stringify([[...terms].sort(), own, exclude]);
}

/** The selection without these lines of the measurements, or with them again. */
export function withReadings(selection: Selection, lines: number[], counted: boolean): Selection {
  const others = selection.exclude.filter((line) => !lines.includes(line));
  return { ...selection, exclude: counted ? others : [...others, ...lines].sort((a, b) => a - b) };
}

const RICHER = ":richer";

/** Id of a term without the mark of its richer form. */
export function plain(id: string): string {
  return id.endsWith(RICHER) ? id.slice(0, -RICHER.length) : id;
}

/** Is the term ticked, in either form? */
export function isTicked(selection: Selection, id: string): boolean {
  return selection.terms.some((other) => plain(other) === id);
}

/** Is the term ticked in its richer form? */
export function isRicher(selection: Selection, id: string): boolean {
  return selection.terms.includes(id + RICHER);
}

/** The selection with a term ticked or not. */
export function toggled(selection: Selection, id: string): Selection {
  const terms = isTicked(selection, id) ? selection.terms.filter((other) => plain(other) !== id) : [...selection.terms, id];
  return { ...selection, terms };
}

/** The selection with a ticked term in its other form. */
export function otherForm(selection: Selection, id: string): Selection {
  const other = isRicher(selection, id) ? id : id + RICHER;
  return { ...selection, terms: selection.terms.map((one) => (plain(one) === id ? other : one)) };
}
