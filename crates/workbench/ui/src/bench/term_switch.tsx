/** A term: its switch, and what it means. */
import { useState } from "preact/hooks";
import { unitName } from "../format";
import type { TermCard } from "../wire";

interface Props {
  term: TermCard;
  ticked: boolean;
  /** Ticked in its richer form. */
  richer: boolean;
  /** Why it cannot be tested with these data. */
  why: string | undefined;
  /** Told when the gesture began, ms. */
  toggle: (start: number) => void;
  changeForm: (start: number) => void;
}

export function TermSwitch({ term, ticked, richer, why, toggle, changeForm }: Props) {
  const [shown, setShown] = useState(false);
  const about = `about-${term.id}`;
  return (
    <li class={why === undefined ? "" : "untestable"}>
      <div class="switch">
        <label>
          <input
            type="checkbox"
            data-testid={`term-${term.id}`}
            checked={ticked}
            disabled={why !== undefined && !ticked}
            onChange={(event) => {
              // The page decides what is ticked, not the box.
              event.currentTarget.checked = ticked;
              toggle(event.timeStamp);
            }}
          />
          <span>
            {term.title} <code>{term.id}</code>
          </span>
        </label>
        <button
          type="button"
          class="quiet"
          aria-expanded={shown}
          aria-controls={about}
          aria-label={`About ${term.title}`}
          onClick={() => setShown(!shown)}
        >
          ?
        </button>
      </div>
      {ticked && term.richer && (
        <label class="richer" title="the form of a real structure instead of the ideal one">
          <input
            type="checkbox"
            data-testid={`richer-${term.id}`}
            checked={richer}
            onChange={(event) => {
              event.currentTarget.checked = richer;
              changeForm(event.timeStamp);
            }}
          />{" "}
          richer form
        </label>
      )}
      {why !== undefined && <p class="hint">Cannot be tested: {why}</p>}
      <div id={about} hidden={!shown} class="explained">
        {shown && <Explained term={term} />}
      </div>
    </li>
  );
}

function Explained({ term }: { term: TermCard }) {
  return (
    <>
      <p>{term.physics}</p>
      <pre>{term.equation}</pre>
      <p>Visible when {term.shows}.</p>
      {term.parameters.length > 0 && (
        <p class="hint">{term.parameters.map(({ name, unit }) => `${name} (${unitName(unit)})`).join(", ")}</p>
      )}
    </>
  );
}
