// Pages of diagnose, compare, runs and a campaign book, opened from disk in a real browser without network.
// HEXBENCH_BINARY names the program, HEXBENCH_ARTEFACTS a folder for pictures. Exits 77 when something needed is missing.
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { violations } from "../../crates/workbench/ui/tests/axe.mjs";
import { makePages, missing, openFile, startBrowser } from "./pages.mjs";
import { blind, countPrinted, countShown } from "./printed.mjs";

const reason = missing();
if (reason !== "") {
  console.log(`The pages cannot be opened: ${reason}`);
  process.exit(77);
}

const NARROW = { width: 360, height: 740 };
const LEAST_FIGURES = { diagnosis: 12, comparison: 9, runs: 2, book: 3 };
/** Drawings on a telephone, panels of a figure one by one. */
const LEAST_NARROW = { diagnosis: 9, comparison: 8, runs: 2, book: 2 };
/** Pages of which a part is folded. */
const FOLDED = ["diagnosis", "comparison"];
/** Least contrast of text and its ground: WCAG 2.2, level AA. */
const LEAST_CONTRAST = 4.5;

/** Colours that carry the story: data before and with the effect, bars of what is well and what is not. */
const TELLING = {
  diagnosis: { before: [0xd5, 0x5e, 0x00], after: [0x00, 0x72, 0xb2], good: [0x00, 0x56, 0x3f], bad: [0xa8, 0x3e, 0x00] },
  comparison: { before: [0xd5, 0x5e, 0x00], after: [0x00, 0x72, 0xb2] },
  runs: { before: [0xd5, 0x5e, 0x00], after: [0x00, 0x72, 0xb2] },
  book: { alarm: [0xd5, 0x5e, 0x00], level: [0x00, 0x72, 0xb2] },
};
/** Least share of the pixels of a colour on the screen that is on paper as well: figures are a little smaller there. */
const LEAST_PRINTED = 0.6;

const pictures = process.env.HEXBENCH_ARTEFACTS;
let pages;
let browser;
before(async () => {
  pages = makePages();
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  pages?.remove();
});

