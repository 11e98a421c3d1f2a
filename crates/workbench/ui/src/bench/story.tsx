/** The panels that carry the story: what the model leaves, over what it follows most significantly. */
import { useEffect } from "preact/hooks";
import { follow } from "../asks";
import { Chart } from "../charts/chart";
import type { Looks } from "../charts/looks";
import { marked, marksOf } from "../charts/marks";
import { drawing, type Panel, type Sheet } from "../charts/panels";
import { line, means, points } from "../charts/series";
import { chance, digits, unitName } from "../format";
import * as History from "../history";
import { picking } from "../picks";
import type { Followed, FollowedPanel, Six, View } from "../wire";
import { where } from "./residuals";
import type { BenchProps } from "./screen";

const LEAVES = "current model";
const SPRINGS = "springs alone";
const COURSE = "tested trend";
const MEAN = "bin mean";
const LEGS = [0, 1, 2, 3, 4, 5];

export function Story({ store, bench }: BenchProps) {
  const { opened, history, followed } = bench;
  const step = History.now(history);
  useEffect(() => {
    void follow(store);
  }, [store, step, opened.id]);
  const stale = followed?.step !== step;
  return (
    <section data-testid="story" data-panels={followed?.answer.panels.length ?? 0} data-stale={stale} aria-busy={stale}>
      <h3>What the residuals follow</h3>
      <Ranked store={store} bench={bench} answer={followed?.answer ?? null} />
    </section>
  );
}

function Ranked({ store, bench, answer }: Pick<BenchProps, "store" | "bench"> & { answer: Followed | null }) {
  if (answer === null) return <p class="hint">Testing what the residuals follow ...</p>;
  if (!answer.seen) return <p class="hint">These readings do not determine the elongations of single legs, so nothing is ranked.</p>;
  if (answer.panels.length === 0) return <p>{untrended(History.now(bench.history).view)}</p>;
  return (
    <>
      <ol class="follows">
        {answer.panels.map((panel) => (
          <li key={said(panel)}>{said(panel)}</li>
        ))}
      </ol>
      <Panels store={store} bench={bench} panels={answer.panels} />
      <p class="hint">Error bars: twice the standard uncertainty of the mean. Chances are corrected for the number of tests.</p>
    </>
  );
}

/** Without a trend: nothing is left, or it follows nothing that is tested here. */
function untrended({ at_the_noise }: View): string {
  if (at_the_noise) return "Nothing significant: chance alone explains even the strongest of the tested trends.";
  return "No single trend is significant, and yet the error is above the noise: what is left follows nothing tested here. The diagnosis compares whole effects, which see more than a trend.";
}

function Panels({ store, bench, panels }: Pick<BenchProps, "store" | "bench"> & { panels: FollowedPanel[] }) {
  const { history, opened } = bench;
  const springs = History.springs(history).view.residual_um;
  const left = History.now(history).view.residual_um;
  const marks = marksOf(bench, "fitted");
  const isSprings = springs === left;
  const draw = (width: number, looks: Looks) => {
    const sheet: Sheet = {
      x: "",
      across: 3,
      panels: panels.map((panel) => drawn(panel, springs, left, marks, looks, isSprings)),
      legend: isSprings ? [LEAVES, MEAN, COURSE] : [SPRINGS, LEAVES, MEAN, COURSE],
      tooltip: (series, index, x, y, at) => {
        const panel = panels[index];
        const condition = at % opened.conditions.pose.length;
        return `${series}: ${digits(y)} ${unitOf(panel)}\n${panel?.title} ${digits(x, 4)} ${panel?.unit}\n${where(opened.conditions, condition)}`;
      },
    };
    return drawing(sheet, width, looks);
  };
  return (
    <Chart
      name="story"
      of={[panels, springs, left, bench.wanted.exclude, bench.picked]}
      shape={`story ${panels.map(said).join()} ${isSprings} ${marks.shape}`}
      label={panels.map(said).join(" ")}
      draw={draw}
      pick={picking(store, "fitted", opened.conditions.pose.length)}
    />
  );
}

/** Residuals of the legs of a panel, one row for each leg; left out ones have no place. */
function cloud({ places }: FollowedPanel, residual: Six[]): number[][] {
  return LEGS.flatMap((leg) =>
    residual.map((six, i) => {
      const place = places[i]?.[leg];
      return place ? [place[0] ?? 0, (six[leg] ?? 0) / (place[1] ?? 1)] : [Number.NaN, Number.NaN];
    }),
  );
}

function drawn(
  panel: FollowedPanel,
  springs: Six[],
  left: Six[],
  marks: ReturnType<typeof marksOf>,
  looks: Looks,
  isSprings: boolean,
): Panel {
  const before = points(SPRINGS, cloud(panel, springs), { colour: looks.before, symbol: "rect", size: 4, opacity: 0.5 });
  const out = LEGS.flatMap(() => marks.out);
  // A condition is a point of the leg that the panel is about, or of each leg.
  const { leg } = panel.association;
  const legs = leg === null ? LEGS : [leg - 1];
  const picked = legs.flatMap((one) => marks.picked.map((index) => one * left.length + index));
  const look = { colour: looks.now, size: 5 };
  return {
    title: `${what(panel)} (${unitOf(panel)})`,
    x: panel.unit === "" ? panel.title : `${panel.title} (${panel.unit})`,
    series: [
      ...(isSprings ? [] : [before]),
      ...marked(LEAVES, cloud(panel, left), look, { ...marks, out, picked }, looks),
      line(COURSE, panel.course, looks.ink, "dashed"),
      ...means(MEAN, panel.bins, looks.ink),
    ],
  };
}

function unitOf(panel: FollowedPanel | undefined): string {
  return panel?.association.of === "compliance" ? "nm/N" : unitName("um");
}

/** `compliance of leg 3`. */
function what({ association: { leg, of } }: FollowedPanel): string {
  return `${of === "compliance" ? "compliance" : "elongation"} of ${leg === null ? "all legs" : `leg ${leg}`}`;
}

function said(panel: FollowedPanel): string {
  const { rank_correlation: rank, f, p } = panel.association;
  const course = Math.abs(rank) < 0.1 ? ", up and down again" : "";
  // Rounded before a zero loses its sign.
  const told = (Math.round(100 * rank) / 100 + 0).toFixed(2);
  return `The ${what(panel)} follows ${panel.title} (rank correlation ${told}${course}, F ${digits(f)}, chance ${chance(p)}).`;
}
