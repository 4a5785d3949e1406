// Bundles each page's script with its libraries into one: node build.mjs OUT writes OUT/report.js, report.css (the sheets
// that it imports) and report.sha256 (the digest by which the page allows the script, and no other), and view.* alike.
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const out = process.argv[2];
if (!out) {
  console.error("usage: node build.mjs OUT");
  process.exit(2);
}
mkdirSync(out, { recursive: true });

async function bundle(page, entry) {
  const result = await build({
    entryPoints: [fileURLToPath(new URL(`src/${entry}`, import.meta.url))],
    outfile: `${out}/${page}.js`,
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    legalComments: "inline",
    write: false,
  });
  for (const file of result.outputFiles) {
    if (/<\/script|<!--/i.test(file.text)) throw new Error(`${file.path} cannot stand inside a script element`);
    writeFileSync(file.path, file.contents);
  }
  const script = readFileSync(`${out}/${page}.js`);
  writeFileSync(`${out}/${page}.sha256`, createHash("sha256").update(script).digest("base64"));
}

await bundle("report", "main.js");
await bundle("view", "live/main.js");
