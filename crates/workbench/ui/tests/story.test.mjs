// The story of the workbench in a real browser. HEXBENCH_BINARY names the program: node tests/story.test.mjs
// Exits 77 when there is no program or no browser.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { blind, printedText } from "../../../../tests/browser/printed.mjs";
import { browser, workbench } from "./suite.mjs";
import {
  changedFrom,
  cutTables,
  downloaded,
  filledIn,
  fitsWidth,
  heldOut,
  holdBack,
  judged,
  loadCase,
  loadUndiagnosed,
  openPage,
  settled,
  startWorkbench,
  tabTo,
  tick,
  watched,
  wordsOfPage,
} from "./workbench.mjs";

const CASES = join(dirname(fileURLToPath(import.meta.url)), "../../../../data/cases");
const CASE = "mujoco-foundation";
const TERM = "base-compliance";

/** Letters and digits alone: blanks and the case of a first letter are layout. */
const plain = (text) => text.toLowerCase().replace(/[^\p{L}\p{N}%±<>+]+/gu, "");

test("the model fails, a term is ticked by keyboard, and the held-out error falls", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  assert.ok(!page.url().includes("token"), "the token stays in the address bar");
  await tabTo(page, `case-${CASE}`);
  await page.keyboard.press("Enter");
  await at("held-out").waitFor();
  const springs = await heldOut(page);
  assert.match(await at("held-out-state").textContent(), /not yet/);
  await tabTo(page, `term-${TERM}`);
  await page.keyboard.press("Space");
  const ticked = await changedFrom(page, springs);
  console.log(`held-out error ${springs.toFixed(3)} -> ${ticked.toFixed(3)} times the noise`);
  assert.ok(ticked < springs, `${ticked} after, ${springs} before`);
  assert.ok(await at(`term-${TERM}`).isChecked());
  await at("tick").waitFor();
  const ticks = await page.evaluate(() => performance.getEntriesByName("tick").map(({ duration, detail }) => ({ duration, ...detail })));
  assert.equal(ticks.length, 1);
  console.log(`tick to new error drawn: ${ticks[0].duration.toFixed(0)} ms, of it server ${ticks[0].server.toFixed(1)} ms`);
  await close();
});

test("undo and redo bring back what was, without asking again", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  const springs = await heldOut(page);
  await settled(page);
  await at(`term-${TERM}`).click();
  const one = await changedFrom(page, springs);
  await settled(page);
  await at("term-creep").click();
  const two = await changedFrom(page, one);
  await settled(page);
  await judged(page);
  let asked = 0;
  page.on("request", () => {
    asked += 1;
  });
  await at("undo").click();
  assert.equal(await heldOut(page), one);
  await page.keyboard.press("Control+z");
  assert.equal(await heldOut(page), springs);
  assert.ok(await at("undo").isDisabled());
  assert.ok(!(await at(`term-${TERM}`).isChecked()));
  await page.keyboard.press("Control+Shift+z");
  assert.equal(await heldOut(page), one);
  await at("redo").click();
  assert.equal(await heldOut(page), two);
  assert.equal(asked, 0);
  assert.equal(await at("history").locator("li").count(), 3);
  await at("springs-alone").click();
  assert.equal(await changedFrom(page, two), springs);
  await close();
});

test("model, report and measurements are taken home", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  const springs = await heldOut(page);
  await at(`term-${TERM}`).click();
  await changedFrom(page, springs);
  const model = await downloaded(page, "export-model");
  assert.match(model.text, /^format = "model\/1"$/m);
  assert.match(model.text, new RegExp(TERM));
  const hexapod = await downloaded(page, "export-hexapod");
  assert.match(hexapod.text, /^format = "hexapod\/1"$/m);
  const report = await downloaded(page, "export-report");
  assert.match(report.text, /<title>[^<]*mujoco-foundation[^<]*<\/title>/);
  const diagnosis = await downloaded(page, "export-diagnosis");
  assert.equal(JSON.parse(diagnosis.text).format, "diagnosis/1");
  await close();
});

/** Reference numbers of a command on the files of the case. */
function command(...words) {
  const folder = join(CASES, CASE);
  const files = [join(folder, "hexapod.toml"), join(folder, "measurements.csv"), "--holdout", join(folder, "holdout.csv")];
  return JSON.parse(
    execFileSync(process.env.HEXBENCH_BINARY, [words[0], ...files, ...words.slice(1), "--json", "-"], { encoding: "utf8" }),
  );
}

test("readings are left out by keyboard and put back, and every output says which", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  const all = await heldOut(page);
  await at("tab-readings").click();
  await at("readings").waitFor();
  const box = page.locator("[data-testid^=counts-]").first();
  const [line] = /\d+/.exec(await box.getAttribute("data-testid"));
  await box.focus();
  await page.keyboard.press("Space");
  const fewer = await changedFrom(page, all);
  assert.match(await at("left-out").textContent(), new RegExp(`left out of the fit.*\\b${line}\\b`));
  assert.match(await at("history").locator("li").last().textContent(), /readings? left out/);
  assert.match((await downloaded(page, "export-model")).text, new RegExp(`excluded = \\[\\s*${line}\\b`));
  assert.ok(JSON.parse((await downloaded(page, "export-diagnosis")).text).excluded.includes(Number(line)));
  assert.match((await downloaded(page, "export-report")).text, /Left out beforehand, as requested/);
  assert.match((await downloaded(page, "save-session-page")).text, /left out of the fit, as requested/);
  await at(`pick-${line}`).click();
  assert.match(await at("picked").textContent(), new RegExp(`measurements\\.csv, lines? ${line}`));
  await at("tab-residuals").click();
  await at("picked").waitFor();
  await at("count-all").click();
  assert.equal(await changedFrom(page, fewer), all);
  await close();
});

