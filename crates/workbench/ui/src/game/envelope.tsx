/** Guess and reveal: what is ticked is the guess. */
import { useState } from "preact/hooks";
import { reveal } from "../asks";
import { unitName } from "../format";
import type { Bench, Score } from "../state";
import type { Store } from "../store";
import { Scores } from "./scores";

const OUTSIDE = "outside";

interface Props {
  store: Store;
  bench: Bench;
  scores: Score[];
}

export function Envelope({ store, bench, scores }: Props) {
  return (
    <section class="card envelope" aria-label="Game">
      {bench.revealed === null ? <GuessForm store={store} bench={bench} /> : <Outcome store={store} bench={bench} />}
      <Scores scores={scores} />
    </section>
  );
}

function GuessForm({ store, bench }: Omit<Props, "scores">) {
  const [outside, setOutside] = useState(false);
  const terms = bench.wanted.terms;
  const guess = outside ? [...terms, OUTSIDE] : terms;
  return (
    <>
      <h2>What is hidden?</h2>
      <p>
        Your guess is what you have ticked: <strong data-testid="guess">{inWords(guess)}</strong>.
      </p>
      <div class="row">
        <label>
          <input type="checkbox" checked={outside} data-testid="guess-outside" onChange={() => setOutside(!outside)} /> plus something
          outside the catalogue
        </label>
        <button type="button" class="main" data-testid="reveal" onClick={() => void reveal(store, guess)}>
          Open the envelope
        </button>
      </div>
    </>
  );
}

function Outcome({ store, bench }: Omit<Props, "scores">) {
  const { revealed, open } = bench;
  if (revealed === null || open.from !== "game") return null;
  const { answer, guess } = revealed;
  return (
    <div role="status" data-testid="revealed">
      <h2>{answer.right ? "Right." : "Not quite."}</h2>
      <p>
        Hidden:{" "}
        <strong>{answer.hidden.length === 0 ? "nothing" : answer.hidden.map(({ id, title }) => `${title} (${id})`).join(", ")}</strong>. You
        said: {inWords(guess)}.
      </p>
      <p class="hint">
        True leg stiffness, {unitName("N/um")}: {answer.leg_stiffness.map((k) => k.toFixed(3)).join(", ")}.
      </p>
      <button type="button" data-testid="game-again" onClick={() => void store.open({ from: "game", level: open.level, seed: null })}>
        Play again
      </button>
    </div>
  );
}

function inWords(guess: string[]): string {
  if (guess.length === 0) return "nothing is hidden";
  return guess.map((id) => (id === OUTSIDE ? "something outside the catalogue" : id)).join(", ");
}
