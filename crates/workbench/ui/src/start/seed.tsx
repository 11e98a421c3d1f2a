/** The number that decides all that is drawn; empty: the server draws one. */

interface Props {
  name: string;
  value: string;
  set: (value: string) => void;
}

export function Seed({ name, value, set }: Props) {
  return (
    <label>
      <span>Seed</span>{" "}
      <input
        type="number"
        min="0"
        max={Number.MAX_SAFE_INTEGER}
        step="1"
        placeholder="random"
        value={value}
        data-testid={`${name}-seed`}
        onInput={(event) => set(event.currentTarget.value)}
      />
    </label>
  );
}

/** A whole number, or null for an empty field (the server draws one). */
export function seedOf(text: string): number | null {
  return text.trim() === "" ? null : Number(text);
}
