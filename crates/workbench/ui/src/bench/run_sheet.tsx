/** The readings a diagnosis asks for: taken to the machine as a run sheet, and brought back filled in. */
import { takeHome } from "../asks";
import { PickFiles } from "../drop_area";
import { textsOf } from "../files";
import { repeatsOf, totalOf } from "../plan/choice";
import { PlanSection } from "../plan/section";
import { append } from "../session";
import type { Bench } from "../state";
import type { Store } from "../store";

export function RunSheet({ store, bench, count: asksFor }: { store: Store; bench: Bench; count: number }) {
  const count = bench.plan === null ? asksFor : totalOf(repeatsOf(bench.plan));
  const take = async (files: File[]) => {
    const [file] = await textsOf(files.slice(0, 1));
    if (file !== undefined) void append(store, file);
  };
  return (
    <section
      class="run-sheet"
      data-testid="run-sheet"
      aria-label="Run sheet"
      onDragOver={(event) => event.preventDefault()}
      onDrop={(event) => {
        event.preventDefault();
        void take([...(event.dataTransfer?.files ?? [])]);
      }}
    >
      <h3>Run sheet: {count === 1 ? "the next reading" : `the next ${count} readings`} to take</h3>
      <PlanSection store={store} bench={bench} />
      <div class="row">
        <button type="button" data-testid="export-run-sheet" disabled={count === 0} onClick={() => void takeHome(store, "run-sheet")}>
          Run sheet (run-sheet.csv)
        </button>
        <button
          type="button"
          data-testid="export-run-sheet-page"
          disabled={count === 0}
          onClick={() => void takeHome(store, "run-sheet-page")}
        >
          Printable (run-sheet.html)
        </button>
        <PickFiles name="readings-back" title="Open the completed run sheet" accept=".csv,.txt" take={(files) => void take(files)} />
      </div>
      <p class="hint">
        Enter the readings, correct the settings that differ from the plan, and delete the rows that were not measured. Then drop the file
        here: the program fits its readings with the others, diagnoses again, and compares the obtained odds with the predicted ones.
      </p>
    </section>
  );
}
