/** Terms of one's own: switches, and the editor. */
import { useState } from "preact/hooks";
import type { BenchProps } from "../bench/screen";
import { Editor } from "./editor";
import { idOf, titleOf } from "./term_file";

export function OwnTerms({ store, catalogue, bench, state }: BenchProps) {
  const [edited, setEdited] = useState<string | null>(null);
  const { own, terms } = bench.wanted;
  const full = own.length >= catalogue.limits.own_terms;
  return (
    <details open>
      <summary>Your own formulas</summary>
      <ul class="switches">
        {own.map((text) => {
          const id = idOf(text);
          return (
            <li key={id} class="switch">
              <label>
                <input
                  type="checkbox"
                  data-testid={`term-${id}`}
                  checked={terms.includes(id)}
                  onChange={(event) => store.toggle(id, event.timeStamp)}
                />
                <span>
                  {titleOf(text)} <code>{id}</code>
                </span>
              </label>
              <button type="button" class="quiet" onClick={() => setEdited(text)}>
                Edit
              </button>
              <button type="button" class="quiet" aria-label={`Remove ${id}`} onClick={() => store.dropOwn(id)}>
                Remove
              </button>
            </li>
          );
        })}
      </ul>
      {edited === null ? (
        <button type="button" data-testid="own-new" disabled={full} onClick={() => setEdited(catalogue.formula.example)}>
          Write a formula
        </button>
      ) : (
        <Editor
          key={edited}
          text={edited}
          help={catalogue.formula}
          problem={state.problem?.place === "formula" ? state.problem : null}
          put={async (text) => {
            if (await store.putOwn(text)) setEdited(null);
          }}
          close={() => {
            if (state.problem?.place === "formula") store.dismiss();
            setEdited(null);
          }}
        />
      )}
    </details>
  );
}
