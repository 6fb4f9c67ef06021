// The page in a headless Chromium: its numbers against the native library's, and what its reader does.
import assert from "node:assert/strict";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { basename, resolve } from "node:path";

import {
  answers,
  choose,
  command,
  compare,
  complaints,
  downloaded,
  drop,
  enter,
  four,
  listed,
  open,
  page,
  pathShown,
  printed,
  samples,
  screenshots,
  settled,
  table,
  textOf,
} from "./browser.js";

test("dropped files slide as the native library has it", async () => {
  await open("mu=0.1");
  await drop("three.csv");
  compare(await table(), answers.components[0]);
  assert.match(await textOf("command"), /^stickslip slide three\.csv --component N00E --mu 0\.1$/);
  await pathShown();
  compare(await table("path-numbers"), answers.path);
  await choose("(N90E)");
  compare(await table(), answers.components[1]);
  await choose("(N00E)");
  await page.click("#vertical");
  await settled();
  compare(await table(), answers.vertical);
  assert.deepEqual(complaints, []);
});

test("a generated motion is that of Python", async () => {
  await open("mu=0.1&period=2&motion=kanai-tajimi");
  compare(await table(), answers["kanai-tajimi"]);
  assert.deepEqual(complaints, []);
});

test("the command and the Python lines give the numbers of the page", async () => {
  for (const [settings = "", file = "three.csv"] of [
    ["mu=0.12&law=caster&reach=0.1&stop_gap=0.2&restitution=0.3"],
    ["mu=0.2&law=one-way&slope=5"],
    ["mu=0.1&law=caster&reach=0.05&slope=3"], // never rests
    ["mu=0.2&law=one-way&mu_static=0.25"],
    ["mu=0.05&law=speed&mu_fast=0.1&rate=30&period=2.5&pendulum=1"],
    ["mu=0.15&law=degrading&mu_residual=0.1&distance=0.05&scale=-1.5"],
    ["mu=0.1&law=stribeck&mu_static=0.12&stribeck_speed=0.1&exponent=2"],
    ["mu=0.08&law=pendulum&mus=0.01 0.04 0.08"],
    ["mu=0.1&law=pendulum&radii=0.4 0.9&mus=0.05 0.1&capacities=0.3 0.3&restitution=0.2"],
    ["mu=0.06&law=kumar&period=3&pendulum=1"],
    ["mu=0.08&law=kumar&static_pressure=3e7&contact_radius=0.1&temperature=-5&rate=50&diffusivity=5e-6&conductivity=20&vertical=1"],
  ]) {
    await open(settings);
    await drop(file);
    const { peak, residual } = await table();
    const lines = await printed(await textOf("python"), "print(repr(response.peak), repr(response.residual))");
    const [p = NaN, r = NaN] = lines.split(" ").map(Number);
    compare({ peak: peak ?? NaN, residual: residual ?? NaN }, { peak: p, residual: r });
    const line = await textOf("command");
    if (!line.startsWith("stickslip")) continue;
    const [row] = JSON.parse(command(`${line} --json`)).results;
    compare({ peak: peak ?? NaN, residual: residual ?? NaN }, { peak: row.peak_m, residual: row.residual_m });
  }
  assert.deepEqual(complaints, []);
});

test("the files of a station: path and vertical component, by command and by Python", async () => {
  for (const [settings = "", ...files] of [
    ["mu=0.1", "RSN1_MADE_NOW-UP.AT2", "RSN1_MADE_NOW000.AT2", "RSN1_MADE_NOW090.AT2"], // as a folder lists them
    ["mu=0.1&vertical=1", "RSN2_PAIR_NOW-H1.AT2", "RSN2_PAIR_NOW-H2.AT2", "RSN2_PAIR_NOW-UP.AT2"], // no azimuths, no north
    ["mu=0.1&vertical=1", "RSN1_MADE_NOW-UP.AT2", "RSN1_MADE_NOW000.AT2", "RSN1_MADE_NOW090.AT2"],
  ]) {
    await open(settings);
    await drop(...files);
    await pathShown();
    const horizontal = files.filter((name) => !name.includes("UP"));
    assert.match((await listed("records")).join(), new RegExp(`^${horizontal.map((name) => `${name} [^,]*, [^,]*, path, vertical.`).join(",")}$`));
    assert.equal((await page.$$("#plot-path .north")).length, files[0]?.startsWith("RSN2") ? 0 : 1);
    for (const [id, planar] of /** @type {[string, boolean][]} */ ([["numbers", false], ["path-numbers", true]])) {
      const { peak = NaN, residual = NaN } = await table(id);
      const [prefix, size] = [planar ? "path-" : "", planar ? "float(sum(response.residual ** 2)) ** 0.5" : "response.residual"];
      const line = await textOf(`${prefix}command`);
      assert.equal(line.includes("NOW-UP.AT2"), settings.includes("vertical"), line);
      const [row] = JSON.parse(command(`${line} --json`)).results;
      compare({ peak, residual }, { peak: row.peak_m, residual: row.residual_m });
      const [p = NaN, r = NaN] = JSON.parse(await printed(await textOf(`${prefix}python`), `print([response.peak, ${size}])`));
      compare({ peak, residual }, { peak: p, residual: r });
    }
  }
  // The same samples as in the file of three components, to seven digits.
  const { peak = NaN } = await table();
  assert.ok(Math.abs(peak / answers.vertical.peak - 1) < 1e-3, `${peak}`);
  assert.deepEqual(complaints, []);
});

test("the path in the plane: all laws that can, its command and its Python lines, CSV", async () => {
  for (const settings of [
    "mu=0.12&mu_static=0.15&vertical=1&slope=3",
    "mu=0.05&law=speed&mu_fast=0.1&rate=30&period=2.5&pendulum=1",
    "mu=0.15&law=degrading&mu_residual=0.1&distance=0.05&stop_gap=0.2&restitution=0.3",
    "mu=0.1&law=stribeck&mu_static=0.12&stribeck_speed=0.1&exponent=2&scale=0.8",
    "mu=0.06&law=kumar&period=3&pendulum=1",
  ]) {
    await open(settings);
    await drop("three.csv");
    await pathShown();
    const { peak = NaN, residual = NaN } = await table("path-numbers");
    const lines = await printed(await textOf("path-python"), "print(repr([response.peak, *response.residual.tolist()]))");
    const [p = NaN, x = NaN, y = NaN] = JSON.parse(lines);
    compare({ peak, residual }, { peak: p, residual: Math.hypot(x, y) });
    const line = await textOf("path-command");
    if (!line.startsWith("stickslip")) continue;
    const [row] = JSON.parse(command(`${line} --json`)).results;
    compare({ peak, residual }, { peak: row.peak_m, residual: row.residual_m });
    const rows = (await downloaded("#path-csv", ".csv")).trim().split("\n");
    const [, last, across] = (rows.at(-1) ?? "").split(",").map(Number);
    compare({ x: last ?? NaN, y: across ?? NaN }, { x, y });
  }
  await page.select("#law", "1"); // casters
  await page.waitForFunction(() => document.querySelector("#title-path")?.textContent?.startsWith("No path in the plane"));
  assert.deepEqual(complaints, []);
});

