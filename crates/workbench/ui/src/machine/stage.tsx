/** The canvas of the machine, or a sentence where there is no WebGL. */
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { looks } from "../charts/looks";
import { MachineScene, type Shown } from "./scene";

/** Drawn again when `of` changes. */
export function Stage({ shown, of, dark }: { shown: Shown; of: unknown[]; dark: boolean }) {
  const box = useRef<HTMLDivElement>(null);
  const scene = useRef<MachineScene | null>(null);
  const [fault, setFault] = useState(false);
  // Made once; the effect below draws every change.
  useEffect(() => {
    if (box.current === null) return;
    try {
      scene.current = new MachineScene(box.current);
      scene.current.draw(shown, looks(dark));
    } catch {
      setFault(true);
    }
    return () => {
      scene.current?.dispose();
      scene.current = null;
    };
  }, []);
  useLayoutEffect(() => scene.current?.draw(shown, looks(dark)), [dark, ...of]);
  if (fault) {
    return (
      <p class="trouble" data-testid="no-webgl">
        This browser shows no 3D graphics (WebGL is off or missing). Everything else works; the numbers are below.
      </p>
    );
  }
  const label = "The machine in 3D: base, legs coloured by what is left in them, platform. Arrow keys turn it, plus and minus come nearer.";
  return (
    <>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: keys turn the machine. */}
      <div ref={box} class="stage" data-testid="chart-machine" role="img" aria-label={label} tabIndex={0} />
      <p class="hint">Turn it with the mouse or the arrow keys; + and - come nearer, and the wheel after a click.</p>
    </>
  );
}
