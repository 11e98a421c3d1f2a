/** What the colours of the machine mean. */
import { digits, unitName } from "../format";
import type { Quantity } from "./sheet";

const PLATFORMS: Record<Quantity, [string, string][]> = {
  deflections: [
    ["measured", "measured"],
    ["predicted", "predicted now"],
  ],
  missed: [
    ["predicted", "residual now"],
    ["springs", "residual of the springs alone"],
  ],
};

export function Key({ quantity, reach }: { quantity: Quantity; reach: number }) {
  const platforms: [string, string][] = [["unloaded", "reference state"], ...PLATFORMS[quantity]];
  const legs: [string, string][] = [
    ["longer", `leg longer than predicted (full color: ${digits(reach, 2)} ${unitName("um")})`],
    ["shorter", "leg shorter than predicted"],
  ];
  return (
    <ul class="key">
      {[...platforms, ...legs].map(([name, title]) => (
        <li key={name}>
          <span class={`swatch ${name}`} /> {title}
        </li>
      ))}
      <li>arrow: change in force; arrow with two heads: axis of the change in moment (right-hand rule)</li>
    </ul>
  );
}
