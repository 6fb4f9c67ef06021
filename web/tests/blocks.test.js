// Blocks that rock on the page, against the command and the Python lines.
import assert from "node:assert/strict";
import { test } from "node:test";

import { choose, command, compare, complaints, downloaded, drop, enter, listed, open, page, printed, screenshots, settled, table, textOf } from "./browser.js";

/** What the command calls the numbers of the table, which has JSON's null for infinity and nothing. @type {Record<string, string>} */
const NAMES = {
  "peak rotation over \u03b1": "peak_rotation_ratio",
  "peak rotation": "peak_rotation_rad",
  "certain at": "overturned_at_s",
  impacts: "impacts",
  "base displaced": "base_displacement_m",
  "sliding distance": "sliding_distance_m",
  condition: "condition",
  p: "p_rad_s",
  "\u03b1": "alpha_rad",
  restitution: "restitution",
  "margin of the closest decision": "margin",
};

/** Compares the table with a row of the command. @param {Record<string, number>} found  @param {any} row */
function compareWithRow(found, row) {
  for (const [name, key] of Object.entries(NAMES)) {
    if (!(name in found)) continue;
    const value = row[key];
    if (value === null) assert.ok(!Number.isFinite(found[name]), `${name}: ${found[name]}, natively none`);
    else compare(found, { [name]: value });
  }
  assert.equal(found.overturned, { right: 1, left: -1 }[/** @type {"right"} */ (row.overturned)] ?? 0);
}

test("a block rocks, slides and falls as the command and Python have it", async () => {
  const overturned = [];
  for (const settings of [
    "law=slender-block",
    "law=slender-block&width=0.8&height=1.6&restitution=0.7&scale=-0.6",
    "law=rigid-block&scale=0.8&mu=0.5",
    "law=rigid-block&width=0.5&height=1.5&mu=0.25&restitution=0.8&scale=0.7",
    "law=rigid-block&mu=0.4&vertical=1&scale=0.7",
  ]) {
    await open(settings);
    await drop("three.csv");
    const found = await table();
    overturned.push(found.overturned);
    assert.equal("base displaced" in found, settings.includes("rigid"));
    const line = await textOf("command");
    if (settings.includes("vertical")) assert.doesNotMatch(line, /^stickslip/);
    else compareWithRow(found, JSON.parse(command(`${line} --json`)).results[0]);
    const lines = "import json; print(json.dumps([response.peak_rotation, response.impacts, response.margin, len(response.events)]))";
    const [rotation, impacts, margin, events] = JSON.parse((await printed(await textOf("python"), lines)).replace("Infinity", "null"));
    compare(found, { "peak rotation": rotation, impacts, events });
    if (margin !== null) compare(found, { "margin of the closest decision": margin });
  }
  assert.ok(overturned.some((side) => side === 0) && overturned.some((side) => side !== 0), `${overturned}`); // both are tested
  assert.deepEqual(complaints, []);
});

test("the pictures of a block: its rotation over time, at a point, and the block itself", async () => {
  await open("law=slender-block&width=0.6&height=2");
  await drop("three.csv");
  const { overturned = 0, "certain at": certain = NaN } = await table();
  assert.notEqual(overturned, 0);
  assert.equal(await textOf("answer"), `it overturns to the ${overturned > 0 ? "right" : "left"}, certain at ${Number(certain.toPrecision(4))} s`);
  const lines = (await downloaded("#csv", ".csv")).trim().split("\n").filter((line) => !line.startsWith("#"));
  assert.equal(lines[0], "time_s,ground_acceleration_m_s2,rotation_rad");
  const last = Number(lines.at(-1)?.split(",")[2]);
  assert.equal(last, (overturned * Math.PI) / 2);
  /** The box of the block in the scene [pixels] at a time. @param {number} time */
  const box = async (time) => {
    await page.$eval("#time", (one, time) => {
      const slider = /** @type {HTMLInputElement} */ (one);
      slider.value = String(time);
      slider.dispatchEvent(new Event("input"));
    }, time);
    return page.evaluate(() => {
      const canvas = /** @type {HTMLCanvasElement} */ (document.querySelector("#scene"));
      const copy = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true }));
      copy.drawImage(canvas, 0, 0);
      const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
      let [left, right, top, bottom] = [Infinity, -Infinity, Infinity, -Infinity];
      for (let y = 0; y < canvas.height; ++y)
        for (let x = 0; x < canvas.width; ++x) {
          const i = 4 * (y * canvas.width + x);
          if (data[i] !== 0xd5 || data[i + 1] !== 0x5e || data[i + 2] !== 0 || data[i + 3] !== 255) continue;
          [left, right, top, bottom] = [Math.min(left, x), Math.max(right, x + 1), Math.min(top, y), Math.max(bottom, y + 1)];
        }
      return { wide: right - left, high: bottom - top, middle: (left + right) / 2 - canvas.width / 2 };
    });
  };
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "light" }]);
  const [stands, lies] = [await box(0), await box(1e4)];
  assert.ok(Math.abs(stands.high / stands.wide - 2 / 0.6) < 0.15, JSON.stringify(stands));
  assert.ok(Math.abs(lies.wide / lies.high - 2 / 0.6) < 0.15, JSON.stringify(lies));
  assert.ok(Math.abs(stands.middle) < 2 && Math.sign(lies.middle) === overturned);
  await page.focus("figure:has(#plot-rotation)");
  await page.keyboard.press("ArrowLeft");
  assert.match(await textOf("readout"), /: ground .* g, rotation \u2212?5\.389 \u03b1, \u2212?1\.571 rad$/);
  assert.deepEqual(complaints, []);
});

