/** A machine simulated on the spot. */
import { useState } from "preact/hooks";
import type { Choice } from "../wire";
import type { StartProps } from "./screen";
import { Seed, seedOf } from "./seed";

export function Simulation({ store, catalogue }: StartProps) {
  const [machine, setMachine] = useState(catalogue.machines[0]?.id ?? "");
  const [plan, setPlan] = useState(catalogue.plans[0]?.id ?? "");
  const [effects, setEffects] = useState<string[]>([]);
  const [distance, setDistance] = useState("");
  const [seed, setSeed] = useState("");
  const submit = (event: Event) => {
    event.preventDefault();
    const open = { machine, plan, effects, distance: distance.trim() === "" ? null : Number(distance), seed: seedOf(seed) };
    void store.open({ from: "simulation", ...open });
  };
  return (
    <form class="card" onSubmit={submit}>
      <h2>Simulate a machine</h2>
      <div class="fields">
        <Select label="Machine" name="machine" value={machine} choices={catalogue.machines} set={setMachine} />
        <Select label="Plan" name="plan" value={plan} choices={catalogue.plans} set={setPlan} />
        <label>
          <span>Visibility of each effect (times the noise)</span>
          <input
            type="number"
            min="0.1"
            step="any"
            placeholder="typical size"
            value={distance}
            data-testid="simulation-distance"
            onInput={(event) => setDistance(event.currentTarget.value)}
          />
        </label>
        <Seed name="simulation" value={seed} set={setSeed} />
      </div>
      <Effects choices={catalogue.effects} chosen={effects} set={setEffects} />
      <button type="submit" class="main" data-testid="simulate">
        Simulate measurements
      </button>
    </form>
  );
}

interface SelectProps {
  label: string;
  name: string;
  value: string;
  choices: Choice[];
  set: (id: string) => void;
}

function Select({ label, name, value, choices, set }: SelectProps) {
  const text = choices.find(({ id }) => id === value)?.text;
  return (
    <label>
      <span>{label}</span>
      <select value={value} data-testid={`simulation-${name}`} onChange={(event) => set(event.currentTarget.value)}>
        {choices.map(({ id, title }) => (
          <option key={id} value={id}>
            {title}
          </option>
        ))}
      </select>
      {text && <small>{text}</small>}
    </label>
  );
}

interface EffectsProps {
  choices: Choice[];
  chosen: string[];
  set: (ids: string[]) => void;
}

function Effects({ choices, chosen, set }: EffectsProps) {
  const toggle = (id: string) => set(chosen.includes(id) ? chosen.filter((other) => other !== id) : [...chosen, id]);
  return (
    <details>
      <summary>
        Effects included: {chosen.length === 0 ? "none" : chosen.join(", ")} <span class="hint">(open to choose)</span>
      </summary>
      <fieldset class="checks">
        <legend class="unseen">Effects in the machine</legend>
        {choices.map(({ id, title, text }) => (
          <label key={id} title={text}>
            <input type="checkbox" checked={chosen.includes(id)} data-testid={`effect-${id}`} onChange={() => toggle(id)} />
            <span>
              {title} <code>{id}</code>
            </span>
          </label>
        ))}
      </fieldset>
    </details>
  );
}
