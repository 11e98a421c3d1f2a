// The installed Chromium, for the tests of the pages and of the workbench.
import { existsSync } from "node:fs";

const BROWSERS = [process.env.HEXBENCH_CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
const QUIET = ["--no-first-run", "--disable-quic", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
/** On a busy machine Chromium sometimes crashes as it starts, before any page is open. */
const LAUNCHES = 3;

export function browserPath() {
  return BROWSERS.find((path) => path && existsSync(path));
}

/** A browser, started by `driver`, the `chromium` of playwright-core. A crash in a page later is a failure; one at the start is tried again. */
export async function launch(driver, ...args) {
  const options = { executablePath: browserPath(), args: ["--no-sandbox", ...QUIET, ...args] };
  for (let left = LAUNCHES - 1; left > 0; left--) {
    try {
      return await driver.launch(options);
    } catch (error) {
      console.log(`# Chromium did not start and is tried again: ${error.message.split("\n")[0]}`);
    }
  }
  return driver.launch(options);
}
