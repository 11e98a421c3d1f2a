/** The training game. */
import { useState } from "preact/hooks";
import { Scores } from "../game/scores";
import type { Score } from "../state";
import type { Store } from "../store";
import type { GameLevel } from "../wire";
import { Seed, seedOf } from "./seed";

const LEVELS: { level: GameLevel; title: string; text: string }[] = [
  { level: "easy", title: "Easy", text: "One effect from the catalogue, easy to detect." },
  { level: "hard", title: "Hard", text: "One or two effects." },
  { level: "honest", title: "Honest", text: "Anything: no effect, one, two, or something outside the catalogue." },
];

export function Game({ store, scores }: { store: Store; scores: Score[] }) {
  const [level, setLevel] = useState<GameLevel>("easy");
  const [seed, setSeed] = useState("");
  const submit = (event: Event) => {
    event.preventDefault();
    void store.open({ from: "game", level, seed: seedOf(seed) });
  };
  return (
    <form class="card" onSubmit={submit}>
      <h2>Guess the hidden effect</h2>
      <p>The program simulates a machine and hides what is in it. Identify the hidden effects, then open the envelope.</p>
      <fieldset class="checks">
        <legend class="unseen">Level</legend>
        {LEVELS.map((one) => (
          <label key={one.level}>
            <input
              type="radio"
              name="level"
              checked={level === one.level}
              data-testid={`level-${one.level}`}
              onChange={() => setLevel(one.level)}
            />
            <span>
              <strong>{one.title}.</strong> {one.text}
            </span>
          </label>
        ))}
      </fieldset>
      <Seed name="game" value={seed} set={setSeed} />
      <button type="submit" class="main" data-testid="game-start">
        Start
      </button>
      <Scores scores={scores} />
    </form>
  );
}