/** Waits for the chart over sizes or friction. @param {string} wanted  in its title */
const chartShown = (wanted) => page.waitForFunction((wanted) => document.querySelector("#title-over")?.textContent?.includes(wanted), { timeout: 60_000 }, wanted);

test("the chart of a block over its size and over friction", async () => {
  await open("law=rigid-block&mu=0.4&scale=0.7");
  await drop("three.csv");
  const imports = [(await textOf("python")).split("\n").slice(0, -3).join("\n"), "import json"];
  const rows = async () => (await downloaded("#over-csv", ".csv")).trim().split("\n").filter((line) => !line.startsWith("#")).slice(1).map((line) => line.split(",").map(Number));
  for (const [choice, wanted, block] of /** @type {[string, string, string][]} */ ([
    ["height", "height [cm]", "width=0.3 * x, height=x, mu=0.4"],
    ["mu", "over \u03bc", "width=0.6, height=2, mu=x"],
  ])) {
    await page.select("#over", choice);
    await chartShown(wanted);
    const found = (await rows()).filter((_, i) => i % 6 === 0);
    const values = JSON.stringify(found.map(([x]) => x));
    const code = `print(json.dumps([ss.integrate(ss.RockingBlock(${block}), motion.scaled(0.7), settle=True).peak_rotation_ratio for x in ${values}]).replace("Infinity", "1e999"))`;
    const expected = JSON.parse(await printed(...imports, code)); // 1e999 is infinite
    found.forEach(([x, ratio = NaN], i) => (expected[i] === Infinity ? assert.equal(ratio, Infinity, `at ${x}`) : compare({ ratio }, { ratio: expected[i] })));
    assert.ok(expected.some((/** @type {number} */ ratio) => ratio < Infinity));
  }
  await page.focus("figure[data-spectrum=over]");
  await page.keyboard.press("ArrowRight");
  assert.match(await textOf("read-over"), /^\u03bc = .*: (peak .* \u03b1|overturns)$/);
  await page.select("#law", "8"); // a slender block has no friction
  await chartShown("height [cm]");
  assert.equal(await page.$eval("#mu-label", (one) => one.getClientRects().length), 0);
  await page.select("#unit-length", "m");
  await chartShown("height [m]");
  assert.deepEqual(complaints, []);
});

test("many blocks: a line for each record, as `stickslip rock` has them", async () => {
  const files = ["three.csv", "RSN1_MADE_NOW000.AT2", "RSN1_MADE_NOW090.AT2"];
  await open("law=rigid-block&mu=0.5&scale=0.93");
  await drop(...files, "up.csv");
  await page.click("#view-many");
  const expected = JSON.parse(command(`stickslip rock ${files.join(" ")} --component all --width 0.6 --height 2 --mu 0.5 --scale 0.93 --json`)).results;
  await page.waitForFunction((count) => document.querySelectorAll("#many-table tbody tr").length === count, {}, expected.length);
  const found = await page.$$eval("#many-table tbody tr", (all) => all.map((one) => JSON.parse(/** @type {HTMLElement} */ (one).dataset.si ?? "")));
  expected.forEach((/** @type {any} */ row, /** @type {number} */ i) => {
    const [ratio, side, impacts, margin, base] = found[i].map(Number);
    assert.equal(side, { right: 1, left: -1 }[/** @type {"right"} */ (row.overturned)] ?? 0);
    if (row.peak_rotation_ratio === null) assert.equal(ratio, Infinity);
    else compare({ ratio }, { ratio: row.peak_rotation_ratio });
    compare({ impacts, margin, base }, { impacts: row.impacts, margin: row.margin, base: row.base_displacement_m });
  });
  const fallen = expected.filter((/** @type {any} */ row) => row.overturned !== null).length;
  assert.ok(fallen > 0 && fallen < expected.length);
  assert.match(await textOf("many-note"), new RegExp(`^${fallen} of ${expected.length} overturn\\. Left out, because they are vertical: three\\.csv \\(Up\\), up\\.csv`));
  await page.waitForFunction(() => !(/** @type {HTMLElement} */ (document.querySelector("#figure-curves")).hidden), { timeout: 60_000 });
  const lines = (await downloaded("#curves-csv", ".csv")).trim().split("\n").filter((line) => !line.startsWith("#")).map((line) => line.split(","));
  assert.deepEqual(lines[0]?.slice(0, 2), ["height_m", "median"]);
  const [height = NaN, , ...peaks] = (lines[20] ?? []).map(Number);
  const there = JSON.parse(command(`stickslip rock ${files.join(" ")} --component all --width ${0.3 * height} --height ${height} --mu 0.5 --scale 0.93 --json`)).results;
  there.forEach((/** @type {any} */ row, /** @type {number} */ i) => compare({ ratio: peaks[i] ?? NaN }, { ratio: row.peak_rotation_ratio ?? Infinity }));
  const csv = (await downloaded("#many-csv", ".csv")).trim().split("\n");
  assert.match(csv[1] ?? "", /^record,.*,peak_rotation_ratio,overturned,impacts,margin,base_displacement_m$/);
  assert.deepEqual(complaints, []);
});