test("the panels that carry the story come first, and what is ticked changes them", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  const ranked = () => page.waitForFunction(() => document.querySelector("[data-testid=story][data-stale=false]") !== null);
  await ranked();
  const panels = async () => Number(await at("story").getAttribute("data-panels"));
  const found = await panels();
  assert.ok(found >= 1 && found <= 3, `${found} panels`);
  const said = await at("story").locator("li").allTextContents();
  assert.match(said[0], /^The (elongation|compliance) of .* follows .* \(rank correlation .*, F .*, chance .*\)\.$/);
  await at("chart-story").locator("canvas").waitFor();
  assert.equal(await at("chart-residuals").count(), 0, "everything else is folded");
  const springs = await heldOut(page);
  await at(`term-${TERM}`).click();
  await changedFrom(page, springs);
  await ranked();
  assert.notDeepEqual(await at("story").locator("li").allTextContents(), said);
  await at("undo").click();
  await ranked();
  assert.deepEqual(await at("story").locator("li").allTextContents(), said);
  await close();
});

test("a point of a chart leads to its line", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  await judged(page);
  await at("any-variable").click();
  await at("choose-layout").selectOption("all");
  await at("chart-residuals").evaluate((chart) => chart.scrollIntoView({ block: "center" }));
  const box = await at("chart-residuals").locator("canvas").boundingBox();
  // Points are many: some place of a raster meets one.
  for (let k = 0; k < 400 && (await at("picked").count()) === 0; k++) {
    await page.mouse.click(box.x + 60 + ((k * 37) % (box.width - 90)), box.y + 150 + ((k * 11) % 150));
  }
  assert.match(await at("picked").textContent(), /measurements\.csv, lines? \d+.*: pose \[/);
  await close();
});

/** Draws a rectangle over a chart between two places, as shares of its canvas. */
async function brushed(page, chart, [left, top], [right, bottom]) {
  await chart.evaluate((element) => element.scrollIntoView({ block: "center" }));
  const box = await chart.locator("canvas").boundingBox();
  await page.mouse.move(box.x + left * box.width, box.y + top * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.5 * (left + right) * box.width, box.y + 0.5 * (top + bottom) * box.height);
  assert.equal(await chart.locator(".brush").count(), 1, "the rectangle is seen while it is drawn");
  await page.mouse.move(box.x + right * box.width, box.y + bottom * box.height);
  await page.mouse.up();
  assert.equal(await chart.locator(".brush").count(), 0);
}

/** Conditions and readings that the page says are picked; none: zeros. */
async function picks(page) {
  const said = await page.getByTestId("picked-count").textContent();
  if (said === "") return [0, 0];
  return /^(\d+) conditions? selected: (\d+) readings?/.exec(said).slice(1).map(Number);
}

test("a rectangle picks conditions in every chart, table and in the machine, and they are left out and put back together", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  await judged(page);
  const springs = await heldOut(page);
  await at("any-variable").click();
  await at("choose-layout").selectOption("all");
  await at("choose-variable").selectOption("order");
  const chart = at("chart-residuals");
  await brushed(page, chart, [0.01, 0.01], [0.99, 0.99]);
  const [all] = await picks(page);
  await brushed(page, chart, [0.01, 0.01], [0.5, 0.99]);
  const [left, readings] = await picks(page);
  assert.match(
    await at("picked").textContent(),
    /measurements\.csv, lines 2, 3, 4, 5 and \d+ more/,
    "conditions stand in the order of the file",
  );
  await brushed(page, chart, [0.5, 0.01], [0.99, 0.99]);
  const [right] = await picks(page);
  assert.ok(left > 1 && right > 1 && left + right === all, `${left} + ${right} of ${all}`);
  await brushed(page, chart, [0.3, 0.001], [0.9, 0.02]);
  assert.deepEqual(await picks(page), [0, 0], "nothing is in this rectangle");

  await brushed(page, chart, [0.01, 0.01], [0.5, 0.99]);
  assert.deepEqual(await picks(page), [left, readings]);
  await at("tab-predicted").click();
  await at("choose-predicted-of").selectOption("fitted");
  assert.deepEqual(await picks(page), [left, readings]);
  await at("tab-readings").click();
  await at("all-readings").click();
  assert.equal(await page.locator("[data-testid^=pick-][aria-pressed=true]").count(), left);
  await at("tab-machine").click();
  const seen = await at("machine-text").textContent();
  await at("next-picked").click();
  assert.notEqual(await at("machine-text").textContent(), seen);
  assert.deepEqual(await picks(page), [left, readings]);

  await at("leave-picked-out").click();
  const fewer = await changedFrom(page, springs);
  assert.match(await at("left-out").textContent(), new RegExp(`^${readings} readings left out of the fit`));
  assert.match(await at("picked-count").textContent(), new RegExp(`, ${readings} of them left out of the fit$`));
  assert.equal(await at("leave-picked-out").count(), 0);
  await at("put-picked-back").click();
  assert.equal(await changedFrom(page, fewer), springs);
  await page.keyboard.press("Escape");
  assert.deepEqual(await picks(page), [0, 0]);
  assert.equal(await at("picked").count(), 0);
  await close();
});

