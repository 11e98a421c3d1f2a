// Parts of the machine and proposed readings picked in 3D. HEXBENCH_BINARY names the program: node tests/machine.test.mjs
// Exits 77 when there is no program or no browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { violations } from "./axe.mjs";
import { browser, workbench } from "./suite.mjs";
import { downloaded, holdBack, judged, loadCase, openPage, settled, tabTo } from "./workbench.mjs";

const STEP_PX = 12;

/** A place over the stage where the note beside the pointer begins like this; the note. */
async function pointAt(page, stage, begin) {
  const { x, y, width, height } = await page.getByTestId(stage).boundingBox();
  for (let dy = 0.15 * height; dy < 0.9 * height; dy += 2 * STEP_PX) {
    for (let dx = 0.1 * width; dx < 0.9 * width; dx += STEP_PX) {
      await page.mouse.move(x + dx, y + dy);
      const note = page.getByTestId(stage).locator(".leg-note");
      if (!(await note.isVisible())) continue;
      const text = await note.textContent();
      if (begin.test(text)) return { x: x + dx, y: y + dy, text };
    }
  }
  return assert.fail(`nothing says ${begin}`);
}

const pressed = (page) => page.locator('[data-testid=parts] [aria-pressed="true"]').allTextContents();

test("a leg clicked in 3D selects its readings everywhere, a second click and Escape take them back", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, "mujoco-foundation");
  await judged(page);
  await settled(page);
  await at("tab-machine").click();
  await at("chart-machine").scrollIntoViewIfNeeded();
  const picture = () =>
    at("chart-machine")
      .locator("canvas")
      .evaluate((canvas) => canvas.toDataURL());
  const found = await pointAt(page, "chart-machine", /^leg [2-5]:/);
  const leg = found.text[4];
  await page.mouse.click(found.x, found.y);
  assert.deepEqual(await pressed(page), [`Leg ${leg}`]);
  assert.match(await at("picked-count").textContent(), new RegExp(`selected: \\d+ readings, missed most in leg ${leg}$`));
  await page.mouse.move(2, 2);
  const chosen = await picture();
  assert.deepEqual(await violations(page), []);

  // The table has the same readings, and the leg that is missed most is this one in every row of them.
  await at("tab-readings").click();
  const all = at("all-readings");
  if (await all.count()) await all.click();
  const rows = await page
    .locator("[data-testid=readings] tbody tr")
    .evaluateAll((list) => list.map((row) => ({ chosen: row.classList.contains("chosen"), leg: row.cells[3].textContent })));
  assert.ok(rows.some((row) => row.chosen));
  for (const row of rows) assert.equal(row.chosen, row.leg === leg, JSON.stringify(row));
  await at("tab-numbers").click();
  assert.equal(await page.locator("[data-testid=legs] tr.chosen th").textContent(), leg);

  // Back at the machine it is marked until it is clicked again.
  await at("tab-machine").click();
  assert.deepEqual(await pressed(page), [`Leg ${leg}`]);
  await at(`leg-${leg}`).click();
  assert.deepEqual([await pressed(page), await at("picked").count()], [[], 0]);
  await page.mouse.move(2, 2);
  await at("chart-machine").focus();
  assert.notEqual(await picture(), chosen, "a leg that is selected looks so");

  // By keyboard, and Escape.
  await tabTo(page, `leg-${leg}`);
  await page.keyboard.press("Space");
  assert.deepEqual(await pressed(page), [`Leg ${leg}`]);
  await page.keyboard.press("Escape");
  assert.deepEqual([await pressed(page), await at("picked").count()], [[], 0]);

  // A press that turns the machine picks nothing.
  const again = await pointAt(page, "chart-machine", /^leg/);
  await page.mouse.move(again.x, again.y);
  await page.mouse.down();
  await page.mouse.move(again.x + 40, again.y, { steps: 4 });
  await page.mouse.up();
  assert.equal(await at("picked").count(), 0);
  await close();
});

test("the arrow of the load selects the readings under that load", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, "mujoco-foundation");
  await judged(page);
  await settled(page);
  await at("tab-machine").click();
  await at("chart-machine").scrollIntoViewIfNeeded();
  const said = await at("machine-text").textContent();
  const found = await pointAt(page, "chart-machine", /^load/);
  await page.mouse.click(found.x, found.y);
  assert.deepEqual(await pressed(page), ["Load"]);
  assert.match(await at("picked-count").textContent(), /under the same load$/);
  assert.equal(await at("machine-text").textContent(), said, "the condition shown stays");
  await at("tab-readings").click();
  const loads = await page.locator("[data-testid=readings] tr.chosen").evaluateAll((rows) => rows.map((row) => row.cells[5].textContent));
  assert.ok(loads.length > 0 && new Set(loads).size === 1, loads.join("; "));
  await close();
});

/** Powers of ten beyond which odds end, and what stands there. */
const OVERWHELMING = 4;
const SURE = "> 10 000 : 1";

