/** What the colours of the machine mean. */
import { digits, unitName } from "../format";
import type { Quantity } from "./sheet";

const PLATFORMS: Record<Quantity, [string, string][]> = {
  deflections: [
    ["measured", "measured"],
    ["predicted", "predicted now"],
  ],
  missed: [
    ["predicted", "missed now"],
    ["springs", "missed by the springs alone"],
  ],
};

export function Key({ quantity, reach }: { quantity: Quantity; reach: number }) {
  const platforms: [string, string][] = [["unloaded", "before the load"], ...PLATFORMS[quantity]];
  const legs: [string, string][] = [
    ["longer", `leg longer than predicted (full colour: ${digits(reach, 2)} ${unitName("um")})`],
    ["shorter", "shorter"],
  ];
  return (
    <ul class="key">
      {[...platforms, ...legs].map(([name, title]) => (
        <li key={name}>
          <span class={`swatch ${name}`} /> {title}
        </li>
      ))}
      <li>arrow: change of the force; two heads: axis of the change of the moment (right hand)</li>
    </ul>
  );
}
