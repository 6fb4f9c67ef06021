// Many records, whatever moves: their table, and curves of each.

import { latest } from "./client.js";
import { csv, download } from "./csv.js";
import { element, make } from "./dom.js";
import { resizePlots } from "./drawing.js";
import { CURVE_HEIGHT, LinePlot } from "./plots.js";
import { completed, kindOf, toLink } from "./settings.js";
import { GRAVITY, objects, problemOf, refuse, rows, settings, state, untilIdle } from "./state.js";
import { statistics } from "./statistics.js";
import { groundNumbers } from "./tables.js";
import { digits } from "./units.js";
import { inUnits, inWords, shown, unit } from "./values.js";

/** @import { Row } from "./state.js" */

/** @type {{row: Row, values: number[], error?: string}[]} */
let lines = [];

let cancelled = false;

export const cancelMany = () => void (cancelled = true);

const object = () => objects[kindOf(settings)];

/** The records of the table: what the reader chose, without vertical components; one of a station if all of them act. */
function countedRows() {
  const counted = rows.filter(({ motion, counts }) => motion && counts && !motion.vertical);
  if (!object().plane) return counted;
  const stations = new Set();
  return counted.filter((row) => {
    const station = row.joined?.planarId ?? null;
    const key = station === null ? row : row.joined?.members.join();
    return !stations.has(key) && stations.add(key);
  });
}

export const slideMany = latest(async () => {
  cancelled = false;
  const found = [];
  const motions = countedRows();
  const { table } = object();
  const given = JSON.stringify(settings);
  element("many-cancel").hidden = false;
  for (const row of motions) {
    if (state.broken) break;
    element("many-progress").textContent = `Record ${found.length + 1} of ${motions.length}`;
    try {
      found.push({ row, values: await table.values(row) });
    } catch (error) {
      found.push({ row, values: table.columns().map(() => NaN), error: /** @type {Error} */ (error).message });
    }
    if (cancelled || given !== JSON.stringify(settings)) break;
  }
  element("many-cancel").hidden = true;
  element("many-progress").textContent = cancelled ? `Cancelled after ${found.length} of ${motions.length}` : "";
  if (table !== object().table) return; // the next one is coming
  lines = found;
  showMany();
  updateCurves();
});

/** What is not in the table, and why. */
function manyNote() {
  const vertical = rows.filter(({ motion }) => motion?.vertical).map(({ label }) => label);
  const aside = rows.find(({ motion, counts }) => motion && !counts);
  return [
    ...(countedRows().length ? [] : ["No record yet: drop files on the page."]),
    object().table.note(lines.map(({ values }) => values)),
    ...(vertical.length ? [`Left out, because they are vertical: ${vertical.join(", ")}.`] : []),
    ...(aside ? [`\u201c${aside.label}\u201d does not count${aside === state.generated ? " unless you add it to the records" : ""}.`] : []),
  ]
    .filter((one) => one)
    .join(" ");
}

/** Of each record. @type {{key: string, labels: string[], xs: Float64Array, peaks: Float64Array[], median: Float64Array} | null} */
let curves = null;

/** @type {LinePlot | null} */
let curvePlot = null;

/** What the curves depend on. */
const curvesKey = () => JSON.stringify([object().curves?.over().key, countedRows().map((row) => problemOf(settings, row)[1])]);

export const updateCurves = latest(async () => {
  const counted = countedRows();
  const [key, of] = [curvesKey(), object().curves];
  if (curves?.key === key) return showCurves();
  curves = null;
  element("figure-curves").hidden = true;
  if (!counted.length || !of) return;
  const highest = Math.max(...counted.map(({ motion }) => ((motion?.measures.pga ?? 0) * Math.abs(settings.scale)) / GRAVITY));
  const { values: levels, name } = of.over();
  const xs = levels(highest);
  /** @type {Float64Array[]} */
  const peaks = [];
  for (const row of counted) {
    await untilIdle();
    if (cancelled || state.broken || element("many").hidden || key !== curvesKey()) return;
    element("many-progress").textContent = `Peak over ${name}: record ${peaks.length + 1} of ${counted.length}`;
    element("many-cancel").hidden = false;
    peaks.push(await of.peaks(row, xs));
  }
  element("many-cancel").hidden = true;
  element("many-progress").textContent = "";
  const median = xs.map((_, i) => statistics(peaks.map((peak) => peak[i] ?? NaN)).median);
  curves = { key, labels: counted.map(({ label }) => label), xs, peaks, median };
  showCurves();
});