test("a plan is made in 3D: a reading picked marks its row, and fewer or more readings change the odds", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, "paper-protocol");
  await settled(page);
  await at("tab-diagnosis").click();
  await at("diagnose").click();
  await judged(page);
  await at("plan-rows").waitFor();
  const rows = () => page.locator("[data-testid=plan-rows] tbody tr").count();
  const first = () => page.locator("[data-testid=plan-odds] [data-odds]").first();
  const odds = async () => Number(await first().getAttribute("data-odds"));
  const newOdds = async (old) => {
    await page.waitForFunction((before) => {
      const told = document.querySelector("[data-testid=plan-odds]");
      return told?.dataset.stale === "false" && told.querySelector("[data-odds]")?.dataset.odds !== before;
    }, String(old));
    return odds();
  };
  const proposed = await odds();
  const told = await first().textContent();
  assert.ok(proposed > 0 && (await rows()) > 0);
  assert.deepEqual(await violations(page), []);

  // Hovering in 3D marks the row; a click keeps it marked; the row marks the reading in 3D.
  await at("chart-plan").scrollIntoViewIfNeeded();
  const picture = () =>
    at("chart-plan")
      .locator("canvas")
      .evaluate((canvas) => canvas.toDataURL());
  const found = await pointAt(page, "chart-plan", /^reading \d+, /);
  const reading = /^reading (\d+),/.exec(found.text)[1];
  const chosen = () => page.locator("[data-testid=plan-rows] tr.chosen button[aria-pressed]").allTextContents();
  assert.deepEqual(await chosen(), [reading]);
  await page.mouse.click(found.x, found.y);
  await page.mouse.move(2, 2);
  assert.deepEqual(await chosen(), [reading]);
  assert.equal(await at(`plan-${reading}`).getAttribute("aria-pressed"), "true");
  const picked = await picture();
  await at(`plan-${reading}`).click();
  await page.mouse.move(2, 2);
  await at("chart-plan").focus();
  assert.deepEqual(await chosen(), []);
  assert.notEqual(await picture(), picked, "a reading that is picked looks so");

  // Once less, and back: the odds fall and return; the number before is grey until the new one is there.
  const letGo = await holdBack(page, /\/plan$/);
  const times = Number(await at("times-1").textContent());
  await at("less-1").click();
  assert.equal(Number(await at("times-1").textContent()), times - 1);
  await page.locator('[data-testid=plan-odds][data-stale="true"].old').waitFor();
  assert.equal(await odds(), proposed, "the old number stays until the new one is there");
  letGo();
  const fewer = await newOdds(proposed);
  const fewerShown = await first().textContent();
  if (fewer > OVERWHELMING) assert.deepEqual([told, fewerShown], [SURE, SURE], "beyond that odds say no more");
  else assert.notEqual(fewerShown, told, "the odds shown change");
  await page.unroute(/\/plan$/);
  assert.ok(fewer < proposed, `${fewer} with a reading less, ${proposed} before`);
  await at("more-1").click();
  const same = await newOdds(fewer);
  assert.ok(Math.abs(same / proposed - 1) < 1e-6, `${same} ${proposed}`);
  await at("more-1").click();
  const more = await newOdds(same);
  assert.ok(more > proposed, `${more} with a reading more, ${proposed} before`);
  const sheet = await downloaded(page, "export-run-sheet");
  const all = await page.locator("[data-testid^=times-]").allTextContents();
  const sum = all.reduce((total, count) => total + Number(count), 0);
  assert.equal(sheet.text.trim().split("\n").length - 1, sum, "the run sheet is that of the plan");

  // Another number is another plan.
  // The table and the machine are drawn anew while it is typed.
  await at("plan-number").fill("12");
  await page.locator("[data-testid=plan-rows] tbody tr").first().hover();
  await page.mouse.move(2, 2);
  assert.equal(await at("plan-number").inputValue(), "12", "what is typed stays");
  await at("plan-number").press("Enter");
  const twelve = await newOdds(more);
  console.log(`# log10 odds ${fewer.toFixed(2)} / ${proposed.toFixed(2)} / ${more.toFixed(2)}, of twelve readings ${twelve.toFixed(2)}`);
  assert.ok(twelve > proposed);
  // Half of the time holds fewer readings, which let fewer effects show; slower changes of load take longer.
  const minutes = async () => {
    const [, hours, rest] = /^(?:(\d+) h )?(\d+) min$/.exec(await at("plan-takes").textContent());
    return 60 * Number(hours ?? 0) + Number(rest);
  };
  const long = await minutes();
  const total = () => at("plan-number").inputValue().then(Number);
  const before = await total();
  const sizes = () => page.locator("[data-testid=plan-visible] details tbody tr").allTextContents();
  const shown = await sizes();
  assert.ok(shown.length > 10, `${shown.length} parameters`);
  await at("plan-hours").fill(String(long / 120));
  await at("plan-hours").press("Enter");
  const fitting = await newOdds(twelve);
  assert.ok((await minutes()) <= long / 2 + 1 && (await total()) < before, `${await minutes()} of ${long} min`);
  assert.notDeepEqual(await sizes(), shown);
  const half = await minutes();
  await at("pace-load_change_s").fill("600");
  await at("pace-load_change_s").press("Enter");
  await page.waitForFunction((told) => document.querySelector("[data-testid=plan-takes]")?.textContent !== told, `${half} min`);
  assert.ok((await minutes()) > half + 5, `${await minutes()} after ${half} min`);
  await at("plan-reset").click();
  assert.ok(Math.abs((await newOdds(fitting)) / proposed - 1) < 1e-6);
  assert.deepEqual(await violations(page), []);
  await close();
});
