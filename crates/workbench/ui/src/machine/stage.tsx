/** The machine in 3D, and the parts of it that can be picked as buttons. */
import { looks } from "../charts/looks";
import { isPart } from "../picks";
import type { Part, Pick } from "../state";
import { painted, type Shown } from "./body";
import { Canvas } from "./canvas";
import type { Pointed } from "./pointer";

const LABEL =
  "The machine in 3D: base, platform, and legs colored by their residuals. Arrow keys rotate it; plus and minus zoom; the buttons below select a part.";
const LEGS = [0, 1, 2, 3, 4, 5];

interface Props {
  shown: Shown;
  /** Drawn again when this changes. */
  of: unknown[];
  dark: boolean;
  picked: Pick | null;
  parts: Pointed<Part>;
}

export function Stage({ shown, of, dark, picked, parts }: Props) {
  return (
    <>
      <Canvas name="machine" label={LABEL} paint={() => painted(shown, looks(dark))} of={[dark, ...of]} acts={parts}>
        <fieldset class="views" data-testid="parts">
          <legend class="unseen">Select readings by a part of the machine</legend>
          {LEGS.map((leg) => (
            <PartButton key={leg} part={{ kind: "leg", leg }} title={`Leg ${leg + 1}`} picked={picked} parts={parts} />
          ))}
          {shown.wrench !== null && <PartButton part={{ kind: "load" }} title="Load" picked={picked} parts={parts} />}
        </fieldset>
      </Canvas>
      <p class="hint screen-only">
        Click a leg, a joint or the load to select its readings, and again (or Escape) to clear the selection. Rotate with the mouse or the
        arrow keys; zoom with + and -, or with the wheel after a click.
      </p>
    </>
  );
}

interface PartProps {
  part: Part;
  title: string;
  picked: Pick | null;
  parts: Pointed<Part>;
}

function PartButton({ part, title, picked, parts }: PartProps) {
  const what = part.kind === "leg" ? `readings missed most in leg ${part.leg + 1}` : "readings under this load";
  return (
    <button
      type="button"
      class="quiet"
      data-testid={part.kind === "leg" ? `leg-${part.leg + 1}` : "load"}
      aria-pressed={isPart(picked, part)}
      aria-label={`${title}: select the ${what}`}
      onClick={() => parts.pick(part)}
      onPointerEnter={() => parts.hover(part)}
      onPointerLeave={() => parts.hover(null)}
      onFocus={() => parts.hover(part)}
      onBlur={() => parts.hover(null)}
    >
      {title}
    </button>
  );
}
