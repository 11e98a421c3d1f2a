/** The whole page. */
import { useEffect, useRef } from "preact/hooks";
import { BenchScreen } from "./bench/screen";
import { BusyLine } from "./busy";
import { StartScreen } from "./start/screen";
import type { Store } from "./store";
import { ThemeSwitch } from "./theme_switch";
import { Trouble } from "./trouble";
import { useStore } from "./use_store";

export function App({ store }: { store: Store }) {
  const state = useStore(store);
  const { bench, catalogue, problem } = state;
  const title = bench?.opened.title;
  const heading = useRef<HTMLHeadingElement>(null);
  useEffect(() => {
    document.title = title === undefined ? "hexbench workbench" : `${title} - hexbench workbench`;
    // What had the focus is gone: begin at the top of what is new.
    if (document.activeElement === document.body) heading.current?.focus();
  }, [title]);
  return (
    <>
      <header class="top">
        <h1 ref={heading} tabIndex={-1}>
          {title ?? "hexbench workbench"}
        </h1>
        <nav class="row" aria-label="Page">
          {bench && (
            <button type="button" data-testid="close" onClick={() => store.close()}>
              Open other data
            </button>
          )}
          <ThemeSwitch />
        </nav>
      </header>
      {problem?.place === "page" && <Trouble problem={problem} {...(state.locked ? {} : { dismiss: store.dismiss })} />}
      <main>
        {catalogue && bench && (
          <BenchScreen key={`${bench.opened.title} ${bench.opened.seed}`} store={store} state={state} catalogue={catalogue} bench={bench} />
        )}
        {catalogue && !bench && <StartScreen store={store} catalogue={catalogue} state={state} />}
      </main>
      <BusyLine store={store} state={state} />
      <footer>
        hexbench {catalogue?.version} · <a href="/licences.txt">licenses of the software in this page</a>
      </footer>
    </>
  );
}
