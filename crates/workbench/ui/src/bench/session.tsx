/** The session: notes, what was done saved as a file or a page, and a saved one opened. */
import { DropArea, PickFiles } from "../drop_area";
import { isSession, textsOf } from "../files";
import { keep, refuseFile, resume } from "../session";
import type { Bench } from "../state";
import type { Store } from "../store";

export function Session({ store, bench }: { store: Store; bench: Bench }) {
  const take = async (files: File[]) => {
    const texts = await textsOf(files);
    const session = texts.find(isSession);
    if (session !== undefined) void resume(store, session);
    else if (texts.length > 0) refuseFile(store, texts[0]?.name ?? "");
  };
  return (
    <DropArea take={(files) => void take(files)}>
      <h2>Session</h2>
      <label class="notes">
        <span>Notes</span>
        <textarea
          rows={3}
          data-testid="notes"
          value={bench.notes}
          placeholder="Observations at the machine, reasons for leaving readings out, ..."
          onInput={(event) => store.note(event.currentTarget.value)}
        />
      </label>
      <div class="row">
        <button type="button" data-testid="save-session" onClick={() => void keep(store, "file")}>
          Save session (session.json)
        </button>
        <button type="button" data-testid="save-session-page" onClick={() => void keep(store, "report")}>
          Session report (session.html)
        </button>
        <PickFiles name="open-session" title="Open a session" accept=".json" take={(files) => void take(files)} />
      </div>
      <p class="hint">
        A session file holds the steps, the formulas, the notes, the readings left out, and SHA-256 digests of the data files. It opens only
        with the same data files: here (drop it on this box), on the command line, and in Python.
      </p>
    </DropArea>
  );
}
