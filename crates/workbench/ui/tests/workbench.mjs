// A workbench and a browser for tests.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { build } from "esbuild";
import { chromium } from "playwright-core";
import { browserPath, launch } from "../../../../tests/browser/chromium.mjs";

const STARTS_WITHIN_MS = 20_000;
/** Longest wait for anything on the page: a diagnosis of a program that is not optimised, on a busy machine. */
export const PATIENCE_MS = 120_000;

/** Why the tests cannot run here; empty when they can. */
export function missing() {
  const binary = process.env.HEXBENCH_BINARY;
  if (!binary || !existsSync(binary)) return "HEXBENCH_BINARY names no program.";
  return browserPath() === undefined ? "no Chromium was found; HEXBENCH_CHROMIUM may name one." : "";
}

/** Starts `hexbench workbench` on a free port; gives its address and a way to end it. */
export async function startWorkbench(...files) {
  const child = spawn(process.env.HEXBENCH_BINARY, ["workbench", ...files], { stdio: ["ignore", "pipe", "inherit"] });
  const url = await new Promise((resolve, reject) => {
    let said = "";
    const timer = setTimeout(() => {
      child.kill("SIGKILL");
      reject(new Error(`no address within ${STARTS_WITHIN_MS} ms; said: ${said}`));
    }, STARTS_WITHIN_MS);
    child.on("exit", (code) => reject(new Error(`ended with ${code}; said: ${said}`)));
    child.stdout.on("data", (data) => {
      said += data;
      const found = /http:\/\/127\.0\.0\.1:\d+\/#token=\S+/.exec(said);
      if (!found) return;
      clearTimeout(timer);
      resolve(found[0]);
    });
  });
  const ended = new Promise((resolve) => child.on("exit", resolve));
  return {
    url,
    stop: async () => {
      child.kill("SIGINT");
      await ended;
    },
  };
}

/** The function that puts what the program says of its commands into words of the page. */
export async function wordsOfPage() {
  const entry = new URL("../src/page/here.ts", import.meta.url).pathname;
  const { outputFiles } = await build({ entryPoints: [entry], bundle: true, write: false, format: "esm" });
  const { here } = await import(`data:text/javascript,${encodeURIComponent(outputFiles[0].text)}`);
  return here;
}

/** Words of the command line that the page shows; what opens the page itself is one. */
export function typedWords(page) {
  return page.evaluate(() => document.body.innerText.match(/(?<![\w-])--[a-z][\w-]*|\bhexbench (?!workbench\b)[a-z]+\b.*/g) ?? []);
}

/** A browser without 3D graphics: the page needs none. */
export function startBrowser() {
  return launch(chromium, "--disable-gpu", "--disable-3d-apis");
}

/** A page in its own profile that notes what must not happen. `refusals`: statuses the test provokes. */
export async function openPage(browser, url, { refusals = [], ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1300, height: 900 }, acceptDownloads: true, ...options });
  if (process.env.HEXBENCH_PAGE) await context.route(/\/app\.(js|css)$/, (route) => route.fulfill(fromFolder(route.request().url())));
  return watched(await context.newPage(), url, refusals);
}

/** A file of the page from the folder HEXBENCH_PAGE, so that a page can be tried before it is built into the program. */
function fromFolder(url) {
  const name = new URL(url).pathname.split("/").at(-1);
  return { path: join(process.env.HEXBENCH_PAGE, name), contentType: name.endsWith(".js") ? "text/javascript" : "text/css" };
}

/** Opens the address and watches console, errors and requests. */
export async function watched(page, url, refusals = []) {
  const faults = [];
  const origin = new URL(url).origin;
  page.setDefaultTimeout(PATIENCE_MS);
  page.on("pageerror", (error) => faults.push(`error: ${error.message}`));
  page.on("console", (message) => {
    const provoked = refusals.some((status) => message.text().includes(`status of ${status}`) || message.text().includes(status));
    if (["error", "warning"].includes(message.type()) && !provoked) faults.push(`console: ${message.text()}`);
  });
  page.on("request", (request) => {
    const address = new URL(request.url());
    if (!["data:", "blob:"].includes(address.protocol) && address.origin !== origin) faults.push(`foreign request: ${request.url()}`);
  });
  await page.goto(url);
  return {
    page,
    at: (id) => page.getByTestId(id),
    /** Ends the page; fails when it did something it must not. */
    close: async () => {
      await page.context().close();
      assert.deepEqual(faults, []);
    },
  };
}