test("the slider moves by mouse and by keyboard", async () => {
  await open("mu=0.1");
  await drop("three.csv");
  const slider = /** @type {import("puppeteer-core").ElementHandle<HTMLInputElement>} */ (await page.$("#mu-slider"));
  const box = /** @type {{x: number, y: number, width: number, height: number}} */ (await slider.boundingBox());
  await page.mouse.move(box.x + box.width * 0.1, box.y + box.height / 2);
  await page.mouse.down();
  for (let i = 1; i <= 40; ++i) await page.mouse.move(box.x + box.width * (0.1 + 0.01 * i), box.y + box.height / 2);
  await page.mouse.up();
  await settled();
  const far = Number(await page.$eval("#mu", (one) => /** @type {HTMLInputElement} */ (one).value));
  assert.ok(far > 0.4 && far < 0.6, `mu by mouse is ${far}`);
  assert.ok(((await table()).peak ?? 1) < answers.first["0.15"].peak);

  await slider.focus();
  await page.keyboard.press("Home");
  for (let i = 0; i < 29; ++i) await page.keyboard.press("ArrowRight"); // from 0.005 in steps of 0.005
  await settled();
  compare(await table(), answers.first["0.15"]);
  await page.waitForFunction(() => /mu=0\.15\b/.test(location.hash));
  // A reader without a mouse reads values at a point.
  await page.focus("#one figure[tabindex]");
  await page.keyboard.press("PageDown");
  await page.keyboard.press("ArrowRight");
  assert.match(await textOf("readout"), /^t = 0\.51 s: ground .* g, velocity .* cm\/s, displacement .* cm$/);
  await page.focus("figure:has(#plot-hysteresis)");
  await page.keyboard.press("ArrowRight");
  assert.match(await textOf("read-hysteresis"), /^t = 0\.52 s: displacement .* cm, force per unit mass .* g$/);
  await pathShown();
  await page.focus("#figure-path");
  await page.keyboard.press("ArrowRight");
  assert.match(await textOf("read-path"), /^t = 0\.53 s: .* cm along, .* cm across, .* cm from the start$/);
  assert.deepEqual(complaints, []);
});

test("archives, broken files, and files that leave their units open", async () => {
  await open("mu=0.1");
  await drop("packed.csv.gz", "broken.csv", "many.zip", "column.txt", "many.tar.gz");
  const failed = await listed("asking");
  assert.equal(failed.length, 3);
  assert.match(failed[0] ?? "", /^broken\.csv.*line 3.*oops/);
  assert.match(failed[1] ?? "", /^many\.zip::broken\.csv/);
  // In the words of a page with fields, not of Python.
  assert.match(failed[2] ?? "", /^column\.txt.*the file states no units of acceleration and no time step ?units/);
  compare(await table(), answers.components[0]); // the first that could be read
  for (const archive of ["many.zip", "many.tar.gz"]) {
    await choose(`${archive}::folder/three.csv (N00E)`);
    compare(await table(), answers.components[0]);
    await choose(`${archive}::folder/three.csv (N90E)`);
    compare(await table(), answers.components[1]);
  }

  // By keys, from one record to the next.
  await page.focus("#records [type=radio]:checked");
  const places = () => page.$$eval("#records [type=radio]", (all) => [all.findIndex((one) => /** @type {HTMLInputElement} */ (one).checked), all.length]);
  const [first = NaN, count = NaN] = await places();
  for (let i = 0; i < 2; ++i) await page.keyboard.press("ArrowDown");
  await settled();
  assert.deepEqual(await places(), [(first + 2) % count, count]);

  await page.select("#asking form select", "m/s^2");
  await page.type("#asking form input", "0.01");
  await drop("three.csv"); // does not disturb what is typed
  await page.evaluate(() => (document.body.dataset.state = "busy"));
  await page.click("#asking form button");
  await settled();
  compare(await table(), answers.column);
  assert.match(await textOf("command"), /--units m\/s\^2|--units 'm\/s\^2'/);

  // Several that ask are read at once, each with its own step; the unit may be one of all.
  await drop("column.txt", "FAS-045.txt");
  assert.equal((await listed("asking")).length, 4);
  await page.select("#asking-units", "m/s^2");
  const fields = await page.$$("#asking form input");
  await fields[0]?.type("0.01");
  await page.evaluate(() => (document.body.dataset.state = "busy"));
  await page.click("#asking-read");
  await settled();
  compare(await table(), answers.column);
  // Units alone do not answer for the step of the other.
  assert.match((await listed("asking")).join(), /FAS-045\.txt.*the file states no time step ?time step \[s\]/);
  assert.deepEqual(complaints, []);
});

test("a table of metadata answers for each file", async () => {
  await open("mu=0.1");
  await drop("SLO-000.txt", "FAS-045.txt", "steps.csv", "SLO-090.txt");
  assert.deepEqual(
    await page.$$eval("#asking form", (all) => all.map((one) => [one.querySelectorAll("select").length, one.querySelectorAll("input").length])),
    [[1, 0], [1, 0], [1, 0]], // the units alone are open
  );
  await page.select("#asking-units", "g");
  await page.evaluate(() => (document.body.dataset.state = "busy"));
  await page.click("#asking-read");
  await settled();
  assert.deepEqual(await listed("asking"), []);
  // 3,000 samples at 0.01 s and half as many at 0.02 s are 30 s.
  for (const [file, seconds] of /** @type {[string, string][]} */ ([["SLO-000.txt", "29.98 s, path"], ["SLO-090.txt", "29.98 s, path"], ["FAS-045.txt", "29.99 s"]]))
    assert.ok((await listed("records")).some((one) => one.includes(file) && one.includes(seconds)), `${file}: ${await listed("records")}`);
  await choose("SLO-090.txt");
  await pathShown();
  const { peak = NaN } = await table("path-numbers");
  compare({ peak }, { peak: JSON.parse(await printed(await textOf("path-python"), "print(response.peak)")) });
  const [row] = JSON.parse(command(`${await textOf("path-command")} --json`)).results;
  compare({ peak }, { peak: row.peak_m });
  assert.deepEqual(complaints, []);
});

