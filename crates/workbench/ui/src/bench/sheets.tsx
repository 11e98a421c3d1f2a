/** Sheets of the bench, one shown at a time. */
import { useRef } from "preact/hooks";
import { MachineSheet } from "../machine/sheet";
import { DiagnosisSheet } from "./diagnosis";
import { NumbersSheet } from "./numbers";
import { PredictedSheet } from "./predicted";
import { ReadingsSheet } from "./readings";
import { ResidualSheet } from "./residuals";
import { ScatterSheet } from "./scatter";
import type { BenchProps } from "./screen";

const SHEETS = [
  { name: "residuals", title: "Residuals", Sheet: ResidualSheet },
  { name: "predicted", title: "Predicted and measured", Sheet: PredictedSheet },
  { name: "readings", title: "Readings", Sheet: ReadingsSheet },
  { name: "scatter", title: "Is it noise?", Sheet: ScatterSheet },
  { name: "machine", title: "Machine", Sheet: MachineSheet },
  { name: "numbers", title: "Parameters", Sheet: NumbersSheet },
  { name: "diagnosis", title: "Diagnosis", Sheet: DiagnosisSheet },
] as const;

export type SheetName = (typeof SHEETS)[number]["name"];

export function Sheets(props: BenchProps & { shown: SheetName; show: (sheet: SheetName) => void }) {
  const { shown, show } = props;
  const list = useRef<HTMLDivElement>(null);
  const at = SHEETS.findIndex((sheet) => sheet.name === shown);
  const { name, Sheet } = SHEETS[at] ?? SHEETS[0];
  const setAt = (index: number) => show((SHEETS[index] ?? SHEETS[0]).name);
  const onKey = (event: KeyboardEvent) => {
    const next = moved(event.key, at);
    if (next === null) return;
    event.preventDefault();
    setAt(next);
    (list.current?.children[next] as HTMLElement | undefined)?.focus();
  };
  return (
    <section class="card">
      <div role="tablist" aria-label="Views" class="tabs" ref={list} onKeyDown={onKey}>
        {SHEETS.map((sheet, index) => (
          <button
            key={sheet.name}
            type="button"
            role="tab"
            id={`tab-${sheet.name}`}
            data-testid={`tab-${sheet.name}`}
            aria-selected={index === at}
            aria-controls="sheet"
            tabIndex={index === at ? 0 : -1}
            onClick={() => setAt(index)}
          >
            {sheet.title}
          </button>
        ))}
      </div>
      <div role="tabpanel" id="sheet" aria-labelledby={`tab-${name}`}>
        <Sheet {...props} />
      </div>
    </section>
  );
}

/** The sheet a key leads to. */
function moved(key: string, at: number): number | null {
  const count = SHEETS.length;
  if (key === "ArrowRight") return (at + 1) % count;
  if (key === "ArrowLeft") return (at + count - 1) % count;
  if (key === "Home") return 0;
  if (key === "End") return count - 1;
  return null;
}
