/** How long the readings of a plan take. */
import { NumberField } from "../number_field";
import type { Store } from "../store";
import type { MeasuringPace } from "../wire";
import { choose, type Plan } from "./choice";

const PARTS: { of: keyof MeasuringPace; label: string }[] = [
  { of: "reading_s", label: "reading, s" },
  { of: "load_change_s", label: "change of load, s" },
  { of: "pose_change_s", label: "change of pose, s" },
];

export function Time({ store, plan, pace }: { store: Store; plan: Plan; pace: MeasuringPace }) {
  const { poses, seconds } = plan.answer;
  return (
    <>
      <p aria-live="polite">
        These readings take about <strong data-testid="plan-takes">{duration(seconds)}</strong>, at{" "}
        {poses === 1 ? "1 pose" : `${poses} poses`}.
      </p>
      <fieldset class="row plain">
        <legend>Time per</legend>
        {PARTS.map(({ of, label }) => (
          <NumberField
            key={of}
            label={label}
            name={`pace-${of}`}
            range={[0, 36000]}
            value={pace[of]}
            take={(value) => {
              store.setBench({ pace: { ...pace, [of]: value } });
              void choose(store, plan.wanted);
            }}
          />
        ))}
      </fieldset>
    </>
  );
}

/** `50 min`, `2 h 05 min`. */
export function duration(seconds: number): string {
  const minutes = Math.ceil(seconds / 60);
  const [hours, rest] = [Math.floor(minutes / 60), minutes % 60];
  return hours === 0 ? `${minutes} min` : `${hours} h ${String(rest).padStart(2, "0")} min`;
}
