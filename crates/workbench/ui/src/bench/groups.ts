/** The catalogue in groups, as a bench is built. */
import type { Catalogue, TermCard } from "../wire";

export interface Group {
  title: string;
  terms: TermCard[];
}

/** A group for each chapter of the catalogue. */
export function grouped({ chapters, terms }: Catalogue): Group[] {
  return chapters.map((title) => ({ title, terms: terms.filter(({ chapter }) => chapter === title) }));
}
