// Pages of the program and a browser to open them in.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { browserPath, launch } from "./chromium.mjs";

const ROOT = join(dirname(fileURLToPath(import.meta.url)), "../..");
const CASE = join(ROOT, "data/cases/mujoco-foundation");
/** Where `npm ci` puts what the page of the workbench needs, the driver of browsers among it. */
const PACKAGES = process.env.HEXBENCH_NODE_PACKAGES ?? join(ROOT, "crates/workbench/ui");
const PATIENCE_MS = 60_000;

/** Why nothing can be opened here; empty when it can. */
export function missing() {
  const binary = process.env.HEXBENCH_BINARY;
  if (!binary || !existsSync(binary)) return "HEXBENCH_BINARY names no program.";
  if (!browserPath()) return "no Chromium was found; HEXBENCH_CHROMIUM may name one.";
  return driver() ? "" : `playwright-core is not installed in ${PACKAGES}: npm ci there.`;
}

function driver() {
  try {
    return createRequire(join(PACKAGES, "package.json"))("playwright-core");
  } catch {
    return undefined;
  }
}

/** The three pages in a folder of their own. */
export function makePages() {
  const folder = mkdtempSync(join(tmpdir(), "hexbench-pages-"));
  const file = (name) => join(folder, name);
  const run = (...words) => execFileSync(process.env.HEXBENCH_BINARY, words, { cwd: CASE, stdio: ["ignore", "ignore", "inherit"] });
  const files = ["hexapod.toml", "measurements.csv"];
  const held = ["--holdout", "holdout.csv"];
  run("diagnose", ...files, ...held, "--html", file("diagnosis.html"), "--json", file("a.json"));
  run("compare", ...files, ...held, "--html", file("comparison.html"));
  run("diagnose", ...files, "--json", file("b.json"));
  run("runs", file("a.json"), file("b.json"), "--html", file("runs.html"));
  const page = (name) => pathToFileURL(file(`${name}.html`)).href;
  return {
    diagnosis: page("diagnosis"),
    comparison: page("comparison"),
    runs: page("runs"),
    remove: () => rmSync(folder, { recursive: true }),
  };
}

/** A browser that is kept off the network. */
export function startBrowser() {
  return launch(driver().chromium, "--disable-gpu", "--proxy-server=127.0.0.1:9");
}

/** Opens a file in a profile of its own and notes what must not happen: complaints, and any request but for the file itself. */
export async function openFile(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1200, height: 800 }, offline: true, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  const faults = [];
  page.on("pageerror", (error) => faults.push(`error: ${error.message}`));
  page.on("console", (message) => faults.push(`${message.type()}: ${message.text()}`));
  page.on("request", (request) => request.url() !== url && faults.push(`request: ${request.url()}`));
  await page.goto(url);
  return { page, faults, close: () => context.close() };
}
