// The page: what it shows, and what its reader does.

import { decompress } from "fzstd";

import { latest, startWorker } from "./client.js";
import { csv, download } from "./csv.js";
import { metadataOf, statedOf } from "./metadata.js";
import { color, CURVE_HEIGHT, CurvePlot, forgetColors, levelLine, LinePlot, shade } from "./plots.js";
import { drawScene, measureScene } from "./scene.js";
import {
  applies,
  command,
  completed,
  described,
  FIELDS,
  fromLink,
  given,
  LAWS,
  listed,
  MU,
  NOT_GIVEN,
  pathCommand,
  pathPython,
  PERIODS,
  python,
  remark,
  spectrumCommand,
  spectrumPython,
  toLink,
} from "./settings.js";
import { GENERATORS, recorded } from "./sources.js";
import { fromText } from "./packed.js";
import { statistics } from "./statistics.js";
import { svg } from "./svg.js";
import { digits, fromUnit, toUnit, unitOf } from "./units.js";

/** @import { Range, Settings, Summary } from "./library.js" */
/** @import { Field } from "./settings.js" */
/** @import { Joined, Motion, Response } from "./worker.js" */
/** @import { Stated } from "./metadata.js" */
/** @import { Source } from "./sources.js" */
/** @import { Choice, Quantity } from "./units.js" */

/**
 * A line of the list of records: a ground motion, or a file that could not be read.
 * @typedef {Object} Row
 * @property {string} label
 * @property {string} file
 * @property {Motion} [motion]
 * @property {Joined} [joined]     with the other components of its station
 * @property {boolean} counts      whether it is among the records that the reader chose
 * @property {(station: readonly Motion[]) => Source} source  of the components that act
 * @property {string} [error]
 * @property {Uint8Array} [bytes]  of a file that could not be read, to try again
 * @property {HTMLLIElement} [failed]  what says that it could not
 * @property {() => Stated} [entered]  what the reader entered for it
 */

/**
 * @template {HTMLElement} [T=any]
 * @param {string} id
 * @returns {T}
 */
const element = (id) => /** @type {T} */ (document.getElementById(id));

/**
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {Record<string, any>} [properties]
 * @param {...(Node | string)} children
 */
