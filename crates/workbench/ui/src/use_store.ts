/** The state in a component. */
import { useLayoutEffect, useState } from "preact/hooks";
import type { State } from "./state";
import type { Store } from "./store";

/** The state; the component is drawn again when it changes. */
export function useStore(store: Store): State {
  const [state, setState] = useState(store.get());
  useLayoutEffect(() => {
    setState(store.get());
    return store.subscribe(() => setState(store.get()));
  }, [store]);
  return state;
}
