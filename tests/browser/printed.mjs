// What stands on paper: sheets of a PDF as pixels, by poppler.
import { execFileSync } from "node:child_process";

/** Pixels of an inch: those of a browser. */
const PER_INCH = 96;
/** Farthest that a channel of a pixel may be from a colour to count as it. */
const NEAR = 24;
const MOST_BYTES = 1 << 30;

/** Why no PDF can be looked at here; empty when one can. */
export function blind() {
  try {
    execFileSync("pdftoppm", ["-v"], { stdio: "ignore" });
    return "";
  } catch {
    return "pdftoppm is not installed (Debian has it in poppler-utils)";
  }
}

/** Writes every sheet of a PDF as a picture: `PATH-1.png` and so on. */
export function drawSheets(pdf, path) {
  execFileSync("pdftoppm", ["-r", String(PER_INCH), "-png", "-", path], { input: pdf });
}

/** Words on all sheets of a PDF, line by line. */
export function printedText(pdf) {
  return execFileSync("pdftotext", ["-layout", "-", "-"], { input: pdf, encoding: "utf8", maxBuffer: MOST_BYTES });
}

/** Pixels of each colour ([red, green, blue], by name) on all sheets of a PDF together. */
export function countPrinted(pdf, colours) {
  const sheets = execFileSync("pdftoppm", ["-r", String(PER_INCH), "-"], { input: pdf, maxBuffer: MOST_BYTES });
  const counts = Object.fromEntries(Object.keys(colours).map((name) => [name, 0]));
  for (let at = 0; at < sheets.length; ) {
    const { first, end } = sheet(sheets, at);
    count(sheets.subarray(first, end), 3, colours, counts);
    at = end;
  }
  return counts;
}

/** Where the pixels of a sheet begin and end: `P6`, width, height, the largest value, then three bytes for each pixel. */
function sheet(sheets, at) {
  const header = /^P6\s+(\d+)\s+(\d+)\s+255\s/.exec(sheets.toString("latin1", at, at + 40));
  if (header === null) throw new Error(`no sheet begins at byte ${at}`);
  const first = at + header[0].length;
  return { first, end: first + 3 * Number(header[1]) * Number(header[2]) };
}

/** Pixels of each colour on a picture (PNG) of the browser, which decodes it. */
export async function countShown(page, png, colours) {
  const raw = await page.evaluate(async (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const picture = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const canvas = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
    canvas.drawImage(picture, 0, 0);
    const { data } = canvas.getImageData(0, 0, picture.width, picture.height);
    return new Promise((resolve) => {
      const reader = new FileReader();
      reader.onload = () => resolve(reader.result.split(",")[1]);
      reader.readAsDataURL(new Blob([data]));
    });
  }, png.toString("base64"));
  const counts = Object.fromEntries(Object.keys(colours).map((name) => [name, 0]));
  count(Buffer.from(raw, "base64"), 4, colours, counts);
  return counts;
}

/** Adds the pixels of each colour, which are `step` bytes apart. */
function count(pixels, step, colours, counts) {
  for (const [name, colour] of Object.entries(colours)) {
    for (let at = 0; at < pixels.length; at += step) {
      if (colour.every((value, channel) => Math.abs(pixels[at + channel] - value) <= NEAR)) counts[name]++;
    }
  }
}
