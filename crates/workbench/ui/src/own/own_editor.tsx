/** The editor of a formula, in the bench. */
import { useLayoutEffect, useRef } from "preact/hooks";
import type { BenchProps } from "../bench/screen";
import { putOwn } from "./acts";
import { Editor } from "./editor";

interface Props extends BenchProps {
  text: string;
  close: () => void;
}

export function OwnEditor({ store, state, catalogue, text, close }: Props) {
  const box = useRef<HTMLElement>(null);
  // Before anything can be typed elsewhere.
  useLayoutEffect(() => {
    box.current?.scrollIntoView({ block: "nearest" });
    box.current?.querySelector<HTMLElement>("input, textarea")?.focus();
  }, []);
  const problem = state.problem?.place === "formula" ? state.problem : null;
  return (
    <section class="card" ref={box} aria-label="Formula editor">
      <h2>Your own term</h2>
      <Editor
        text={text}
        help={catalogue.formula}
        problem={problem}
        put={async (file) => {
          if (await putOwn(store, file)) close();
        }}
        close={() => {
          if (problem !== null) store.dismiss();
          close();
        }}
      />
    </section>
  );
}
