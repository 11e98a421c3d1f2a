// Builds the page into a folder: node build.mjs FOLDER
import { copyFile, mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const folder = process.argv[2];
if (!folder) {
  console.error("node build.mjs FOLDER");
  process.exit(2);
}

/** Packages of which parts end in the bundle, with the files that hold their licences. */
const bundled = [
  ["echarts", ["LICENSE", "NOTICE", "licenses/LICENSE-d3"]],
  ["zrender", ["LICENSE"]],
  ["tslib", ["LICENSE.txt"]],
  ["preact", ["LICENSE"]],
];

/** The licence texts of all packages, each under its name and version. */
async function licences() {
  const parts = [];
  for (const [name, files] of bundled) {
    const root = join(here, "node_modules", name);
    const { version, license } = JSON.parse(await readFile(join(root, "package.json"), "utf8"));
    const texts = await Promise.all(files.map((file) => readFile(join(root, file), "utf8")));
    parts.push(`${name} ${version} (${license})\n${"=".repeat(72)}\n\n${texts.map((text) => text.trim()).join("\n\n")}\n`);
  }
  return parts.join("\n\n");
}

/** Names of the packages esbuild took something from. */
function packagesIn(metafile) {
  const names = Object.keys(metafile.inputs).map((path) => /node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(path)?.[1]);
  return new Set(names.filter(Boolean));
}

await mkdir(folder, { recursive: true });
const result = await build({
  absWorkingDir: here,
  entryPoints: { app: "src/main.tsx" },
  outdir: folder,
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  jsx: "automatic",
  jsxImportSource: "preact",
  legalComments: "none",
  define: { "process.env.NODE_ENV": '"production"' },
  metafile: true,
});
const listed = new Set(bundled.map(([name]) => name));
const missing = [...packagesIn(result.metafile)].filter((name) => !listed.has(name));
if (missing.length > 0) {
  console.error(`no licence text is listed for: ${missing.join(", ")}`);
  process.exit(1);
}
await writeFile(join(folder, "licences.txt"), await licences());
for (const name of ["index.html", "favicon.svg"]) {
  await copyFile(join(here, "src", name), join(folder, name));
}
for (const [path, { bytes }] of Object.entries(result.metafile.outputs)) {
  console.log(`${path.split("/").at(-1)} ${Math.round(bytes / 1000)} kB`);
}
