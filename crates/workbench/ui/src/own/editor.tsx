/** Editor of a term file: the text is what counts, the form shows and writes it. */
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { download } from "../download";
import type { Problem } from "../state";
import { Trouble } from "../trouble";
import type { FormulaHelp } from "../wire";
import { Form } from "./form";
import { Help } from "./help";
import { idOf, parsed, pointedAt, written } from "./term_file";

interface Props {
  text: string;
  help: FormulaHelp;
  problem: Problem | null;
  put: (text: string) => Promise<void>;
  close: () => void;
}

export function Editor({ text: first, help, problem, put, close }: Props) {
  const [text, setText] = useState(first);
  const area = useRef<HTMLTextAreaElement>(null);
  const term = parsed(text);
  useLayoutEffect(() => showPlace(area.current, problem?.message), [problem]);
  return (
    <form
      class="editor"
      data-testid="own-editor"
      onSubmit={(event) => {
        event.preventDefault();
        void put(text);
      }}
    >
      {term === null ? (
        <p class="hint">This file contains more than the form can show; edit it as text.</p>
      ) : (
        <Form term={term} units={help.units} set={(next) => setText(written(next))} />
      )}
      <label>
        <span>Term file (term/1)</span>
        <textarea
          ref={area}
          data-testid="own-text"
          rows={10}
          spellcheck={false}
          value={text}
          onInput={(event) => setText(event.currentTarget.value)}
        />
      </label>
      {problem && <Trouble problem={problem} />}
      <div class="row">
        <button type="submit" class="main" data-testid="own-add">
          Fit
        </button>
        <button type="button" data-testid="own-save" onClick={() => download(`${idOf(text) || "term"}.toml`, "application/toml", text)}>
          Save file
        </button>
        <label class="button">
          Open file
          <input
            type="file"
            class="unseen"
            accept=".toml"
            onChange={(event) => void event.currentTarget.files?.[0]?.text().then(setText)}
          />
        </label>
        <button type="button" class="quiet" onClick={close}>
          Close
        </button>
      </div>
      <Help help={help} />
    </form>
  );
}

/** Marks what the message points at. */
function showPlace(area: HTMLTextAreaElement | null, message: string | undefined): void {
  const place = area === null || message === undefined ? null : pointedAt(area.value, message);
  if (area === null || place === null) return;
  area.focus();
  area.setSelectionRange(...place);
}