test("several conditions are picked by keyboard, in a chart and in the table", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  await settled(page);
  await at("chart-story").focus();
  const pressed = async (key) => {
    await page.keyboard.press(key);
    return (await picks(page))[0];
  };
  const picture = () =>
    at("chart-story")
      .locator("canvas")
      .evaluate((canvas) => canvas.toDataURL());
  const none = await picture();
  assert.equal(await pressed("ArrowRight"), 1);
  const one = await picture();
  assert.equal(await pressed("Shift+ArrowRight"), 2);
  assert.equal(await pressed("Shift+ArrowRight"), 3);
  const three = await picture();
  assert.equal(new Set([none, one, three]).size, 3, "what is picked is drawn");
  assert.equal(await pressed("Shift+ArrowLeft"), 2, "going back gives up the last one");
  assert.equal(await pressed("Escape"), 0);
  assert.equal(await picture(), none);
  await at("tab-readings").click();
  const buttons = page.locator("[data-testid^=pick-][aria-pressed]");
  await buttons.first().focus();
  assert.equal(await pressed("Shift+ArrowDown"), 2);
  assert.equal(await pressed("Shift+ArrowDown"), 3);
  assert.equal(await buttons.nth(2).evaluate((button) => button === document.activeElement), true);
  await buttons.nth(5).click({ modifiers: ["Shift"] });
  assert.equal((await picks(page))[0], 4);
  await close();
});

test("paper has the last column of a diagnosis", { skip: blind() || false }, async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  await at("tab-diagnosis").click();
  await at("diagnose").click();
  await at("picture").waitFor();
  assert.match(printedText(await page.pdf({ format: "A4" })), /dalpha µrad +dbeta µrad +dgamma µrad/);
  await close();
});

test("the diagnosis begins with the story in one picture, in the colors of the page, in words, and for the step shown", async () => {
  const { page, at, close } = await openPage(browser, workbench.url, { colorScheme: "light" });
  await loadUndiagnosed(page, CASE);
  await at("tab-diagnosis").click();
  assert.equal(await at("picture").count(), 0);
  await at("diagnose").click();
  await at("picture").waitFor();
  const wide = at("picture-wide").locator("svg");
  assert.ok((await wide.isVisible()) && !(await at("picture-narrow").isVisible()));
  assert.equal(await wide.getAttribute("role"), "img");
  assert.match(await wide.locator("title").textContent(), /^The load at which the added effects explain most: force change/);
  const first = await page.evaluate(() => {
    const [picture, verdict] = ["picture", "verdict"].map((id) => document.querySelector(`[data-testid=${id}]`));
    return (picture.compareDocumentPosition(verdict) & Node.DOCUMENT_POSITION_FOLLOWING) !== 0;
  });
  assert.ok(first, "the picture stands above the verdict");
  const words = () => at("picture-words").locator("li").allTextContents();
  const [load, error] = await words();
  assert.match(
    load,
    /the springs miss [\d.]+ \u00b5m, left with the added effects [\d.]+ \u00b5m \(line: noise of this joint [\d.]+ \u00b5m\)/,
  );
  assert.match(error, new RegExp(`^Error on held-out readings: springs alone [\\d.]+ x noise, \\+ ${TERM} [\\d.]+ x noise`));
  const drawn = () =>
    wide.evaluate((svg) => ({
      paper: getComputedStyle(svg.querySelector("path")).fill,
      unknown: [...svg.outerHTML.matchAll(/var\((--\w+)\)/g)].filter(([, name]) => getComputedStyle(svg).getPropertyValue(name) === ""),
      fixed: svg.outerHTML.match(/"#[0-9A-F]{6}"/g),
    }));
  const light = await drawn();
  await at("theme").selectOption("dark");
  const dark = await drawn();
  assert.notEqual(light.paper, dark.paper);
  assert.deepEqual([light.unknown, light.fixed], [[], null], "every color is one of the page");

  await at("choose-picture").selectOption("step");
  await at("pictured").waitFor();
  await page.waitForFunction(() => document.querySelector("[data-testid=pictured]")?.dataset.stale === "false");
  assert.ok(!(await words())[0].includes("explain"), "the springs alone explain nothing");
  const springs = await heldOut(page);
  await at("term-joint-friction").click();
  await changedFrom(page, springs);
  await page.waitForFunction(() => /\+ joint-friction/.test(document.querySelector("[data-testid=picture-words]")?.textContent ?? ""));
  await at("tick-named").click();
  await page.waitForFunction(() => document.querySelector("[data-testid=story-picture]")?.dataset.of === "diagnosis");
  assert.deepEqual(await words(), [load, error]);

  await page.setViewportSize({ width: 390, height: 800 });
  assert.ok(!(await wide.isVisible()) && (await at("picture-narrow").isVisible()));
  assert.ok(await fitsWidth(page));
  const letters = await at("picture-narrow")
    .locator("text")
    .evaluateAll((all) => {
      const heights = all.filter((text) => text.textContent !== "").map((text) => text.getBoundingClientRect().height);
      return Math.min(...heights);
    });
  assert.ok(letters > 8, `the smallest letters are ${letters} px high`);
  await close();
});

