/** Leg stiffnesses and the numbers of the terms. */

import { digits, unitName, withUncertainty } from "../format";
import * as History from "../history";
import { Scroll } from "../scroll";
import type { Leg, LookAlike, View } from "../wire";
import type { BenchProps } from "./screen";
import { StiffnessChart } from "./stiffness";

export function NumbersSheet({ bench }: BenchProps) {
  const springs = History.springs(bench.history).view;
  const now = History.now(bench.history).view;
  return (
    <>
      <p class="hint" data-testid="numbers-of">
        {whose(now)}
      </p>
      <h3>Leg stiffness, {unitName("N/um")}, with standard uncertainty (k = 1)</h3>
      <StiffnessChart springs={springs.legs} now={now.legs} />
      <LegTable springs={springs.legs} now={now.legs} picked={bench.picked?.part?.kind === "leg" ? bench.picked.part.leg : null} />
      {now.terms.length > 0 && <Parameters view={now} />}
    </>
  );
}

/** Whose numbers these are, and whether they can be trusted. */
function whose({ terms, at_the_noise }: View): string {
  const model = terms.length === 0 ? "the springs alone: no term is ticked yet" : `the springs with ${terms.join(", ")}`;
  const trust = at_the_noise
    ? ""
    : " This model is not at the noise: the numbers are biased by what it lacks, by more than their uncertainty.";
  return `Numbers of ${model}.${trust}`;
}

const UNKNOWN = "not determined";
const NOTE = "note";

function LegTable({ springs, now, picked }: { springs: Leg[]; now: Leg[]; picked: number | null }) {
  const nominal = now.some((leg) => leg.nominal !== null);
  return (
    <Scroll label="Leg stiffness" stacks>
      <table data-testid="legs">
        <thead>
          <tr>
            <th scope="col">leg</th>
            {nominal && <th scope="col">nominal</th>}
            <th scope="col">springs alone</th>
            <th scope="col">now</th>
            <th scope="col">change</th>
          </tr>
        </thead>
        <tbody>
          {now.map((leg, i) => (
            <tr key={i} class={i === picked ? "chosen" : undefined}>
              <th scope="row" data-name="leg ">
                {i + 1}
              </th>
              {nominal && <td data-title="nominal">{leg.nominal === null ? "" : digits(leg.nominal, 4)}</td>}
              <td data-title="springs alone">{stiffness(springs[i])}</td>
              <td data-title="now">{stiffness(leg)}</td>
              <td data-title="change">{change(springs[i], leg)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </Scroll>
  );
}

function stiffness(leg: Leg | undefined): string {
  if (leg === undefined || leg.stiffness === null) return UNKNOWN;
  return leg.std === null ? digits(leg.stiffness, 4) : plusMinus(leg.stiffness, leg.std);
}

function change(before: Leg | undefined, now: Leg): string {
  if (before === undefined || before.stiffness === null || now.stiffness === null) return "";
  const percent = 100 * (now.stiffness / before.stiffness - 1);
  return Math.abs(percent) < 0.005 ? "none" : `${percent > 0 ? "+" : ""}${digits(percent, 2)} %`;
}

function plusMinus(value: number, std: number): string {
  const text = withUncertainty(value, std);
  return `${text.value} \u00b1 ${text.std}`;
}

function Parameters({ view }: { view: View }) {
  const shown = view.parameters.filter(({ name }) => !/^leg-\d\.stiffness$/.test(name));
  const remarks = view.not_determined.length > 0 || shown.some(({ name }) => remark(name, view.look_alikes) !== "");
  return (
    <>
      <h3>Parameters of the terms</h3>
      <Scroll label="Parameters" stacks>
        <table class="parameters" data-testid="parameters">
          <thead>
            <tr>
              <th scope="col">parameter</th>
              <th scope="col">value</th>
              <th scope="col">unit</th>
              {remarks && (
                <th scope="col" class="words">
                  {NOTE}
                </th>
              )}
            </tr>
          </thead>
          <tbody>
            {shown.map(({ name, value, std, unit }) => (
              <tr key={name}>
                <th scope="row">{name}</th>
                <td>{plusMinus(value, std)}</td>
                <td>{unitName(unit)}</td>
                {remarks && (
                  <td class="words" data-title={NOTE}>
                    {remark(name, view.look_alikes)}
                  </td>
                )}
              </tr>
            ))}
            {view.not_determined.map((name) => (
              <tr key={name}>
                <th scope="row">{name}</th>
                <td colspan={2}>{UNKNOWN}</td>
                <td class="words" data-title={NOTE}>
                  these data cannot determine it
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </Scroll>
    </>
  );
}

/** Look-alikes of a number, in words. */
function remark(name: string, alikes: LookAlike[]): string {
  const others = alikes.filter(({ a, b }) => a === name || b === name);
  const names = others.map(({ a, b, correlation }) => `${a === name ? b : a} (correlation ${correlation.toFixed(2)})`);
  return names.length === 0 ? "" : `hard to separate from ${names.join(", ")}`;
}
