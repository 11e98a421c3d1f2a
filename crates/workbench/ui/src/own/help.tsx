/** What a formula may use. */
import type { FormulaHelp } from "../wire";

export function Help({ help }: { help: FormulaHelp }) {
  return (
    <details>
      <summary>Variables and functions for formulas</summary>
      <dl class="help">
        {help.variables.map(({ id, title, text }) => (
          <div key={id}>
            <dt>
              <code>{id}</code>
            </dt>
            <dd>
              {title}
              {text && `, ${text}`}
            </dd>
          </div>
        ))}
      </dl>
      <p>
        Functions: <code>{help.functions.join(" ")}</code>
      </p>
    </details>
  );
}
