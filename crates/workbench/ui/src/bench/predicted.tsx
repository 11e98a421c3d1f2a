/** Predicted against measured, per coordinate. */
import { useState } from "preact/hooks";
import { Chart } from "../charts/chart";
import type { Looks } from "../charts/looks";
import { drawing, type Panel, reachOf } from "../charts/panels";
import { band, line, points } from "../charts/series";
import { digits } from "../format";
import * as History from "../history";
import type { Opened, Six } from "../wire";
import { Options } from "./options";
import { where } from "./residuals";
import type { BenchProps } from "./screen";

type Quantity = "values" | "differences";

const COORDINATES = ["a", "b", "c", "alpha", "beta", "gamma"];
const SPRINGS = "springs alone";
const NOW = "the model now";

export function PredictedSheet({ bench }: BenchProps) {
  const [quantity, setQuantity] = useState<Quantity>("differences");
  const { opened, history } = bench;
  const springs = History.springs(history).view.predicted;
  const now = History.now(history).view.predicted;
  const draw = (width: number, looks: Looks) => {
    const panels = COORDINATES.map((_, k) =>
      quantity === "values" ? values(k, opened, springs, now, looks) : differences(k, opened, springs, now, looks),
    );
    const tooltip = (series: string, panel: number, x: number, y: number, index: number) =>
      `${series}\nmeasured ${digits(x, 4)} ${unit(panel)}, ${quantity === "values" ? "predicted" : "measured minus predicted"} ${digits(y)} ${unit(panel)}\n${where(opened, index)}`;
    return drawing(
      { panels, x: "measured (um, urad)", across: 3, legend: [SPRINGS, NOW], tooltip, square: quantity === "values" },
      width,
      looks,
    );
  };
  return (
    <>
      <div class="row">
        <Options
          label="show"
          name="predicted"
          value={quantity}
          options={[
            { id: "differences", title: "measured minus predicted" },
            { id: "values", title: "predicted over measured" },
          ]}
          set={setQuantity}
        />
      </div>
      <Chart
        name="predicted"
        of={[springs, now]}
        shape={quantity}
        label={`${quantity === "values" ? "Predicted" : "Measured minus predicted"} over measured, six coordinates`}
        draw={draw}
      />
      <p class="hint">
        {opened.absolute ? "What is measured beside what is commanded." : "Deflections: loaded minus reference."}{" "}
        {quantity === "values" ? "On the line, the model is right." : "The band is the noise of one reading."}
      </p>
    </>
  );
}

function values(k: number, { conditions }: Opened, springs: Six[], now: Six[], looks: Looks): Panel {
  const pairs = (predicted: Six[]) => predicted.map((six, i) => [conditions.measured[i]?.[k] ?? 0, six[k] ?? 0]);
  const reach = reachOf(conditions.measured.map((six) => six[k] ?? 0));
  return {
    title: `${COORDINATES[k]} (${unit(k)})`,
    reach,
    series: [
      line(
        "measured",
        [
          [-reach, -reach],
          [reach, reach],
        ],
        looks.grey,
        "dashed",
      ),
      points(SPRINGS, pairs(springs), { colour: looks.before, symbol: "rect", size: 5, opacity: 0.45 }),
      points(NOW, pairs(now), { colour: looks.now, size: 5 }),
    ],
  };
}

function differences(k: number, { conditions, noise }: Opened, springs: Six[], now: Six[], looks: Looks): Panel {
  const pairs = (predicted: Six[]) =>
    predicted.map((six, i) => [conditions.measured[i]?.[k] ?? 0, (conditions.measured[i]?.[k] ?? 0) - (six[k] ?? 0)]);
  const before = pairs(springs);
  const after = pairs(now);
  const sigma = k < 3 ? noise.translation_um : noise.rotation_urad;
  return {
    title: `${COORDINATES[k]} (${unit(k)})`,
    reach: reachOf([...before, ...after].map(([, y]) => y ?? 0)),
    series: [
      { ...points(SPRINGS, before, { colour: looks.before, symbol: "rect", size: 4, opacity: 0.45 }), ...band(sigma, looks.band) },
      points(NOW, after, { colour: looks.now }),
    ],
  };
}

function unit(k: number): string {
  return k < 3 ? "um" : "urad";
}
