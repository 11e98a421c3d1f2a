/** What is wrong with the files as they are written, above everything that rests on them. */
import { Said } from "../page/said";
import type { Bench } from "../state";
import type { Store } from "../store";
import type { Section } from "../wire";
import { Ways } from "./ways";

const MISREAD = "The files do not seem to mean what they say: no number below counts until this is settled";
const WRONG = "Something is wrong with the files: put it right before you trust a number below";

/** Do the files seem to mean something else than they say? */
export function isMisread({ checked }: Bench): boolean {
  return checked !== null && checked.ways.length > 0;
}

export function FileCheck({ store, bench }: { store: Store; bench: Bench }) {
  const { checked } = bench;
  if (checked === null || checked.sections.length === 0) return null;
  const { ready, sections, ways } = checked;
  return (
    <section class={`lead-card ${ready ? "" : "bad"}`} role={ready ? undefined : "alert"} data-testid="file-check" data-ready={ready}>
      {!ready && <h2>{ways.length > 0 ? MISREAD : WRONG}</h2>}
      {ways.length > 0 && <Ways store={store} ways={ways} name="check-read-as" />}
      {ready ? <Odd sections={sections} /> : <Said sections={sections.map(untitled)} name="check" />}
    </section>
  );
}

/** What may be right after all stands back until somebody asks. */
function Odd({ sections }: { sections: Section[] }) {
  return (
    <details>
      <summary>Something looks odd in the files, and may be right</summary>
      <Said sections={sections.map(untitled)} name="check" />
    </details>
  );
}

/** The first section needs no title in a card of its own. */
export function untitled(section: Section, index: number): Section {
  return index === 0 ? { ...section, title: "" } : section;
}