test("the table downloads with full digits", async () => {
  await open("mu=0.1");
  await drop("three.csv");
  const lines = (await downloaded("#csv", ".csv")).trim().split("\n");
  const rows = lines.filter((line) => !line.startsWith("#")).map((line) => line.split(","));
  assert.deepEqual(rows[0], ["time_s", "ground_acceleration_m_s2", "velocity_m_s", "displacement_m", "force_m_s2"]);
  const { peak = NaN, residual = NaN } = await table();
  assert.ok(lines.includes(`# peak [m]: ${peak}`));
  assert.equal(Number(rows.at(-1)?.[3]), residual);
  assert.ok(rows.length > 3000);
  assert.deepEqual(complaints, []);
});

test("response spectrum: panel, CSV, command and Python, by keys", async () => {
  await open("mu=0.1&scale=-2");
  await drop("three.csv");
  // The one of the record that the page opened with may still be there.
  await page.waitForFunction(() => document.querySelector("#response-command")?.textContent?.includes("three.csv"));
  const expected = answers.spectrum.map((/** @type {number} */ value) => 2 * value);
  const compareAll = (/** @type {number[]} */ found) => {
    assert.equal(found.length, expected.length);
    compare(Object.fromEntries(Object.entries(found)), Object.fromEntries(Object.entries(expected)));
  };
  compareAll(await page.$eval("#figure-response", (one) => JSON.parse(/** @type {HTMLElement} */ (one).dataset.si ?? "")));

  const lines = (await downloaded("#response-csv", ".csv")).trim().split("\n");
  assert.ok(lines.includes(`# Arias intensity [m/s]: ${(await table())["Arias intensity"]}`));
  const rows = lines.filter((line) => !line.startsWith("#")).map((line) => line.split(","));
  assert.deepEqual(rows.shift(), ["period_s", "pseudo_acceleration_m_s2"]);
  compareAll(rows.map(([, value]) => Number(value)));

  const python = await printed(await textOf("response-python"), "print([float(value) for value in spectrum.values])");
  compareAll(JSON.parse(python));
  const json = command(`${(await textOf("response-command")).replace(/ --csv.*/, "")} --json --periods 1`);
  const second = JSON.parse(json).results[0];
  assert.equal(second.damping_ratio, 0.05);

  await page.focus("#figure-response");
  for (let i = 0; i < 7; ++i) await page.keyboard.press("PageDown");
  for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowLeft"); // point 66, of 1 s
  const shown = Number(((expected[66] ?? NaN) / 9.80665).toPrecision(4));
  assert.equal(await textOf("read-response"), `T = 1 s: ${shown} g`);
  assert.ok(Math.abs(second.pseudo_acceleration_m_s2 - (expected[66] ?? NaN)) < 1e-12);
  assert.deepEqual(complaints, []);
});

test("many records: both ways, with mean, median and deviation", async () => {
  await open("mu=0.1");
  await drop("three.csv");
  await page.click("#view-many");
  await page.waitForFunction(() => document.querySelectorAll("#many-table tbody tr").length === 2);
  const found = await page.$$eval("#many-table tbody tr", (all) =>
    all.map((one) => JSON.parse(/** @type {HTMLElement} */ (one).dataset.si ?? "")),
  );
  answers.many.forEach((/** @type {number[]} */ expected, /** @type {number} */ i) =>
    compare(Object.fromEntries(Object.entries(found[i] ?? [])), Object.fromEntries(Object.entries(expected))),
  );
  const lines = (await downloaded("#many-csv", ".csv")).trim().split("\n");
  assert.equal(lines.length, 1 + 1 + 2 + 3);
  const peak = lines[1]?.split(",").indexOf("peak_normal_m") ?? -1;
  const peaks = lines.slice(2, 4).map((line) => Number(line.split(",")[peak]));
  const mean = peaks.reduce((sum, value) => sum + value, 0) / 2;
  assert.equal(lines[4]?.split(",")[0], "mean");
  assert.ok(Math.abs(Number(lines[4]?.split(",")[peak]) - mean) < 1e-12);
  assert.ok(Math.abs(Number(lines[5]?.split(",")[peak]) - mean) < 1e-12); // the median of two
  // Records that are removed leave the table, and at last the pictures.
  for (let left = 1; left >= 0; --left) {
    await page.click("#records li:last-child button");
    await page.waitForFunction((left) => document.querySelectorAll("#many-table tbody tr").length === left, {}, left);
  }
  assert.equal(await page.$eval("#output", (one) => one.classList.contains("empty")), true);
  assert.deepEqual(complaints, []);
});

test("many records: as `stickslip newmark` has them", async () => {
  const real = process.env.STICKSLIP_RECORDS;
  const files = ["three.csv", "up.csv", "RSN1_MADE_NOW000.AT2", "RSN1_MADE_NOW090.AT2", "RSN1_MADE_NOW-UP.AT2"];
  if (real) files.push(...["geonet/20161113_110259_WTMC_20.V2A", "smc/0111a.smc", "cosmos/akbmr_bnz.v2c"].map((name) => resolve(real, name)));
  await open("mu=0.1&law=one-way");
  await drop(...files);
  await page.click("#view-many");
  const expected = JSON.parse(command(`stickslip newmark ${files.join(" ")} --component all --ky 0.1 --json`));
  await page.waitForFunction((count) => document.querySelectorAll("#many-table tbody tr").length === count, {}, expected.results.length);
  assert.equal(expected.results.length, real ? 7 : 4);
  const found = await page.$$eval("#many-table tbody tr", (all) => all.map((one) => JSON.parse(/** @type {HTMLElement} */ (one).dataset.si ?? "")));
  const named = (/** @type {number[]} */ [normal = NaN, inverse = NaN, mean = NaN]) => ({ normal, inverse, mean });
  const rowOf = (/** @type {any} */ row) => named([row.normal_m, row.inverse_m, row.mean_m]);
  expected.results.forEach((/** @type {any} */ row, /** @type {number} */ i) => compare(named(found[i]), rowOf(row)));
  assert.ok(expected.results.every((/** @type {any} */ row) => Math.abs(row.normal_m / row.inverse_m - 1) > 0.01)); // else the names could be exchanged
  const lines = (await downloaded("#many-csv", ".csv")).trim().split("\n").slice(-3).map((line) => line.split(","));
  const column = 1 + 5; // after the name and the measures of the ground
  ["mean", "median", "sd"].forEach((name, i) => {
    const row = expected.statistics.find((/** @type {any} */ one) => one.statistic === name);
    compare(named((lines[i] ?? []).slice(column, column + 3).map(Number)), rowOf(row));
  });
  // Both leave the vertical components out, and say so.
  const note = await textOf("many-note");
  for (const { file } of expected.left_out) assert.ok(note.includes(basename(file).replace(/\.csv$/, "")), `${file} in: ${note}`);
  assert.equal(expected.left_out.length, real ? 5 : 3);

  // The peaks over mu at one of its levels are those of the table there.
  await page.waitForFunction(() => !(/** @type {HTMLElement} */ (document.querySelector("#figure-curves")).hidden), { timeout: 60_000 });
  const [head = [], ...curves] = (await downloaded("#curves-csv", ".csv")).trim().split("\n").filter((line) => !line.startsWith("#")).map((line) => line.split(","));
  assert.equal(head.length, 2 + found.length);
  const level = curves[2] ?? [];
  await page.$eval("#mu", (one, mu) => {
    const input = /** @type {HTMLInputElement} */ (one);
    input.value = String(mu);
    input.dispatchEvent(new Event("input"));
  }, level[0]);
  await settled();
  await page.waitForFunction((mu) => document.querySelector("#many-settings")?.textContent?.includes(`${mu}`) && document.querySelector("#many-progress")?.textContent === "", {}, level[0]);
  const there = await page.$$eval("#many-table tbody tr", (all) => all.map((one) => JSON.parse(/** @type {HTMLElement} */ (one).dataset.si ?? "")[2]));
  compare(Object.fromEntries(level.slice(2).map((value, i) => [i, Number(value)])), Object.fromEntries(there.map((value, i) => [i, value])));
  assert.deepEqual(complaints, []);
});

