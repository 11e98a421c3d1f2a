// Pictures of every state of the workbench and of every page, wide and narrow, light, dark and printed: node tests/browser/all_states.mjs FOLDER
// HEXBENCH_BINARY names the program, HEXBENCH_STATES walks of the workbench (see states.mjs) or pages, all of them where it is empty.
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { WALKS } from "../../crates/workbench/ui/tests/states.mjs";
import * as workbench from "../../crates/workbench/ui/tests/workbench.mjs";
import { makePages, missing, openFile, startBrowser } from "./pages.mjs";
import { blind, drawSheets } from "./printed.mjs";

const SIZES = [
  { width: 1440, height: 900 },
  { width: 390, height: 844 },
];
const THEMES = ["light", "dark"];
const PAGES = ["diagnosis", "comparison", "runs", "book"];

const reason = missing() || blind();
if (reason !== "") {
  console.log(`No pictures can be taken: ${reason}`);
  process.exit(77);
}
const folder = process.argv[2];
mkdirSync(folder, { recursive: true });
const only = (process.env.HEXBENCH_STATES ?? "").split(",").filter((name) => name !== "");
const isWanted = (name) => only.length === 0 || only.includes(name);
let taken = 0;
if (WALKS.some(({ name }) => isWanted(name))) await ofWorkbench(WALKS.filter(({ name }) => isWanted(name)));
await ofPages(PAGES.filter(isWanted));
console.log(`${taken} pictures in ${folder}`);

/** A picture of all of the page as it is, in both themes; of the wide one the printed sheets as well. */
async function pictures(page, name, { width, height }) {
  for (const colorScheme of THEMES) {
    await page.emulateMedia({ colorScheme });
    // What sticks to the window stands at its place, and charts are drawn in their new colors.
    await page.evaluate(() => scrollTo(0, 0));
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 200))));
    await page.screenshot({ path: join(folder, `${name}-${width}-${colorScheme}.png`), fullPage: true });
    taken += 1;
  }
  if (width === SIZES[0].width) {
    // From the dark page: paper is light all the same.
    drawSheets(await page.pdf({ format: "A4" }), join(folder, `${name}-print`));
    taken += 1;
    await page.setViewportSize({ width, height });
  }
  await page.emulateMedia({ colorScheme: THEMES[0] });
}

async function ofWorkbench(walks) {
  const server = await workbench.startWorkbench();
  const browser = await workbench.startBrowser();
  for (const viewport of SIZES) {
    for (const { refusals, walk } of walks) {
      const opened = await workbench.openPage(browser, server.url, { refusals, viewport, colorScheme: THEMES[0] });
      await walk(opened, (state) => pictures(opened.page, state, viewport));
      await opened.close();
    }
  }
  await browser.close();
  await server.stop();
}

async function ofPages(names) {
  if (names.length === 0) return;
  const pages = makePages();
  const browser = await startBrowser();
  for (const viewport of SIZES) {
    for (const name of names) {
      const { page, close } = await openFile(browser, pages[name], { viewport });
      await pictures(page, `page-${name}`, viewport);
      await close();
    }
  }
  await browser.close();
  pages.remove();
}