test("what lasts says so with a way to end it, and a number that is old looks old", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadUndiagnosed(page, CASE);
  const springs = await heldOut(page);
  const letGo = await holdBack(page, /\/(view|diagnosis)$/);
  const box = at("held-out-box");
  await at(`term-${TERM}`).click();
  await at("cancel").waitFor();
  assert.match(await at("busy").textContent(), /^Fitting \.\.\. ?\d+ s/);
  assert.equal(await at("busy").locator("progress").count(), 1);
  assert.equal(await box.getAttribute("aria-busy"), "true");
  assert.match(await at("old").textContent(), /previous step/);
  await page.waitForFunction(() => {
    const [number, hint] = [".number", ".hint"].map((part) => document.querySelector(`[data-testid=held-out-box] ${part}`));
    return getComputedStyle(number).color === getComputedStyle(hint).color;
  });
  await page.mouse.wheel(0, 2000);
  assert.ok(await at("busy").isVisible(), "it is seen wherever the page is scrolled to");
  await page.emulateMedia({ media: "print" });
  assert.ok(!(await at("busy").isVisible()), "paper has nothing under way");
  await page.emulateMedia({ media: null });
  await at("cancel").click();
  await at("cancel").waitFor({ state: "detached" });
  assert.ok(!(await at(`term-${TERM}`).isChecked()), "what is ticked is what is shown");
  assert.equal(await at("old").count(), 0);
  await at("tab-diagnosis").click();
  await at("diagnose").click();
  await at("cancel").waitFor();
  assert.match(await at("busy").textContent(), /^Comparing all explanations/);
  await at("cancel").click();
  await at("cancel").waitFor({ state: "detached" });
  assert.equal(await at("verdict").count(), 0);
  assert.equal(await at("error").count(), 0);
  letGo();
  await page.unroute(/\/(view|diagnosis)$/);
  await at(`term-${TERM}`).click();
  assert.ok((await changedFrom(page, springs)) < springs);
  await close();
});

test("a session is saved, opened again in another tab, and gives the same numbers in the command", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  const springs = await heldOut(page);
  await at(`term-${TERM}`).click();
  const ticked = await changedFrom(page, springs);
  await at("tab-readings").click();
  await page.locator("[data-testid^=counts-]").first().click();
  const shown = await changedFrom(page, ticked);
  await at("notes").fill("door open at noon");
  await page.reload();
  await at("notes").waitFor();
  await page.waitForFunction(() => document.querySelector("[data-testid=notes]")?.value === "door open at noon");
  await at(`term-${TERM}`).waitFor();
  await close();

  const again = await openPage(browser, workbench.url);
  await loadCase(again.page, CASE);
  await again.at(`term-${TERM}`).click();
  await changedFrom(again.page, springs);
  await again.at("tab-readings").click();
  await again.page.locator("[data-testid^=counts-]").first().click();
  assert.equal(await changedFrom(again.page, ticked), shown);
  await again.at("notes").fill("door open at noon");
  const session = await downloaded(again.page, "save-session");
  assert.equal(session.name, "session.json");
  await again.close();

  const third = await openPage(browser, workbench.url);
  const folder = join(CASES, CASE);
  const file = { name: "session.json", mimeType: "application/json", buffer: Buffer.from(session.text) };
  await third.at("files").setInputFiles([...["hexapod.toml", "measurements.csv", "holdout.csv"].map((name) => join(folder, name))]);
  await third.at("files").setInputFiles(file);
  assert.equal(await third.at("role-session.json").inputValue(), "session");
  await third.at("open-files").click();
  await third.page.waitForFunction(
    (value) => document.querySelector("[data-testid=held-out]")?.getAttribute("data-value") === String(value),
    shown,
  );
  assert.equal(await third.at("notes").inputValue(), "door open at noon");
  assert.equal(await third.at("history").locator("li").count(), 3);
  await third.close();

  const place = mkdtempSync(join(tmpdir(), "hexbench-story-"));
  writeFileSync(join(place, "session.json"), session.text);
  const fit = command("fit", "--session", join(place, "session.json"));
  rmSync(place, { recursive: true });
  const kept = JSON.parse(session.text);
  for (const number of [kept.steps[kept.at].times_noise, Math.sqrt(fit.held_out.chi2_reduced)]) {
    assert.ok(Math.abs(number / shown - 1) < 1e-12, `${number} ${shown}`);
  }
  assert.deepEqual(fit.excluded, kept.steps[kept.at].selection.exclude);
});

test("a run sheet goes to the machine, its readings come back, and what came stands beside what was foreseen", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, "paper-protocol");
  const springs = await heldOut(page);
  const readings = async () => /(\d+) deflections/.exec(await page.locator(".about").textContent())[1];
  const before = Number(await readings());
  await at("tab-diagnosis").click();
  await at("diagnose").click();
  await at("run-sheet").waitFor();
  await at("tick-named").click();
  await changedFrom(page, springs);
  const model = await downloaded(page, "export-model");
  const sheet = await downloaded(page, "export-run-sheet");
  const rows = sheet.text.trim().split("\n");
  assert.ok(rows.length > 2 && rows.slice(1).every((row) => row.endsWith(",,,,,,")), sheet.text);
  const paper = await downloaded(page, "export-run-sheet-page");
  assert.match(paper.text, /expected.*right in /s);
  await at("notes").fill("readings of the afternoon");
  const buffer = Buffer.from(filledIn(model.text, sheet.text));
  await at("readings-back").setInputFiles({ name: "run-sheet.csv", mimeType: "text/csv", buffer });
  await at("came").waitFor();
  await page.waitForFunction(() => !/diagnose again/.test(document.querySelector("[data-testid=came]")?.textContent ?? ""));
  const came = await at("came").textContent();
  assert.match(came, /Before: ambiguous \(.*\); now: /);
  assert.match(came, /: 1 for base-compliance.*: 1 for leg-coupling.*: 1 for base-compliance/);
  assert.equal(Number(await readings()), before + rows.length - 1);
  assert.equal(await at("notes").inputValue(), "readings of the afternoon");
  assert.ok(await at(`term-${TERM}`).isChecked());
  await page.reload();
  await at("held-out").waitFor();
  assert.equal(Number(await readings()), before + rows.length - 1, "a reload keeps the readings");
  await judged(page);
  await at("tab-diagnosis").click();
  assert.equal(await at("came").textContent(), came, "the readings are diagnosed again, and what was foreseen is kept");
  const session = await downloaded(page, "save-session");
  assert.equal(JSON.parse(session.text).foreseen.readings, rows.length - 1);
  await close();
});

