// One workbench and one browser for a file of tests, which ends with 77 where there is no program or no browser.
import { after, before } from "node:test";
import { missing, startBrowser, startWorkbench } from "./workbench.mjs";

const reason = missing();
if (reason !== "") {
  console.log(`These tests cannot run: ${reason}`);
  process.exit(77);
}

export let workbench;
export let browser;
before(async () => {
  workbench = await startWorkbench();
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await workbench?.stop();
});
