/** Predicted against measured, per coordinate. */
import { useState } from "preact/hooks";
import { Chart } from "../charts/chart";
import type { Looks } from "../charts/looks";
import { legendOf, type Marks, marked, marksOf } from "../charts/marks";
import { drawing, type Panel, reachOf } from "../charts/panels";
import { hasHeldOut, type Readings, readings, WHICH, type Which } from "../charts/readings";
import { band, line, points } from "../charts/series";
import { digits, unitName } from "../format";
import * as History from "../history";
import { picking } from "../picks";
import type { NoiseLevels } from "../wire";
import { Options } from "./options";
import { Picked } from "./picked";
import { where } from "./residuals";
import type { BenchProps } from "./screen";

type Quantity = "values" | "differences";

const COORDINATES = ["a", "b", "c", "alpha", "beta", "gamma"];
const SPRINGS = "springs alone";
const NOW = "current model";

export function PredictedSheet({ store, bench }: BenchProps) {
  const [quantity, setQuantity] = useState<Quantity>("differences");
  const [which, setWhich] = useState<Which>(bench.picked?.which ?? (hasHeldOut(bench.opened) ? "held-out" : "fitted"));
  const { opened, history } = bench;
  const springs = readings(which, opened, History.springs(history).view);
  const now = readings(which, opened, History.now(history).view);
  const marks = marksOf(bench, which);
  const draw = (width: number, looks: Looks) => {
    const panels = COORDINATES.map((_, k) =>
      quantity === "values" ? values(k, springs, now, marks, looks) : differences(k, opened.noise, springs, now, marks, looks),
    );
    const tooltip = (series: string, panel: number, x: number, y: number, index: number) =>
      `${series}\nmeasured ${digits(x, 4)} ${unit(panel)}, ${quantity === "values" ? "predicted" : "measured minus predicted"} ${digits(y)} ${unit(panel)}\n${where(now.conditions, index)}`;
    return drawing(
      {
        panels,
        x: unitName("measured (um, urad)"),
        across: 3,
        legend: legendOf([SPRINGS, NOW], marks),
        tooltip,
        square: quantity === "values",
      },
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
            { id: "values", title: "predicted against measured" },
          ]}
          set={setQuantity}
        />
        {hasHeldOut(opened) && <Options label="of" name="predicted-of" value={which} options={WHICH} set={setWhich} />}
      </div>
      <Chart
        name="predicted"
        of={[springs.predicted, now.predicted, bench.wanted.exclude, bench.picked]}
        shape={`${quantity} ${which} ${marks.shape}`}
        label={`${quantity === "values" ? "Predicted" : "Measured minus predicted"} against measured, six coordinates, ${WHICH.find(({ id }) => id === which)?.title}`}
        draw={draw}
        pick={picking(store, which, now.conditions.pose.length)}
      />
      <Picked store={store} bench={bench} />
      <p class="hint">
        {opened.absolute ? "What is measured beside what is commanded." : "Deflections: loaded minus reference."}{" "}
        {quantity === "values" ? "On the line, prediction equals measurement." : "The band shows the noise of one reading."}
      </p>
    </>
  );
}

/** Measured, predicted of one coordinate. */
function pairs({ measured, predicted }: Readings, k: number): number[][] {
  return predicted.map((six, i) => [measured[i]?.[k] ?? 0, six[k] ?? 0]);
}

function values(k: number, springs: Readings, now: Readings, marks: Marks, looks: Looks): Panel {
  const reach = reachOf(now.measured.map((six) => six[k] ?? 0));
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
      points(SPRINGS, pairs(springs, k), { colour: looks.before, symbol: "rect", size: 5, opacity: 0.6 }),
      ...marked(NOW, pairs(now, k), { colour: looks.now, size: 5 }, marks, looks),
    ],
  };
}

function differences(k: number, noise: NoiseLevels, springs: Readings, now: Readings, marks: Marks, looks: Looks): Panel {
  const missed = (of: Readings) => pairs(of, k).map(([x = 0, y = 0]) => [x, x - y]);
  const before = missed(springs);
  const after = missed(now);
  const sigma = k < 3 ? noise.translation_um : noise.rotation_urad;
  return {
    title: `${COORDINATES[k]} (${unit(k)})`,
    reach: reachOf([...before, ...after].map(([, y]) => y ?? 0)),
    series: [
      { ...points(SPRINGS, before, { colour: looks.before, symbol: "rect", size: 4, opacity: 0.6 }), ...band(sigma, looks.band) },
      ...marked(NOW, after, { colour: looks.now }, marks, looks),
    ],
  };
}

function unit(k: number): string {
  return unitName(k < 3 ? "um" : "urad");
}
