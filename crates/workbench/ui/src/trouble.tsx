/** A problem, with its next step. */
import { here } from "./page/here";
import type { Problem } from "./state";

export function Trouble({ problem, dismiss }: { problem: Problem; dismiss?: () => void }) {
  return (
    <div class="trouble" role="alert" data-testid="error">
      <p>
        <strong>{here(problem.message)}</strong> {here(problem.next)}
      </p>
      <div class="buttons">
        {problem.again && (
          <button type="button" data-testid="retry" onClick={problem.again}>
            Try again
          </button>
        )}
        {dismiss && (
          <button type="button" class="quiet" onClick={dismiss}>
            Close
          </button>
        )}
      </div>
    </div>
  );
}
