// Rules of accessibility (axe-core), asked of a page as it stands.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const PACKAGES = process.env.HEXBENCH_NODE_PACKAGES ?? join(import.meta.dirname, "..");
const AXE = readFileSync(createRequire(join(PACKAGES, "package.json")).resolve("axe-core/axe.min.js"), "utf8");

/** Rules that the page breaks, each with its first places. */
export async function violations(page) {
  await page.evaluate(AXE);
  return page.evaluate(async () => {
    const { violations } = await globalThis.axe.run(document, { resultTypes: ["violations"] });
    return violations.map(
      ({ id, nodes }) =>
        `${id}: ${nodes
          .slice(0, 3)
          .map(({ html }) => html.slice(0, 160))
          .join(" | ")}`,
    );
  });
}
