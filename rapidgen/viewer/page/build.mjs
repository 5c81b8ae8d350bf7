// The page's sources become rapidgen/viewer/assets: page.js and plot.js with their styles, index.html, and
// the licences of what is bundled.
import { build } from "esbuild";
import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";

const out = new URL("../assets/", import.meta.url).pathname;
rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const { metafile } = await build({
  entryPoints: { page: "src/main.ts", plot: "src/plot.ts" },
  outdir: out,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  legalComments: "none",
  logLevel: "warning",
  metafile: true,
});
cpSync("static/", out, { recursive: true });

const bundled = Object.keys(metafile.inputs)
  .map((path) => /^node_modules\/(?:@[^/]+\/)?[^/]+/.exec(path)?.[0])
  .filter((folder) => folder !== undefined);
const texts = [...new Set(bundled)].sort().map((folder) => {
  const { name, version, license } = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  // Without a file of its own: the text that this project goes with, too.
  if (file === undefined && license !== "Apache-2.0") throw new Error(`${name}: ${license} has no text`);
  const text = file === undefined ? "Apache License 2.0" : readFileSync(`${folder}/${file}`, "utf8").trim();
  return `${name} ${version}\n\n${text}\n`;
});
writeFileSync(`${out}licences.txt`, texts.join("\n\n"));