/** The number at the top. */
export async function heldOut(page) {
  return Number(await page.getByTestId("held-out").getAttribute("data-value"));
}

/** Waits until the panels beside the residuals belong to the step shown. */
export async function settled(page) {
  await page.locator('[data-testid="story"][data-stale="false"]').waitFor();
}

/** Waits until the diagnosis that begins by itself is there. */
export async function judged(page) {
  await page.getByTestId("held-out").waitFor();
  await page.waitForFunction(() => document.querySelector("[data-testid=answer]")?.getAttribute("aria-busy") !== "true");
}

/** Waits until the number at the top is another. */
export async function changedFrom(page, before) {
  await page.waitForFunction((old) => Number(document.querySelector("[data-testid=held-out]")?.getAttribute("data-value")) !== old, before);
  return heldOut(page);
}

/** Loads a bundled case. */
export async function loadCase(page, id) {
  await page.getByTestId(`case-${id}`).click();
  await page.getByTestId("story").waitFor();
}

/** Holds back what these requests ask, until the function returned is called. */
export async function holdBack(page, pattern) {
  let letGo = () => {};
  const held = new Promise((resolve) => {
    letGo = resolve;
  });
  await page.route(pattern, async (route) => {
    await held;
    await route.continue().catch(() => {});
  });
  return letGo;
}

/** Loads a bundled case and calls off the diagnosis that begins by itself. */
export async function loadUndiagnosed(page, id) {
  const letGo = await holdBack(page, /\/diagnosis$/);
  await loadCase(page, id);
  await settled(page);
  await page.getByTestId("busy").getByText("Comparing all explanations").waitFor();
  await page.getByTestId("cancel").click();
  await page.getByTestId("answer-diagnose").waitFor();
  letGo();
  await page.unroute(/\/diagnosis$/);
}

/** Ticks a term, in a group that may be folded. */
export async function tick(page, term) {
  const box = page.getByTestId(`term-${term}`);
  await box.evaluate((element) => {
    element.closest("details").open = true;
  });
  await box.click();
}

/** Text of the file that a click brings. */
export async function downloaded(page, id) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByTestId(id).click()]);
  return { name: download.suggestedFilename(), text: await readFile(await download.path(), "utf8") };
}

/** Presses Tab until an element has the focus. */
export async function tabTo(page, id) {
  const most = 200;
  for (let i = 0; i < most; i++) {
    await page.keyboard.press("Tab");
    if (await page.evaluate((name) => document.activeElement?.getAttribute("data-testid") === name, id)) return;
  }
  assert.fail(`${id} is not reached by ${most} presses of Tab`);
}

/** True when the page is not wider than the window. */
export function fitsWidth(page) {
  return page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth);
}

/** Tables that are wider than their place: on a telephone they stand row by row. */
export function cutTables(page) {
  return page.evaluate(() => {
    const boxes = document.querySelectorAll(".scroll");
    const seen = [...boxes].filter((box) => box.checkVisibility());
    return seen.filter((box) => box.scrollWidth > box.clientWidth).map((box) => box.textContent);
  });
}

/** A run sheet with the temperature that nobody set: that of the reference. */
function atOneTemperature(sheet) {
  const [header, ...rows] = sheet.trim().split("\n");
  const column = header.split(",").indexOf("delta_T_K");
  const filled = rows.map((row) => row.split(",").map((cell, k) => (k === column && cell === "" ? "0" : cell)));
  return [header, ...filled.map((cells) => cells.join(","))].map((line) => `${line}\n`).join("");
}

/** The rows of a run sheet as a machine like the model would read them. */
export function filledIn(model, sheet) {
  const place = mkdtempSync(join(tmpdir(), "hexbench-sheet-"));
  const [of, rows, read] = ["model.toml", "run-sheet.csv", "read.csv"].map((name) => join(place, name));
  writeFileSync(of, model);
  writeFileSync(rows, atOneTemperature(sheet));
  execFileSync(process.env.HEXBENCH_BINARY, ["predict", of, rows, "-o", read], { stdio: "ignore" });
  const text = readFileSync(read, "utf8");
  rmSync(place, { recursive: true });
  return text;
}
