/** The readings of a plan: picked by their number, taken more or less often. */
import { setting } from "../format";
import { Scroll } from "../scroll";
import type { Bench } from "../state";
import type { Store } from "../store";
import type { Six } from "../wire";
import { choose, loadOf, MOST_READINGS, type Plan, pickReading, repeatsOf, totalOf, withOneMore } from "./choice";

interface Props {
  store: Store;
  bench: Bench;
  plan: Plan;
  /** The reading pointed at, here or in the machine. */
  pointed: number | null;
  point: (reading: number | null) => void;
}

const [TIMES, POSE, LOAD, WHAT] = ["times", "pose (mm, deg)", "change of load (N, N m)", "what it is"];

export function PlanRows({ store, bench, plan, pointed, point }: Props) {
  const repeats = repeatsOf(plan);
  const isFull = totalOf(repeats) >= MOST_READINGS;
  return (
    <Scroll label="Readings of the plan" stacks>
      <table class="readings" data-testid="plan-rows">
        <thead>
          <tr>
            <th scope="col">reading</th>
            {[TIMES, POSE, LOAD].map((title) => (
              <th key={title} scope="col">
                {title}
              </th>
            ))}
            <th scope="col" class="words">
              {WHAT}
            </th>
          </tr>
        </thead>
        <tbody>
          {plan.answer.next.map((reading, k) => {
            const times = repeats[k] ?? 0;
            const marks = [times === 0 && "out", (k === plan.picked || k === pointed) && "chosen"].filter(Boolean).join(" ");
            return (
              <tr key={k} class={marks} onPointerEnter={() => point(k)} onPointerLeave={() => point(null)}>
                <td>
                  <button
                    type="button"
                    class="quiet"
                    data-testid={`plan-${k + 1}`}
                    aria-pressed={k === plan.picked}
                    aria-label={`Reading ${k + 1}: show it in the machine`}
                    onClick={() => pickReading(store, bench, k)}
                    onFocus={() => point(k)}
                    onBlur={() => point(null)}
                  >
                    {k + 1}
                  </button>
                </td>
                <td class="steps" data-title={TIMES}>
                  <button
                    type="button"
                    class="quiet"
                    data-testid={`less-${k + 1}`}
                    aria-label={`Reading ${k + 1} once less`}
                    disabled={times === 0}
                    onClick={() => void choose(store, withOneMore(plan, k, -1))}
                  >
                    {"\u2212"}
                  </button>
                  <span data-testid={`times-${k + 1}`}>{times}</span>
                  <button
                    type="button"
                    class="quiet"
                    data-testid={`more-${k + 1}`}
                    aria-label={`Reading ${k + 1} once more`}
                    disabled={isFull}
                    onClick={() => void choose(store, withOneMore(plan, k, 1))}
                  >
                    +
                  </button>
                </td>
                <td data-title={POSE}>{six(reading.pose)}</td>
                <td data-title={LOAD}>{six(loadOf(reading))}</td>
                <td class="words" data-title={WHAT}>
                  {reading.text}
                </td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </Scroll>
  );
}

function six(values: Six): string {
  return values.map((value) => setting(value)).join(", ");
}
