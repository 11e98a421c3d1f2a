/** Fields of a simple term file. */
import { unitName } from "../format";
import type { OwnTerm, Parameter } from "./term_file";

interface Props {
  term: OwnTerm;
  units: string[];
  set: (term: OwnTerm) => void;
}

export function Form({ term, units, set }: Props) {
  const parameters = term.parameters;
  const change = (index: number, part: Partial<Parameter>) =>
    set({ ...term, parameters: parameters.map((parameter, i) => (i === index ? { ...parameter, ...part } : parameter)) });
  return (
    <div class="fields">
      <Field label="ID (lowercase letters and hyphens)" name="own-id" value={term.id} set={(id) => set({ ...term, id })} />
      <Field label="Title" name="own-title" value={term.title} set={(title) => set({ ...term, title })} />
      <Field
        wide
        label="Leg elongation, m"
        name="own-elongation"
        value={term.elongation}
        set={(elongation) => set({ ...term, elongation })}
      />
      {parameters.map((parameter, index) => (
        <fieldset key={index} class="parameter">
          <legend>Parameter {index + 1}</legend>
          <Field label="Name" name={`own-name-${index}`} value={parameter.name} set={(name) => change(index, { name })} />
          <label>
            <span>Unit</span>
            <select
              value={parameter.unit}
              data-testid={`own-unit-${index}`}
              onChange={(event) => change(index, { unit: event.currentTarget.value })}
            >
              {[...new Set([parameter.unit, ...units])].map((unit) => (
                <option key={unit} value={unit}>
                  {unit === "1" ? "1 (plain number)" : unitName(unit)}
                </option>
              ))}
            </select>
          </label>
          <Field label="Typical size" name={`own-scale-${index}`} value={parameter.scale} set={(scale) => change(index, { scale })} />
          <Field label="Units per SI unit" name={`own-per-si-${index}`} value={parameter.perSi} set={(perSi) => change(index, { perSi })} />
          <label class="row">
            <input type="checkbox" checked={parameter.positive} onChange={() => change(index, { positive: !parameter.positive })} /> never
            negative
          </label>
          <button type="button" class="quiet" onClick={() => set({ ...term, parameters: parameters.filter((_, i) => i !== index) })}>
            Remove
          </button>
        </fieldset>
      ))}
      <button
        type="button"
        onClick={() =>
          set({ ...term, parameters: [...parameters, { name: "", unit: units[0] ?? "1", scale: "1", perSi: "", positive: false }] })
        }
      >
        Add a parameter
      </button>
    </div>
  );
}

interface FieldProps {
  label: string;
  name: string;
  value: string;
  set: (value: string) => void;
  wide?: boolean;
}

function Field({ label, name, value, set, wide }: FieldProps) {
  return (
    <label class={wide ? "whole" : ""}>
      <span>{label}</span>
      <input
        type="text"
        data-testid={name}
        value={value}
        spellcheck={false}
        autocomplete="off"
        onInput={(event) => set(event.currentTarget.value)}
      />
    </label>
  );
}
