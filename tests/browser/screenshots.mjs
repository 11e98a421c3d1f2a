// Pictures of the report and the workbench for the documentation: node tests/browser/screenshots.mjs FOLDER
import { mkdirSync, statSync } from "node:fs";
import { join } from "node:path";
import * as workbench from "../../crates/workbench/ui/tests/workbench.mjs";
import { makePages, missing, openFile, startBrowser } from "./pages.mjs";

const LARGEST_BYTES = 180_000;
const SIZE = { width: 1200, height: 800 };
/** Picture, page, theme, section at its top. */
const PICTURES = [
  ["report", "diagnosis", "light", "verdict"],
  ["report-dark", "diagnosis", "dark", "leg-space"],
];

/** Picture of the workbench, theme, sheet, where the picture begins. */
const WORKBENCH = [
  ["workbench", "light", "residuals", "held-out"],
  ["workbench-machine", "dark", "machine", "tab-machine"],
];
const CASE = "mujoco-foundation";
const TERM = "base-compliance";

const reason = missing();
if (reason !== "") {
  console.log(`No pictures can be taken: ${reason}`);
  process.exit(77);
}
const folder = process.argv[2];
mkdirSync(folder, { recursive: true });
const pages = makePages();
const browser = await startBrowser();
for (const [name, of, colorScheme, section] of PICTURES) {
  const { page, close } = await openFile(browser, pages[of], { viewport: SIZE, colorScheme });
  // The top of the page tells its title; further sections begin at the top of the picture.
  if (section !== "verdict") await page.locator(`#${section}`).evaluate((s) => s.scrollIntoView());
  await taken(page, name);
  await close();
}
await browser.close();
pages.remove();
await ofWorkbench();

/** The case loaded, two terms ticked one after the other, one of them taken back. */
async function ofWorkbench() {
  const server = await workbench.startWorkbench();
  const browser = await workbench.startBrowser();
  for (const [name, colorScheme, sheet, top] of WORKBENCH) {
    const { page, at, close } = await workbench.openPage(browser, server.url, { viewport: SIZE, colorScheme });
    await workbench.loadCase(page, CASE);
    await workbench.judged(page);
    let error = await workbench.heldOut(page);
    for (const term of ["joint-friction", TERM, "joint-friction"]) {
      await at(`term-${term}`).click();
      error = await workbench.changedFrom(page, error);
    }
    await at(`tab-${sheet}`).click();
    // What is ticked leaves nothing to be followed: the sheet of every leg shows that best.
    if (sheet === "residuals") await at("any-variable").click();
    await at(`chart-${sheet}`).locator("canvas").first().waitFor();
    await at(top).evaluate((element) => element.scrollIntoView());
    await taken(page, name);
    await close();
  }
  await browser.close();
  await server.stop();
}

async function taken(page, name) {
  const path = join(folder, `${name}.png`);
  await page.screenshot({ path });
  const bytes = statSync(path).size;
  console.log(`${path}: ${bytes} bytes`);
  if (bytes > LARGEST_BYTES) process.exitCode = 1;
}