function make(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

const GRAVITY = 9.80665;
const NO_COMMAND = "The command has no option for this; the lines in Python give the same numbers.";
const KINDS = ["breakaway", "reversal", "arrest", "end", "impact", "liftoff", "landing"];
/** What the page holds packed; empty if nothing. @param {string} id */
const unpacked = (id) => {
  const text = (element(id).textContent ?? "").trim();
  return /** @type {Uint8Array<ArrayBuffer>} */ (text ? decompress(fromText(text)) : new Uint8Array());
};
const worker = startWorker(new TextDecoder().decode(unpacked("worker")));

let { settings, others } = fromLink(location.hash.slice(1));
/** @type {Choice} */
const units = {
  length: others.length === "in" || others.length === "m" ? others.length : "cm",
  acceleration: others.acceleration === "si" ? "si" : "g",
};
/** @type {Row[]} */
const rows = [];
/** @type {Row | null} */
let selected = null;
/** @type {Response | null} */
let response = null;
/** Settings to compare with, and what they give. @type {{settings: Settings, response: Response | null} | null} */
let pinned = null;
let now = 0; // [s]
let generator = GENERATORS.find((one) => one.name === others.motion);
/** Why there is no response to the settings; empty if there may be one. */
let broken = "";
/** Beyond which another unit is more probable. @type {Record<string, Range>} */
let ranges = {};

// ---- the response

/** @param {Quantity} quantity */
const unit = (quantity) => unitOf(quantity, units);
/** @param {number} value  @param {Quantity} quantity */
const shown = (value, quantity) => {
  const { name, size } = unit(quantity);
  return `${digits(value / size)}${name ? ` ${name}` : ""}`;
};
/** @param {Float64Array} values  @param {Quantity} quantity */
const inUnits = (values, quantity) => {
  const { size } = unit(quantity);
  const result = new Float64Array(values.length);
  for (let i = 0; i < result.length; ++i) result[i] = (values[i] ?? 0) / size;
  return result;
};

const plots = makePlots();

function makePlots() {
  const onCursor = (/** @type {number | null} */ index) => {
    if (!playing && !moving && response && index !== null) setTime(response.time[index] ?? 0, false);
  };
  const history = (/** @type {string} */ name, /** @type {string[]} */ strokes) =>
    new LinePlot(element(`plot-${name}`), strokes, onCursor, "time", { onWindow: setWindow });
  return {
    acceleration: history("acceleration", ["acceleration"]),
    velocity: history("velocity", ["velocity", "pinned"]),
    displacement: history("displacement", ["displacement", "pinned"]),
    hysteresis: new CurvePlot(element("plot-hysteresis"), "force"),
    path: new CurvePlot(element("plot-path"), "displacement", true),
    sliding: new LinePlot(element("plot-sliding"), ["displacement", "velocity"], (i) => readSpectrum("sliding", i), "number"),
    response: new LinePlot(element("plot-response"), ["acceleration"], (i) => readSpectrum("response", i), "logarithm"),
  };
}

const update = latest(async () => {
  const row = selected;
  if (!row?.motion || broken) return;
  const [now, id] = problemOf(settings, row);
  const change = changes;
  const done = (/** @type {string} */ state) => {
    if (change === changes) document.body.dataset.state = state; // else the next one is coming
  };
  try {
    const found = await worker.slide(id, now);
    if (pinned) {
      const [others, other] = problemOf(pinned.settings, row);
      pinned.response = await worker.slide(other, others).catch(() => null);
    }
    if (row !== selected || broken) return;
    response = found;
    element("trouble").textContent = "";
    done("shown");
  } catch (error) {
    if (row !== selected || broken) return;
    refuse(/** @type {Error} */ (error).message);
    done("failed");
  }
  show(now, row);
});

/** Shows why there are no numbers, in their place. @param {string} reason */
function refuse(reason) {
  response = null;
  element("trouble").textContent = reason;
  element("output").classList.add("empty");
}

/**
 * What a motion slides with: the settings that have a meaning, and the motion with or without its vertical component.
 * @param {Settings} given
 * @param {Row} row
 * @returns {[Settings, number]}
 */
function problemOf(given, { motion, joined }) {
  const full = completed(given);
  const both = joined?.verticalId ?? null;
  if (both === null) full.vertical = 0;
  return [full, full.vertical && both !== null ? both : /** @type {Motion} */ (motion).id];
}

/**
 * Where a row and the components that act with it come from.
 * @param {Row} row
 * @param {boolean} vertical
 * @param {boolean} plane
 * @returns {Source}
 */
function sourceOf(row, vertical, plane = false) {
  const self = /** @type {Motion} */ (row.motion);
  const station = rows.flatMap(({ motion }) => (motion && row.joined?.members.includes(motion.id) ? [motion] : []));
  const acting = station.filter((one) => one === self || (one.vertical ? vertical : plane));
  const source = row.source(acting.length ? acting : [self]);
  return { ...source, dropsVertical: plane && !vertical && station.some((one) => one.vertical && source.files.includes(one.file)) };
}

let lastChange = 0; // [ms]
let changes = 0;

/** @type {ReturnType<typeof setTimeout> | undefined} */
let linkWaits;
const saveLink = () => history.replaceState(null, "", `#${linkText()}`);

/** Before the answer comes, the page is not up to date. */
function changed() {
  lastChange = performance.now();
  ++changes;
  document.body.dataset.state = "busy";
  element("figure-path").dataset.state = "busy";
  clearTimeout(linkWaits);
  linkWaits = setTimeout(saveLink, 200); // once for a moving slider: a browser allows 20 a second
  broken = showRemarks();
  if (broken) {
    document.body.dataset.state = "failed";
    return refuse(broken);
  }
  update();
  updateSliding();
  updateResponseSpectrum();
  updatePath();
  if (!element("many").hidden) slideMany();
}

/** Shows beside each field what is wrong with it. @returns {string} what must be mended; empty if nothing */
function showRemarks() {
  const full = completed(settings);
  let wrong = "";
  const say = (/** @type {HTMLElement} */ place, /** @type {HTMLInputElement} */ input, /** @type {Field} */ field) => {
    const found = unreadable.has(field.key)
      ? { text: `${field.label} must be a number`, refused: true }
      : remark(field, full, (value) => inField(field, [value]), ranges);
    const scaled = field.key === "mus" && full.mus.join() !== typedMus().join() ? `scaled to ${full.mus.map(digits).join(", ")}` : "";
    place.textContent = found?.text ?? scaled;
    place.classList.toggle("wrong", found?.refused ?? false);
    input.setAttribute("aria-invalid", String(found?.refused ?? false));
    if (found?.refused) wrong ||= found.text;
  };
  say(element("mu-remark"), element("mu"), MU);
  for (const label of element("fields").children) {
    const field = fieldOf(label.dataset.key, full);
    if (field) say(label.querySelector(".remark"), label.querySelector("input"), field);
  }
  if (element("fields").textContent.includes("is its unit right?")) element("mounting").open = true; // to be seen
  return wrong || (selected === generated ? generatorTrouble : "");
}

/** What is wrong with the numbers of the generator; empty if nothing. */
let generatorTrouble = "";

/** @param {string} key  @param {Settings} full */
const fieldOf = (key, full) => FIELDS.find((field) => field.key === key && applies(field, full));

// ---- spectra

/** @type {{key: string, mus: Float64Array, peak: Float64Array, residual: Float64Array} | null} */
let sliding = null;
const LEVELS = 100;
const PART_TIME = 20; // of a part [ms]: a change waits for it

/** What the spectrum depends on: not mu, to which the coefficients of several surfaces are scaled. @param {Row} row */
const slidingKey = (row) => JSON.stringify(problemOf({ ...settings, mu: 1 }, row));

/** In parts, while nothing else is asked: it does not depend on mu, so that a moving slider can wait for it. */
const updateSliding = latest(async () => {
  const row = selected;
  if (!row?.motion || broken) return;
  const [full, id] = problemOf(settings, row);
  const key = slidingKey(row);
  if (sliding?.key === key) return; // `show` has drawn it
  const highest = Math.max((row.motion.measures.pga * Math.abs(full.scale)) / GRAVITY, 0.01);
  const mus = Float64Array.from({ length: LEVELS }, (_, i) => ((i + 1) / LEVELS) * highest);
  const [peak, residual] = [new Float64Array(LEVELS), new Float64Array(LEVELS)];
  for (let i = 0, count = 4; i < LEVELS; ) {
    await untilIdle();
    if (row !== selected || broken || key !== slidingKey(row)) return;
    const begin = performance.now();
    const part = await worker.spectrum(id, full, mus.slice(i, i + count)).catch(() => null);
    if (!part) return;
    peak.set(part.peak, i);
    residual.set(part.residual, i);
    i += part.peak.length;
    count = Math.max(1, Math.min(25, Math.floor((count * PART_TIME) / (performance.now() - begin))));
  }
  sliding = { key, mus, peak, residual };
  showSliding();
});

/** Until the response to the last change is drawn, and some time more. */
async function untilIdle() {
  while (document.body.dataset.state === "busy" || performance.now() - lastChange < 200)
    await new Promise((resolve) => setTimeout(resolve, 20));
}

function showSliding() {
  if (!sliding) return;
  const { mus, peak, residual } = sliding;
  element("title-sliding").textContent = `Sliding spectrum: peak and residual (dashed) [${unit("length").name}] over \u03bc`;
  const drawn = [sliding.key, units.length, color("ink")].join(" ");
  plots.sliding.show(mus, [inUnits(peak, "length"), inUnits(residual, "length")], { key: drawn });
  plots.sliding.marks([{ axis: "x", value: settings.mu }]);
}

/** Of the motion as it was recorded. @type {{key: string, row: Row, values: Float64Array} | null} */
let spectrum = null;

/** The damping ratio of a response spectrum. */
const zeta = () => Number(others.zeta ?? 0.05);

const updateResponseSpectrum = latest(async () => {
  const row = selected;
  if (!row?.motion || broken) return;
  const [{ id }, damping] = [row.motion, zeta()];
  const key = `${id} ${damping}`;
  if (spectrum?.key !== key) {
    await untilIdle();
    const values = await worker.responseSpectrum(id, PERIODS, damping).catch(() => null);
    if (row !== selected || !values) return;
    spectrum = { key, row, values };
  }
  // It does not depend on the slider, so that a moving one does not draw it.
  const drawn = [key, settings.scale, units.acceleration, color("ink")].join(" ");
  if (element("figure-response").dataset.drawn !== drawn) showResponseSpectrum();
  element("figure-response").dataset.drawn = drawn;
});

/** @returns {Float64Array}  of the scaled motion [m/s^2] */
const spectralAccelerations = () => (spectrum?.values ?? new Float64Array()).map((value) => value * Math.abs(settings.scale));

function showResponseSpectrum() {
  if (!spectrum) return;
  const { row } = spectrum;
  element("title-response").textContent =
    `Response spectrum: pseudo-acceleration [${unit("acceleration").name}] over the period [s], damping ratio ${zeta()}`;
  const values = spectralAccelerations();
  element("figure-response").dataset.si = JSON.stringify([...values]);
  plots.response.show(PERIODS, [inUnits(values, "acceleration")]);
  const source = sourceOf(row, false);
  element("response-command").textContent = spectrumCommand(source, zeta(), settings.scale) ?? NO_COMMAND;
  element("response-python").textContent = spectrumPython(source, zeta(), settings.scale);
}

/** The point of each spectrum whose values are shown. */
const points = { sliding: 0, response: 0, curves: 0 };

/**
 * @param {"sliding" | "response"} which
 * @param {number | null} index
 */
function readSpectrum(which, index) {
  if (index === null) return;
  points[which] = index;
  const at = (/** @type {Float64Array | undefined} */ values) => values?.[index] ?? NaN;
  element(`read-${which}`).textContent =
    which === "sliding"
      ? `\u03bc = ${digits(at(sliding?.mus))}: peak ${shown(at(sliding?.peak), "length")}, ` +
        `residual ${shown(at(sliding?.residual), "length")}`
      : `T = ${digits(at(PERIODS))} s: ${shown(at(spectralAccelerations()), "acceleration")}`;
}

/**
 * @param {keyof typeof points} which
 * @param {number} step
 */
function moveOnSpectrum(which, step) {
  const xs = { sliding: sliding?.mus, response: PERIODS, curves: curves?.mus }[which] ?? new Float64Array();
  const index = Math.min(xs.length - 1, Math.max(0, points[which] + step));
  (which === "curves" ? curvePlot : plots[which])?.point(xs[index] ?? 0);
  if (which === "curves") readCurves(index);
  else readSpectrum(which, index);
}

function downloadSliding() {
  if (!sliding || !selected) return;
  const { mus, peak, residual } = sliding;
  const lines = Array.from(mus, (mu, i) => [mu, peak[i] ?? NaN, residual[i] ?? NaN]);
  const comment = `stickslip: ${selected.label}; ${toLink({ ...completed(settings), mu: NaN })}`;
  download(`${fileName(selected)}_sliding_spectrum.csv`, csv(["mu", "peak_m", "residual_m"], lines, [comment]), "text/csv");
}

function downloadResponse() {
  if (!spectrum) return;
  const values = spectralAccelerations();
  const lines = Array.from(PERIODS, (period, i) => [period, values[i] ?? NaN]);
  const notes = [
    `stickslip: ${spectrum.row.label}; damping ratio ${zeta()}; scale ${settings.scale}`,
    ...comments(groundNumbers(spectrum.row)),
  ];
  const header = ["period_s", "pseudo_acceleration_m_s2"];
  download(`${fileName(spectrum.row)}_response_spectrum.csv`, csv(header, lines, notes), "text/csv");
}

// ---- the path in the plane

/** @type {{row: Row, summary: Summary, time: Float64Array, axis: Float64Array, transverse: Float64Array} | null} */
let path = null;

const SLOW = 100; // [ms]: a path that takes longer waits until the slider rests
let pathTime = 0; // that the last path took [ms]

const updatePath = latest(async () => {
  if (pathTime > SLOW) await untilIdle();
  const row = selected;
  if (broken) return;
  const id = row?.joined?.planarId ?? null;
  const full = completed(settings);
  let trouble = row?.joined?.reason ?? "";
  const figure = element("figure-path");
  const change = changes;
  const begin = performance.now();
  const found = id === null ? null : await worker.path(id, full).catch((/** @type {Error} */ error) => ((trouble = error.message), null));
  pathTime = performance.now() - begin;
  if (row !== selected || broken) return;
  figure.hidden = id === null && trouble === "";
  element("path").hidden = found === null;
  path = row && found ? { row, ...found } : null;
  element("title-path").textContent = path
    ? `Path in the plane [${unit("length").name}], seen from above: under both horizontal components, friction along the velocity`
    : `No path in the plane: ${trouble}`;
  if (!path || !row?.motion) return;
  showPath();
  showPointOfPath();
  element("path-numbers").tBodies[0].replaceChildren(...pathNumbers().map((line) => tableRow(line)));
  const source = sourceOf(row, full.vertical === 1, true);
  element("path-command").textContent = pathCommand(full, source) ?? NO_COMMAND;
  const even = !Number.isNaN(row.motion.measures.dt);
  element("path-python").textContent = pathPython(full, source, even, path.summary.at_rest === 1);
  if (change === changes) figure.dataset.state = "shown";
});

/** As a map: the axis upward, the transverse direction, clockwise from it, to the right. */
function showPath() {
  if (!path?.row.motion) return;
  const [axis, transverse] = [inUnits(path.axis, "length"), inUnits(path.transverse, "length")];
  const { name } = unit("length");
  const { azimuth, component, orientation } = path.row.motion;
  const right = Number.isNaN(azimuth) ? "" : ` (${(azimuth + 90) % 360}\u00b0)`;
  let far = 0;
  axis.forEach((x, i) => {
    if (Math.hypot(x, transverse[i] ?? 0) > Math.hypot(axis[far] ?? 0, transverse[far] ?? 0)) far = i;
  });
  const { peak, residual } = path.summary;
  const last = axis.length - 1;
  plots.path.resize();
  plots.path.map(transverse, axis, {
    right: `transverse${right} [${name}]`,
    up: `along ${Number.isNaN(azimuth) ? component : orientation.replace(/^[\d.]+$/, "$&\u00b0")} [${name}]`,
    marks: [
      { name: "start", x: 0, y: 0, label: "start" },
      { name: "peak", x: transverse[far] ?? 0, y: axis[far] ?? 0, label: `peak ${shown(peak, "length")}` },
      { name: "residual", x: transverse[last] ?? 0, y: axis[last] ?? 0, label: `residual ${shown(residual, "length")}` },
    ],
    north: azimuth,
  });
}

/** @returns {Line[]} */
const pathNumbers = () => (path ? [...slideNumbers(path.summary), ...certificate(path.summary)] : []);

function downloadPath() {
  if (!path) return;
  const { row, time, axis, transverse } = path;
  const lines = Array.from(time, (t, i) => [t, axis[i] ?? NaN, transverse[i] ?? NaN]);
  const notes = [`stickslip: ${row.label}, in the plane; ${toLink(completed(settings))}`, ...comments(pathNumbers())];
  download(`${fileName(row)}_path.csv`, csv(["time_s", "axis_m", "transverse_m"], lines, notes), "text/csv");
}

// ---- many records

/** @typedef {{row: Row, normal: {peak: number, residual: number}, inverse: {peak: number, residual: number}, error?: string}} Pair */

/** @type {Pair[]} */
let pairs = [];
let cancelled = false;

/** The records of the table: what the reader chose, without vertical components. */
const countedRows = () => rows.filter(({ motion, counts }) => motion && counts && !motion.vertical);

const slideMany = latest(async () => {
  cancelled = false;
  const found = [];
  const motions = countedRows();
  const given = JSON.stringify(settings);
  element("many-cancel").hidden = false;
  for (const row of motions) {
    if (broken) break;
    element("many-progress").textContent = `Record ${found.length + 1} of ${motions.length}`;
    const [full, id] = problemOf(settings, row);
    const none = { peak: NaN, residual: NaN };
    try {
      found.push({ row, ...(await worker.bothWays(id, full)) });
    } catch (error) {
      found.push({ row, normal: none, inverse: none, error: /** @type {Error} */ (error).message });
    }
    if (cancelled || given !== JSON.stringify(settings)) break;
  }
  element("many-cancel").hidden = true;
  element("many-progress").textContent = cancelled ? `Cancelled after ${found.length} of ${motions.length}` : "";
  pairs = found;
  showMany();
  updateCurves();
});

/** What is not in the table, and why. */
function manyNote() {
  const vertical = rows.filter(({ motion }) => motion?.vertical).map(({ label }) => label);
  const aside = rows.find(({ motion, counts }) => motion && !counts);
  return [
    ...(countedRows().length ? [] : ["No record yet: drop files on the page."]),
    ...(vertical.length ? [`Left out, because they are vertical: ${vertical.join(", ")}.`] : []),
    ...(aside ? [`\u201c${aside.label}\u201d does not count${aside === generated ? " unless you add it to the records" : ""}.`] : []),
  ].join(" ");
}

// ---- peaks over mu of many records

const CURVE_LEVELS = 25;
/** The mean of both polarities [m] of each record. @type {{key: string, labels: string[], mus: Float64Array, peaks: Float64Array[], median: Float64Array} | null} */
let curves = null;
/** @type {LinePlot | null} */
let curvePlot = null;

/** What the curves depend on: not mu. */
const curvesKey = () => JSON.stringify(countedRows().map((row) => problemOf({ ...settings, mu: 1 }, row)));

const updateCurves = latest(async () => {
  const counted = countedRows();
  const key = curvesKey();
  if (curves?.key === key) return showCurves();
  curves = null;
  element("figure-curves").hidden = true;
  if (!counted.length) return;
  const highest = Math.max(0.02, ...counted.map(({ motion }) => ((motion?.measures.pga ?? 0) * Math.abs(settings.scale)) / GRAVITY));
  const mus = Float64Array.from({ length: CURVE_LEVELS }, (_, i) => 0.01 * (100 * highest) ** (i / (CURVE_LEVELS - 1)));
  /** @type {Float64Array[]} */
  const peaks = [];
  for (const row of counted) {
    await untilIdle();
    if (cancelled || broken || element("many").hidden || key !== curvesKey()) return;
    element("many-progress").textContent = `Peak over \u03bc: record ${peaks.length + 1} of ${counted.length}`;
    element("many-cancel").hidden = false;
    const [full, id] = problemOf(settings, row);
    const both = await Promise.all([1, -1].map((sign) => worker.spectrum(id, { ...full, scale: sign * full.scale }, mus).catch(() => null)));
    peaks.push(mus.map((_, i) => both.reduce((sum, one) => sum + (one?.peak[i] ?? NaN), 0) / 2));
  }
  element("many-cancel").hidden = true;
  element("many-progress").textContent = "";
  const median = mus.map((_, i) => statistics(peaks.map((peak) => peak[i] ?? NaN)).median);
  curves = { key, labels: counted.map(({ label }) => label), mus, peaks, median };
  showCurves();
});

function showCurves() {
  if (!curves) return;
  const { mus, peaks, median } = curves;
  const figure = element("figure-curves");
  figure.hidden = false;
  element("title-curves").textContent = `Peak [${unit("length").name}] over \u03bc: each record, mean of both polarities; median colored`;
  if (figure.dataset.lines !== String(peaks.length)) {
    curvePlot?.destroy();
    const strokes = [...peaks.map(() => "pinned"), "displacement"];
    const how = { logarithmic: true, dashed: false, height: CURVE_HEIGHT };
    curvePlot = new LinePlot(element("plot-curves"), strokes, readCurves, "logarithm", how);
    figure.dataset.lines = String(peaks.length);
  }
  curvePlot?.resize();
  curvePlot?.show(mus, [...peaks, median].map((values) => inUnits(values, "length")));
  curvePlot?.marks([{ axis: "x", value: settings.mu }]);
}

/** @param {number | null} index */
function readCurves(index) {
  if (index === null || !curves) return;
  points.curves = index;
  const values = curves.peaks.map((peak) => peak[index] ?? NaN).filter((value) => !Number.isNaN(value));
  element("read-curves").textContent =
    `\u03bc = ${digits(curves.mus[index] ?? NaN)}: median ${shown(curves.median[index] ?? NaN, "length")}, ` +
    `from ${shown(Math.min(...values), "length")} to ${shown(Math.max(...values), "length")}`;
}

function downloadCurves() {
  if (!curves) return;
  const { mus, peaks, median, labels } = curves;
  const lines = Array.from(mus, (mu, i) => [mu, median[i] ?? NaN, ...peaks.map((peak) => peak[i] ?? NaN)]);
  const note = `stickslip: peak [m], mean of both polarities; ${toLink({ ...completed(settings), mu: NaN })}`;
  download("peaks_over_mu.csv", csv(["mu", "median", ...labels], lines, [note]), "text/csv");
}

/** @type {[string, (pair: Pair) => number][]} */
const COLUMNS = [
  ["peak normal", ({ normal }) => normal.peak],
  ["peak inverse", ({ inverse }) => inverse.peak],
  ["peak mean", ({ normal, inverse }) => (normal.peak + inverse.peak) / 2],
  ["residual normal", ({ normal }) => normal.residual],
  ["residual inverse", ({ inverse }) => inverse.residual],
  ["residual mean", ({ normal, inverse }) => (normal.residual + inverse.residual) / 2],
];

/** @returns {[string, number[]][]}  mean, median and standard deviation of each column [m] */
function manyStatistics() {
  const columns = COLUMNS.map(([, of]) => statistics(pairs.map(of)));
  return [
    ["mean", columns.map((one) => one.mean)],
    ["median", columns.map((one) => one.median)],
    ["standard deviation", columns.map((one) => one.deviation)],
  ];
}

function showMany() {
  element("many-settings").textContent = inWords(completed(settings));
  element("many-note").textContent = manyNote();
  const { name, size } = unit("length");
  const cells = (/** @type {number[]} */ values) => values.map((value) => make("td", {}, digits(value / size)));
  const table = element("many-table");
  table.tHead.replaceChildren(
    make("tr", {}, make("th", {}, "record"), make("th", {}, "PGA"), ...COLUMNS.map(([head]) => make("th", {}, `${head} [${name}]`))),
  );
  table.tBodies[0].replaceChildren(
    ...pairs.map((pair) => {
      const pga = shown((pair.row.motion?.measures.pga ?? NaN) * Math.abs(settings.scale), "acceleration");
      const head = make("th", { scope: "row" }, pair.row.label, ...(pair.error ? [make("small", {}, ` ${pair.error}`)] : []));
      const line = make("tr", {}, head, make("td", {}, pga), ...cells(COLUMNS.map(([, of]) => of(pair))));
      line.dataset.si = JSON.stringify(COLUMNS.map(([, of]) => of(pair)));
      return line;
    }),
  );
  table.tFoot.replaceChildren(
    ...manyStatistics().map(([head, values]) => make("tr", {}, make("th", { scope: "row", colSpan: 2 }, head), ...cells(values))),
  );
}

function downloadMany() {
  const ground = ["pga_m_s2", "pgv_m_s", "arias_m_s", "d5_95_s", "tm_s"];
  const header = ["record", ...ground, ...COLUMNS.map(([head]) => `${head.replace(" ", "_")}_m`)];
  const lines = pairs.map((pair) => [
    pair.row.label,
    ...groundNumbers(pair.row).map(([, value]) => value),
    ...COLUMNS.map(([, of]) => of(pair)),
  ]);
  const ends = manyStatistics().map(([head, values]) => [head, ...ground.map(() => ""), ...values]);
  download("records.csv", csv(header, [...lines, ...ends], [`stickslip: ${toLink(completed(settings))}`]), "text/csv");
}

/** @param {boolean} many */
function view(many) {
  element("many").hidden = !many;
  element("one").hidden = many;
  element("top").hidden = many;
  element("view-one").setAttribute("aria-pressed", String(!many));
  element("view-many").setAttribute("aria-pressed", String(many));
  if (many) {
    showMany(); // in the present units
    if (broken) refuse(broken);
    else slideMany();
  } else for (const plot of Object.values(plots)) plot.resize();
}

/**
 * @param {Settings} s
 * @param {Row} row
 */
function show(s, row) {
  const source = sourceOf(row, s.vertical === 1);
  element("command").textContent = command(s, source) ?? NO_COMMAND;
  element("python").textContent = python(s, source, response?.summary.at_rest !== 0);
  element("pinned").textContent = pinned ? `Compared with ${inWords(completed(pinned.settings))} (dashed).` : "";
  element("output").classList.toggle("empty", response === null);
  if (!response) return;
  element("subject").textContent = `${row.label}: ${inWords(s)}`;
  element("answer").replaceChildren(
    ...["peak", "residual"].map((name) =>
      make("span", {}, `${name} `, make("b", {}, shown(/** @type {any} */ (response).summary[name], "length"))),
    ),
  );
  const { summary, acceleration, velocity, displacement, force, events } = response;
  const other = pinned?.response ?? null;
  // Both on the longer time base: the one that rested earlier stays where it is.
  const time = other && other.time.length > response.time.length ? other.time : response.time;
  if (span && span[0] >= (time.at(-1) ?? 0)) setWindow(null);
  const padded = (/** @type {Float64Array} */ values, /** @type {number} */ rest) => {
    if (values.length === time.length) return values;
    const longer = new Float64Array(time.length).fill(rest);
    longer.set(values);
    return longer;
  };
  const [length, speed, ground] = [unit("length"), unit("velocity"), unit("acceleration")];

  element("title-acceleration").textContent = `Ground acceleration [${ground.name}]`;
  // It does not depend on the slider, except that its time ends with the slider at rest.
  const drawn = [row.motion?.id, s.scale, time.length, units.acceleration, color("ink")].join(" ");
  plots.acceleration.show(time, [inUnits(padded(acceleration, 0), "acceleration")], { key: drawn });
  plots.acceleration.marks(
    slipLevels(s, summary).map((level, i) => ({ value: level / ground.size, label: i ? "" : "slip level", below: level < 0 })),
  );
  element("title-velocity").textContent = `Velocity relative to the ground [${speed.name}]; shaded where it sticks`;
  const rests = sticks(events, time.at(-1) ?? 0);
  const speeds = [padded(velocity, 0), other ? padded(other.velocity, 0) : new Float64Array()];
  plots.velocity.show(
    time,
    speeds.map((values) => inUnits(values, "velocity")),
    { before: (u, ctx) => shade(u, ctx, rests) },
  );
  const [peak, residual] = [summary.peak / length.size, summary.residual / length.size];
  let [low, high] = [0, 0];
  for (let i = 0; i < displacement.length; ++i) {
    low = Math.min(low, displacement[i] ?? 0);
    high = Math.max(high, displacement[i] ?? 0);
  }
  const signed = -low > high ? -peak : peak;
  element("title-displacement").textContent =
    `Displacement relative to the ground [${length.name}]: peak ${digits(signed)} (dotted line), residual ${digits(residual)} (dashed)`;
  const places = [
    padded(displacement, summary.residual),
    other ? padded(other.displacement, other.summary.residual) : new Float64Array(),
  ];
  plots.displacement.show(
    time,
    places.map((values) => inUnits(values, "length")),
    {
      range: [Math.min(0, signed), Math.max(0, signed)],
      after: (u, ctx) => {
        levelLine(u, ctx, signed, { stroke: "level", dash: [2, 3] });
        levelLine(u, ctx, residual, { stroke: "displacement", dash: [6, 3] });
      },
    },
  );
  element("title-hysteresis").textContent = `Force per unit mass [${ground.name}] over displacement [${length.name}]`;
  plots.hysteresis.show(inUnits(displacement, "length"), inUnits(force, "acceleration"));
  showNumbers();
  showSliding();
  element("report").textContent = report(s, row);
  element("time").max = String(time.at(-1) ?? 1);
  if (row !== windowed) {
    windowed = row;
    const strong = strongWindow(row);
    if (strong) now = strong[0];
    setWindow(strong);
  }
  setTime(Math.min(now, time.at(-1) ?? 0));
}

/**
 * The ground accelerations at which the slider at x = 0 starts to slide forward and backward [m/s^2].
 * @param {Settings} s
 * @param {Summary} summary
 */
function slipLevels({ slope, law }, { hold }) {
  const held = hold / GRAVITY;
  const angle = ((Number.isNaN(slope) ? 0 : slope) * Math.PI) / 180;
  const [c, d] = [Math.cos(angle), Math.sin(angle)];
  const forward = (-GRAVITY * (held * c - d)) / (c + held * d);
  return LAWS[law]?.name === "one-way" ? [forward] : [(GRAVITY * (held * c + d)) / (c - held * d), forward];
}

/**
 * When the slider sticks.
 * @param {Float64Array} events
 * @param {number} end
 * @returns {[number, number][]}
 */
function sticks(events, end) {
  /** @type {[number, number][]} */
  const intervals = [];
  /** @type {number | null} */
  let since = 0;
  for (let i = 0; i < events.length; i += 4) {
    const [time = 0, kind = 0] = [events[i], events[i + 3]];
    if (KINDS[kind] === "breakaway" && since !== null) {
      intervals.push([since, time]);
      since = null;
    } else if (KINDS[kind] === "arrest") {
      since = time;
    }
  }
  if (since !== null) intervals.push([since, end]);
  return intervals;
}

/** The row whose window is that of its strong motion. @type {Row | null} */
let windowed = null;

/** The times of D5-95 with a quarter of it before and after, where the record is over three times as long. @param {Row} row  @returns {[number, number] | null} */
function strongWindow({ motion }) {
  const { begin, d5_95, duration } = motion?.measures ?? { begin: NaN, d5_95: NaN, duration: NaN };
  const [from, to] = [Math.max(0, begin - d5_95 / 4), begin + 1.25 * d5_95];
  return to - from < duration / 3 ? [from, to] : null;
}

/** @typedef {[string, number, Quantity, string]} Line  name, value in SI units, quantity, SI unit */

/**
 * @param {Row} row
 * @param {number} times  the scale of the motion
 * @returns {Line[]}
 */
function groundNumbers({ motion }, times = settings.scale) {
  if (!motion) return [];
  const { pga, pgv, arias, d5_95, mean_period } = motion.measures;
  return [
    ["PGA", pga * Math.abs(times), "acceleration", "m/s^2"],
    ["PGV", pgv * Math.abs(times), "velocity", "m/s"],
    ["Arias intensity", arias * times ** 2, "velocity", "m/s"],
    ["D5-95", d5_95, "time", "s"],
    ["Tm", mean_period, "time", "s"],
  ];
}

/** Comments of a table. @param {Line[]} lines */
const comments = (lines) => lines.map(([name, value, , si]) => `${name}${si ? ` [${si}]` : ""}: ${value}`);

/** @param {Summary} summary  @returns {Line[]} */
const slideNumbers = (summary) => [
  ["peak", summary.peak, "length", "m"],
  ["residual", summary.residual, "length", "m"],
  ["sliding distance", summary.sliding_distance, "length", "m"],
  ["time sliding", summary.time_sliding, "time", "s"],
  ["slips", summary.slips, "none", ""],
  ["impacts", summary.impacts, "none", ""],
  ["lift-offs", summary.liftoffs, "none", ""],
  ...(Number.isNaN(summary.temperature)
    ? []
    : [/** @type {Line} */ (["highest temperature", summary.temperature, "temperature", "degrees Celsius"])]),
];

/** How far to trust a response. @param {Summary} summary  @returns {Line[]} */
const certificate = (summary) => [
  ["events", summary.events, "none", ""],
  ["energy imbalance over input", summary.imbalance / (summary.input || 1), "none", ""],
  ["margin of the closest decision", Math.min(summary.margin, summary.impact_margin), "none", ""],
];

/**
 * @param {Response | null} of
 * @param {number} times  the scale of the motion
 * @returns {Line[]}
 */
function numbers(of = response, times = settings.scale) {
  if (!of || !selected?.motion) return [];
  return [...slideNumbers(of.summary), ...groundNumbers(selected, times), ...certificate(of.summary)];
}

/**
 * @param {Line} line
 * @param {...HTMLElement} more
 */
function tableRow([name, value, quantity], ...more) {
  const row = make("tr", {}, make("th", { scope: "row" }, name), make("td", {}, shown(value, quantity)), ...more);
  row.dataset.name = name;
  row.dataset.si = String(value);
  return row;
}

function showNumbers() {
  const compared = pinned ? numbers(pinned.response, pinned.settings.scale) : [];
  element("numbers").tHead.replaceChildren(
    ...(compared.length ? [make("tr", {}, make("th"), make("td", {}, "now"), make("td", {}, "compared"))] : []),
  );
  const body = element("numbers").tBodies[0];
  const lines = numbers();
  const known = [...body.rows];
  if (known.length === lines.length && known.every((row, i) => row.dataset.name === lines[i]?.[0] && row.cells.length === (compared.length ? 3 : 2)))
    lines.forEach(([, value, quantity], i) => {
      known[i].dataset.si = String(value);
      known[i].cells[1].textContent = shown(value, quantity);
      if (compared[i]) known[i].cells[2].textContent = shown(compared[i][1], quantity);
    });
  else
    body.replaceChildren(
      ...lines.map((line, i) => tableRow(line, ...(compared[i] ? [make("td", {}, shown(compared[i][1], line[2]))] : []))),
    );
  if (response && !response.summary.at_rest)
    body.append(
      make("tr", {}, make("th", { colSpan: 2 }, "It never comes to rest; these are the numbers at the end of the record.")),
    );
}

/**
 * A paragraph for a report.
 * @param {Settings} s
 * @param {Row} row
 */
function report(s, row) {
  if (!response || !row.motion) return "";
  const { summary } = response;
  const law = LAWS[s.law]?.label ?? "";
  const details = FIELDS.filter((field) => field.key !== "scale" && applies(field, s) && given(s, field.key)).map(
    (field) => `${field.label} ${inField(field, listOf(s[field.key]))}`,
  );
  if (s.pendulum) details.push("the spring being a pendulum");
  const scaled = s.scale === 1 ? "" : `, scaled by ${s.scale}`;
  const ground = `${row.label} (PGA ${shown(summary.pga, "acceleration")}${s.vertical ? ", with its vertical component" : ""}${scaled})`;
  const rest = summary.at_rest
    ? `comes to rest with a residual displacement of ${shown(summary.residual, "length")}`
    : `has not come to rest at the end of the record, where its displacement is ${shown(summary.residual, "length")}`;
  return (
    `A mass held by friction (${law}, \u03bc = ${s.mu}${details.length ? `; ${details.join("; ")}` : ""}) was subjected to the ground motion ` +
    `${ground}. It slides ${shown(summary.sliding_distance, "length")} in ${summary.slips} slips; its displacement relative to the ` +
    `ground reaches ${shown(summary.peak, "length")}, and it ${rest}. Computed with stickslip, event by event; the energy ` +
    `balance closes to ${digits(Math.abs(summary.imbalance / (summary.input || 1)))} of the work of the ground, and the closest ` +
    `decision between stick and slip has a relative margin of ${digits(Math.min(summary.margin, summary.impact_margin))}.`
  );
}

function downloadSvg() {
  if (!response || !selected) return;
  const { summary, time, acceleration, velocity, displacement } = response;
  const { length, ground, speed } = { length: unit("length"), ground: unit("acceleration"), speed: unit("velocity") };
  const level = { stroke: "#a0417a", label: "" };
  const picture = svg(selected.label, time, [
    {
      title: `Ground acceleration [${ground.name}]`,
      lines: [{ values: inUnits(acceleration, "acceleration"), stroke: "#56616c" }],
      levels: slipLevels(completed(settings), summary).map((value) => ({ ...level, value: value / ground.size })),
    },
    {
      title: `Velocity relative to the ground [${speed.name}]`,
      lines: [{ values: inUnits(velocity, "velocity"), stroke: "#0072b2" }],
      levels: [],
    },
    {
      title: `Displacement relative to the ground [${length.name}], peak ${digits(summary.peak / length.size)}`,
      lines: [{ values: inUnits(displacement, "length"), stroke: "#d55e00" }],
      levels: [{ ...level, value: summary.residual / length.size, label: `residual ${digits(summary.residual / length.size)}` }],
    },
  ]);
  download(`${fileName(selected)}.svg`, picture, "image/svg+xml");
}

/** @param {Row} row */
const fileName = (row) => row.label.replace(/[^\w.-]+/g, "_");

// ---- time

let playing = false;
let moving = false; // whether the page moves the cursors

/**
 * @param {number} time  [s]
 * @param {boolean} [cursors]  whether the pictures' cursors follow
 */
function setTime(time, cursors = true) {
  if (!response) return;
  now = time;
  const { summary, displacement, velocity, acceleration, force } = response;
  const at = interpolated(response.time, time);
  drawScene(element("scene"), {
    settings: completed(settings),
    x: at(displacement),
    peak: summary.peak,
    acceleration: at(acceleration),
    pga: summary.pga,
    ruler: unit("length"),
  });
  element("readout").textContent =
    `t = ${time.toFixed(2)} s: ground ${shown(plain(at(acceleration)), "acceleration")}, ` +
    `velocity ${shown(plain(at(velocity)), "velocity")}, displacement ${shown(plain(at(displacement)), "length")}`;
  const [x, f] = [plain(at(displacement)), plain(at(force))];
  plots.hysteresis.point(x / unit("length").size, f / unit("acceleration").size);
  element("read-hysteresis").textContent =
    `t = ${time.toFixed(2)} s: displacement ${shown(x, "length")}, force per unit mass ${shown(f, "acceleration")}`;
  showPointOfPath();
  element("time").value = String(time);
  if (!cursors) return;
  moving = true;
  for (const plot of [plots.acceleration, plots.velocity, plots.displacement]) plot.point(time);
  moving = false;
}

/** As a reader wants it: the window of the pictures follows. @param {number} time */
function goTo(time) {
  setTime(time);
  if (span && (time < span[0] || time > span[1])) zoom(1);
}

/** The times that the histories show; null for all. @type {[number, number] | null} */
let span = null;

/** @param {[number, number] | null} range */
function setWindow(range) {
  if (range?.[0] === span?.[0] && range?.[1] === span?.[1]) return;
  span = range;
  element("whole").hidden = range === null;
  element("whole").title = range ? `instead of ${range.map((time) => time.toFixed(3)).join(" to ")} s` : "";
  for (const plot of [plots.acceleration, plots.velocity, plots.displacement]) plot.window(range);
  setTime(now);
}

const SHORTEST = 0.1; // window [s]

/** Changes the width of the window, about the present time. @param {number} factor */
function zoom(factor) {
  const end = response?.time.at(-1) ?? 0;
  const [from, to] = span ?? [0, end];
  const width = Math.max(factor * (to - from), SHORTEST);
  if (width >= end) return setWindow(null);
  const begin = Math.min(Math.max(now - width / 2, 0), end - width);
  setWindow([begin, begin + width]);
}

/** The point of the path at the present time. */
function showPointOfPath() {
  if (!path) return;
  const at = interpolated(path.time, now);
  const [x, y] = [plain(at(path.axis)), plain(at(path.transverse))];
  const { size } = unit("length");
  plots.path.point(y / size, x / size);
  element("read-path").textContent =
    `t = ${now.toFixed(2)} s: ${shown(x, "length")} along, ${shown(y, "length")} across, ` +
    `${shown(Math.hypot(x, y), "length")} from the start`;
}

/** Round-off as zero: nobody reads 1e-17 m. @param {number} value */
const plain = (value) => (Math.abs(value) < 1e-12 ? 0 : value);

/**
 * Reads histories at a time.
 * @param {Float64Array} times
 * @param {number} time  [s]
 * @returns {(values: Float64Array) => number}
 */
function interpolated(times, time) {
  const i = indexAt(times, time);
  const [before = 0, after = before] = [times[i], times[i + 1]];
  const part = after > before ? Math.min((time - before) / (after - before), 1) : 0;
  return (values) => {
    const [a = 0, b = a] = [values[i], values[i + 1]];
    return a + part * (b - a);
  };
}

/**
 * The last sample at or before a time.
 * @param {Float64Array} times
 * @param {number} time
 */
function indexAt(times, time) {
  let [low, high] = [0, times.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((times[middle] ?? 0) <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** @param {boolean} on */
function play(on) {
  playing = on;
  element("play").textContent = on ? "Pause" : "Play";
  if (!on || !response) return;
  const end = response.time.at(-1) ?? 0;
  if (now >= end) now = 0;
  let last = performance.now();
  const step = (/** @type {number} */ at) => {
    if (!playing) return;
    const next = now + ((at - last) / 1000) * Number(element("speed").value);
    last = at;
    goTo(Math.min(next, end));
    if (next >= end) play(false);
    else requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

// ---- records

let readingStopped = false;

/** A table that states what files leave open. @type {Map<string, Stated> | null} */
let metadata = null;

/** @param {FileList | File[]} files */
async function addFiles(files) {
  let done = 0;
  const before = new Set(rows);
  readingStopped = false;
  element("reading-cancel").hidden = files.length === 1;
  for (const file of files) {
    element("progress").textContent = files.length > 1 ? `Reading file ${++done} of ${files.length}` : "Reading";
    const inside = await worker.unpack(file.name, new Uint8Array(await file.arrayBuffer()));
    for (const one of inside) {
      if ("error" in one) rows.push(failedRow(one.name, one.error));
      else if (!takeMetadata(one.bytes)) await addFile(one.name, one.bytes);
      if (readingStopped) break;
    }
    if (readingStopped) break;
  }
  if (metadata) for (const row of rows.filter(asks)) await addFile(row.file, /** @type {Uint8Array} */ (row.bytes), {}, rows.indexOf(row));
  element("reading-cancel").hidden = true;
  // What the page showed before the first record was there is no record of its reader.
  if (rows.some((row) => slides(row) && !before.has(row))) for (const row of rows.filter(({ counts, motion }) => motion && !counts)) forget(row);
  await join();
  element("progress").textContent = "";
  select(rows.find((row) => slides(row) && !before.has(row)) ?? selected);
}

/** Joins the components of stations. */
async function join() {
  const found = await worker.join(rows.flatMap(({ motion }) => (motion ? [motion] : [])));
  const byId = new Map(found.map((one) => [one.id, one]));
  for (const row of rows) row.joined = row.motion && byId.get(row.motion.id);
}

/** Whether a row is a motion along which an object slides. @param {Row} row */
const slides = ({ motion }) => motion !== undefined && !motion.vertical;

/** @param {string} file  @param {string} error  @param {Uint8Array} [bytes]  @returns {Row} */
const failedRow = (file, error, bytes) => ({ label: file, file, error, counts: false, source: () => ({ files: [], python: [] }), ...(bytes ? { bytes } : {}) });

/** Whether a file is a table of metadata, which is then used for all files that leave something open. @param {Uint8Array} bytes */
function takeMetadata(bytes) {
  const found = metadataOf(new TextDecoder().decode(bytes.subarray(0, 1 << 20)));
  if (found) metadata = new Map([...(metadata ?? []), ...found]);
  return found !== null;
}

/**
 * @param {string} file
 * @param {Uint8Array} bytes
 * @param {Stated} [entered]  by the reader
 * @param {number} [place]    of the row that this replaces
 */
async function addFile(file, bytes, entered = {}, place = rows.length) {
  const row = metadata ? statedOf(metadata, file) : {};
  const { orientation = "" } = row;
  /** @type {Row[]} */
  let found;
  try {
    const motions = await worker.read(file, bytes, { ...entered, orientation }).catch((/** @type {Error} */ error) => {
      // What the file leaves open, as the table states it.
      const { units, dt } = asked(error.message);
      const stated = { ...(units && row.units ? { units: row.units } : {}), ...(dt && row.dt ? { dt: row.dt } : {}) };
      if (Object.keys(stated).length === 0) throw error;
      return worker.read(file, bytes, { ...stated, ...entered, orientation });
    });
    found = motions.map((motion) => ({
      label: motions.length > 1 ? `${file} (${motion.component || motion.number})` : file,
      file,
      motion,
      counts: true,
      source: (station) => recorded(motion, station),
    }));
  } catch (error) {
    found = [failedRow(file, /** @type {Error} */ (error).message, bytes)];
  }
  rows.splice(place, rows[place] ? 1 : 0, ...found);
  showRowsSoon();
  return found.find(slides);
}

/** @param {Row | null} row */
function select(row) {
  if (row !== selected) setWindow(null);
  selected = row;
  showRows();
  element("vertical").disabled = row?.joined?.verticalId == null;
  if (row?.motion) return changed();
  refuse("No record: drop files on the page, or choose a motion that it generates.");
  if (!element("many").hidden) slideMany();
}

function showRows() {
  const list = element("records");
  const focused = /** @type {HTMLElement} */ (document.activeElement);
  const within = list.contains(focused);
  const joined = new Set(rows.flatMap((row) => row.joined?.members ?? []));
  const hidden = (/** @type {Row} */ { motion }) => motion?.vertical && joined.has(motion.id); // it acts with those of its station
  list.replaceChildren(...rows.filter((row) => row.motion && !hidden(row)).map(rowElement));
  const failed = rows.filter((row) => !row.motion).map(failedElement);
  if (failed.some((one, i) => one !== element("asking").children[i]) || failed.length !== element("asking").children.length)
    element("asking").replaceChildren(...failed); // with what is typed in them
  const asking = rows.filter(asks).length;
  element("asking-note").hidden = asking === 0;
  element("asking-all").hidden = asking < 2;
  if (within) (list.contains(focused) ? focused : list.querySelector("[type=radio]:checked"))?.focus();
}

let rowsWait = false;

/** Once for many files. */
function showRowsSoon() {
  if (rowsWait) return;
  rowsWait = true;
  setTimeout(() => {
    rowsWait = false;
    showRows();
  }, 100);
}

/** @param {Row} row */
function removeButton(row) {
  const remove = make("button", { type: "button", textContent: "\u00d7", onclick: () => removeRow(row) });
  remove.setAttribute("aria-label", `Remove ${row.label}`);
  return remove;
}

/** @param {Row} row */
function failedElement(row) {
  if (row.failed) return row.failed;
  row.failed = make("li", { className: "failed" }, make("b", {}, row.label), removeButton(row), make("p", {}, reason(row)));
  if (asks(row)) row.failed.append(retryForm(row));
  row.failed.classList.toggle("asks", asks(row));
  return row.failed;
}

/** @param {Row} row */
function rowElement(row) {
  const { measures, vertical, orientation } = /** @type {Motion} */ (row.motion);
  if (vertical) {
    const note = `vertical (${orientation}): left out; it acts once a horizontal component of its station is here`;
    return make("li", { className: "aside" }, make("span", {}, `${row.label} `, make("small", {}, note)), removeButton(row));
  }
  const radio = make("input", { type: "radio", name: "record", checked: row === selected, onchange: () => select(row) });
  const facts = [
    shown(measures.pga, "acceleration"),
    `${digits(measures.duration)} s`,
    ...(row.joined?.planarId != null ? ["path"] : []),
    ...(row.joined?.verticalId != null ? ["vertical"] : []),
    ...(row.counts ? [] : ["not in the table"]),
  ];
  return make("li", {}, make("label", {}, radio, ` ${row.label} `, make("small", {}, facts.join(", "))), removeButton(row));
}

/** Why a file could not be read, in words of this page. @param {Row} row */
const reason = ({ file, error = "" }) =>
  error
    .replace(`read_record: ${file}: `, "")
    .replace(/: pass (units|dt), .*/s, "") // the page has fields
    .replace(/; pass gaps to keep it as a straight line/, "")
    .replace(/\bdt given\b/, "the time step entered")
    .replace(/\bunits given\b/, "the units entered");

/** What a message says that a file leaves open. @param {string} message */
const asked = (message) => ({ units: /pass units/.test(message), dt: /pass dt/.test(message) });

/** Whether a file leaves its units or its time step open. @param {Row} row */
const asks = ({ bytes, error = "" }) => bytes !== undefined && Object.values(asked(error)).some(Boolean);

/**
 * Asks for what a file leaves open.
 * @param {Row} row
 */
function retryForm(row) {
  const open = asked(row.error ?? "");
  const stated = metadata ? statedOf(metadata, row.file) : {};
  const choice = make("select", {}, make("option", { value: "" }, "choose"));
  for (const name of UNIT_NAMES) choice.append(make("option", {}, name));
  choice.value = stated.units ?? "";
  const dt = make("input", { type: "number", min: "0", step: "any", value: stated.dt ?? "" });
  const form = make(
    "form",
    {},
    ...(open.units ? [make("label", {}, "units ", choice)] : []),
    ...(open.dt ? [make("label", {}, "time step [s] ", dt)] : []),
    make("button", {}, "Read"),
  );
  form.onsubmit = (event) => {
    event.preventDefault();
    answer([row]);
  };
  row.entered = () => ({ ...(choice.value ? { units: choice.value } : {}), ...(dt.value ? { dt: Number(dt.value) } : {}) });
  return form;
}

const UNIT_NAMES = ["g", "m/s^2", "cm/s^2", "mm/s^2", "ft/s^2", "in/s^2"];

/** Reads files again, each with what is entered for it. @param {Row[]} asking */
async function answer(asking) {
  const found = [];
  for (const row of asking) {
    const entered = row.entered?.() ?? {};
    if (Object.keys(entered).length) found.push(await addFile(row.file, /** @type {Uint8Array} */ (row.bytes), entered, rows.indexOf(row)));
  }
  await join();
  const first = found.find((row) => row);
  if (first) select(first);
  else showRows();
}

/** Takes a row from the list. @param {Row} row */
function forget(row) {
  rows.splice(rows.indexOf(row), 1);
  if (row.motion) worker.discard([row.motion.id]);
  if (row === generated) generated = null;
}

/** @param {Row} row */
async function removeRow(row) {
  const place = rows.indexOf(row);
  forget(row);
  // A vertical component acts with the others of its station alone.
  for (const other of rows.filter(({ motion }) => motion?.vertical && row.joined?.members.includes(motion.id)))
    if (!rows.some((one) => one.joined?.members.includes(other.motion?.id ?? -1))) forget(other);
  await join();
  if (row === selected) select(rows.slice(place).find(slides) ?? rows.findLast(slides) ?? null);
  else showRows();
  if (!element("many").hidden) slideMany();
}

/** The motion of the generator is one row, which changes with its numbers. @type {Row | null} */
let generated = null;

/** @param {import("./sources.js").Generator} made  @returns {Record<string, number>} */
const valuesOf = (made) => Object.fromEntries(made.parameters.map(({ key, value }) => [key, Number(others[key] ?? value)]));

const generate = latest(async () => {
  const made = generator;
  if (!made) return;
  const values = valuesOf(made);
  try {
    const motion = await worker.generate(made.name, values);
    const old = generated;
    const said = made.parameters.map((one) => `${one.label} ${shown(values[one.key] ?? NaN, one.quantity ?? "none")}${one.unit ? ` ${one.unit}` : ""}`);
    generated = { label: `${made.label}, ${said.join(", ")}`, file: "", motion, counts: false, source: () => ({ files: [], python: made.python(values) }) };
    const aside = rows.findIndex((row) => row === old || (row.motion && !row.counts));
    const gone = aside >= 0 ? rows[aside] : undefined;
    if (gone) rows[aside] = generated;
    else rows.unshift(generated);
    if (gone?.motion) worker.discard([gone.motion.id]);
    select(generated);
  } catch (error) {
    refuse(/** @type {Error} */ (error).message);
  }
});

/** The record with which the page opens, if it holds one: it does not count. */
async function showSample() {
  const { name, dt } = element("sample").dataset;
  const bytes = unpacked("sample");
  const [motion] = bytes.length ? await worker.read(name, bytes, { units: "g", dt: Number(dt) }) : [];
  if (!motion) return false;
  const source = () => ({ files: [`sample:${name}`], python: [`motion = ss.sample_record("${name}")`] });
  const row = { label: `${name.replaceAll("_", " ")} (sample record)`, file: "", motion, counts: false, source };
  rows.unshift(row);
  select(row);
  return true;
}

// ---- the form

function linkText() {
  return toLink(settings, { ...others, ...units, ...(selected === generated && generator ? { motion: generator.name } : {}) });
}

function showGenerator() {
  generatorTrouble = "";
  element("generator-name").value = generator?.name ?? "";
  element("generate").hidden = !generator;
  element("generator-values").replaceChildren(
    ...(generator?.parameters ?? []).map((one) => {
      const of = one.quantity ? unit(one.quantity) : { name: one.unit ?? "", size: 1 };
      const held = String(toUnit(Number(others[one.key] ?? one.value), of));
      const made = entry(one.label, of.name, held, "", (text) => {
        const value = fromUnit(Number(text), of);
        const valid = text !== "" && value >= one.min && value <= one.max;
        const bounds = [one.min, one.max].map((bound) => digits(bound / of.size));
        const remark = valid ? "" : `${one.label} must be between ${bounds.join(" and ")} ${of.name}`;
        /** @type {HTMLElement} */ (made.querySelector(".remark")).textContent = remark;
        generatorTrouble = remark;
        if (!valid) return changed();
        others[one.key] = String(value);
        generate();
      });
      made.querySelector(".remark")?.classList.add("wrong");
      return made;
    }),
  );
}

/**
 * @param {string} label
 * @param {string} unitName
 * @param {string} value
 * @param {string} hint
 * @param {(text: string, input: HTMLInputElement) => void} onInput
 */
function entry(label, unitName, value, hint, onInput, type = "number") {
  const input = make("input", { type, step: "any", value, title: hint });
  input.oninput = () => onInput(input.value, input);
  return make("label", { title: hint }, make("span", {}, label), input, make("small", {}, unitName), make("small", { className: "remark" }));
}

/** Settings whose fields do not hold numbers. @type {Set<keyof Settings>} */
const unreadable = new Set();

/** @param {number | readonly number[]} value */
const listOf = (value) => (typeof value === "number" ? (Number.isNaN(value) ? [] : [value]) : value);

/** @param {Field} field */
const unitOfField = ({ quantity, unit: name = "" }) => (quantity ? unit(quantity) : { name, size: 1 });

/** Values of a setting in its unit. @param {Field} field  @param {readonly number[]} values */
function inField(field, values) {
  const of = unitOfField(field);
  return values.map((value) => toUnit(value, of)).join(" ") + (of.name ? ` ${of.name}` : "");
}

/** @param {Settings} s */
const inWords = (s) => described(s, (field) => inField(field, listOf(s[field.key])));

/** The coefficients of the surfaces as they were entered: the slider scales them. */
const typedMus = () => (settings.mus.length ? settings.mus : listOf(FIELDS.find(({ key }) => key === "mus")?.value ?? []));

function showForm() {
  element("law").value = String(settings.law);
  element("mu").value = String(settings.mu);
  element("mu-slider").value = String(settings.mu);
  element("pendulum").checked = settings.pendulum === 1;
  element("vertical").checked = settings.vertical === 1;
  element("clipped").checked = settings.clipped === 1;
  showFields();
}

/**
 * A setting as its field holds it.
 * @param {Field} field
 * @param {Settings} s
 */
const entered = (field, s) =>
  listOf(s[field.key])
    .map((value) => toUnit(value, unitOfField(field)))
    .join(" ");

/**
 * @param {Field} field
 * @param {HTMLInputElement} input
 */
function enter(field, input) {
  const { key } = field;
  const values = listed(input.value);
  const isList = typeof NOT_GIVEN[key] !== "number";
  const valid = values.every(Number.isFinite) && (isList || values.length <= 1) && !input.validity.badInput;
  unreadable[valid ? "delete" : "add"](key);
  if (valid) {
    const si = values.map((value) => fromUnit(value, unitOfField(field)));
    /** @type {any} */ (settings)[key] = isList ? si : (si[0] ?? NaN);
    if (key === "mus" && si.length) setMu(Math.max(...si));
  }
  if (FIELDS.some((one) => one.needs?.includes(key))) refreshFields();
  changed();
}

function showFields() {
  element("fields").replaceChildren();
  refreshFields();
}

/** Shows and hides the fields that depend on others; those that stay are not made anew, because one may be typed in. */
function refreshFields() {
  const full = completed(settings);
  element("pendulum").disabled = Number.isNaN(full.period) || LAWS[full.law]?.name === "pendulum";
  const fields = FIELDS.filter((field) => applies(field, full));
  const place = element("fields");
  for (const shown of [...place.children]) if (!fields.some(({ key }) => key === shown.dataset.key)) shown.remove();
  fields.forEach((field, i) => {
    if (place.children[i]?.dataset.key === field.key) return;
    const type = typeof full[field.key] === "number" ? "number" : "text";
    const held = entered(field, { ...full, mus: typedMus() });
    const made = entry(field.label, unitOfField(field).name, held, field.hint, (_, input) => enter(field, input), type);
    made.dataset.key = field.key;
    place.insertBefore(made, place.children[i] ?? null);
  });
}

/** @param {number} mu */
function setMu(mu) {
  settings.mu = mu;
  unreadable.delete("mu");
  if (document.activeElement !== element("mu")) element("mu").value = String(mu);
  element("mu-slider").value = String(mu);
  changed();
}

function listen() {
  element("files").onchange = async () => {
    await addFiles(element("files").files);
    element("files").value = "";
  };
  document.ondragover = (event) => event.preventDefault();
  document.ondrop = (event) => {
    event.preventDefault();
    if (event.dataTransfer?.files.length) addFiles([...event.dataTransfer.files]);
  };
  element("generator-name").onchange = () => {
    generator = GENERATORS.find((one) => one.name === element("generator-name").value);
    showGenerator();
    generate();
  };
  element("law").onchange = () => {
    settings.law = Number(element("law").value);
    unreadable.clear();
    showFields();
    if (LAWS[settings.law]?.name === "pendulum") setMu(Math.max(...typedMus()));
    else changed();
  };
  element("mu-slider").oninput = () => setMu(Number(element("mu-slider").value));
  element("mu").oninput = () => setMu(element("mu").value === "" ? NaN : Number(element("mu").value));
  for (const flag of /** @type {const} */ (["pendulum", "vertical", "clipped"]))
    element(flag).onchange = () => {
      settings[flag] = element(flag).checked ? 1 : 0;
      changed();
    };
  for (const quantity of /** @type {const} */ (["length", "acceleration"])) {
    const choice = element(`unit-${quantity}`);
    choice.value = units[quantity];
    choice.onchange = () => {
      /** @type {any} */ (units)[quantity] = choice.value;
      showRows();
      showFields();
      showGenerator();
      changed();
    };
  }
  element("theme").onchange = () => {
    document.documentElement.dataset.theme = element("theme").value;
    forgetColors();
    changed();
  };
  matchMedia("(prefers-color-scheme: dark)").onchange = () => {
    forgetColors();
    changed();
  };
  element("play").onclick = () => play(!playing);
  element("time").oninput = () => {
    play(false);
    goTo(Number(element("time").value));
  };
  for (const figure of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("figure[tabindex]"))) {
    const { spectrum } = figure.dataset;
    figure.onkeydown = (event) => {
      if (event.target !== figure || !response) return;
      const width = { "+": 0.5, "-": 2, Escape: Infinity }[event.key];
      if (width !== undefined && !spectrum) return zoom(width);
      const step = { ArrowLeft: -1, ArrowRight: 1, PageUp: -1, PageDown: 1 }[event.key];
      if (step === undefined) return;
      event.preventDefault();
      const far = event.key.startsWith("Page");
      if (spectrum === "sliding" || spectrum === "response" || spectrum === "curves") return moveOnSpectrum(spectrum, far ? 10 * step : step);
      const last = response.time.length - 1;
      const index = Math.min(last, Math.max(0, indexAt(response.time, now) + (far ? 50 * step : step)));
      goTo(response.time[index] ?? 0);
    };
  }
  const damping = element("zeta");
  damping.value = String(zeta());
  damping.oninput = () => {
    const valid = damping.value !== "" && Number(damping.value) >= 0 && Number(damping.value) < 2;
    damping.setCustomValidity(valid ? "" : "out of range");
    if (!valid) return;
    others.zeta = damping.value;
    changed();
  };
  element("whole").onclick = () => setWindow(null);
  element("csv").onclick = downloadCsv;
  element("svg").onclick = downloadSvg;
  element("sliding-csv").onclick = downloadSliding;
  element("response-csv").onclick = downloadResponse;
  element("path-csv").onclick = downloadPath;
  element("many-csv").onclick = downloadMany;
  element("curves-csv").onclick = downloadCurves;
  element("asking-read").onclick = () => answer(rows.filter(asks));
  element("asking-units").onchange = () => {
    for (const one of element("asking").querySelectorAll("select")) one.value = element("asking-units").value;
  };
  element("generate").onclick = () => {
    if (!generated) return;
    generated.counts = true;
    generated = null;
    showRows();
    if (!element("many").hidden) slideMany();
  };
  element("reading-cancel").onclick = () => (readingStopped = true);
  element("many-cancel").onclick = () => (cancelled = true);
  element("view-one").onclick = () => view(false);
  element("view-many").onclick = () => view(true);
  element("pin").onclick = () => {
    pinned = pinned ? null : { settings: { ...settings }, response };
    element("pin").setAttribute("aria-pressed", String(pinned !== null));
    changed();
  };
  element("link").onclick = () => {
    saveLink();
    copy(location.href, element("link"));
  };
  for (const button of /** @type {NodeListOf<HTMLButtonElement>} */ (document.querySelectorAll(".copy")))
    button.onclick = () => copy(element(button.dataset.of ?? "").textContent ?? "", button);
  new ResizeObserver(resize).observe(element("output"));
  addEventListener("beforeprint", () => onPaper(true));
  addEventListener("afterprint", () => onPaper(false));
}

function resize() {
  measureScene(element("scene"));
  for (const plot of Object.values(plots)) plot.resize();
  if (!element("many").hidden) curvePlot?.resize();
  setTime(now);
}

/** Draws in light colors and as wide as a sheet, or as before. @param {boolean} on */
function onPaper(on) {
  document.documentElement.classList.toggle("paper", on);
  document.documentElement.dataset.theme = on ? "light" : element("theme").value;
  forgetColors();
  resize();
}

/**
 * @param {string} text
 * @param {HTMLButtonElement} button
 */
async function copy(text, button) {
  const was = button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = "Copied";
  } catch {
    prompt("Copy with Ctrl+C:", text); // where the clipboard is not allowed
  }
  setTimeout(() => (button.textContent = was), 1500);
}

function downloadCsv() {
  if (!response || !selected) return;
  const { time, acceleration, velocity, displacement, force } = response;
  const rows = Array.from(time, (t, i) =>
    [t, acceleration[i], velocity[i], displacement[i], force[i]].map((value) => value ?? NaN),
  );
  const notes = [
    `stickslip: ${selected.label}; ${toLink(completed(settings))}`,
    ...comments(numbers()),
  ];
  const header = ["time_s", "ground_acceleration_m_s2", "velocity_m_s", "displacement_m", "force_m_s2"];
  download(`${fileName(selected)}.csv`, csv(header, rows, notes), "text/csv");
}

// ---- start

async function start() {
  element("law").append(...LAWS.map(({ label }, i) => make("option", { value: String(i) }, label)));
  element("asking-units").append(...UNIT_NAMES.map((name) => make("option", {}, name)));
  element("generator-name").append(...GENERATORS.map(({ name, label }) => make("option", { value: name }, label)));
  element("mounting").open = innerWidth > 800;
  listen();
  showForm();
  showGenerator();
  ranges = await worker.load(unpacked("library"));
  if (!generator && (await showSample())) return;
  generator ??= GENERATORS[0];
  showGenerator();
  generate();
}

start();
