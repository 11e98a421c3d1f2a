// A file that does not mean what it says is found out before anything is asked, read as its finding says, and read as written again; and "Is it noise?" shares the
// selection. HEXBENCH_BINARY names the program: node tests/misread.test.mjs. Exits 77 when there is no program or no browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { reversedFiles } from "./states.mjs";
import { browser, workbench } from "./suite.mjs";
import { changedFrom, downloaded, heldOut, judged, loadCase, openPage, settled } from "./workbench.mjs";

const CASE = "mujoco-foundation";
const TERM = "base-compliance";
const WAY = "deflection-sign=reversed";

test("a misread file is read as its finding says, the effect is named, and every output records it", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await at("files").setInputFiles(reversedFiles(CASE));
  await at("open-files").click();
  await at("held-out").waitFor();
  await at("notes").fill("which way round?");
  await at("tab-diagnosis").click();
  await at("diagnose").click();
  await at("verdict").waitFor();
  assert.equal(await at("verdict").getAttribute("data-word"), "measurement");
  assert.match(await at("section-findings").textContent(), /Sign of the deflections/);
  assert.ok(await at("picture-wide").locator("svg").isVisible(), "a misread file has its picture");
  const order = await page.evaluate(() => {
    const [verdict, ways, picture] = ["verdict", "ways", "picture"].map((id) => document.querySelector(`[data-testid=${id}]`));
    const isBefore = (a, b) => (a.compareDocumentPosition(b) & Node.DOCUMENT_POSITION_FOLLOWING) !== 0;
    return [isBefore(verdict, picture), isBefore(ways, picture)];
  });
  assert.deepEqual(order, [true, true], "what is wrong with the files comes first");
  const as_written = await heldOut(page);

  await at(`read-as-${WAY}`).click();
  await at("read-as").waitFor();
  await page.waitForFunction(() => document.querySelector("[data-testid=verdict]")?.dataset.word === "named");
  assert.match(await at("read-as").textContent(), new RegExp(WAY));
  assert.equal(await at("notes").inputValue(), "which way round?");
  const springs = await heldOut(page);
  await at("tick-named").click();
  const ticked = await changedFrom(page, springs);
  console.log(
    `# error as written ${as_written.toFixed(3)}, read so ${springs.toFixed(3)}, with ${TERM} ${ticked.toFixed(3)} times the noise`,
  );
  assert.ok(ticked < springs && (await at(`term-${TERM}`).isChecked()));
  assert.match((await downloaded(page, "export-model")).text, new RegExp(`read_as = \\[\\s*"${WAY}"`));
  assert.deepEqual(JSON.parse((await downloaded(page, "export-diagnosis")).text).read_as, [WAY]);
  assert.match((await downloaded(page, "export-report")).text, new RegExp(`read with this correction: ${WAY}`));
  const session = await downloaded(page, "save-session");
  assert.deepEqual(JSON.parse(session.text).read_as, [WAY]);

  await page.reload();
  await at("read-as").waitFor();
  assert.match(await at("read-as").textContent(), new RegExp(WAY), "a reload reads them the same way");
  await at("read-as-written").click();
  await at("read-as").waitFor({ state: "detached" });
  assert.equal(await heldOut(page), as_written);

  // The session reads the files its own way, whatever way they are read here, and so do its steps.
  const file = { name: "session.json", mimeType: "application/json", buffer: Buffer.from(session.text) };
  await at("open-session").setInputFiles(file);
  await at("read-as").waitFor();
  await page.locator(`[data-testid=term-${TERM}]:checked`).waitFor({ state: "attached" });
  assert.equal(await heldOut(page), ticked);
  assert.equal(await at("notes").inputValue(), "which way round?");
  const again = await downloaded(page, "save-session");
  assert.deepEqual(
    JSON.parse(again.text).steps.map(({ selection }) => selection),
    JSON.parse(session.text).steps.map(({ selection }) => selection),
  );
  await close();
});

test("what is wrong with the files stands above everything before anything is asked, and one click reads them as they are meant", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await at("files").setInputFiles(reversedFiles(CASE));
  await at("open-files").click();
  await at("file-check").waitFor();
  assert.equal(await at("file-check").getAttribute("data-ready"), "false");
  assert.match(await at("check-findings").textContent(), /Sign of the deflections/);
  const isFirst = await page.evaluate(() => {
    const [check, number] = ["file-check", "held-out-box"].map((id) => document.querySelector(`[data-testid=${id}]`));
    return check.getBoundingClientRect().bottom <= number.getBoundingClientRect().top;
  });
  assert.ok(isFirst, "no number stands above it");
  await page.waitForFunction(() => {
    const [number, hint] = [".number", ".hint"].map((part) => document.querySelector(`[data-testid=held-out-box] ${part}`));
    return getComputedStyle(number).color === getComputedStyle(hint).color;
  });
  await at(`check-read-as-${WAY}`).click();
  await at("read-as").waitFor();
  await at("file-check").waitFor({ state: "detached" });
  await close();
});

test("sound files have nothing above their number", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  const checked = page.waitForResponse(/\/check$/);
  await loadCase(page, CASE);
  assert.equal((await (await checked).json()).ready, true);
  await settled(page);
  assert.equal(await at("file-check").count(), 0);
  await close();
});

test("the one selection is seen and made in the charts of the noise as well", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await loadCase(page, CASE);
  await settled(page);
  await judged(page);
  await at("tab-readings").click();
  await page.locator("[data-testid^=pick-][aria-pressed]").first().click();
  const picked = await at("picked").textContent();
  await at("tab-scatter").click();
  const drawn = () =>
    at("chart-scatter")
      .locator("canvas")
      .evaluate((canvas) => canvas.toDataURL());
  await at("chart-scatter").locator("canvas").waitFor();
  const one = await drawn();
  assert.equal(await at("picked").textContent(), picked);
  await page.keyboard.press("Escape");
  assert.notEqual(await drawn(), one, "what is picked is drawn");
  // A rectangle over the upper end of the normal plot picks conditions with a residual that large.
  const box = await at("chart-scatter").locator("canvas").boundingBox();
  const point = ([x, y]) => [box.x + x * box.width, box.y + y * box.height];
  await page.mouse.move(...point([0.78, 0.12]));
  await page.mouse.down();
  await page.mouse.move(...point([0.9, 0.3]));
  await page.mouse.move(...point([0.99, 0.5]));
  await page.mouse.up();
  assert.match(await at("picked-count").textContent(), /^\d+ conditions? selected/);
  await close();
});