test("the page opens with a sample record, which does not count, and neither does a generated motion unless it is added", async () => {
  await open("mu=0.1");
  assert.match((await listed("records")).join(), /^Kobe 1995 TAK-090 \(sample record\).*not in the table/);
  const { peak = NaN, residual = NaN } = await table();
  const [row] = JSON.parse(command(`${await textOf("command")} --json`)).results;
  compare({ peak, residual }, { peak: row.peak_m, residual: row.residual_m });
  await drop("up.csv"); // alone it is nothing to slide along
  assert.match((await listed("records")).join("|"), /Kobe.*\|up\.csv vertical \(Up\): left out/);
  await drop("three.csv");
  const names = async () => (await listed("records")).map((one) => one.split(" ")[0]);
  assert.deepEqual(await names(), ["up.csv", "three.csv", "three.csv"]);
  await page.select("#generator-name", "pulse");
  await page.waitForFunction(() => document.querySelector("#records")?.textContent?.includes("Ricker"));
  await settled();
  const counted = () => page.$$eval("#many-table tbody tr", (all) => all.length);
  await page.click("#view-many");
  await page.waitForFunction(() => document.querySelectorAll("#many-table tbody tr").length === 2);
  assert.match(await textOf("many-note"), /up\.csv.*does not count unless you add it/);
  await page.click("#generate");
  await page.waitForFunction(() => document.querySelectorAll("#many-table tbody tr").length === 3);
  await page.click("#view-one");
  await page.select("#generator-name", "sine"); // a new row
  await page.waitForFunction(() => document.querySelectorAll("#records li").length === 5);
  await settled();
  await drop("three.csv"); // and the sine has gone
  await page.click("#view-many");
  await page.waitForFunction(() => document.querySelectorAll("#many-table tbody tr").length === 5);
  assert.equal(await counted(), 5);
  assert.ok(!(await names()).includes("sine"));
  assert.deepEqual(complaints, []);
});

test("what is wrong or hard to believe says so beside its field, and no old number stays", async () => {
  await open("mu=0.1");
  await drop("three.csv");
  const visible = () => page.$eval("#numbers", (one) => getComputedStyle(one).visibility === "visible");
  const state = () => page.$eval("body", (one) => one.dataset.state);
  assert.ok(await visible());
  for (const [selector, text, wrong, right] of [
    ["#mu", "-0.1", "\u03bc must be at least 0, got -0.1", "0.1"],
    ["#mu", "", "\u03bc must be at least 0", "0.1"],
    ["#fields [data-key=mu_static] input", "0.05", "\u03bc static must be at least 0.1, got 0.05", "0.12"],
    ["#fields [data-key=stop_gap] input", "-3", "stop gap must be above 0 cm, got -3 cm", "30"],
    ["#fields [data-key=restitution] input", "1.5", "restitution must be between 0 and 1, got 1.5", "0.5"],
    ["#fields [data-key=period] input", "0", "period must be above 0 s, got 0 s", "2"],
  ]) {
    await enter(selector ?? "", text ?? "");
    if (!text) await page.$eval("#mu", (one) => one.dispatchEvent(new Event("input")));
    assert.equal(await state(), "failed");
    assert.equal(await visible(), false, `${selector} ${text}`);
    assert.equal(await textOf("trouble"), wrong);
    const remark = await page.$eval(selector ?? "", (one) => (one.id === "mu" ? document.querySelector("#mu-remark") : one.parentElement?.querySelector(".remark"))?.textContent);
    assert.equal(remark, wrong);
    await enter(selector ?? "", right ?? "");
    await settled();
    assert.ok(await visible());
  }
  const first = (await table()).peak;
  for (const [selector, text, remark] of [
    ["#mu", "20", "20 is outside 0.01 to 1.5, the range of surfaces: is its unit right?"],
    ["#fields [data-key=stop_gap] input", "1000", "1000 cm is outside 2 cm to 100 cm, the range of casters, bearings and their stops: is its unit right?"],
  ]) {
    await enter(selector ?? "", text ?? "");
    if (selector === "#mu") await enter("#fields [data-key=mu_static] input", "20");
    await settled();
    assert.ok(await visible());
    assert.equal(await page.$eval(selector ?? "", (one) => (one.id === "mu" ? document.querySelector("#mu-remark") : one.parentElement?.querySelector(".remark"))?.textContent), remark);
  }
  assert.equal((await table()).peak, 0); // of mu = 20, not the one before
  assert.notEqual(first, 0);
  await open("mu=0.08&law=pendulum&radii=0.3937 37.465 37.465");
  assert.match(await page.$eval("#fields [data-key=radii] .remark", (one) => one.textContent ?? ""), /^3746\.5 cm is outside 20 cm to 800 cm, the range of dishes/);
  // What the library says of the parts of a law.
  for (const [law = "", key = "", text = "", wrong = ""] of [
    ["kumar", "temperature", "-150", "temperature must be between -100 \u00b0C and 400 \u00b0C, got -150 \u00b0C"],
    ["stribeck", "exponent", "1.5", "exponent must be a whole number between 1 and 31, got 1.5"],
    ["speed", "mu_fast", "-1", "\u03bc fast must be at least 0, got -1"],
    ["pendulum", "mus", "0 0.1 0.1", "\u03bc of each must be above 0, got 0"],
    ["pendulum", "radii", "40 50 60 70", "radii must be 2, 3 or 5 numbers, got 4"],
  ]) {
    await open(`law=${law}`);
    await enter(`#fields [data-key=${key}] input`, text);
    assert.equal(await textOf("trouble"), wrong);
  }
  // The generator, in its unit.
  await open("motion=pulse");
  await enter("#generator-values input", "50");
  assert.match(await textOf("trouble"), /^PGA must be between 0\.00102 and 10\.2 g$/);
  assert.equal(await visible(), false);
  assert.deepEqual(complaints, []);
});