test("the words of a run sheet break: on a wide screen none of it is cut", async () => {
  const { page, at, close } = await openPage(browser, workbench.url, { viewport: { width: 1440, height: 900 } });
  await page.locator("summary", { hasText: "Effects included" }).click();
  await at("effect-joint-rotation-stiffness").check();
  await at("simulation-plan").selectOption("vertical-only");
  await at("simulation-distance").fill("12");
  await at("simulation-seed").fill("5");
  await at("simulate").click();
  await judged(page);
  await at("answer-plan").click();
  await at("plan-rows").waitFor();
  assert.deepEqual(await cutTables(page), []);
  await close();
});

test("a session of other files is refused by the name of the file", async () => {
  const { page, at, close } = await openPage(browser, workbench.url, { refusals: [422] });
  await loadCase(page, CASE);
  const session = await downloaded(page, "save-session");
  await at("close").click();
  await loadCase(page, "mujoco-clean");
  const before = await heldOut(page);
  await at("open-session").setInputFiles({ name: "session.json", mimeType: "application/json", buffer: Buffer.from(session.text) });
  await at("error").waitFor();
  assert.match(await at("error").textContent(), /is not the file of the session/);
  assert.match(await at("error").textContent(), /holds other data.*Open other data/);
  await at("open-session").setInputFiles({ name: "x.json", mimeType: "application/json", buffer: Buffer.from("{}") });
  await page.waitForFunction(() => /x\.json is not a session file/.test(document.querySelector("[data-testid=error]")?.textContent ?? ""));
  assert.equal(await heldOut(page), before);
  await close();
});

test("the verdict, how sure it is and what to do next come first, unasked, and one click does it", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  await judged(page);
  const isFirst = await page.evaluate(() => {
    const [answer, number] = ["answer", "held-out-box"].map((id) => document.querySelector(`[data-testid=${id}]`));
    return answer.getBoundingClientRect().bottom <= number.getBoundingClientRect().top;
  });
  assert.ok(isFirst, "no number stands above the verdict");
  assert.match(await at("answer-verdict").textContent(), new RegExp(`^NAMED The model lacks one effect: .*\\(${TERM}\\)`));
  assert.match(await at("answer-sure").textContent(), new RegExp(`^Probability: ${TERM} > 99 %`));
  assert.match(await at("answer-next").textContent(), new RegExp(`^Next: Tick ${TERM}`));
  const springs = await heldOut(page);
  await at("answer-tick").click();
  assert.ok((await changedFrom(page, springs)) < springs);
  await at("answer-model").waitFor();
  await at("answer-details").click();
  assert.equal(await at("tab-diagnosis").getAttribute("aria-selected"), "true");
  assert.equal(await at("verdict").getAttribute("data-word"), "named");
  await close();
});

test("a verdict of readings that have changed since is gray and asks to diagnose again; no error at the noise stands unquestioned beside OUTSIDE", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, "not-in-catalogue");
  await judged(page);
  assert.equal(await at("answer").getAttribute("data-word"), "outside");
  const springs = await heldOut(page);
  await at("answer-law").click();
  await at("add-law").click();
  await changedFrom(page, springs);
  assert.match(await at("held-out-state").textContent(), /at the noise/);
  assert.equal(await at("answer").getAttribute("data-old"), "true");
  assert.match(await at("beside").textContent(), /^Diagnosis before your last change: OUTSIDE/);
  await page.waitForFunction(() => {
    const parts = [".held-out .hint", "[data-testid=answer-verdict]", "[data-testid=answer-verdict] strong", "[data-testid=beside]"];
    return new Set(parts.map((part) => getComputedStyle(document.querySelector(part)).color)).size === 1;
  });
  assert.equal(await at("answer-next").count(), 0, "an old answer says nothing to do but to ask again");
  await at("answer-diagnose").click();
  await judged(page);
  assert.equal(await at("answer").getAttribute("data-old"), "false");
  assert.equal(await at("answer").getAttribute("data-word"), "named");
  await close();
});

test("a game is not given away", async () => {
  const { at, page, close } = await openPage(browser, workbench.url);
  let asked = 0;
  page.on("request", (request) => {
    if (/\/(check|diagnosis)$/.test(request.url())) asked += 1;
  });
  await at("level-easy").check();
  await at("game-seed").fill("7");
  await at("game-start").click();
  await at("guess").waitFor();
  await settled(page);
  assert.deepEqual([asked, await at("answer").count()], [0, 0]);
  await close();
});

test("the diagnosis names the effect and ticks it", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  const springs = await heldOut(page);
  await at("tab-residuals").focus();
  await page.keyboard.press("End");
  await at("diagnose").click();
  await at("verdict").waitFor();
  assert.equal(await at("verdict").getAttribute("data-word"), "named");
  assert.match(await at("verdict").textContent(), new RegExp(TERM));
  assert.match(await at("section-confidence").textContent(), new RegExp(TERM));
  await at("tick-named").click();
  assert.ok((await changedFrom(page, springs)) < springs);
  assert.ok(await at(`term-${TERM}`).isChecked());
  await close();
});

test("where something outside is told, a law is searched and added by one click, and the error falls", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, "not-in-catalogue");
  const springs = await heldOut(page);
  await at("tab-diagnosis").click();
  await at("diagnose").click();
  await at("verdict").waitFor();
  assert.equal(await at("verdict").getAttribute("data-word"), "outside");
  await at("discover").click();
  await at("add-law").waitFor();
  assert.match(await at("discovered").textContent(), /repeats every 8\.0\d mm of leg length/);
  await at("add-law").click();
  const error = await changedFrom(page, springs);
  assert.ok(error < 1.1 && springs > 1.5, `${springs} -> ${error}`);
  await close();
});

