/** Switches of terms of one's own. */
import type { BenchProps } from "../bench/screen";
import { dropOwn } from "./acts";
import { idOf, titleOf } from "./term_file";

export function OwnTerms({ store, catalogue, bench, edit }: BenchProps & { edit: (text: string) => void }) {
  const { own, terms } = bench.wanted;
  const full = own.length >= catalogue.limits.own_terms;
  return (
    <details open>
      <summary>Your own formulas</summary>
      <ul class="switches">
        {own.map((text) => {
          const id = idOf(text);
          return (
            <li key={id} class="switch own">
              <label>
                <input
                  type="checkbox"
                  data-testid={`term-${id}`}
                  checked={terms.includes(id)}
                  onChange={(event) => {
                    event.currentTarget.checked = terms.includes(id);
                    store.toggle(id, event.timeStamp);
                  }}
                />
                <span>
                  {titleOf(text)} <code>{id}</code>
                </span>
              </label>
              <button type="button" class="quiet" onClick={() => edit(text)}>
                Edit
              </button>
              <button type="button" class="quiet" aria-label={`Remove ${id}`} onClick={() => dropOwn(store, id)}>
                Remove
              </button>
            </li>
          );
        })}
      </ul>
      <button type="button" data-testid="own-new" disabled={full} onClick={() => edit(catalogue.formula.example)}>
        Write a formula
      </button>
      {full && <p class="hint">At most {catalogue.limits.own_terms} formulas at a time.</p>}
    </details>
  );
}