test("a size that cannot be says so, and no old number stays; sizes are in the chosen unit", async () => {
  await open("law=slender-block");
  await drop("three.csv");
  const visible = () => page.$eval("#numbers", (one) => getComputedStyle(one).visibility === "visible");
  for (const [text, wrong] of [
    ["-5", "width must be above 0 cm, got -5 cm"],
    ["400", /too squat to rock on after an impact/],
  ]) {
    await enter("#fields [data-key=width] input", String(text));
    await settled("failed");
    assert.equal(await visible(), false);
    if (typeof wrong === "string") assert.equal(await textOf("trouble"), wrong);
    else assert.match(await textOf("trouble"), /** @type {RegExp} */ (wrong));
    await enter("#fields [data-key=width] input", "60");
    await settled();
    assert.ok(await visible());
  }
  await page.select("#unit-length", "in");
  await settled();
  const value = await page.$eval("#fields [data-key=width] input", (one) => /** @type {HTMLInputElement} */ (one).value);
  assert.equal(Number(value), Number((0.6 / 0.0254).toPrecision(12)));
  assert.equal(await textOf("subject"), "three.csv (N00E): slender block, width 23.622 in, height 78.74 in");
  await page.select("#unit-length", "m");
  const remark = () => page.$eval("#fields [data-key=height] .remark", (one) => one.textContent);
  assert.equal(await remark(), "");
  for (const [width, height, wrong] of [
    ["60", "200", /^p is 0\.2654 rad\/s, outside that of blocks that rock, 0\.5 to 12 rad\/s: is the unit right\?$/],
    ["0.6", "1.2", /^\u03b1 is 0\.4636 rad: too much for small angles; take a rigid block$/],
    ["0.6", "2", /^$/],
  ]) {
    await enter("#fields [data-key=width] input", String(width));
    await enter("#fields [data-key=height] input", String(height));
    await settled();
    assert.match((await remark()) ?? "", /** @type {RegExp} */ (wrong));
  }
  // What belongs to a slider is not there, and comes back with it.
  const seen = (/** @type {string} */ id) => page.$eval(`#${id}`, (one) => one.getClientRects().length > 0);
  assert.deepEqual([await seen("plot-velocity"), await seen("plot-rotation"), await seen("clipped")], [false, true, false]);
  await page.select("#law", "0");
  await settled();
  assert.deepEqual([await seen("plot-velocity"), await seen("plot-rotation"), await seen("clipped")], [true, false, true]);
  assert.match(await textOf("command"), /--mu 0\.1$/);
  await choose("(N90E)");
  assert.ok((await listed("records")).length === 2);
  assert.deepEqual(complaints, []);
});

test("two blocks side by side, on the sheet and in a narrow window", async () => {
  await open("law=slender-block&scale=0.5");
  await drop("three.csv");
  await page.click("#pin");
  await settled();
  await enter("#fields [data-key=height] input", "150");
  await settled();
  const row = await page.$$eval('#numbers tr[data-name="p"] td', (all) => all.map((one) => one.textContent));
  assert.equal(row.length, 2);
  assert.notEqual(row[0], row[1]);
  assert.match(await textOf("pinned"), /^Compared with slender block, width 60 cm, height 200 cm/);
  assert.match(await textOf("report"), /^A uniform block, 60 cm wide and 150 cm high \(p = /);
  assert.match(await downloaded("#svg", ".svg"), /Rotation over \u03b1/);
  await chartShown("height [cm]");
  for (const width of [1280, 390])
    for (const value of ["light", "dark"]) {
      await page.setViewport({ width, height: 900 });
      await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value }]);
      await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 300)));
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
      await page.screenshot({ path: /** @type {`${string}.png`} */ (`${screenshots}block-${width}-${value}.png`), fullPage: true });
    }
  assert.deepEqual(complaints, []);
});
