/** What to do after a verdict, as one click. */
import { discover, takeHome } from "../asks";
import { now, readingsOf, sameTerms } from "../history";
import { totalOf } from "../plan/choice";
import type { Bench } from "../state";
import type { Store } from "../store";
import type { Diagnosed } from "../wire";
import type { SheetName } from "./sheets";

interface Props {
  store: Store;
  bench: Bench;
  answer: Diagnosed;
  open: (sheet: SheetName) => void;
}

export function Next(props: Props) {
  return (
    <div class="row next" data-testid="answer-next">
      <b>Next:</b> <Step {...props} />
      <button type="button" class="quiet" data-testid="answer-details" onClick={() => props.open("diagnosis")}>
        Full diagnosis
      </button>
    </div>
  );
}

function Step({ store, bench, answer, open }: Props) {
  const { diagnosis, word } = answer;
  const named = diagnosis.add;
  const isTicked = sameTerms(named, now(bench.history).selection.terms);
  if (word === "outside") {
    const search = () => {
      open("diagnosis");
      if (bench.discovered === null) void discover(store);
    };
    return <Act name="law" title="Search for a law" act={search} why="that describes what no term of the catalogue explains" />;
  }
  if (word === "ambiguous") {
    const count = totalOf(diagnosis.next.map(({ repeats }) => repeats));
    const title = count > 0 ? `See ${count === 1 ? "the reading" : `the ${readingsOf(count)}`} to take` : "See what to measure";
    return <Act name="plan" title={title} act={() => open("diagnosis")} why="to decide between them" />;
  }
  if (word === "measurement") return <span>check the records at the machine, as stated above</span>;
  if (word === "undecided") return <span>take more readings, then open them together</span>;
  if (!isTicked) {
    const title = named.length === 0 ? "Untick all terms" : `Tick ${named.join(", ")}`;
    return <Act name="tick" title={title} act={() => store.tickNamed(named)} why="and see the held-out error below" />;
  }
  return (
    <Act name="model" title="Download the model" act={() => void takeHome(store, "model")} why="for predictions and corrected commands" />
  );
}

function Act({ name, title, act, why }: { name: string; title: string; act: () => void; why: string }) {
  return (
    <>
      <button type="button" class="main" data-testid={`answer-${name}`} onClick={act}>
        {title}
      </button>
      <span class="hint">{why}</span>
    </>
  );
}
