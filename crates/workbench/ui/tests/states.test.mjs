// Every state of the page is accessible in both themes and fits a telephone. HEXBENCH_BINARY names the program: node tests/states.test.mjs
// Exits 77 when there is no program or no browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { violations } from "./axe.mjs";
import { WALKS } from "./states.mjs";
import { browser, workbench } from "./suite.mjs";
import { cutTables, fitsWidth, openPage, typedWords } from "./workbench.mjs";

const WIDE = { width: 1440, height: 900 };
const NARROW = { width: 390, height: 844 };

/** Charts and tables are laid out anew after the window has become narrow. */
async function fitsSoon(page) {
  for (let k = 0; k < 20; k++) {
    if ((await fitsWidth(page)) && (await cutTables(page)).length === 0) return true;
    await page.waitForTimeout(100);
  }
  console.log(`# cut: ${await cutTables(page)}`);
  return false;
}

test("the check itself finds a button without a name", async () => {
  const { page, at, close } = await openPage(browser, workbench.url);
  await at("theme").waitFor();
  await page.evaluate(() => document.querySelector("main").append(document.createElement("button")));
  assert.match((await violations(page)).join(), /button-name/);
  await close();
});

for (const { name, refusals, walk } of WALKS) {
  test(`${name}: no state breaks a rule of accessibility, light or dark, and none is wider than a telephone, hides a column there or names a command`, async () => {
    const opened = await openPage(browser, workbench.url, { refusals, viewport: WIDE });
    const { page } = opened;
    let states = 0;
    await walk(opened, async (state) => {
      for (const colorScheme of ["light", "dark"]) {
        await page.emulateMedia({ colorScheme });
        assert.deepEqual(await violations(page), [], `${state}, ${colorScheme}`);
      }
      assert.deepEqual(await typedWords(page), [], `${state} names what can only be typed`);
      await page.setViewportSize(NARROW);
      assert.ok(await fitsSoon(page), `${state} on a telephone`);
      await page.setViewportSize(WIDE);
      states += 1;
    });
    console.log(`# ${name}: ${states} states`);
    assert.ok(states > 0);
    await opened.close();
  });
}
