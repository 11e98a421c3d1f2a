/** What to work on. */
import type { State } from "../state";
import type { Store } from "../store";
import type { Catalogue } from "../wire";
import { Cases } from "./cases";
import { Files } from "./files";
import { Game } from "./game";
import { Simulation } from "./simulation";

export interface StartProps {
  store: Store;
  catalogue: Catalogue;
}

export function StartScreen({ store, catalogue, state }: StartProps & { state: State }) {
  return (
    <div class="start">
      <p class="lead">
        Compare a hexapod model with measurements, see where it fails, tick the missing effect, and watch the held-out error fall to the
        noise.
      </p>
      <div class="column">
        <Cases store={store} catalogue={catalogue} />
      </div>
      <div class="column">
        <Files store={store} catalogue={catalogue} />
        <Game store={store} scores={state.scores} />
      </div>
      <div class="column">
        <Simulation store={store} catalogue={catalogue} />
      </div>
    </div>
  );
}
