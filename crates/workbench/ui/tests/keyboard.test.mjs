// The story without a mouse: a case, readings picked and left out, a term, sheets, the diagnosis, a session.
// HEXBENCH_BINARY names the program: node tests/keyboard.test.mjs. Exits 77 when there is no program or no browser.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { browser, workbench } from "./suite.mjs";
import { changedFrom, heldOut, openPage, settled, tabTo } from "./workbench.mjs";

const TERM = "base-compliance";

test("everything is done by keyboard, a selection included", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  const press = (key) => page.keyboard.press(key);
  await page.evaluate(() => {
    globalThis.pointed = 0;
    addEventListener("pointerdown", () => globalThis.pointed++, true);
  });
  await tabTo(page, "case-mujoco-foundation");
  await press("Enter");
  await at("held-out").waitFor();
  await settled(page);
  const springs = await heldOut(page);

  // Three conditions are picked in the chart that tells most, and left out.
  await tabTo(page, "chart-story");
  for (const key of ["ArrowRight", "Shift+ArrowRight", "Shift+ArrowRight"]) await press(key);
  assert.match(await at("picked-count").textContent(), /^3 conditions selected: 6 readings$/);
  await tabTo(page, "leave-picked-out");
  await press("Enter");
  const fewer = await changedFrom(page, springs);
  assert.match(await at("left-out").textContent(), /6 readings left out/);
  await settled(page);

  // The same selection stands in every chart, and keys change it there too.
  await tabTo(page, "tab-residuals");
  for (const [sheet, chart] of [
    ["predicted", "predicted"],
    ["readings", null],
    ["scatter", "scatter"],
    ["machine", "machine"],
  ]) {
    await press("ArrowRight");
    assert.equal(await at(`tab-${sheet}`).getAttribute("aria-selected"), "true");
    assert.match(await at("picked-count").textContent(), /^3 conditions selected/, sheet);
    if (chart !== null) await at(`chart-${chart}`).locator("canvas").waitFor();
  }
  await press("ArrowLeft");
  const drawn = () =>
    at("chart-scatter")
      .locator("canvas")
      .evaluate((canvas) => canvas.toDataURL());
  await tabTo(page, "chart-scatter");
  const three = await drawn();
  await press("Shift+ArrowRight");
  assert.match(await at("picked-count").textContent(), /^4 conditions selected/);
  assert.notEqual(await drawn(), three, "what is picked is drawn");
  await press("Escape");
  assert.equal(await at("picked").count(), 0);
  await tabTo(page, "count-all");
  await press("Enter");
  assert.equal(await changedFrom(page, fewer), springs);

  // The diagnosis names the effect; it is ticked, taken back and done again.
  await tabTo(page, "tab-scatter");
  await press("End");
  await tabTo(page, "diagnose");
  await press("Enter");
  await at("verdict").waitFor();
  await tabTo(page, "tick-named");
  await press("Enter");
  const ticked = await changedFrom(page, springs);
  assert.ok(ticked < springs && (await at(`term-${TERM}`).isChecked()));
  await press("Control+z");
  assert.equal(await heldOut(page), springs);
  await press("Control+Shift+z");
  assert.equal(await heldOut(page), ticked);

  // The session goes home.
  await tabTo(page, "notes");
  await page.keyboard.type("by keyboard");
  await tabTo(page, "save-session");
  const [download] = await Promise.all([page.waitForEvent("download"), press("Enter")]);
  assert.match(await readFile(await download.path(), "utf8"), /by keyboard/);
  assert.equal(await page.evaluate(() => globalThis.pointed), 0, "nothing was pointed at");
  await close();
});
