// Many records: their table, and their peaks over mu.

import { latest } from "./client.js";
import { csv, download } from "./csv.js";
import { element, make } from "./dom.js";
import { resizePlots } from "./drawing.js";
import { CURVE_HEIGHT, LinePlot } from "./plots.js";
import { completed, toLink } from "./settings.js";
import { GRAVITY, problemOf, refuse, rows, settings, state, untilIdle, worker } from "./state.js";
import { statistics } from "./statistics.js";
import { groundNumbers } from "./tables.js";
import { digits } from "./units.js";
import { inUnits, inWords, shown, unit } from "./values.js";

/** @import { Row } from "./state.js" */

/** @typedef {{row: Row, normal: {peak: number, residual: number}, inverse: {peak: number, residual: number}, error?: string}} Pair */

/** @type {Pair[]} */
let pairs = [];

let cancelled = false;

export const cancelMany = () => void (cancelled = true);

/** The records of the table: what the reader chose, without vertical components. */
const countedRows = () => rows.filter(({ motion, counts }) => motion && counts && !motion.vertical);

export const slideMany = latest(async () => {
  cancelled = false;
  const found = [];
  const motions = countedRows();
  const given = JSON.stringify(settings);
  element("many-cancel").hidden = false;
  for (const row of motions) {
    if (state.broken) break;
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
    ...(aside ? [`\u201c${aside.label}\u201d does not count${aside === state.generated ? " unless you add it to the records" : ""}.`] : []),
  ].join(" ");
}

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
    if (cancelled || state.broken || element("many").hidden || key !== curvesKey()) return;
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

/** The point of the curves whose values are shown. */
let point = 0;

/** @param {number | null} index */
function readCurves(index) {
  if (index === null || !curves) return;
  point = index;
  const values = curves.peaks.map((peak) => peak[index] ?? NaN).filter((value) => !Number.isNaN(value));
  element("read-curves").textContent =
    `\u03bc = ${digits(curves.mus[index] ?? NaN)}: median ${shown(curves.median[index] ?? NaN, "length")}, ` +
    `from ${shown(Math.min(...values), "length")} to ${shown(Math.max(...values), "length")}`;
}

/** @param {number} step */
export function moveOnCurves(step) {
  const mus = curves?.mus ?? new Float64Array();
  const index = Math.min(mus.length - 1, Math.max(0, point + step));
  curvePlot?.point(mus[index] ?? 0);
  readCurves(index);
}

export function resizeCurves() {
  if (!element("many").hidden) curvePlot?.resize();
}

export function downloadCurves() {
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

export function downloadMany() {
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
export function view(many) {
  element("many").hidden = !many;
  element("one").hidden = many;
  element("top").hidden = many;
  element("view-one").setAttribute("aria-pressed", String(!many));
  element("view-many").setAttribute("aria-pressed", String(many));
  if (many) {
    showMany(); // in the present units
    if (state.broken) refuse(state.broken);
    else slideMany();
  } else resizePlots();
}
