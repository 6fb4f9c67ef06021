// Makes one self-contained page of the compiled library, the modules and the style sheet: `node web/build.js`.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";

import { toText } from "./page/packed.js";

const build = new URL("../build/web/", import.meta.url);
const page = new URL("page/", import.meta.url);
const modules = fileURLToPath(new URL("node_modules/", build));
const { buildSync } = createRequire(new URL("package.json", build))("esbuild");

/** @param {string} entry */
const bundled = (entry) =>
  buildSync({
    entryPoints: [fileURLToPath(new URL(entry, page))],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    charset: "utf8",
    target: "es2022",
    nodePaths: [modules],
    legalComments: "none", // their texts are in the page
  }).outputFiles[0].text;

/** @param {string | URL} file */
const text = (file) => readFileSync(file, "utf8");
/** @param {string} script  in which a closing tag would end the element */
const inScript = (script) => script.replaceAll("</script", "<\\/script");

const styles = buildSync({
  stdin: { contents: text(`${modules}uplot/dist/uPlot.min.css`) + text(new URL("style.css", page)), loader: "css" },
  minify: true,
  write: false,
}).outputFiles[0].text;

/** Told the size, for which the decoder else makes room of 128 MB: that takes 0.2 s for each part. @param {Uint8Array} bytes */
const packed = (bytes) =>
  toText(execFileSync("zstd", ["--ultra", "-22", `--stream-size=${bytes.length}`, "--stdout"], { input: bytes, maxBuffer: 1 << 26 }));

/** The accelerations [g] of the record with which the page opens, if the package that has it is installed. */
function sampleRecord() {
  const find = 'from stickslip.samples import sample_files; print(next(str(f) for f in sample_files() if f.stem == "Kobe_1995_TAK-090"))';
  try {
    const file = execFileSync("python", ["-c", find], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }).trim();
    const lines = text(file).split(/\r?\n/).filter((line) => /^[\d.]/.test(line));
    return Buffer.from(lines.map((line) => line.split(",")[1]).join("\n"));
  } catch {
    console.warn("stickslip.html opens with a pulse: no sample records (pip install stickslip[records])");
    return null;
  }
}
const sample = sampleRecord();

/** @type {Record<string, string>} */
const parts = {
  STYLE: styles,
  LICENSES: [
    `stickslip\n\n${text(new URL("../LICENSE", import.meta.url))}`,
    `uPlot, which draws the plots\n\n${text(new URL("../licenses/uPlot.txt", import.meta.url))}`,
    `fzstd, which unpacks the library\n\n${text(new URL("../licenses/fzstd.txt", import.meta.url))}`,
    `kissfft, whose header is compiled in\n\n${text(new URL("../licenses/kissfft.txt", import.meta.url))}`,
    "Highway, whose headers are compiled in, is under the Apache License 2.0 (https://www.apache.org/licenses/LICENSE-2.0); " +
      "Emscripten's libraries, musl and libc++, are under the MIT License and the Apache License 2.0 with LLVM exceptions.",
    ...(sample ? ["The sample record has the accelerations of the file Kobe_1995_TAK-090 of the package pyslammer."] : []),
  ]
    .join("\n\n")
    .replace(/[&<>]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[c] ?? c),
  LIBRARY: packed(readFileSync(new URL("stickslip.wasm", build))),
  SAMPLE: sample ? packed(sample) : "",
  WORKER: packed(Buffer.from(bundled("worker.js"))),
  PAGE: packed(Buffer.from(bundled("main.js"))),
  LOADER: inScript(bundled("loader.js")),
};

let html = text(new URL("page.html", page));
for (const [name, part] of Object.entries(parts)) html = html.replace(`/* ${name} */`, () => part);
const file = new URL("stickslip.html", build);
writeFileSync(file, html);

const size = Buffer.byteLength(html);
console.log(`stickslip.html: ${(size / 1000).toFixed(0)} kB`);
if (size > 620_000) {
  console.error("the page must be below 620 kB");
  process.exit(1);
}