test("lengths and accelerations are entered in the chosen units", async () => {
  await open("mu=0.1&law=caster&reach=0.05&stop_gap=0.254&motion=pulse&pga=9.80665");
  const value = (/** @type {string} */ key) => page.$eval(`#fields [data-key=${key}] input`, (one) => /** @type {HTMLInputElement} */ (one).value);
  const pga = () => page.$eval("#generator-values input", (one) => /** @type {HTMLInputElement} */ (one).value);
  assert.deepEqual([await value("reach"), await value("stop_gap"), await pga()], ["5", "25.4", "1"]);
  const { peak = NaN } = await table();
  await page.select("#unit-length", "in");
  await page.select("#unit-acceleration", "si");
  await settled();
  assert.deepEqual([await value("stop_gap"), await pga()], ["10", "9.80665"]);
  assert.equal((await table()).peak, peak);
  await enter("#fields [data-key=stop_gap] input", "20");
  await settled();
  assert.match(await textOf("python"), /gap=0\.508,/);
  await page.select("#unit-length", "m");
  await page.select("#law", "6");
  await settled();
  assert.equal(await value("radii"), "0.3937 3.7465 3.7465");
  await page.select("#unit-length", "cm");
  assert.equal(await value("radii"), "39.37 374.65 374.65");
  assert.deepEqual(complaints, []);
});

test("a bearing keeps what was entered when the slider moves", async () => {
  await open("mu=0.1");
  await page.select("#law", "6");
  await settled();
  // The bearing of the fields, not one scaled to the former mu.
  assert.match(await textOf("python"), /mu=\[0\.01, 0\.04, 0\.08\]/);
  const field = () => page.$eval("#fields [data-key=mus]", (one) => [one.querySelector("input")?.value, one.querySelector(".remark")?.textContent]);
  assert.deepEqual(await field(), ["0.01 0.04 0.08", ""]);
  await enter("#mu", "0.1");
  await settled();
  assert.deepEqual(await field(), ["0.01 0.04 0.08", "scaled to 0.0125, 0.05, 0.1"]);
  assert.match(await textOf("python"), /mu=\[0\.0125, 0\.05, 0\.1\]/);
  assert.deepEqual(complaints, []);
});

test("a long record opens at its strong motion", async () => {
  await open("mu=0.1&motion=sine&cycles=10&frequency=5"); // 2 s: no window
  assert.equal(await page.$eval("#whole", (one) => /** @type {HTMLElement} */ (one).hidden), true);
  const quiet = Array.from({ length: 12000 }, (_, i) => (i > 3000 && i < 4000 ? Math.sin(i / 20) : 0));
  writeFileSync(`${samples}long.csv`, ["Time (s), Acceleration (m/s^2)", ...quiet.map((a, i) => `${(i / 100).toFixed(2)},${a}`)].join("\n"));
  await drop("long.csv");
  const [, from = NaN, to = NaN] = /^instead of (.*) to (.*) s$/.exec(await page.$eval("#whole", (one) => /** @type {HTMLElement} */ (one).title))?.map(Number) ?? [];
  await new Promise((resolve) => setTimeout(resolve, 100));
  const shown = Number(/^t = (\S+) s/.exec(await textOf("readout"))?.[1]);
  assert.ok(Math.abs(shown - from) < 0.02, `${shown} instead of ${from} s`); // to a sample and two digits
  const { "D5-95": strong = NaN } = await table();
  assert.ok(Math.abs(to - from - 1.5 * strong) < 2e-3 && from > 27 && to < 43, `${from} to ${to} s`);
  await page.click("#whole");
  await page.focus("#mu-slider");
  await page.keyboard.press("ArrowRight"); // all times stay
  await settled();
  assert.equal(await page.$eval("#whole", (one) => /** @type {HTMLElement} */ (one).hidden), true);
  assert.deepEqual(complaints, []);
});

test("peak and residual stand above the pictures, with the record and the settings, also on paper", async () => {
  await open("mu=0.12&period=3&law=caster&reach=0.05");
  await drop("three.csv");
  const { peak = NaN, residual = NaN } = await table();
  assert.equal(await textOf("answer"), `peak ${four(peak, 0.01)} cmresidual ${four(residual, 0.01)} cm`);
  assert.equal(await textOf("subject"), "three.csv (N00E): casters, \u03bc 0.12, reach 5 cm, period 3 s");
  const places = () => page.$$eval("#subject, #answer, #plot-acceleration", (all) => all.map((one) => one.getBoundingClientRect()).map(({ top, height }) => [top, height]));
  const above = (/** @type {number[][]} */ [subject = [], answer = [], plot = []]) => [subject, answer].every(([top = NaN, height = 0]) => height > 0 && top < (plot[0] ?? NaN));
  assert.ok(above(await places()));
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.ok(above(await places()));
  assert.deepEqual(complaints, []);
});

test("two settings side by side, SVG, and a paragraph", async () => {
  await open("mu=0.15");
  await drop("three.csv");
  await page.click("#pin");
  await settled();
  await page.focus("#mu-slider");
  for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowLeft");
  await settled();
  compare(await table(), answers.first["0.1"]);
  const row = await page.$eval('#numbers tr[data-name="peak"]', (one) => [...one.querySelectorAll("td")].map((td) => td.textContent));
  const shown = [answers.first["0.1"].peak, answers.first["0.15"].peak].map((peak) => `${Number((peak * 100).toPrecision(4))} cm`);
  assert.deepEqual(row, shown);
  assert.match(await textOf("report"), /^A mass held by friction \(Coulomb, \u03bc = 0\.1\) .* reaches 57\.13 cm/);
  const picture = await downloaded("#svg", ".svg");
  assert.match(picture, /^<svg .*<path d="M[\d.,L-]+" fill="none".*<\/svg>$/s);
  await page.waitForFunction(() => document.querySelector("#title-sliding")?.textContent?.startsWith("Sliding spectrum"));
  assert.deepEqual(complaints, []);
});

