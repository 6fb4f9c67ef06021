// Carts on the page, against the command and the Python lines.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { test } from "node:test";

import { command, compare, complaints, downloaded, drop, enter, listed, open, page, printed, samples, screenshots, settled, table, textOf } from "./browser.js";

/** Runs both lines of the command of the page. @param {string} lines  @param {string} [more] */
function roll(lines, more = "") {
  const [, json = "", file = "", line = ""] = /^echo '(.*)' > (\S+)\n(stickslip cart .*)$/.exec(lines) ?? [];
  writeFileSync(`${samples}${file}`, json);
  return JSON.parse(command(`${line} --json${more}`)).results;
}

/** The numbers of the table by the names of the command. @type {[string, string][]} */
const NAMES = [
  ["center", "peak_m"],
  ["yaw", "peak_yaw_rad"],
  ["corner", "peak_outline_m"],
  ["left at", "residual_axis_m"],
  ["across", "residual_transverse_m"],
  ["turned", "residual_yaw_rad"],
  ["margin of the closest decision", "margin"],
];

/** Ten digits of the largest length or angle. @param {Record<string, number>} found  @param {any} row */
function compareWithRow(found, row) {
  for (const [name, key] of NAMES) {
    if (row[key] === null && found[name] === null) continue; // infinite, which JSON has not
    const size = name.startsWith("margin") ? 1e-2 : key.endsWith("_m") ? row.peak_outline_m : Math.max(row.peak_yaw_rad, 1e-3);
    assert.ok(Math.abs((found[name] ?? NaN) - row[key]) <= 1e-10 * size, `${name}: ${found[name]}, natively ${row[key]}`);
  }
}

test("a cart rolls as the command and Python have it", async () => {
  const station = ["RSN1_MADE_NOW000.AT2", "RSN1_MADE_NOW090.AT2"];
  for (const [settings = "", ...files] of [
    ["law=cart&scale=0.4", ...station],
    ["law=cart&wheels=1&headings=0 90 180 45"], // the sample record
    ["law=cart&wheels=2&scale=-0.8"],
    ["law=cart&scale=0.5&wheels=3&mu=0.2", ...station],
    ["law=cart&scale=0.4&wheels=4&base_length=0.9&base_width=0.5&gyration=0.3&trail=0.04&wheel_width=0.03&rolling_mu=0.02", ...station],
    ["law=cart&scale=0.4&vertical=1", "three.csv"],
    ["law=cart&scale=0.4", "three.csv"], // without the vertical component, which the file has
    ["law=cart&scale=0.4", "RSN1_MADE_NOW000.AT2"], // alone
  ]) {
    await open(settings);
    if (files.length) await drop(...files);
    const found = await table();
    const line = await textOf("command");
    const alone = files.length < 2 && !settings.includes("vertical"); // the command takes all components of a file
    assert.equal(line.startsWith("echo"), !alone, line);
    if (!alone) compareWithRow(found, roll(line)[0]);
    const lines = "print([response.peak, response.peak_yaw, response.peak_outline, *response.residual.tolist(), response.residual_yaw, response.margin, len(response.events)])";
    const values = JSON.parse((await printed(await textOf("python"), lines)).replace("inf", "null"));
    compareWithRow(found, Object.fromEntries(NAMES.map(([, key], i) => [key, values[i]])));
    assert.equal(found.events, values[7]);
    assert.equal((await textOf("title-plan")).includes("one horizontal component"), files.length < 2 && files[0] !== "three.csv");
  }
  assert.deepEqual(complaints, []);
});

test("headings at random are those of the command", async () => {
  await open("law=cart&scale=0.4&wheels=4");
  await drop("RSN1_MADE_NOW000.AT2", "RSN1_MADE_NOW090.AT2");
  await page.waitForFunction(() => document.querySelectorAll("#draws tr[data-si]").length === 3, { timeout: 60_000 });
  const found = await page.$$eval("#draws tr[data-si]", (all) => all.map((one) => JSON.parse(/** @type {HTMLElement} */ (one).dataset.si ?? "")));
  const [row] = roll(await textOf("command"), " --members 30 --seed 1");
  ["peak_m", "peak_yaw_rad", "peak_outline_m"].forEach((key, i) =>
    compare({ median: found[i][0], high: found[i][1] }, { median: row[`${key}_50`], high: row[`${key}_95`] }),
  );
  await page.select("#fields [data-key=wheels] select", "3");
  await page.waitForFunction(() => document.querySelector("#title-draws")?.textContent?.startsWith("No caster swivels"));
  assert.deepEqual(complaints, []);
});