test("the workbench says word for word what the report says, of every bundled case; of commands, where to click instead", async () => {
  const here = await wordsOfPage();
  for (const name of readdirSync(CASES).filter((entry) => statSync(join(CASES, entry)).isDirectory())) {
    const { page, at, close } = await openPage(browser, workbench.url);
    await loadCase(page, name);
    await at("tab-diagnosis").click();
    await at("diagnose").click();
    await at("section-conventions").waitFor();
    const said = plain((await at("said").allTextContents()).join(" "));
    const report = await downloaded(page, "export-report");
    const reader = await browser.newPage();
    await reader.setContent(report.text);
    const parts = await reader
      .locator("section:not(:has(figure)):not(#follows):not(#provenance)")
      .locator("h2, p, li, dt, dd, td, caption")
      .allTextContents();
    await reader.close();
    const wanted = parts.map((part) => plain(here(part))).filter((part) => part !== "");
    assert.ok(wanted.length > 30, `${name}: ${wanted.length} parts`);
    for (const part of wanted) assert.ok(said.includes(part), `${name}: the workbench does not say: ${part}`);
    console.log(`${name}: ${wanted.length} parts of the report stand in the workbench`);
    await close();
  }
});

test("every sheet draws without a fault", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  await at(`term-${TERM}`).click();
  for (const [sheet, chart] of [
    ["predicted", "predicted"],
    ["scatter", "scatter"],
    ["machine", "machine"],
    ["numbers", "stiffness"],
  ]) {
    await at(`tab-${sheet}`).click();
    await at(`chart-${chart}`).locator("canvas").waitFor();
  }
  assert.match(await at("parameters").textContent(), new RegExp(`${TERM}\\.rotation-x`));
  await at("tab-residuals").click();
  await at("any-variable").click();
  const variables = await at("choose-variable")
    .locator("option:not([disabled])")
    .evaluateAll((all) => all.map(({ value }) => value));
  assert.ok(variables.length > 5, `${variables}`);
  for (const variable of variables) await at("choose-variable").selectOption(variable);
  await at("choose-layout").selectOption("all");
  await at("choose-quantity").selectOption("explained");
  await at("chart-residuals").locator("canvas").waitFor();
  await close();
});

test("numbers say whose they are, and residuals without a trend do not look like noise where the error is above it", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  await at("tab-numbers").click();
  assert.match(await at("numbers-of").textContent(), /springs alone: no term is ticked yet\..*biased/);
  const springs = await heldOut(page);
  await tick(page, TERM);
  await changedFrom(page, springs);
  assert.match(await at("numbers-of").textContent(), new RegExp(`springs with ${TERM}\\.`));
  assert.match(await at("held-out-state").textContent(), /not yet at the noise/);
  await at("tab-residuals").click();
  await settled(page);
  assert.equal(await at("story").getAttribute("data-panels"), "0");
  assert.match(await at("story").textContent(), /yet the error is above the noise/);
  await close();
});

test("a term is asked for in its richer form, and every other term is tried", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  assert.ok(await at("term-joint-geometry").isDisabled());
  await at("try-each").click();
  await at("tried").waitFor();
  const found = page.locator(".trial");
  assert.ok((await found.count()) > 15, `${await found.count()} terms tried`);
  assert.match(await found.first().textContent(), new RegExp(`^${TERM}.*better \\(chance`));
  assert.match(await at("looks").textContent(), /viewed for \d\d models: .*confirm the model with new readings/);
  const springs = await heldOut(page);
  await at(`term-${TERM}`).click();
  const ideal = await changedFrom(page, springs);
  assert.equal(await page.locator(".trial").count(), 0, "what was tried belongs to another step");
  await at(`richer-${TERM}`).click();
  const richer = await changedFrom(page, ideal);
  await at("try-each").click();
  await at("tried").waitFor();
  assert.match(await at("tried").textContent(), /^None of \d+ terms gives a significant gain/);
  assert.equal(await page.locator(".trial.good").count(), 0, "beside the answer nothing is approved of");
  await at(`term-${TERM}`).click();
  assert.equal(await changedFrom(page, richer), springs);
  await close();
});

test("the number stands beside its band, and beside the diagnosis where the model ticked is another", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  assert.match(await at("held-out-band").textContent(), /1\.00 \u00b1 0\.0\d for \d+ numbers/);
  assert.match(await at("held-out-state").textContent(), /not yet at the noise \(chance < 0\.1 %\)/);
  assert.equal(await at("looks").textContent(), "viewed for 1 model");
  await at("tab-diagnosis").click();
  await at("diagnose").click();
  await at("beside").waitFor();
  assert.match(await at("beside").textContent(), new RegExp(`NAMED ${TERM}.*not the model you ticked`));
  const springs = await heldOut(page);
  await at("tick-named").click();
  await changedFrom(page, springs);
  assert.doesNotMatch(await at("beside").textContent(), /not the model/);
  await page.reload();
  await changedFrom(page, springs);
  assert.match(await at("looks").textContent(), /^viewed for 2 models/, "a reload does not forget what was seen");
  await close();
});

test("readings held out are drawn, in both sheets", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  const picture = (name) =>
    at(`chart-${name}`)
      .locator("canvas")
      .evaluate((canvas) => canvas.toDataURL());
  for (const sheet of ["predicted", "residuals"]) {
    await at(`tab-${sheet}`).click();
    if (sheet === "residuals") await at("any-variable").click();
    await at(`choose-${sheet}-of`).selectOption("fitted");
    const fitted = await picture(sheet);
    await at(`choose-${sheet}-of`).selectOption("held-out");
    assert.notEqual(await picture(sheet), fitted, sheet);
  }
  await close();
});