for (const name of Object.keys(LEAST_FIGURES)) {
  test(`${name}: opens from disk, asks for nothing, complains of nothing`, async () => {
    const { page, faults, close } = await openFile(browser, pages[name]);
    assert.equal((await unfold(page)) > 0, FOLDED.includes(name), "folded parts");
    const figures = await page.locator("figure > svg, figure > div").filter({ visible: true }).all();
    assert.ok(figures.length >= LEAST_FIGURES[name], `${figures.length} figures`);
    for (const figure of figures) {
      const box = await figure.boundingBox();
      assert.ok(box.width > 200 && box.height > 80, `a figure of ${box.width} x ${box.height}`);
      assert.ok((await figure.locator("title").first().textContent()).length > 10, "a figure without a name");
    }
    assert.deepEqual(faults, []);
    await picture(page, `${name}-light`);
    await close();
  });

  test(`${name}: fits a telephone without scrolling sideways`, async () => {
    const { page, faults, close } = await openFile(browser, pages[name], { viewport: NARROW });
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= NARROW.width, `${width} px wide on ${NARROW.width} px`);
    assert.deepEqual(faults, []);
    await picture(page, `${name}-narrow`);
    await close();
  });

  test(`${name}: drawings on a telephone have text of at least 11 px, and none lies over another`, async () => {
    const { page, close } = await openFile(browser, pages[name], { viewport: { width: 390, height: 844 } });
    await unfold(page);
    const shown = page.locator("figure svg").filter({ visible: true });
    const drawn = await shown.evaluateAll((all) =>
      all.map((svg) => {
        const scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
        const texts = [...svg.querySelectorAll("text")];
        const boxes = texts.map((text) => text.getBoundingClientRect());
        const isOver = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 3 && b.top < a.bottom - 3;
        const over = boxes.flatMap((a, i) => boxes.slice(i + 1).map((b, k) => isOver(a, b) && `${texts[i].textContent} | ${texts[i + 1 + k].textContent}`));
        return {
          least: scale * Math.min(...texts.map((text) => Number.parseFloat(getComputedStyle(text).fontSize))),
          beyond: Math.max(...boxes.map(({ right }) => right)),
          over: over.filter(Boolean),
        };
      }),
    );
    assert.ok(drawn.length >= LEAST_NARROW[name], `${drawn.length} drawings for a telephone`);
    for (const { least, beyond, over } of drawn) {
      assert.ok(least >= 10.95, `text of ${least.toFixed(1)} px`);
      assert.ok(beyond <= 390, `text that ends at ${beyond} px`);
      assert.deepEqual(over, []);
    }
    await close();
  });

  test(`${name}: the theme is switched by keyboard, and text can be read in both`, async () => {
    const { page, close } = await openFile(browser, pages[name], { colorScheme: "light" });
    const light = await colours(page);
    await page.locator("#auto").focus();
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowRight");
    assert.ok(await page.locator("#dark").isChecked());
    const dark = await colours(page);
    assert.ok(luminance(light.paper) > 0.8 && luminance(dark.paper) < 0.1, JSON.stringify({ light, dark }));
    for (const { paper, ...inks } of [light, dark]) {
      for (const [ink, colour] of Object.entries(inks)) {
        assert.ok(contrast(paper, colour) >= LEAST_CONTRAST, `${ink}: ${contrast(paper, colour).toFixed(2)}`);
      }
    }
    await picture(page, `${name}-dark`);
    await close();
  });

  test(`${name}: breaks no rule of accessibility, light or dark`, async () => {
    const { page, close } = await openFile(browser, pages[name], { viewport: { width: 1440, height: 900 } });
    await unfold(page);
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({ colorScheme });
      assert.deepEqual(await violations(page), [], colorScheme);
    }
    await close();
  });

  test(`${name}: prints with every figure, in light colours`, async () => {
    const { page, close } = await openFile(browser, pages[name], { colorScheme: "dark" });
    await page.emulateMedia({ media: "print", colorScheme: "dark" });
    assert.ok(luminance((await colours(page)).paper) > 0.8, "paper is dark");
    const hidden = await page.locator("figure").evaluateAll((all) => all.filter((s) => s.querySelector("svg")?.checkVisibility() !== true).length);
    assert.equal(hidden, 0, "figures that are folded on paper too");
    const paper = 700;
    await page.setViewportSize({ width: paper, height: 1000 });
    const ends = await page.locator("figure svg, table").evaluateAll((all) => all.map((s) => s.getBoundingClientRect().right));
    assert.ok(Math.max(...ends) <= paper, `a figure or a table ends at ${Math.max(...ends)} px of ${paper} px`);
    const pdf = await page.pdf({ format: "A4", path: pictures && join(pictures, `${name}.pdf`) });
    const sheets = pdf.toString("latin1").match(/\/Type\s*\/Page\b/g)?.length ?? 0;
    assert.ok(sheets >= 2 && sheets <= 30, `${sheets} sheets`);
    await close();
  });

  test(`${name}: prints what the screen shows, in color, with the browser's usual settings`, { skip: blind() || false }, async () => {
    const { page, close } = await openFile(browser, pages[name], { colorScheme: "light" });
    await page.emulateMedia({ media: "print" });
    await page.setViewportSize({ width: 700, height: 1000 });
    const decoder = await page.context().newPage();
    const shown = await countShown(decoder, await page.screenshot({ fullPage: true }), TELLING[name]);
    const printed = countPrinted(await page.pdf({ format: "A4" }), TELLING[name]);
    console.log(`# pixels of ${name}: shown ${JSON.stringify(shown)}, printed ${JSON.stringify(printed)}`);
    for (const [colour, count] of Object.entries(shown)) {
      assert.ok(count > 0, `${colour} is not on the page: the test asks for nothing`);
      assert.ok(printed[colour] >= LEAST_PRINTED * count, `${colour}: ${printed[colour]} pixels on paper, ${count} on the screen`);
    }
    await close();
  });
}

/** Opens what is folded, by keyboard; how much that was. */
async function unfold(page) {
  const folded = await page.locator("details").all();
  for (const part of folded) {
    assert.equal(await part.getAttribute("open"), null, "a part that is to be folded is open");
    await part.locator("summary").focus();
    await page.keyboard.press("Enter");
    assert.notEqual(await part.getAttribute("open"), null);
  }
  return folded.length;
}

/** Colours of the page as [red, green, blue]: of the ground of a section, and of what is written on it. */
function colours(page) {
  return page.evaluate(() => {
    const numbers = (text) => text.match(/[\d.]+/g).slice(0, 3).map(Number);
    const style = (selector) => getComputedStyle(document.querySelector(selector));
    return {
      paper: numbers(style("section").backgroundColor),
      text: numbers(style("section").color),
      remark: numbers(style("figcaption").color),
      word: numbers(style(".word").color),
      label: numbers(style("figure svg text").fill),
    };
  });
}

function luminance(rgb) {
  const linear = rgb.map((x) => x / 255).map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}

function contrast(a, b) {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

async function picture(page, name) {
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  await page.screenshot({ path: join(pictures, `${name}.png`), fullPage: true });
}
