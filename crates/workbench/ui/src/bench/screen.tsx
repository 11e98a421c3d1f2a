/** A loaded bench: terms, the held-out error, and charts of what is left. */
import { useEffect, useState } from "preact/hooks";
import { Envelope } from "../game/envelope";
import { OwnEditor } from "../own/own_editor";
import type { Bench, State } from "../state";
import type { Store } from "../store";
import type { Catalogue } from "../wire";
import { About } from "./about";
import { Answer } from "./answer";
import { FileCheck } from "./file_check";
import { HeldOut } from "./held_out";
import { Ladder } from "./ladder";
import { Session } from "./session";
import { type SheetName, Sheets } from "./sheets";
import { Terms } from "./terms";

export interface BenchProps {
  store: Store;
  state: State;
  catalogue: Catalogue;
  bench: Bench;
}

export function BenchScreen(props: BenchProps) {
  const { store, state, bench } = props;
  const [edited, edit] = useState<string | null>(null);
  const [shown, show] = useState<SheetName>("residuals");
  /** Shows a view and goes there. */
  const open = (sheet: SheetName) => {
    show(sheet);
    const tab = document.getElementById(`tab-${sheet}`);
    tab?.focus({ preventScroll: true });
    tab?.scrollIntoView({ block: "start" });
  };
  useUndoKeys(store);
  useEscape(store);
  return (
    <div class="bench">
      <FileCheck store={store} bench={bench} />
      <Answer store={store} state={state} bench={bench} open={open} />
      <HeldOut store={store} bench={bench} tick={state.tick} />
      <Terms {...props} edit={edit} />
      <div class="sheets">
        {edited !== null && <OwnEditor key={edited} {...props} text={edited} close={() => edit(null)} />}
        {bench.opened.sealed && <Envelope store={store} bench={bench} scores={state.scores} />}
        <Ladder store={store} bench={bench} />
        <Sheets {...props} shown={shown} show={show} />
        <Session store={store} bench={bench} />
        <About store={store} bench={bench} />
      </div>
    </div>
  );
}

/** Ctrl+Z and Ctrl+Shift+Z (or Ctrl+Y), except while text is edited. */
function useUndoKeys(store: Store): void {
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (!(event.ctrlKey || event.metaKey) || edits(event.target)) return;
      const key = event.key.toLowerCase();
      if (key !== "z" && key !== "y") return;
      event.preventDefault();
      if (key === "y" || event.shiftKey) store.redo();
      else store.undo();
    };
    addEventListener("keydown", onKey);
    return () => removeEventListener("keydown", onKey);
  }, [store]);
}

/** Escape picks nothing any more, except while text is edited. */
function useEscape(store: Store): void {
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (event.key === "Escape" && !edits(event.target)) store.pick(null);
    };
    addEventListener("keydown", onKey);
    return () => removeEventListener("keydown", onKey);
  }, [store]);
}

function edits(target: EventTarget | null): boolean {
  if (target instanceof HTMLTextAreaElement) return true;
  return target instanceof HTMLInputElement && ["text", "number"].includes(target.type);
}
