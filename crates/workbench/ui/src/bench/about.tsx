/** What is loaded, and files to take home. */
import { takeHome } from "../asks";
import { unitName } from "../format";
import type { Bench } from "../state";
import type { Store } from "../store";
import type { What } from "../wire";

const RESULTS: [What, string][] = [
  ["model", "Model (model.toml)"],
  ["report", "Report (report.html)"],
  ["diagnosis", "Diagnosis (diagnosis.json)"],
];
const SOURCES: [What, string][] = [
  ["hexapod", "Machine (hexapod.toml)"],
  ["measurements", "Measurements (measurements.csv)"],
  ["holdout", "Held-out measurements (holdout.csv)"],
];

export function About({ store, bench }: { store: Store; bench: Bench }) {
  const { opened } = bench;
  const sources = SOURCES.filter(([what]) => what !== "holdout" || hasHoldout(bench));
  return (
    <section class="card">
      <h2>About these data, and files to download</h2>
      <ul class="about">
        {opened.about.map((line) => (
          <li key={line}>{unitName(line)}</li>
        ))}
        {opened.seed !== null && <li>Seed {opened.seed}</li>}
        {opened.contains && (
          <li>
            Simulated effects:{" "}
            {opened.contains.length === 0 ? "none" : opened.contains.map(({ id, title }) => `${title} (${id})`).join(", ")}
          </li>
        )}
      </ul>
      <div class="row">
        {[...RESULTS, ...sources].map(([what, title]) => (
          <button key={what} type="button" data-testid={`export-${what}`} onClick={() => void takeHome(store, what)}>
            {title}
          </button>
        ))}
      </div>
      <p class="hint">
        The model contains the ticked terms; report and diagnosis compare all terms. Each file is computed when you download it.
      </p>
    </section>
  );
}

function hasHoldout({ opened }: Bench): boolean {
  return opened.view.held_out.includes("file");
}
