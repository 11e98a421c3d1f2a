/** Ways to read files that seem misread: each is tried by one click. */
import { readAs } from "../read_as";
import type { Store } from "../store";

export function Ways({ store, ways, name = "read-as" }: { store: Store; ways: string[][]; name?: string }) {
  return (
    <section class="ways" data-testid={name === "read-as" ? "ways" : undefined}>
      <h3>Read the files differently</h3>
      <div class="row">
        {ways.map((way) => (
          <button key={way.join()} type="button" data-testid={`${name}-${way.join("+")}`} onClick={() => void readAs(store, way)}>
            Read as {way.join(", then ")}
          </button>
        ))}
      </div>
      <p class="hint">
        The files stay as they are. Everything is weighed again with the readings changed in this way, and every result records the change.
      </p>
    </section>
  );
}
