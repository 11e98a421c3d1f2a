/** The machine in three dimensions. */
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import type { BenchProps } from "../bench/screen";
import { looks } from "../charts/looks";
import { reachOf } from "../charts/panels";
import { digits } from "../format";
import * as History from "../history";
import { useDark } from "../theme";
import type { Opened, Six } from "../wire";
import { MachineScene, type Shown } from "./scene";

const FACTOR_EXPONENTS = { from: 0, to: 4.5, step: 0.05 };

export function MachineSheet({ bench }: BenchProps) {
  const { opened, history } = bench;
  const view = History.now(history).view;
  const worst = useMemo(() => worstOf(history.steps[0]?.view.residual_um ?? []), [opened]);
  const [index, setIndex] = useState(worst);
  const [exponent, setExponent] = useState(() => Math.log10(usualFactor(opened)));
  const factor = 10 ** exponent;
  const residual = view.residual_um[index] ?? ([0, 0, 0, 0, 0, 0] as Six);
  const shown: Shown = {
    base: opened.base_joints_mm,
    platform: opened.conditions.platform_joints_mm[index] ?? [],
    origin: opened.conditions.pose[index]?.slice(0, 3) as [number, number, number],
    force: opened.conditions.wrench[index] ?? null,
    measured: opened.conditions.measured_motion[index] ?? null,
    predicted: view.predicted_motion[index] ?? null,
    factor,
    residual,
    reach: useMemo(() => reachOf(history.steps[0]?.view.residual_um.flat() ?? []), [opened]),
  };
  return (
    <>
      <div class="row">
        <label class="slider">
          <span>
            condition {index + 1} of {opened.conditions.pose.length}
          </span>
          <input type="range" min={0} max={opened.conditions.pose.length - 1} value={index} data-testid="condition" onInput={(event) => setIndex(Number(event.currentTarget.value))} />
        </label>
        <label class="slider">
          <span>drawn {digits(factor, 2)} times too large</span>
          <input type="range" {...{ min: FACTOR_EXPONENTS.from, max: FACTOR_EXPONENTS.to, step: FACTOR_EXPONENTS.step }} value={exponent} data-testid="factor" onInput={(event) => setExponent(Number(event.currentTarget.value))} />
        </label>
        <button type="button" class="quiet" onClick={() => setIndex(worst)}>
          The condition springs miss most
        </button>
      </div>
      <Stage shown={shown} />
      <p class="hint" data-testid="machine-text">
        Pose [{six(opened.conditions.pose[index])}] mm, deg; load [{six(opened.conditions.wrench[index])}] N, N m. Left in the legs, um: {six(residual)}.
      </p>
      <ul class="key">
        <li><span class="swatch unloaded" /> unloaded</li>
        <li><span class="swatch measured" /> measured</li>
        <li><span class="swatch predicted" /> predicted</li>
        <li><span class="swatch longer" /> leg longer than predicted</li>
        <li><span class="swatch shorter" /> shorter (to {digits(shown.reach, 2)} um)</li>
      </ul>
      <p class="hint">Turn with the mouse or the arrow keys; wheel, + and - come nearer.</p>
    </>
  );
}

function Stage({ shown }: { shown: Shown }) {
  const box = useRef<HTMLDivElement>(null);
  const scene = useRef<MachineScene | null>(null);
  const [fault, setFault] = useState(false);
  const dark = useDark();
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
  useLayoutEffect(() => scene.current?.draw(shown, looks(dark)));
  if (fault) {
    return (
      <p class="trouble" data-testid="no-webgl">
        This browser shows no 3D graphics (WebGL is off or missing). Everything else works; the numbers are below.
      </p>
    );
  }
  return <div ref={box} class="stage" data-testid="chart-machine" role="img" aria-label="The machine: base, legs coloured by what is left, platform unloaded, measured and predicted" tabIndex={0} />;
}

/** The condition with the largest residual. */
function worstOf(residual: Six[]): number {
  const sizes = residual.map((six) => Math.hypot(...six));
  return Math.max(0, sizes.indexOf(Math.max(...sizes)));
}

/** Makes the largest deflection a fifth of the machine's width. */
function usualFactor({ base_joints_mm, conditions }: Opened): number {
  const width_um = 1000 * Math.max(...base_joints_mm.map(([x, y]) => Math.hypot(x, y)));
  const largest_um = Math.max(1e-3, ...conditions.measured_motion.map(([x, y, z]) => Math.hypot(x, y, z)));
  return Math.min(10 ** FACTOR_EXPONENTS.to, Math.max(1, (0.25 * width_um) / largest_um));
}

function six(values: Six | undefined): string {
  return (values ?? []).map((value) => digits(value)).join(", ");
}
