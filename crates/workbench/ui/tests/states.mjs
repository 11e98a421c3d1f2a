// Every state of the page, for pictures and for checks that hold in all of them.
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { changedFrom, downloaded, filledIn, heldOut, holdBack, judged, loadCase, loadUndiagnosed, settled, tick } from "./workbench.mjs";

const CASES = join(dirname(fileURLToPath(import.meta.url)), "../../../../data/cases");
const CASE = "mujoco-foundation";
const TERM = "base-compliance";
/** Sheets with their charts; the residual sheet is shown first. */
const SHEETS = [
  ["residuals", "story"],
  ["predicted", "predicted"],
  ["readings", null],
  ["scatter", "scatter"],
  ["machine", "machine"],
  ["numbers", "stiffness"],
];

/** Text of a file of a case. */
export function textOf(id, name) {
  return readFileSync(join(CASES, id, name), "utf8");
}

/** Files of a case as the page takes them; `changed`: other texts by name. */
export function filesOf(id, changed = {}) {
  const file = (name) => ({ name, mimeType: "text/plain", buffer: Buffer.from(changed[name] ?? textOf(id, name)) });
  return ["hexapod.toml", "measurements.csv", "holdout.csv"].map(file);
}

/** Measurements of a case with every deflection of the other sign. */
function reversed(id, name) {
  const [header, ...rows] = textOf(id, name).trimEnd().split("\n");
  const read = header.split(",").map((column) => /^(d[abc]_um|d(alpha|beta|gamma)_urad|dr[xyz]_urad)$/.test(column));
  const turned = (cell) => (cell.startsWith("-") ? cell.slice(1) : `-${cell}`);
  const row = (text) => text.split(",").map((cell, k) => (read[k] && cell !== "" ? turned(cell) : cell));
  return [header, ...rows.map((text) => row(text).join(","))].join("\n").concat("\n");
}

/** All files of a case, every deflection of the other sign. */
export function reversedFiles(id) {
  const names = ["measurements.csv", "holdout.csv"];
  return filesOf(id, Object.fromEntries(names.map((name) => [name, reversed(id, name)])));
}

/** Walks through the page: each is given an opened page, and calls `state` with the name of every state it comes to. `refusals` it provokes. */
export const WALKS = [
  { name: "start", refusals: [422], walk: startPage },
  { name: "bench", refusals: [], walk: bench },
  { name: "named", refusals: [], walk: named },
  { name: "editor", refusals: [422], walk: editor },
  { name: "busy", refusals: [], walk: busy },
  { name: "outside", refusals: [], walk: outside },
  { name: "plan", refusals: [], walk: plan },
  { name: "misread", refusals: [], walk: misread },
  { name: "game", refusals: [], walk: game },
  { name: "gone", refusals: ["ERR_FAILED"], walk: gone },
];

async function startPage({ page, at }, state) {
  await at(`case-${CASE}`).waitFor();
  await state("start");
  await page.locator("summary", { hasText: "Effects included" }).click();
  await at(`effect-${TERM}`).check();
  await at("files").setInputFiles(filesOf(CASE, { "measurements.csv": "pose,a_mm\n1,zero\n" }));
  await at("role-holdout.csv").waitFor();
  await state("start-files");
  await at("open-files").click();
  await at("error").waitFor();
  await state("start-refused");
}

async function bench({ page, at }, state) {
  await loadCase(page, CASE);
  await settled(page);
  await judged(page);
  await state("springs");
  await at("chart-story").focus();
  for (const key of ["ArrowRight", "Shift+ArrowRight", "Shift+ArrowRight"]) await page.keyboard.press(key);
  await at("picked").waitFor();
  await state("picked");
  await at("any-variable").click();
  await at("choose-layout").selectOption("all");
  await at("chart-residuals").locator("canvas").waitFor();
  await state("any-variable");
  await at("any-variable").click();
  const all = await heldOut(page);
  await at("leave-picked-out").click();
  const fewer = await changedFrom(page, all);
  await tick(page, TERM);
  await changedFrom(page, fewer);
  await settled(page);
  for (const [sheet, chart] of SHEETS) {
    await at(`tab-${sheet}`).click();
    if (chart !== null && chart !== "story") await at(`chart-${chart}`).locator("canvas").waitFor();
    await state(`sheet-${sheet}`);
  }
  await at("tab-machine").click();
  await at("choose-machine").selectOption("missed");
  await at("step-picture").click();
  await at("pictured").locator("svg").filter({ visible: true }).first().waitFor();
  await state("machine-missed");
  await at("tab-residuals").click();
  const ticked = await heldOut(page);
  await at("count-all").click();
  await changedFrom(page, ticked);
  await settled(page);
  await at("try-each").click();
  await at("tried").waitFor();
  await page
    .getByRole("button", { name: /^About/ })
    .first()
    .click();
  await at("notes").fill("The door stood open at noon.");
  await state("tried");
}