test("the slip level and the present friction are marked where they are", async () => {
  await open("mu=0.1");
  await drop("three.csv");
  await page.waitForFunction(() => document.querySelector("#title-sliding")?.textContent?.startsWith("Sliding spectrum"));
  /** Where the marks of a picture are [CSS pixels]. @param {string} id */
  const marks = (id) =>
    page.$$eval(`#plot-${id} [class^=line-]`, (all) =>
      all.map((one) => {
        const [{ left, top }, over] = [one.getBoundingClientRect(), /** @type {Element} */ (one.parentElement).getBoundingClientRect()];
        return one.className.startsWith("line-x") ? left - over.left : top - over.top;
      }),
    );
  const [levels, [at = NaN]] = [await marks("acceleration"), await marks("sliding")];
  assert.equal(levels.length, 2);
  await page.focus("#mu-slider");
  for (let i = 0; i < 20; ++i) await page.keyboard.press("ArrowRight"); // to 0.2
  await settled();
  const [apart, twice] = [levels, await marks("acceleration")].map(([up = NaN, down = NaN]) => down - up);
  assert.ok(Math.abs((twice ?? NaN) / (apart ?? NaN) - 2) < 0.03, `${apart} and ${twice} pixels apart`);
  assert.ok(((await marks("sliding"))[0] ?? NaN) > at + 5);
  assert.deepEqual(complaints, []);
});

test("an invalid setting is refused in the library's words, and the page goes on", async () => {
  await open("mu=0.05&slope=10", "failed");
  assert.match(await textOf("trouble"), /slides under its own weight unless mu is at least/);
  await page.focus("#mu-slider");
  for (let i = 0; i < 40; ++i) await page.keyboard.press("ArrowRight");
  await settled();
  assert.equal(await textOf("trouble"), "");
  assert.deepEqual(complaints, []);
});

test("fields keep what is typed in them while others come and go", async () => {
  await open("mu=0.1");
  const shown = () => page.$$eval("#fields label", (all) => all.map((one) => /** @type {HTMLElement} */ (one).dataset.key));
  const [period, gap] = await Promise.all(["period", "stop_gap"].map((key) => page.$(`#fields [data-key=${key}] input`)));
  await period?.focus();
  await page.keyboard.type("12.55");
  assert.ok((await shown()).includes("damping_ratio"));
  for (let i = 0; i < 4; ++i) await page.keyboard.press("Backspace");
  await page.keyboard.type(".5");
  await page.keyboard.press("Tab");
  await page.keyboard.type("0.05"); // in the field that has come
  await gap?.focus();
  await page.keyboard.type("2.5"); // cm
  await settled();
  await page.waitForFunction(() => location.hash.includes("period=1.5&damping_ratio=0.05&stop_gap=0.025"));
  assert.ok((await shown()).includes("restitution"));
  await period?.focus();
  for (let i = 0; i < 3; ++i) await page.keyboard.press("Backspace");
  assert.ok(!(await shown()).includes("damping_ratio"));
  assert.equal(await page.$eval("#pendulum", (one) => /** @type {HTMLInputElement} */ (one).disabled), true);
  assert.deepEqual(complaints, []);
});

test("all shown numbers change their units", async () => {
  await open("mu=0.1");
  await drop("three.csv");
  await pathShown();
  await page.click("#view-many");
  await page.waitForFunction(() => document.querySelectorAll("#many-table tbody tr").length === 2);
  await page.click("#view-one");
  for (const [length, meters] of /** @type {[string, number][]} */ ([["in", 0.0254], ["cm", 0.01]]))
    for (const [acceleration, size, name] of /** @type {[string, number, string][]} */ ([["si", 1, "m/s\u00b2"], ["g", 9.80665, "g"]])) {
      await page.select("#unit-length", length);
      await page.select("#unit-acceleration", acceleration);
      await settled();
      await pathShown();
      const factor = new Map([["length", meters], ["velocity", meters], ["acceleration", size]]);
      const units = new Map([["length", length], ["velocity", `${length}/s`], ["acceleration", name]]);
      const quantity = new Map([["peak", "length"], ["residual", "length"], ["sliding distance", "length"], ["PGA", "acceleration"], ["PGV", "velocity"], ["Arias intensity", "velocity"]]);
      for (const id of ["numbers", "path-numbers"]) {
        const rows = await page.$$eval(`#${id} tr[data-name]`, (all) =>
          all.map((one) => {
            const { name = "", si = "" } = /** @type {HTMLElement} */ (one).dataset;
            return { name, si, text: one.querySelector("td")?.textContent ?? "" };
          }),
        );
        assert.ok(rows.length >= 8);
        for (const { name, si, text } of rows) {
          const of = quantity.get(name);
          if (of) assert.equal(text, `${four(Number(si), factor.get(of) ?? 1)} ${units.get(of)}`, name);
        }
      }
      const { peak = NaN, residual = NaN, PGA = NaN, "sliding distance": way = NaN } = await table();
      const [long, pga] = [(/** @type {number} */ x) => `${four(x, meters)} ${length}`, `${four(PGA, size)} ${name}`];
      assert.ok((await textOf("records")).includes(`(N00E) ${pga}`));
      const report = await textOf("report");
      for (const part of [`PGA ${pga}`, `slides ${long(way)}`, `reaches ${long(peak)}`, `displacement of ${long(residual)}`])
        assert.ok(report.includes(part), `${part} in: ${report}`);
      for (const [id, unit] of [
        ["acceleration", name],
        ["velocity", `${length}/s`],
        ["displacement", length],
        ["sliding", length],
        ["response", name],
        ["path", length],
      ])
        await page.waitForFunction((id, unit) => document.getElementById(id)?.textContent?.includes(unit), {}, `title-${id}`, `[${unit}]`);
      assert.ok((await textOf("title-hysteresis")).includes(`[${name}] over displacement [${length}]`));
      assert.match(await textOf("readout"), new RegExp(`ground .* ${name}, velocity .* ${length}/s, displacement .* ${length}$`));
      assert.match(await textOf("read-hysteresis"), new RegExp(`displacement .* ${length}, force per unit mass .* ${name}$`));
      assert.match(await textOf("read-path"), new RegExp(`${length} along, .* ${length} across, .* ${length} from the start$`));
      for (const spectrum of ["sliding", "response"]) {
        await page.focus(`figure[data-spectrum=${spectrum}]`);
        await page.keyboard.press("ArrowRight");
        assert.match(await textOf(`read-${spectrum}`), new RegExp(` ${spectrum === "sliding" ? length : name}$`));
      }
      assert.ok((await downloaded("#svg", ".svg")).includes(`Displacement relative to the ground [${length}], peak ${four(peak, meters)}`));
      await page.click("#view-many");
      await page.waitForFunction(() => document.querySelector("#many-progress")?.textContent === "");
      const many = await page.$$eval("#many-table tr", (all) => all.map((one) => [...one.children].map((cell) => cell.textContent ?? "")));
      assert.equal(many[0]?.[2], `peak normal [${length}]`);
      const row = many.find(([label]) => label?.includes("(N00E)"));
      assert.deepEqual(row?.slice(1, 3), [pga, four(peak, meters)]);
      await page.click("#view-one");
    }
  assert.deepEqual(complaints, []);
});

