/** The plan of the next readings: in 3D, as rows, and what it promises. */
import { useEffect, useState } from "preact/hooks";
import { looks } from "../charts/looks";
import { readingsOf } from "../history";
import { Canvas } from "../machine/canvas";
import { NumberField } from "../number_field";
import type { Bench } from "../state";
import type { Store } from "../store";
import { useDark } from "../theme";
import {
  AS_PROPOSED,
  choose,
  chooseWithin,
  isStale,
  MOST_HOURS,
  MOST_READINGS,
  type Plan,
  pickReading,
  repeatsOf,
  totalOf,
} from "./choice";
import { Odds } from "./odds";
import { PlanRows } from "./rows";
import { painted } from "./space";
import { Time } from "./time";
import { Visible } from "./visible";

const LABEL =
  "The readings of the plan in 3D: platforms, loads as arrows, and points already measured. Arrow keys rotate it; plus and minus zoom; the buttons in the table select a reading.";

export function PlanSection({ store, bench }: { store: Store; bench: Bench }) {
  const { plan, diagnosed } = bench;
  useEffect(() => {
    if (bench.plan === null) void choose(store, AS_PROPOSED);
  }, [store, diagnosed]);
  if (plan === null) return <p class="hint">Computing what the readings promise ...</p>;
  return <Planning store={store} bench={bench} plan={plan} />;
}

function Planning({ store, bench, plan }: { store: Store; bench: Bench; plan: Plan }) {
  const [pointed, point] = useState<number | null>(null);
  const dark = useDark();
  const all = totalOf(repeatsOf(plan));
  return (
    <div data-testid="plan">
      <Canvas
        name="plan"
        label={LABEL}
        paint={() => painted(bench.opened, plan, pointed, looks(dark))}
        of={[plan, pointed, dark]}
        acts={{ pick: (reading: number) => pickReading(store, bench, reading), hover: point }}
      />
      <ul class="key">
        <li>
          <span class="swatch predicted" /> platform of a reading
        </li>
        <li>arrow: change of the load, to scale; two heads: moment</li>
        <li>gray points: measured already</li>
      </ul>
      <div class="row">
        <NumberField
          label="Number of readings"
          name="plan-number"
          range={[1, MOST_READINGS]}
          value={plan.wanted.repeats.length > 0 ? all : (plan.wanted.number ?? all)}
          take={(number) => void choose(store, { number: Math.round(number), repeats: [] })}
        />
        <NumberField
          label="or as many as fit in so many hours"
          name="plan-hours"
          range={[0.01, MOST_HOURS]}
          value={null}
          take={(hours) => void chooseWithin(store, hours)}
        />
        <button type="button" class="quiet" data-testid="plan-reset" onClick={() => void choose(store, AS_PROPOSED)}>
          As the diagnosis proposes
        </button>
      </div>
      <Time store={store} plan={plan} pace={bench.pace} />
      <PlanRows store={store} bench={bench} plan={plan} pointed={pointed} point={point} />
      <h4>Predicted odds after {readingsOf(all)}</h4>
      <Odds separation={plan.answer.separation} stale={isStale(plan)} />
      <h4>Smallest effects that show after {readingsOf(all)}</h4>
      <Visible sizes={plan.answer.visible} stale={isStale(plan)} />
    </div>
  );
}
