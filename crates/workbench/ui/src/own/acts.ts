/** Formulas of one's own among what is ticked. */
import type { Store } from "../store";
import { idOf } from "./term_file";

/** Adds a formula and ticks it, or replaces the one of the same id. */
export async function putOwn(store: Store, text: string): Promise<boolean> {
  const wanted = store.get().bench?.wanted;
  if (wanted === undefined) return false;
  const id = idOf(text);
  const terms = wanted.terms.includes(id) ? wanted.terms : [...wanted.terms, id];
  return store.select({ ...wanted, terms, own: replaced(wanted.own, text) }, "formula");
}

/** Removes a formula. */
export function dropOwn(store: Store, id: string): void {
  const wanted = store.get().bench?.wanted;
  if (wanted === undefined) return;
  const own = wanted.own.filter((text) => idOf(text) !== id);
  void store.select({ ...wanted, terms: wanted.terms.filter((other) => other !== id), own });
}

/** Adds a law that was found, and ticks it with the effects beside it and nothing else. */
export function addLaw(store: Store, text: string, beside: string[]): void {
  const wanted = store.get().bench?.wanted;
  if (wanted !== undefined) void store.select({ ...wanted, terms: [...beside, idOf(text)], own: replaced(wanted.own, text) });
}

/** Formulas with this one in the place of that of the same id. */
function replaced(own: string[], text: string): string[] {
  const id = idOf(text);
  return [...own.filter((other) => idOf(other) !== id), text];
}
