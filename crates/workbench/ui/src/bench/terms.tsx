/** Switches of all terms. */
import { useState } from "preact/hooks";
import { tryEach } from "../asks";
import { isRicher, isTicked } from "../history";
import { OwnTerms } from "../own/own_terms";
import { grouped } from "./groups";
import type { BenchProps } from "./screen";
import { TermSwitch } from "./term_switch";
import { Tried } from "./tried";

/** `edit` opens a term file in the editor. */
export function Terms(props: BenchProps & { edit: (text: string) => void }) {
  const { store, catalogue, bench } = props;
  const why = new Map(bench.opened.untestable.map(({ term, why }) => [term, why]));
  const { wanted } = bench;
  const open = catalogue.terms.map(({ id }) => id).filter((id) => !why.has(id) && !isTicked(wanted, id));
  return (
    <section class="card terms" aria-labelledby="terms-title">
      <div class="row spread">
        <h2 id="terms-title">Terms of the model</h2>
        <button
          type="button"
          class="quiet"
          data-testid="try-each"
          title="Adds each term in turn to those ticked, and tests its gain on held-out readings"
          onClick={() => void tryEach(store, open)}
        >
          Try each
        </button>
      </div>
      <p class="hint">The six leg springs are always included; tick the other effects that may be present.</p>
      <Tried store={store} bench={bench} />
      {grouped(catalogue).map(({ title, terms }) => (
        <Group
          key={title}
          title={title}
          closed={terms.every(({ id }) => why.has(id)) || (isNarrow() && !terms.some(({ id }) => isTicked(wanted, id)))}
        >
          {terms.map((term) => (
            <TermSwitch
              key={term.id}
              term={term}
              ticked={isTicked(wanted, term.id)}
              richer={isRicher(wanted, term.id)}
              why={why.get(term.id)}
              toggle={(start) => store.toggle(term.id, start)}
              changeForm={(start) => store.changeForm(term.id, start)}
            />
          ))}
        </Group>
      ))}
      <OwnTerms {...props} />
    </section>
  );
}

/** On a telephone the terms would fill two screens above everything else. */
function isNarrow(): boolean {
  return matchMedia("(max-width: 860px)").matches;
}

function Group({ title, closed, children }: { title: string; closed: boolean; children: preact.ComponentChildren }) {
  const [open, setOpen] = useState(!closed);
  return (
    <details open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>{title}</summary>
      <ul class="switches">{children}</ul>
    </details>
  );
}
