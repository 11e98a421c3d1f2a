/** A number that counts once it is complete and within its range; until then it stays as it is typed, whatever is drawn anew. */
import { useState } from "preact/hooks";

interface Props {
  label: string;
  name: string;
  range: [number, number];
  /** Empty: null. */
  value: number | null;
  take: (value: number) => void;
}

export function NumberField({ label, name, range: [least, most], value, take }: Props) {
  const [typed, setTyped] = useState<string | null>(null);
  return (
    <label class="row">
      <span>{label}</span>
      <input
        type="number"
        min={least}
        max={most}
        step="any"
        value={typed ?? value ?? ""}
        data-testid={name}
        onInput={({ currentTarget }) => setTyped(currentTarget.value)}
        onBlur={() => setTyped(null)}
        onChange={({ currentTarget: { valueAsNumber: number } }) => {
          if (!(number >= least && number <= most)) return;
          setTyped(null);
          take(number);
        }}
      />
    </label>
  );
}