function showCurves() {
  const of = object().curves;
  if (!curves || !of) return;
  const { xs, peaks, median } = curves;
  const { size, at } = of.over();
  const figure = element("figure-curves");
  figure.hidden = false;
  element("title-curves").textContent = of.title();
  const drawn = `${peaks.length} ${of.csv}`;
  if (figure.dataset.lines !== drawn) {
    curvePlot?.destroy();
    const strokes = [...peaks.map(() => "pinned"), "displacement"];
    const how = { logarithmic: of.logarithmic, gaps: true, dashed: false, height: CURVE_HEIGHT };
    curvePlot = new LinePlot(element("plot-curves"), strokes, readCurves, of.logarithmic ? "logarithm" : "number", how);
    figure.dataset.lines = drawn;
  }
  curvePlot?.resize();
  curvePlot?.show(
    xs.map((x) => x / size),
    [...peaks, median].map((values) => inUnits(values, of.quantity).map((value) => (value < Infinity ? value : NaN))),
  );
  curvePlot?.marks([{ axis: "x", value: at / size }]);
}

/** The point of the curves whose values are shown. */
let point = 0;

/** @param {number | null} index */
function readCurves(index) {
  const of = object().curves;
  if (index === null || !curves || !of) return;
  point = index;
  const { name, size } = of.over();
  const values = curves.peaks.map((peak) => peak[index] ?? NaN).filter((value) => !Number.isNaN(value));
  element("read-curves").textContent =
    `${name} = ${digits((curves.xs[index] ?? NaN) / size)}: median ${shown(curves.median[index] ?? NaN, of.quantity)}, ` +
    `from ${shown(Math.min(...values), of.quantity)} to ${shown(Math.max(...values), of.quantity)}`;
}

/** @param {number} step */
export function moveOnCurves(step) {
  const of = object().curves;
  if (!curves || !of) return;
  const index = Math.min(curves.xs.length - 1, Math.max(0, point + step));
  curvePlot?.point((curves.xs[index] ?? 0) / of.over().size);
  readCurves(index);
}

export function resizeCurves() {
  if (!element("many").hidden) curvePlot?.resize();
}

export function downloadCurves() {
  const of = object().curves;
  if (!curves || !of) return;
  const { xs, peaks, median, labels } = curves;
  const all = Array.from(xs, (x, i) => [x, median[i] ?? NaN, ...peaks.map((peak) => peak[i] ?? NaN)]);
  const { csv: over } = of.over();
  const note = `stickslip: ${of.csv}; ${toLink({ ...completed(settings), ...(over === "mu" ? { mu: NaN } : {}) })}`;
  download(`peaks_over_${over}.csv`, csv([over, "median", ...labels], all, [note]), "text/csv");
}

/** @returns {[string, number[]][]}  mean, median and standard deviation of each column that has them */
function manyStatistics() {
  const { columns, counts } = object().table;
  const all = columns().map((_, i) => statistics(counts(i) ? lines.map(({ values }) => values[i] ?? NaN) : []));
  return [
    ["mean", all.map((one) => one.mean)],
    ["median", all.map((one) => one.median)],
    ["standard deviation", all.map((one) => one.deviation)],
  ];
}

function showMany() {
  const { title, columns, text } = object().table;
  const heads = columns();
  element("many-title").textContent = title;
  element("many-settings").textContent = inWords(completed(settings));
  element("many-note").textContent = manyNote();
  const cells = (/** @type {number[]} */ values) =>
    values.map((value, i) => make("td", {}, text(value, i) ?? digits(value / unit(heads[i]?.[1] ?? "none").size)));
  const table = element("many-table");
  table.tHead.replaceChildren(
    make(
      "tr",
      {},
      make("th", {}, "record"),
      make("th", {}, "PGA"),
      ...heads.map(([head, quantity]) => make("th", {}, `${head}${unit(quantity).name ? ` [${unit(quantity).name}]` : ""}`)),
    ),
  );
  table.tBodies[0].replaceChildren(
    ...lines.map(({ row, values, error }) => {
      const pga = shown((row.motion?.measures.pga ?? NaN) * Math.abs(settings.scale), "acceleration");
      const head = make("th", { scope: "row" }, row.label, ...(error ? [make("small", {}, ` ${error}`)] : []));
      const line = make("tr", {}, head, make("td", {}, pga), ...cells(values));
      line.dataset.si = JSON.stringify(values.map((value) => (Number.isFinite(value) ? value : String(value))));
      return line;
    }),
  );
  table.tFoot.replaceChildren(
    ...manyStatistics().map(([head, values]) =>
      make(
        "tr",
        {},
        make("th", { scope: "row", colSpan: 2 }, head),
        ...cells(values).map((cell, i) => (object().table.counts(i) ? cell : make("td"))),
      ),
    ),
  );
}

export function downloadMany() {
  const ground = ["pga_m_s2", "pgv_m_s", "arias_m_s", "d5_95_s", "tm_s"];
  const header = ["record", ...ground, ...object().table.columns().map(([, , name]) => name)];
  const all = lines.map(({ row, values }) => [row.label, ...groundNumbers(row).map(([, value]) => value), ...values]);
  const ends = manyStatistics().map(([head, values]) => [
    head,
    ...ground.map(() => ""),
    ...values.map((value, i) => (object().table.counts(i) ? value : "")),
  ]);
  download("records.csv", csv(header, [...all, ...ends], [`stickslip: ${toLink(completed(settings))}`]), "text/csv");
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
