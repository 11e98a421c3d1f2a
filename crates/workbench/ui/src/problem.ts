/** What went wrong, in words with a next step. */
import { Refusal, ServerGone } from "./api";
import type { Problem } from "./state";

export const OPEN_ADDRESS = "Open the address that `hexbench workbench` printed: it carries the key to this bench.";

/** A failed request as something to show; `again` repeats it. */
export function problemOf(error: unknown, place: Problem["place"], again?: () => void): Problem {
  if (error instanceof ServerGone) {
    return {
      place: "page",
      message: error.message,
      next: "Is `hexbench workbench` still running? Start it again if not.",
      ...retry(again),
    };
  }
  if (error instanceof Refusal) {
    if (error.status === 401) return { place: "page", message: "This page has no valid key.", next: OPEN_ADDRESS };
    const repeats = error.status === 408 || error.status >= 500;
    return { place: repeats ? "page" : place, message: error.message, next: error.next, ...(repeats ? retry(again) : {}) };
  }
  const message = error instanceof Error ? error.message : String(error);
  return { place: "page", message: `The page failed: ${message}`, next: "Load the page again; please report this.", ...retry(again) };
}

function retry(again?: () => void): { again?: () => void } {
  return again === undefined ? {} : { again };
}
