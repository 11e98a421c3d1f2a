/** Something under way, shown only when it lasts. */
import { useEffect, useState } from "preact/hooks";
import type { Busy } from "./state";

const BLINK_MS = 150;

const WORDS: Record<Busy, string> = {
  opening: "Loading and fitting the springs",
  fitting: "Fitting",
  diagnosing: "Weighing all explanations",
  discovering: "Searching the law",
  exporting: "Writing the file",
  revealing: "Opening the envelope",
  trying: "Trying each term",
  resuming: "Fitting the steps of the session",
};

/** A line of text while `busy`, after a moment. */
export function BusyLine({ busy: all }: { busy: Busy[] }) {
  const busy = all.at(-1) ?? null;
  const [shown, setShown] = useState(false);
  useEffect(() => {
    setShown(false);
    if (busy === null) return;
    const timer = setTimeout(() => setShown(true), BLINK_MS);
    return () => clearTimeout(timer);
  }, [busy]);
  return (
    <p class="busy" role="status" data-testid="busy">
      {busy !== null && shown ? `${WORDS[busy]} ...` : ""}
    </p>
  );
}
