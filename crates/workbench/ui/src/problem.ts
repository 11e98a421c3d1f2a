/** What went wrong, in words with a next step. */
import { Refusal, ServerGone } from "./api";
import type { Problem } from "./state";

export const OPEN_ADDRESS = "Open the address that `hexbench workbench` printed: it contains the access key.";

/** A failed request as something to show; `again` repeats it. */
export function problemOf(error: unknown, place: Problem["place"], again?: () => void): Problem {
  if (error instanceof ServerGone) {
    return {
      place: "page",
      message: error.message,
      next: "Check that `hexbench workbench` is still running; if not, start it again.",
      ...retry(again),
    };
  }
  if (error instanceof Refusal) {
    if (error.status === 401) return { place: "page", message: "The access key of this page is not valid.", next: OPEN_ADDRESS };
    const repeats = error.status === 408 || error.status >= 500;
    return { place: repeats ? "page" : place, message: error.message, next: error.next, ...(repeats ? retry(again) : {}) };
  }
  const message = error instanceof Error ? error.message : String(error);
  return {
    place: "page",
    message: `Error in the page: ${message}`,
    next: "Reload the page, and please report this error.",
    ...retry(again),
  };
}

function retry(again?: () => void): { again?: () => void } {
  return again === undefined ? {} : { again };
}