test("every load is drawn without a complaint, a moment alone as well", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  await at("tab-machine").click();
  await at("chart-machine").locator("canvas").waitFor();
  const last = Number(await at("condition").getAttribute("max"));
  let alone = 0;
  for (let i = 0; i <= last; i++) {
    await at("condition").fill(String(i));
    const [, load] = /load \[([^\]]*)\]/.exec(await at("machine-text").textContent());
    const [fx, fy, fz] = load.split(", ");
    if ([fx, fy, fz].every((part) => part === "0")) alone += 1;
  }
  assert.ok(alone > 0, "no load of this case is a moment alone: the test asks for nothing");
  await close();
});

test("a machine is simulated, tells its seed and what was put in, and the same seed gives the same readings", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  const readings = [];
  for (let i = 0; i < 2; i++) {
    await page.locator("summary", { hasText: "Effects included" }).click();
    await at(`effect-${TERM}`).check();
    await at("simulation-plan").selectOption("few-poses");
    await at("simulation-distance").fill("30");
    await at("simulation-seed").fill("11");
    await at("simulate").click();
    await at("held-out").waitFor();
    assert.match(await page.locator(".about").textContent(), new RegExp(`Seed 11.*${TERM}`));
    readings.push(await downloaded(page, "export-measurements"));
    await at("close").click();
  }
  assert.deepEqual(readings[0], readings[1]);
  assert.match(readings[0].text, /^pose,/);
  await close();
});

test("the page is dark or light as the system says or as chosen", async () => {
  const { page, at, close } = await openPage(browser, workbench.url, { colorScheme: "dark" });
  const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  await at("theme").waitFor();
  const dark = await paper();
  await at("theme").selectOption("light");
  assert.notEqual(await paper(), dark);
  await page.reload();
  await at("theme").waitFor();
  assert.notEqual(await paper(), dark);
  await at("theme").selectOption("auto");
  assert.equal(await paper(), dark);
  await close();
});

test("the machine turns and comes nearer by keyboard, without 3D graphics of the browser", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  await at("tab-machine").click();
  const canvas = at("chart-machine").locator("canvas");
  await canvas.waitFor();
  const picture = () => canvas.evaluate((drawn) => drawn.toDataURL());
  const seen = [await picture()];
  await at("chart-machine").focus();
  for (const key of ["ArrowLeft", "ArrowUp", "+"]) {
    await page.keyboard.press(key);
    seen.push(await picture());
  }
  assert.equal(new Set(seen).size, 4, "every key changes the picture");
  await close();
});

test("a game is played to its end", async () => {
  const { at, close } = await openPage(browser, workbench.url);
  await at("level-easy").check();
  await at("game-seed").fill("7");
  await at("game-start").click();
  await at("guess").waitFor();
  await at("tab-diagnosis").click();
  await at("diagnose").click();
  await at("verdict").waitFor();
  const named = at("tick-named");
  if ((await named.count()) > 0) {
    await named.click();
    await at("tick").waitFor();
  }
  await at("reveal").click();
  await at("revealed").waitFor();
  assert.match(await at("revealed").textContent(), /Hidden: .+ You said: /);
  assert.match(await at("scores").textContent(), /^[01] of 1 right so far, 0 of them without the diagnosis/);
  await close();
});

test("a formula of one's own is refused with its place, put right, fitted and saved", async () => {
  const { page, at, close } = await openPage(browser, workbench.url, { refusals: [422] });
  await loadCase(page, CASE);
  const springs = await heldOut(page);
  await at("own-new").click();
  await at("own-id").fill("square-spring");
  await at("own-title").fill("Softer with the square of the force");
  await at("own-elongation").fill("size * nonsense");
  await at("own-add").click();
  const error = at("own-editor").getByTestId("error");
  await error.waitFor();
  assert.match(await error.textContent(), /nonsense/);
  assert.equal(await heldOut(page), springs);
  await at("own-elongation").fill("size * (f*abs(f) - f0*abs(f0)) / 100");
  assert.match(await at("own-text").inputValue(), /f\*abs\(f\)/);
  await at("own-add").click();
  await at("term-square-spring").waitFor();
  assert.notEqual(await changedFrom(page, springs), springs);
  assert.ok(await at("term-square-spring").isChecked());
  await page.getByRole("button", { name: "Edit" }).click();
  const file = await downloaded(page, "own-save");
  assert.equal(file.name, "square-spring.toml");
  assert.match(file.text, /^format = "term\/1"$/m);
  await close();
});

test("files are chosen, a bad one is refused with its line, and nothing is lost", async () => {
  const { at, close } = await openPage(browser, workbench.url, { refusals: [422] });
  const folder = join(CASES, CASE);
  await at("files").setInputFiles([join(folder, "hexapod.toml"), join(folder, "measurements.csv"), join(folder, "holdout.csv")]);
  assert.equal(await at("role-hexapod.toml").inputValue(), "hexapod");
  assert.equal(await at("role-measurements.csv").inputValue(), "data");
  assert.equal(await at("role-holdout.csv").inputValue(), "holdout");
  await at("files").setInputFiles({ name: "measurements.csv", mimeType: "text/csv", buffer: Buffer.from("pose,a_mm\n1,zero\n") });
  await at("open-files").click();
  await at("error").waitFor();
  assert.match(await at("error").textContent(), /measurements\.csv/);
  assert.equal(await at("role-holdout.csv").inputValue(), "holdout");
  await at("files").setInputFiles([join(folder, "measurements.csv")]);
  await at("open-files").click();
  await at("held-out").waitFor();
  await close();
});

