/** Choices above a chart. */
interface Props<T extends string> {
  label: string;
  name: string;
  value: T;
  options: { id: T; title: string; disabled?: boolean }[];
  set: (id: T) => void;
}

export function Options<T extends string>({ label, name, value, options, set }: Props<T>) {
  return (
    <label class="row">
      <span>{label}</span>
      <select value={value} data-testid={`choose-${name}`} onChange={(event) => set(event.currentTarget.value as T)}>
        {options.map(({ id, title, disabled }) => (
          <option key={id} value={id} disabled={disabled ?? false}>
            {title}
          </option>
        ))}
      </select>
    </label>
  );
}
