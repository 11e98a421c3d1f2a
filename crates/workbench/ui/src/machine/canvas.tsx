/** A canvas on which something in space is drawn, turned, pointed at and picked. */
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import type { Pointed } from "./pointer";
import { type Painted, Scene } from "./scene";
import { VIEWS, type ViewName } from "./views";

interface Props<T> {
  name: string;
  /** What it shows, for those who do not see it. */
  label: string;
  paint: () => Painted<T>;
  /** Drawn again when this changes. */
  of: unknown[];
  acts: Pointed<T>;
  /** Between the canvas and the buttons of views. */
  children?: preact.ComponentChildren;
}

export function Canvas<T>({ name, label, paint, of, acts, children }: Props<T>) {
  const box = useRef<HTMLDivElement>(null);
  const scene = useRef<Scene<T> | null>(null);
  const newest = useRef(acts);
  newest.current = acts;
  useEffect(() => {
    if (box.current === null) return;
    scene.current = new Scene<T>(box.current, { pick: (one) => newest.current.pick(one), hover: (one) => newest.current.hover(one) });
    scene.current.draw(paint());
    return () => {
      scene.current?.dispose();
      scene.current = null;
    };
  }, []);
  useLayoutEffect(() => scene.current?.draw(paint()), of);
  return (
    <>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: keys turn the machine. */}
      <div ref={box} class="stage" data-testid={`chart-${name}`} role="img" aria-label={label} tabIndex={0} />
      {children}
      <fieldset class="views">
        <legend class="unseen">View</legend>
        {(Object.keys(VIEWS) as ViewName[]).map((view) => (
          <button key={view} type="button" class="quiet" data-testid={`view-${view}`} onClick={() => scene.current?.look(view)}>
            {VIEWS[view].title}
          </button>
        ))}
      </fieldset>
    </>
  );
}
