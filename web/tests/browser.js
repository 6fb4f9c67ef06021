// The page in a headless Chromium, for its tests: what its reader does and sees, and what the native library says.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { after, before, beforeEach } from "node:test";
import { basename, resolve } from "node:path";
import { fileURLToPath } from "node:url";

/** @import { Browser, Page } from "puppeteer-core" */

export const build = new URL("../../build/web/", import.meta.url);
export const samples = fileURLToPath(new URL("samples/", build));
export const screenshots = fileURLToPath(new URL("screenshots/", build));
const address = new URL("stickslip.html", build).href;
const puppeteer = createRequire(new URL("package.json", build))("puppeteer-core");
export const answers = JSON.parse(readFileSync(`${samples}answers.json`, "utf8"));
const python = process.env.PYTHON ?? "python";

/** @type {Browser} */
let browser;
/** @type {Page} */
export let page;
/** What must not happen. @type {string[]} */
export let complaints = [];

before(async () => {
  mkdirSync(screenshots, { recursive: true });
  browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu"],
  });
});
after(() => browser?.close());

beforeEach(async () => {
  complaints = [];
  await page?.close();
  page = await browser.newPage();
  page.on("console", (message) => complaints.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => complaints.push(`error: ${/** @type {Error} */ (error).message}`));
  page.on("request", (request) => {
    if (!/^(data|blob):/.test(request.url()) && request.url().split("#")[0] !== address)
      complaints.push(`request: ${request.url()}`);
  });
});

/** @param {string} [settings]  @param {string} [state]  in which it ends */
export async function open(settings = "", state = "shown") {
  await page.setViewport({ width: 1280, height: 900 });
  await page.goto("about:blank");
  await page.goto(`${address}#${settings}`);
  await settled(state);
}

/** Waits until the page shows what belongs to its settings. */
export const settled = (state = "shown") =>
  page.waitForFunction((wanted) => document.body.dataset.state === wanted, { timeout: 60_000 }, state);

/** Drops files on the page, as from a file manager. @param {...string} names  in the folder of samples, or with their own */
export async function drop(...names) {
  const contents = names.map((name) => [basename(name), readFileSync(resolve(samples, name)).toString("base64")]);
  await page.evaluate((files) => {
    const transfer = new DataTransfer();
    for (const [name = "", base64 = ""] of files)
      transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
    document.body.dataset.state = "busy";
    document.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
  }, contents);
  await page.waitForFunction(() => document.querySelector("#progress")?.textContent === "", { timeout: 60_000 });
  await settled();
}

/** Waits for the path in the plane of the present settings. */
export const pathShown = () => page.waitForFunction(() => document.querySelector("#figure-path[data-state=shown]"), { timeout: 60_000 });

/** A table, in SI units. @returns {Promise<Record<string, number>>} */
export const table = async (id = "numbers") =>
  Object.fromEntries(
    await page.$$eval(`#${id} tr[data-name]`, (rows) =>
      rows.map((row) => [/** @type {HTMLElement} */ (row).dataset.name, Number(/** @type {HTMLElement} */ (row).dataset.si)]),
    ),
  );

/** Ten significant digits. @param {Record<string, number>} found  @param {Record<string, number>} expected */
export function compare(found, expected) {
  for (const [name, value] of Object.entries(expected)) {
    // The margin is a relative difference of accelerations; its error is that of round-off over it.
    const allowed = name.startsWith("margin") ? 1e-12 : 1e-10 * Math.max(Math.abs(value), name === "residual" ? (expected.peak ?? 0) : 0);
    assert.ok(Math.abs((found[name] ?? NaN) - value) <= allowed, `${name}: ${found[name]}, natively ${value}`);
  }
}

/** @param {string} text  of a label in the list of records */
export async function choose(text) {
  await page.evaluate((wanted) => {
    const label = [...document.querySelectorAll("#records label")].find((one) => one.textContent?.includes(wanted));
    label?.querySelector("input")?.click();
  }, text);
  await settled();
}

/** The items of a list. @param {string} id */
export const listed = (id) => page.$$eval(`#${id} li`, (all) => all.map((one) => (one.textContent ?? "").trim()));

/** @param {string} id */
export const textOf = (id) => page.$eval(`#${id}`, (one) => one.textContent ?? "");

/** What a button downloads. @param {string} button  @param {string} ending */
export async function downloaded(button, ending) {
  const folder = mkdtempSync(`${fileURLToPath(build)}download-`);
  const client = await page.createCDPSession();
  await client.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
  await page.click(button);
  const found = () => readdirSync(folder).find((name) => name.endsWith(ending));
  for (let tries = 0; tries < 100 && !found(); ++tries) await new Promise((resolve) => setTimeout(resolve, 100));
  const text = readFileSync(`${folder}/${found()}`, "utf8");
  rmSync(folder, { recursive: true });
  return text;
}

/** What lines of Python print. @param {...string} lines */
export const printed = async (...lines) =>
  execFileSync(python, ["-W", "ignore", "-c", lines.join("\n")], { cwd: samples, encoding: "utf8" })
    .trim()
    .split("\n")
    .at(-1) ?? "";

/** What a command prints. @param {string} line */
export const command = (line) =>
  execFileSync(python, ["-W", "ignore", "-m", "stickslip", ...line.split(" ").slice(1)], { cwd: samples, encoding: "utf8" });

/** Types into a field. @param {string} selector  @param {string} text */
export async function enter(selector, text) {
  await page.$eval(selector, (one) => (/** @type {HTMLInputElement} */ (one).value = ""));
  await page.type(selector, text);
}

/** Four digits, as the page shows them. @param {number} value  in SI units  @param {number} size  of the unit */
export const four = (value, size) => String(Number((value / size).toPrecision(4))).replace("-", "\u2212");