test("many carts: a line for each station", async () => {
  await open("law=cart&scale=0.4");
  await drop("RSN1_MADE_NOW000.AT2", "RSN1_MADE_NOW090.AT2", "three.csv");
  const lines = await textOf("command");
  await page.click("#view-many");
  await page.waitForFunction(() => document.querySelectorAll("#many-table tbody tr").length === 2);
  const found = await page.$$eval("#many-table tbody tr", (all) => all.map((one) => JSON.parse(/** @type {HTMLElement} */ (one).dataset.si ?? "")));
  const [row] = roll(lines);
  const named = Object.fromEntries(NAMES.slice(0, 6).map(([name], i) => [name, found[0][i]]));
  compareWithRow({ ...named, "margin of the closest decision": row.margin }, row);
  assert.equal(await page.$eval("#figure-curves", (one) => /** @type {HTMLElement} */ (one).hidden), true);
  assert.match((await downloaded("#many-csv", ".csv")).split("\n")[1] ?? "", /,peak_m,peak_yaw_rad,peak_outline_m,residual_axis_m,residual_transverse_m,residual_yaw_rad$/);
  assert.deepEqual(complaints, []);
});

test("what is wrong about a cart says so; lengths are in the chosen unit; its pictures in both modes and widths", async () => {
  await open("law=cart&scale=0.4");
  await drop("RSN1_MADE_NOW000.AT2", "RSN1_MADE_NOW090.AT2");
  const visible = () => page.$eval("#numbers", (one) => getComputedStyle(one).visibility === "visible");
  for (const [key, text, wrong, right] of [
    ["headings", "10 20", "headings must be 4 numbers, got 2", "20 110 -50 160"],
    ["headings", "10 20 30 400", "headings must be between -360 \u00b0 and 360 \u00b0, got 400 \u00b0", "20 110 -50 160"],
    ["trail", "0", "trail must be above 0 cm, got 0 cm", "3"],
  ]) {
    await enter(`#fields [data-key=${key}] input`, text ?? "");
    await settled("failed");
    assert.equal(await textOf("trouble"), wrong);
    assert.equal(await visible(), false);
    await enter(`#fields [data-key=${key}] input`, right ?? "");
    await settled();
    assert.ok(await visible());
  }
  const { corner = NaN, center = NaN } = await table();
  await page.select("#unit-length", "in");
  await settled();
  const inches = (/** @type {number} */ meters) => `${Number((meters / 0.0254).toPrecision(4))} in`;
  assert.ok((await textOf("answer")).startsWith(`center ${inches(center)}corner ${inches(corner)}`));
  for (const id of ["title-center", "title-plan"]) assert.ok((await textOf(id)).includes("[in]"));
  assert.match(await textOf("readout"), /: ground .* g, center .* in along, .* in across, yaw .* rad$/);
  assert.match(await textOf("read-plan"), / in along, .* in across$/);
  const header = (await downloaded("#csv", ".csv")).split("\n").find((line) => line.startsWith("time_s"));
  assert.equal(header, "time_s,ground_acceleration_m_s2,displacement_axis_m,displacement_transverse_m,yaw_rad,heading_0_rad,heading_1_rad,heading_2_rad,heading_3_rad");
  assert.equal((await listed("records")).length, 2);
  await page.focus("figure:has(#plot-yaw)");
  for (let i = 0; i < 20; ++i) await page.keyboard.press("PageDown");
  for (const width of [1280, 390])
    for (const value of ["light", "dark"]) {
      await page.setViewport({ width, height: 900 });
      await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value }]);
      await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 300)));
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
      await page.screenshot({ path: /** @type {`${string}.png`} */ (`${screenshots}cart-${width}-${value}.png`), fullPage: true });
    }
  assert.deepEqual(complaints, []);
});
