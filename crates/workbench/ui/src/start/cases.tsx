/** Bundled measurements, and the files of the command line. */
import type { StartProps } from "./screen";

export function Cases({ store, catalogue }: StartProps) {
  const { given } = catalogue;
  return (
    <section class="card">
      <h2>Available measurements</h2>
      <ul class="choices">
        {given && (
          <li>
            <button type="button" class="choice" data-testid="given" onClick={() => void store.open({ from: "given" })}>
              <strong>{given.title}</strong>
              <span>{given.text || "Files given on the command line."}</span>
            </button>
          </li>
        )}
        {catalogue.cases.map(({ id, title, text }) => (
          <li key={id}>
            <button type="button" class="choice" data-testid={`case-${id}`} onClick={() => void store.open({ from: "case", id })}>
              <strong>{title}</strong>
              <span>{text}</span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
