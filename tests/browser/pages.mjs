// Pages of the program and a browser to open them in.
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { browserPath, launch } from "./chromium.mjs";

const ROOT = join(dirname(fileURLToPath(import.meta.url)), "../..");
const CASE = join(ROOT, "data/cases/mujoco-foundation");
/** Where `npm ci` puts what the page of the workbench needs, the driver of browsers among it. */
const PACKAGES = process.env.HEXBENCH_NODE_PACKAGES ?? join(ROOT, "crates/workbench/ui");
/** A machine of which several campaigns make a book, and the stiffness of its leg 3 before and after something happened to it. */
const SCENE = join(ROOT, "scenes/paper-rich");
const LEG_3 = ["2.7503", "2.55"];
const CAMPAIGNS = 6;
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

/** Fits of campaigns of one machine, whose leg 3 is softer in the second half. */
function campaigns(folder, run) {
  const scene = join(folder, "scene");
  cpSync(SCENE, scene, { recursive: true });
  const truth = join(scene, "sealed/truth.toml");
  const fitted = [];
  for (let seed = 1; seed <= CAMPAIGNS; seed++) {
    const [bench, fit] = [join(folder, `bench-${seed}`), join(folder, `fit-${seed}.json`)];
    if (seed === 1 + CAMPAIGNS / 2) writeFileSync(truth, readFileSync(truth, "utf8").replace(...LEG_3));
    run("simulate", scene, "--seed", `${seed}`, "-o", bench);
    const files = ["hexapod.toml", "measurements.csv"].map((name) => join(bench, name));
    const holdout = ["--holdout", join(bench, "holdout.csv")];
    run("fit", ...files, ...holdout, "--add", "base-compliance", "-o", join(folder, "model.toml"), "--json", fit);
    fitted.push(fit);
  }
  return fitted;
}

/** The pages in a folder of their own. */
export function makePages() {
  const folder = mkdtempSync(join(tmpdir(), "hexbench-pages-"));
  const file = (name) => join(folder, name);
  const run = (...words) => execFileSync(process.env.HEXBENCH_BINARY, words, { cwd: CASE, stdio: ["ignore", "ignore", "inherit"] });
  const files = ["hexapod.toml", "measurements.csv"];
  const held = ["--holdout", "holdout.csv"];
  run("diagnose", ...files, ...held, "--html", file("diagnosis.html"), "--json", file("a.json"));
  run("compare", ...files, ...held, "--html", file("comparison.html"));
  run("diagnose", ...files, ...held, "--exclude", "2-13", "--json", file("b.json"));
  run("runs", file("a.json"), file("b.json"), "--html", file("runs.html"));
  const dates = ["01-12", "02-09", "03-10", "04-13", "05-11", "06-08"].map((day) => `2026-${day}`).join(",");
  run("runs", ...campaigns(folder, run), "--dates", dates, "--html", file("book.html"));
  const page = (name) => pathToFileURL(file(`${name}.html`)).href;
  return {
    diagnosis: page("diagnosis"),
    comparison: page("comparison"),
    runs: page("runs"),
    book: page("book"),
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
