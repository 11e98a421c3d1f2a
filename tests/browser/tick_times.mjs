// Time from a tick to the new error on the screen: node tests/browser/tick_times.mjs FILE (a page for docs).
// HEXBENCH_BINARY names the program.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import { changedFrom, heldOut, judged, missing, openPage, startBrowser, startWorkbench } from "../../crates/workbench/ui/tests/workbench.mjs";

const SCENE = "scenes/hidden-1";
/** Poses of the scene: twelve readings at each; the last make a file as long as the workbench takes. */
const POSES = [18, 84, 834, 4166];
const TERMS = ["base-compliance", "leg-nonlinearity", "creep", "load-offset"];
/** Poses up to which poses are left out in turn: beyond, a tick of a term that bends lasts minutes. */
const IN_TURN = 834;
/** Ticks of each term; the median is told. The first of a page also warms up what draws. */
const TIMES = 5;

const reason = missing();
if (reason !== "") {
  console.log(`Nothing can be timed: ${reason}`);
  process.exit(77);
}

const median = (all) => [...all].sort((a, b) => a - b)[Math.floor(all.length / 2)];

/** Ticks of one term beside the springs: ms on the screen, and of them ms on the server. */
async function ticks({ page, at }, term) {
  const all = [];
  for (let k = 0; k <= TIMES; k++) {
    const springs = await heldOut(page);
    const known = await page.evaluate(() => performance.getEntriesByName("tick").length);
    await at(`term-${term}`).click();
    await changedFrom(page, springs);
    await page.waitForFunction((n) => performance.getEntriesByName("tick").length > n, known);
    const last = await page.evaluate(() => {
      const { duration, detail } = performance.getEntriesByName("tick").at(-1);
      return [duration, detail.server];
    });
    if (k > 0) all.push(last);
    const ticked = await heldOut(page);
    await at("undo").click();
    await changedFrom(page, ticked);
  }
  return [0, 1].map((part) => median(all.map((one) => one[part])));
}

/** The story of a step in one picture, asked for as the page does: ms on the server, the median. */
async function pictures({ page }, term) {
  const all = [];
  for (let k = 0; k <= TIMES; k++) {
    all.push(
      await page.evaluate(async (terms) => {
        const authorization = `Bearer ${sessionStorage.getItem("hexbench-token")}`;
        const headers = { authorization, "content-type": "application/json" };
        const ask = async (path, body) => (await fetch(path, { method: "POST", headers, body: JSON.stringify(body) })).json();
        globalThis.timed ??= await ask("/api/benches", { from: "given" });
        return (await ask(`/api/benches/${globalThis.timed.id}/picture`, { terms, own: [], exclude: [] })).milliseconds;
      }, [term]),
    );
  }
  return median(all.slice(1));
}

/** Rows of the table for a file of this many poses, judged by a file of its own or by poses left out. */
async function rows(folder, poses, held) {
  const [hexapod, data, holdout] = ["hexapod.toml", "measurements.csv", "holdout.csv"].map((name) => join(folder, name));
  const workbench = await startWorkbench(hexapod, data, ...(held ? ["--holdout", holdout] : []));
  const browser = await startBrowser();
  const opened = await openPage(browser, workbench.url);
  // The diagnosis that begins by itself shares the cores: ticks are timed without it.
  await judged(opened.page);
  const found = [];
  for (const term of TERMS) {
    const [screen, server] = await ticks(opened, term);
    const row = [12 * poses, held ? "holdout file" : "poses in turn", term, screen.toFixed(0), server.toFixed(0)];
    console.log(row.join("  "));
    found.push(`| ${row.join(" | ")} |`);
  }
  if (held) drawn.push(`| ${12 * poses} | ${(await pictures(opened, TERMS[0])).toFixed(0)} |`);
  await opened.close();
  await browser.close();
  await workbench.stop();
  return found;
}

const table = [];
const drawn = [];
for (const poses of POSES) {
  const folder = mkdtempSync(join(tmpdir(), "hexbench-ticks-"));
  const words = ["simulate", SCENE, "-o", folder, "--force", "--poses", String(poses)];
  execFileSync(process.env.HEXBENCH_BINARY, words, { stdio: ["ignore", "ignore", "inherit"] });
  for (const held of poses > IN_TURN ? [true] : [true, false]) table.push(...(await rows(folder, poses, held)));
  rmSync(folder, { recursive: true });
}
const text = `# From a tick to the new error

Written by \`scripts/tick_times.sh\`; do not edit.

Milliseconds from the click on a term to the frame in which the new held-out error, the residual sheet and the numbers are drawn, and how many of
them the server took; median of ${TIMES} ticks. Headless Chromium that draws by software, ${cpus().length} cores (${cpus()[0].model}). The readings are those
of \`${SCENE}\` with more poses, no two conditions equal but for their repeats. "Poses in turn": without a holdout file every tick fits the model
twelve times more, each time without some of the poses.

| readings | judged by | term | on the screen, ms | on the server, ms |
|---|---|---|---|---|
${table.join("\n")}

The story of a step in one picture (\`${TERMS[0]}\`, with a holdout file), which the page asks for after the number is drawn:

| readings | on the server, ms |
|---|---|
${drawn.join("\n")}
`;
writeFileSync(process.argv[2], text);