async function named({ page, at }, state) {
  await loadUndiagnosed(page, CASE);
  await at("tab-diagnosis").click();
  await state("diagnosis-before");
  await at("diagnose").click();
  await at("verdict").waitFor();
  await state("diagnosis");
  const springs = await heldOut(page);
  await at("tick-named").click();
  await changedFrom(page, springs);
  await state("diagnosis-ticked");
}

async function editor({ page, at }, state) {
  await loadCase(page, CASE);
  await judged(page);
  await at("own-new").click();
  await at("own-id").fill("square-spring");
  await at("own-elongation").fill("size * nonsense");
  await at("own-add").click();
  await at("own-editor").getByTestId("error").waitFor();
  await state("editor-refused");
}

async function busy({ page, at }, state) {
  await loadCase(page, CASE);
  await settled(page);
  await judged(page);
  const letGo = await holdBack(page, /\/view$/);
  await tick(page, TERM);
  await at("cancel").waitFor();
  await state("busy");
  await at("cancel").click();
  letGo();
}

async function outside({ page, at }, state) {
  await loadCase(page, "not-in-catalogue");
  const springs = await heldOut(page);
  await at("tab-diagnosis").click();
  await at("diagnose").click();
  await at("discover").waitFor();
  await state("outside");
  await at("discover").click();
  await at("add-law").waitFor();
  await state("law");
  await at("add-law").click();
  await changedFrom(page, springs);
  await at("tab-residuals").click();
  await settled(page);
  await judged(page);
  await state("law-added");
}

async function plan({ page, at }, state) {
  await loadCase(page, "paper-protocol");
  await at("tab-diagnosis").click();
  await at("diagnose").click();
  await at("run-sheet").waitFor();
  await state("ambiguous");
  const springs = await heldOut(page);
  await at("tick-named").click();
  await changedFrom(page, springs);
  const [model, sheet] = [await downloaded(page, "export-model"), await downloaded(page, "export-run-sheet")];
  const buffer = Buffer.from(filledIn(model.text, sheet.text));
  await at("readings-back").setInputFiles({ name: "run-sheet.csv", mimeType: "text/csv", buffer });
  await page.waitForFunction(() => / now: (?!diagnose again)/.test(document.querySelector("[data-testid=came]")?.textContent ?? ""));
  await judged(page);
  await state("readings-back");
}

async function misread({ page, at }, state) {
  await at("files").setInputFiles(reversedFiles(CASE));
  await at("role-holdout.csv").waitFor();
  await at("open-files").click();
  await at("story").waitFor();
  await at("tab-diagnosis").click();
  await at("diagnose").click();
  await at("verdict").waitFor();
  await state("misread");
  await at("read-as-deflection-sign=reversed").click();
  await at("read-as").waitFor();
  await at("tick-named").waitFor();
  await judged(page);
  await state("read-as");
}

async function game({ page, at }, state) {
  await at("level-easy").check();
  await at("game-seed").fill("7");
  await at("game-start").click();
  await at("guess").waitFor();
  await settled(page);
  await state("game");
  await at("reveal").click();
  await at("revealed").waitFor();
  await state("game-revealed");
}

async function gone({ page, at }, state) {
  await loadCase(page, CASE);
  await settled(page);
  await judged(page);
  await page.route(/\/view$/, (route) => route.abort("failed"));
  await tick(page, TERM);
  await at("retry").waitFor();
  await state("gone");
}
