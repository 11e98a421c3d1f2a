/** The story in one picture: of what the diagnosis found, or of the step shown. */
import { useEffect, useState } from "preact/hooks";
import { picture as pictureOfStep } from "../asks";
import * as History from "../history";
import { Picture } from "../page/picture";
import type { Bench } from "../state";
import type { Store } from "../store";
import type { StoryChart } from "../wire";
import { Options } from "./options";

type Of = "diagnosis" | "step";

interface Props {
  store: Store;
  bench: Bench;
}

/** Of the diagnosis; where the step shown is another model, of that as well. */
export function Pictures({ store, bench, found }: Props & { found: StoryChart }) {
  const [wanted, want] = useState<Of>("diagnosis");
  const { terms } = History.now(bench.history).selection;
  const same = History.sameTerms(terms, bench.diagnosed?.answer.diagnosis.add ?? []);
  const of = same ? "diagnosis" : wanted;
  return (
    <section data-testid="story-picture" data-of={of}>
      <div class="row spread">
        <h3>{of === "diagnosis" ? found.title : "The current step in one picture"}</h3>
        {!same && (
          <Options
            label="of"
            name="picture"
            value={of}
            options={[
              { id: "diagnosis", title: "what the diagnosis found" },
              { id: "step", title: "the current step" },
            ]}
            set={want}
          />
        )}
      </div>
      {of === "diagnosis" ? <Picture picture={found} /> : <StepPicture store={store} bench={bench} />}
    </section>
  );
}

/** Of the step shown, once it is drawn. */
export function StepPicture({ store, bench }: Props) {
  const { pictured, opened, history } = bench;
  const step = History.now(history);
  useEffect(() => {
    void pictureOfStep(store);
  }, [store, step, opened.id]);
  const stale = pictured?.step !== step;
  const picture = pictured?.answer.picture;
  return (
    <div data-testid="pictured" data-stale={stale} aria-busy={stale}>
      {picture && <Picture picture={picture} />}
      {pictured === null && <p class="hint">Drawing the step ...</p>}
      {picture === null && <p class="hint">These readings do not determine the motion of the platform, so there is nothing to draw.</p>}
    </div>
  );
}
