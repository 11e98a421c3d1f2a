/** The canvas of the machine. */
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import { looks } from "../charts/looks";
import { MachineScene, type Shown } from "./scene";
import { VIEWS, type ViewName } from "./views";

const LABEL = "The machine in 3D: base, platform, and legs colored by their residuals. Arrow keys rotate it; plus and minus zoom.";

/** Drawn again when `of` changes. */
export function Stage({ shown, of, dark }: { shown: Shown; of: unknown[]; dark: boolean }) {
  const box = useRef<HTMLDivElement>(null);
  const scene = useRef<MachineScene | null>(null);
  useEffect(() => {
    if (box.current === null) return;
    scene.current = new MachineScene(box.current);
    scene.current.draw(shown, looks(dark));
    return () => {
      scene.current?.dispose();
      scene.current = null;
    };
  }, []);
  useLayoutEffect(() => scene.current?.draw(shown, looks(dark)), [dark, ...of]);
  return (
    <>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: keys turn the machine. */}
      <div ref={box} class="stage" data-testid="chart-machine" role="img" aria-label={LABEL} tabIndex={0} />
      <fieldset class="views">
        <legend class="unseen">View</legend>
        {(Object.keys(VIEWS) as ViewName[]).map((name) => (
          <button key={name} type="button" class="quiet" data-testid={`view-${name}`} onClick={() => scene.current?.look(name)}>
            {VIEWS[name].title}
          </button>
        ))}
      </fieldset>
      <p class="hint screen-only">Rotate with the mouse or the arrow keys; zoom with + and -, or with the wheel after a click.</p>
    </>
  );
}