test("names in files are text, never markup", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  const folder = join(CASES, CASE);
  const { readFile } = await import("node:fs/promises");
  const machine = (await readFile(join(folder, "hexapod.toml"), "utf8")).replace(
    /^name = .*$/m,
    "name = '<img src=x onerror=alert(1)><b>bold</b>'",
  );
  await at("files").setInputFiles([
    { name: "hexapod.toml", mimeType: "text/plain", buffer: Buffer.from(machine) },
    { name: "<b>measurements</b>.csv", mimeType: "text/csv", buffer: await readFile(join(folder, "measurements.csv")) },
  ]);
  await at("open-files").click();
  await at("held-out").waitFor();
  assert.match(await page.locator("h1").textContent(), /<b>bold<\/b>/);
  assert.equal(await page.locator("img, h1 b, .about b").count(), 0);
  await close();
});

test("a narrow window needs no scrolling sideways", async () => {
  const { page, at, close } = await openPage(browser, workbench.url, { viewport: { width: 360, height: 740 } });
  assert.ok(await fitsWidth(page), "start screen");
  await loadCase(page, CASE);
  await tick(page, TERM);
  for (const sheet of ["residuals", "predicted", "readings", "scatter", "machine", "numbers", "diagnosis"]) {
    await at(`tab-${sheet}`).click();
    assert.ok(await fitsWidth(page), sheet);
  }
  await at("own-new").click();
  assert.ok(await fitsWidth(page), "editor");
  await close();
});

test("only the newest answer is drawn, and a busy server is asked once more", async () => {
  const { page, at, close } = await openPage(browser, workbench.url, { refusals: [503] });
  await loadCase(page, CASE);
  const springs = await heldOut(page);
  let asked = 0;
  let late = () => {};
  const lateAnswer = new Promise((resolve) => {
    late = resolve;
  });
  await page.route("**/view", async (route) => {
    asked += 1;
    if (asked === 1) {
      const response = await route.fetch();
      await new Promise((resolve) => setTimeout(resolve, 2500));
      await route.fulfill({ response }).catch(() => {});
      late();
    } else if (asked === 2) await route.fulfill({ status: 503, headers: { "retry-after": "1" }, json: { error: "busy", next: "wait" } });
    else await route.continue();
  });
  await at("term-creep").click();
  await at(`term-${TERM}`).click();
  const newest = await changedFrom(page, springs);
  await lateAnswer;
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 200)));
  assert.equal(await heldOut(page), newest);
  assert.ok((await at("term-creep").isChecked()) && (await at(`term-${TERM}`).isChecked()));
  assert.equal(await at("history").locator("li").count(), 2);
  assert.equal(asked, 3);
  await close();
});

test("two tabs do not disturb each other, and a reload brings back what was ticked", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  const second = await watched(await page.context().newPage(), workbench.url);
  await loadCase(page, CASE);
  await loadCase(second.page, "mujoco-clean");
  const [one, two] = [await heldOut(page), await heldOut(second.page)];
  await at(`term-${TERM}`).click();
  const ticked = await changedFrom(page, one);
  assert.equal(await heldOut(second.page), two);
  assert.ok(!(await second.at(`term-${TERM}`).isChecked()));
  await page.reload();
  await at("held-out").waitFor();
  await page.waitForFunction((term) => document.querySelector(`[data-testid=${term}]`)?.checked, `term-${TERM}`);
  await page.waitForFunction((old) => Number(document.querySelector("[data-testid=held-out]").dataset.value) === old, ticked);
  await second.close();
  await close();
});

test("a bench the server has dropped is loaded again unasked", async () => {
  const { page, at, close } = await openPage(browser, workbench.url, { refusals: [410] });
  await loadCase(page, CASE);
  const springs = await heldOut(page);
  const token = await page.evaluate(() => sessionStorage.getItem("hexbench-token"));
  const { limits } = await page.evaluate(
    (key) => fetch("/api/catalogue", { headers: { authorization: `Bearer ${key}` } }).then((answer) => answer.json()),
    token,
  );
  for (let i = 0; i < limits.benches; i++) {
    const status = await page.evaluate(
      (key) =>
        fetch("/api/benches", {
          method: "POST",
          headers: { authorization: `Bearer ${key}`, "content-type": "application/json" },
          body: JSON.stringify({ from: "case", id: "paper-protocol" }),
        }).then((answer) => answer.status),
      token,
    );
    assert.equal(status, 201);
  }
  await at(`term-${TERM}`).click();
  assert.ok((await changedFrom(page, springs)) < springs);
  await close();
});

test("without the key the page says which address to open", async () => {
  const { at, close } = await openPage(browser, new URL("/", workbench.url).href);
  assert.match(await at("error").textContent(), /address that `hexbench workbench` printed/);
  await close();
});

test("files of the command line are open at once, and a server that is gone is told with a way to try again", async () => {
  const folder = join(CASES, CASE);
  const own = await startWorkbench(
    join(folder, "hexapod.toml"),
    join(folder, "measurements.csv"),
    "--holdout",
    join(folder, "holdout.csv"),
  );
  const { page, at, close } = await openPage(browser, own.url, { refusals: ["ERR_CONNECTION_REFUSED"] });
  await at("held-out").waitFor();
  const springs = await heldOut(page);
  await settled(page);
  await judged(page);
  await own.stop();
  await at(`term-${TERM}`).click();
  await at("retry").waitFor();
  assert.match(await at("error").textContent(), /is not responding/);
  assert.equal(await heldOut(page), springs);
  await close();
});
