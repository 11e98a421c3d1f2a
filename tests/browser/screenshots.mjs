// Pictures of the report for the documentation: node tests/browser/screenshots.mjs FOLDER
import { mkdirSync, statSync } from "node:fs";
import { join } from "node:path";
import { makePages, missing, openFile, startBrowser } from "./pages.mjs";

const LARGEST_BYTES = 150_000;
const SIZE = { width: 1200, height: 800 };
/** Picture, page, theme, section at its top. */
const PICTURES = [
  ["report", "diagnosis", "light", "verdict"],
  ["report-dark", "diagnosis", "dark", "leg-space"],
];

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
  const path = join(folder, `${name}.png`);
  await page.screenshot({ path });
  await close();
  const bytes = statSync(path).size;
  console.log(`${path}: ${bytes} bytes`);
  if (bytes > LARGEST_BYTES) process.exitCode = 1;
}
await browser.close();
pages.remove();
