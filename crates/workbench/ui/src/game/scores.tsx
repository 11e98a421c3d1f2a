/** Games played in this tab. */
import type { Score } from "../state";

export function Scores({ scores }: { scores: Score[] }) {
  if (scores.length === 0) return null;
  const right = scores.filter((score) => score.right);
  const alone = right.filter((score) => !score.helped).length;
  return (
    <p class="hint" data-testid="scores">
      {right.length} of {scores.length} right so far, {alone} of them without the diagnosis.
    </p>
  );
}
