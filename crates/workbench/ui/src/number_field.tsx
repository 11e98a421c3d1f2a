/** A number that counts once it is complete and within its range. */

interface Props {
  label: string;
  name: string;
  range: [number, number];
  /** Empty: null. */
  value: number | null;
  take: (value: number) => void;
}

export function NumberField({ label, name, range: [least, most], value, take }: Props) {
  return (
    <label class="row">
      <span>{label}</span>
      <input
        type="number"
        min={least}
        max={most}
        step="any"
        value={value ?? ""}
        data-testid={name}
        onChange={({ currentTarget: { valueAsNumber: number } }) => {
          if (number >= least && number <= most) take(number);
        }}
      />
    </label>
  );
}
