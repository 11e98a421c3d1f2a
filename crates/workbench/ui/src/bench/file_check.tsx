/** What is wrong with the files as they are written, above everything that rests on them. */
import { Said } from "../page/said";
import type { Bench } from "../state";
import type { Store } from "../store";
import { Ways } from "./ways";

export function FileCheck({ store, bench }: { store: Store; bench: Bench }) {
  const { checked } = bench;
  if (checked === null || checked.sections.length === 0) return null;
  const { ready, sections, ways } = checked;
  return (
    <section class={`lead-card ${ready ? "" : "bad"}`} role={ready ? undefined : "alert"} data-testid="file-check" data-ready={ready}>
      {!ready && (
        <h2>
          {ways.length > 0
            ? "The files do not seem to mean what they say: no number below counts until this is settled"
            : "Something is wrong with the files: put it right before you trust a number below"}
        </h2>
      )}
      <Said sections={sections} name="check" />
      {ways.length > 0 && <Ways store={store} ways={ways} name="check-read-as" />}
    </section>
  );
}