/** Where the object is in the scene, relative to the middle [pixels], and its largest possible place. */
const objectAt = () =>
  page.evaluate(() => {
    const canvas = /** @type {HTMLCanvasElement} */ (document.querySelector("#scene"));
    const [width, height] = [canvas.width, canvas.height];
    const ctx = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true }));
    ctx.drawImage(canvas, 0, 0);
    const row = ctx.getImageData(0, height - 34 - 20, width, 1).data; // 20 pixels above the floor
    let [sum, count] = [0, 0];
    for (let i = 0; i < width; ++i)
      if (row[4 * i] === 0xd5 && row[4 * i + 1] === 0x5e && row[4 * i + 2] === 0 && row[4 * i + 3] === 255) [sum, count] = [sum + i + 0.5, count + 1];
    return { at: sum / count - width / 2, wide: count, most: width / 2 - Math.min(64, width / 5) - 8 };
  });

test("the object slides in real time and slower, and is where the response is", async () => {
  await open("mu=0.1");
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "light" }]);
  await drop("three.csv");
  const { peak = NaN } = await table();
  /** Moves the time, as by hand. @param {number} time */
  const seek = (time) =>
    page.$eval("#time", (one, time) => {
      const slider = /** @type {HTMLInputElement} */ (one);
      slider.value = String(time);
      slider.dispatchEvent(new Event("input"));
    }, time);
  const displacement = async () => {
    const [, value = "", unit] = /displacement (\S+) (\w+)$/.exec(await textOf("readout")) ?? [];
    assert.equal(unit, "cm");
    return Number(value.replace("\u2212", "-")) / 100;
  };
  let farthest = 0;
  for (let time = 6; time < 16; time += 0.5) {
    await seek(time);
    const [{ at, wide, most }, x] = [await objectAt(), await displacement()];
    assert.ok(wide > 50);
    assert.ok(Math.abs(at - (x / peak) * most) < 1, `at ${at} pixels, ${x} m of ${peak} m`);
    farthest = Math.max(farthest, Math.abs(at));
  }
  assert.ok(farthest > 30);

  /** Seconds of the record in a second of the clock. @param {string} speed */
  const pace = async (speed) => {
    await seek(6);
    await page.select("#speed", speed);
    await page.click("#play");
    assert.equal(await textOf("play"), "Pause");
    const found = await page.evaluate(async () => {
      const slider = /** @type {HTMLInputElement} */ (document.querySelector("#time"));
      const frame = () => new Promise(requestAnimationFrame);
      for (let i = 0; i < 3; ++i) await frame();
      const [begin, from] = [await frame(), Number(slider.value)];
      let now = begin;
      while (now - begin < 1000) now = await frame();
      return (1000 * (Number(slider.value) - from)) / (now - begin);
    });
    await page.click("#play");
    const stopped = await textOf("readout");
    await new Promise((resolve) => setTimeout(resolve, 100));
    assert.equal(await textOf("readout"), stopped);
    return found;
  };
  // A frame may come before or after the page's own: one of 60 in a second, more on a busy machine.
  for (const speed of [1, 0.5, 0.25]) {
    const found = await pace(String(speed));
    assert.ok(Math.abs(found / speed - 1) < 0.2, `${found} s in a second at speed ${speed}`);
  }
  const end = await page.$eval("#time", (one) => Number(/** @type {HTMLInputElement} */ (one).max));
  await seek(end - 0.5);
  await page.select("#speed", "4");
  await page.click("#play");
  await page.waitForFunction(() => document.querySelector("#play")?.textContent === "Play");
  assert.ok((await textOf("readout")).startsWith(`t = ${end.toFixed(2)} s`));
  assert.deepEqual(complaints, []);
});

test("a window of time: by mouse and by keys, in all histories, until all times are wanted", async () => {
  await open("mu=0.1");
  await drop("three.csv");
  /** The window, from the button that ends it; null if there is none. */
  const window = () =>
    page.$eval("#whole", (one) => {
      const [, from, to] = /^instead of (.*) to (.*) s$/.exec(/** @type {HTMLElement} */ (one).title) ?? [];
      return /** @type {HTMLElement} */ (one).hidden ? null : [Number(from), Number(to)];
    });
  /** Where the present time is in each history, as a part of its width. */
  const cursors = () =>
    page.$$eval("#plot-acceleration, #plot-velocity, #plot-displacement", (all) =>
      all.map((one) => {
        const [line, over] = [one.querySelector(".u-cursor-x"), one.querySelector(".u-over")].map((part) => part?.getBoundingClientRect());
        return ((line?.left ?? NaN) - (over?.left ?? NaN)) / (over?.width ?? NaN);
      }),
    );
  const now = async () => Number(/^t = (\S+) s/.exec(await textOf("readout"))?.[1]);
  const agree = async () => {
    const [from = NaN, to = NaN] = (await window()) ?? [];
    const place = ((await now()) - from) / (to - from);
    for (const found of await cursors()) assert.ok(Math.abs(found - place) < 0.01, `at ${found} instead of ${place} of the width`);
  };
  const box = /** @type {{x: number, y: number, width: number, height: number}} */ (await (await page.$("#plot-velocity .u-over"))?.boundingBox());
  const move = (/** @type {number} */ part) => page.mouse.move(box.x + part * box.width, box.y + box.height / 2);
  const end = await page.$eval("#time", (one) => Number(/** @type {HTMLInputElement} */ (one).max));
  assert.equal(await window(), null);
  await move(0.2);
  await page.mouse.down();
  for (let i = 1; i <= 10; ++i) await move(0.2 + 0.02 * i);
  await page.mouse.up();
  const [from = NaN, to = NaN] = (await window()) ?? [];
  assert.ok(Math.abs(from / end - 0.2) < 0.01 && Math.abs(to / end - 0.4) < 0.01, `${from} to ${to} s`);

  // The slider keeps it, and so does a change of units.
  await page.focus("#mu-slider");
  await page.keyboard.press("ArrowRight");
  await settled();
  await page.select("#unit-length", "in");
  await settled();
  assert.deepEqual(await window(), [from, to]);
  await page.mouse.move(1, 1);
  await page.focus("#one figure[tabindex]");
  await page.keyboard.press("PageUp");
  await agree();
  await page.keyboard.press("+");
  const [begin = NaN, last = NaN] = (await window()) ?? [];
  assert.ok(Math.abs((last - begin) / (to - from) - 0.5) < 0.01);
  await agree();
  for (let i = 0; i < 10; ++i) await page.keyboard.press("PageDown"); // it follows
  assert.ok(((await window())?.[0] ?? 0) > last);
  await agree();
  await page.keyboard.press("-");
  const wider = (await window()) ?? [];
  assert.ok(Math.abs(((wider[1] ?? NaN) - (wider[0] ?? NaN)) / (to - from) - 1) < 0.01);
  await page.keyboard.press("Escape");
  assert.equal(await window(), null);

  await page.keyboard.press("+");
  assert.ok(await window());
  await page.click("#whole");
  assert.equal(await window(), null);
  await page.focus("#one figure[tabindex]");
  await page.keyboard.press("+");
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2, { count: 2 });
  assert.equal(await window(), null);
  await page.keyboard.press("+");
  await choose("(N90E)"); // another record
  assert.equal(await window(), null);
  assert.deepEqual(complaints, []);
});

/** Drops many files at once, and clicks a button as soon as a text is there. @param {number} count  @param {string} id  @param {string} text  @param {string} button */
const dropManyAndClick = (count, id, text, button) =>
  page.evaluate(
    async (count, id, text, button, content) => {
      const transfer = new DataTransfer();
      for (let k = 0; k < count; ++k) transfer.items.add(new File([content], `${k}.csv`));
      /** @type {string[]} */
      const seen = [];
      const status = /** @type {HTMLElement} */ (document.getElementById(id));
      const done = new Promise((resolve) => {
        const observer = new MutationObserver(() => {
          seen.push(status.textContent ?? "");
          if (!status.textContent?.startsWith(text)) return;
          document.getElementById(button)?.click();
          observer.disconnect();
          resolve(undefined);
        });
        observer.observe(status, { childList: true, characterData: true, subtree: true });
      });
      document.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
      await done;
      return seen;
    },
    count,
    id,
    text,
    button,
    readFileSync(`${samples}three.csv`, "utf8"),
  );

test("many files show their progress and can be cancelled", async () => {
  await open("mu=0.1");
  const read = await dropManyAndClick(30, "progress", "Reading file 4 of 30", "reading-cancel");
  assert.deepEqual(read.slice(0, 4), [1, 2, 3, 4].map((k) => `Reading file ${k} of 30`));
  await page.waitForFunction(() => document.querySelector("#progress")?.textContent === "");
  await settled();
  // Two components of each file that was read.
  const rows = await page.$$eval("#records li", (all) => all.length);
  assert.ok(rows >= 2 * 3 && rows <= 2 * 6, `${rows} rows`);
  compare(await table(), answers.components[0]);

  await page.click("#view-many");
  await page.waitForFunction((rows) => document.querySelectorAll("#many-table tbody tr").length === rows, {}, rows);
  const slid = await dropManyAndClick(30, "many-progress", `Record 9 of ${rows + 60}`, "many-cancel");
  assert.ok(slid.includes(`Record 8 of ${rows + 60}`));
  await page.waitForFunction(() => document.querySelector("#many-progress")?.textContent?.startsWith("Cancelled"));
  const [, count = "", of] = /^Cancelled after (\d+) of (\d+)$/.exec(await textOf("many-progress")) ?? [];
  assert.equal(Number(of), rows + 60);
  assert.ok(Number(count) >= 9 && Number(count) < 20);
  assert.equal(await page.$$eval("#many-table tbody tr", (all) => all.length), Number(count));
  // The page goes on: a change of friction slides them all.
  await page.focus("#mu-slider");
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction((all) => document.querySelectorAll("#many-table tbody tr").length === all, { timeout: 60_000 }, rows + 60);
  assert.deepEqual(complaints, []);
});

test("on paper it is light, without controls, and fits the sheet", async () => {
  await open("mu=0.12&period=3&motion=kanai-tajimi");
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "dark" }]);
  await drop("three.csv");
  await pathShown();
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  const found = await page.evaluate(() => ({
    wide: document.documentElement.scrollWidth,
    ink: getComputedStyle(document.body).color,
    controls: [...document.querySelectorAll("button, select, input, .choices, footer")].filter(
      (one) => one.getClientRects().length > 0,
    ).length,
    pictures: [...document.querySelectorAll("canvas")].filter((one) => one.getClientRects().length > 0).map((one) => one.getBoundingClientRect()).map(({ left, right, width }) => ({ left, right, width })),
  }));
  assert.equal(found.ink, "rgb(34, 34, 34)");
  assert.equal(found.controls, 0);
  assert.ok(found.pictures.length >= 8);
  for (const { width } of found.pictures) assert.ok(width > 300 && width <= 680, `a picture is ${width} pixels wide`);
  // The line of the ground acceleration in the light palette, although the page was dark.
  const light = await page.$eval("#plot-acceleration canvas", (one) => {
    const canvas = /** @type {HTMLCanvasElement} */ (one);
    const { data } = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d")).getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) count += data[i] === 0x56 && data[i + 1] === 0x61 && data[i + 2] === 0x6c ? 1 : 0;
    return count;
  });
  assert.ok(light > 100, `${light} pixels`);
  await page.screenshot({ path: `${screenshots}print.png`, fullPage: true });
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).color), "rgb(230, 230, 230)");
  const file = `${screenshots}print.pdf`;
  await page.pdf({ path: file, format: "A4" });
  assert.ok(statSync(file).size > 20_000);
  assert.deepEqual(complaints, []);
});

test("memory does not grow over 1,000 redraws", async () => {
  await open("mu=0.1");
  await drop("three.csv");
  const redraw = (/** @type {number} */ count) =>
    page.evaluate(async (count) => {
      const slider = /** @type {HTMLInputElement} */ (document.querySelector("#mu-slider"));
      for (let i = 0; i < count; ++i) {
        slider.value = String(0.1 + 0.005 * (i % 40));
        slider.dispatchEvent(new Event("input"));
        while (document.body.dataset.state !== "shown") await new Promise((resolve) => setTimeout(resolve));
      }
    }, count);
  const used = async () => {
    const client = await page.createCDPSession();
    await client.send("HeapProfiler.collectGarbage");
    return (await page.metrics()).JSHeapUsedSize ?? 0;
  };
  await redraw(100);
  const before = await used();
  await redraw(1000);
  const grown = ((await used()) - before) / 1e6;
  assert.ok(grown < 2, `${grown} MB more after 1,000 redraws`);
  assert.deepEqual(complaints, []);
});

test("screenshots at both widths in both modes", async () => {
  for (const width of [1280, 390])
    for (const value of ["light", "dark"]) {
      await open("mu=0.12&law=caster&reach=0.05&period=3&motion=kanai-tajimi");
      await page.setViewport({ width, height: 900 });
      await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value }]);
      await page.focus("#one figure[tabindex]");
      for (let i = 0; i < 20; ++i) await page.keyboard.press("PageDown");
      await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 300)));
      await page.waitForFunction(() => ["sliding", "response"].every((one) => document.querySelector(`#title-${one}`)?.textContent));
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= width, `the page is ${wide} pixels wide in a window of ${width}`);
      const path = /** @type {`${string}.png`} */ (`${screenshots}${width}-${value}.png`);
      await page.screenshot({ path, fullPage: true });
      assert.ok(statSync(path).size > 20_000);
    }
  assert.deepEqual(complaints, []);
});
