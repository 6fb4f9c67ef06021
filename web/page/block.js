// Blocks that rock: their pictures, numbers and lines.

import { latest } from "./client.js";
import { csv, download } from "./csv.js";
import { element } from "./dom.js";
import { history, padded } from "./drawing.js";
import { updateCurves } from "./many.js";
import { color, levelLine, LinePlot, shade } from "./plots.js";
import { drawArrow, emptied, line } from "./scene.js";
import { completed, hasMu, imports, kindOf, record, toLink } from "./settings.js";
import { fileName, objects, problemOf, settings, state, units, untilIdle, worker } from "./state.js";
import { digits } from "./units.js";
import { inUnits, plain, shown, unit } from "./values.js";

/** @import { BlockSummary, Settings } from "./library.js" */
/** @import { Found, Row } from "./state.js" */
/** @import { Source } from "./sources.js" */

const rotationPlot = history("rotation", ["displacement", "pinned"]);
const basePlot = history("base", ["velocity", "pinned"]);
const overPlot = new LinePlot(element("plot-over"), ["displacement"], readOver, "number", { gaps: true });

/** @param {Float64Array} values  @param {number} unit */
const over = (values, unit) => values.map((value) => value / unit);

/** @param {BlockSummary} summary */
const outcome = ({ overturned, overturned_at }) =>
  overturned ? `overturns to the ${shown(overturned, "side")}, certain at ${shown(overturned_at, "time")}` : "stands";

/** Whether the sizes are probably in another unit, by the ranges of Python's `PlausibilityWarning`. @param {BlockSummary} summary */
function implausible({ p, alpha }) {
  for (const [range, name, value] of /** @type {[string, string, number][]} */ ([["frequency parameter", "p", p], ["angle of a slender block", "\u03b1", alpha]])) {
    const { bounds: [low, high] = [0, Infinity], where = "" } = state.ranges[range] ?? {};
    if ((value < low || value >= high) && !(name === "\u03b1" && hasMu(settings)))
      return name === "p" ? `p is ${shown(p, "rate")}, outside that of ${where}, ${low} to ${high} rad/s: is the unit right?` : `\u03b1 is ${shown(alpha, "angle")}: too much for small angles; take a rigid block`;
  }
  return "";
}

/** @param {Found} found  @param {Found | null} other  @param {Float64Array} time */
function show({ summary, rotation, displacement }, other, time) {
  const two = (/** @type {(found: any) => Float64Array} */ of, /** @type {any} */ found) => [
    padded(time, of(found), of(found).at(-1) ?? 0),
    other && of(other).length ? padded(time, of(other), of(other).at(-1) ?? 0) : new Float64Array(),
  ];
  element("title-rotation").textContent =
    `Rotation over \u03b1, of ${shown(summary.alpha, "angle")}: ` +
    (summary.overturned ? outcome(summary) : `peak ${digits(summary.peak_ratio)}, it stands`);
  rotationPlot.show(
    time,
    two((one) => over(one.rotation, one.summary.alpha), { rotation, summary }),
    {
      after: (u, ctx) => {
        for (const side of [-1, 1]) levelLine(u, ctx, side, { stroke: "level", dash: [2, 3] });
      },
    },
  );
  element("figure-base").hidden = displacement.length === 0;
  if (displacement.length) {
    element("title-base").textContent = `Displacement of the base relative to the ground [${unit("length").name}]`;
    basePlot.resize(); // it may have been hidden
    basePlot.show(time, two((one) => inUnits(one.displacement, "length"), { displacement }));
  }
  const place = element("fields").querySelector("[data-key=height] .remark");
  if (place) place.textContent = implausible(summary);
  showOver();
}

/** @param {Found} found  @param {(values: Float64Array) => number} at  @param {HTMLCanvasElement} canvas */
function showTime({ summary, rotation, displacement, gap, acceleration }, at, canvas) {
  const theta = at(rotation);
  const { width: wide, height: high } = completed(settings);
  const { ctx, width, height } = emptied(canvas);
  const floor = height - 18;
  // The block stands or lies in the picture.
  const size = Math.min((floor - 6) / Math.hypot(wide, high), (width / 2 - 12) / (high + wide / 2));
  ctx.strokeStyle = color("ink");
  ctx.lineWidth = 1.5;
  line(ctx, 0, floor, width, floor);
  /** @param {number} x  of the middle of the base  @param {number} y  @param {number} turn */
  const outline = (x, y, turn) => {
    ctx.save();
    ctx.translate(width / 2 + x * size, floor - y * size);
    ctx.rotate(turn);
    ctx.beginPath();
    ctx.rect((-wide / 2) * size, -high * size, wide * size, high * size);
    ctx.restore();
  };
  ctx.strokeStyle = color("quiet");
  ctx.lineWidth = 1;
  ctx.setLineDash([4, 3]);
  outline(0, 0, 0);
  ctx.stroke();
  ctx.setLineDash([]);
  ctx.fillStyle = color("displacement");
  // About the corner on which it stands; where the base slides, the library follows its middle.
  const x = displacement.length ? at(displacement) : Math.sign(theta) * (wide / 2) * (1 - Math.cos(theta));
  outline(x, (gap.length ? at(gap) : 0) + (wide / 2) * Math.abs(Math.sin(theta)), theta);
  ctx.fill();
  drawArrow(ctx, summary.pga > 0 ? at(acceleration) / summary.pga : 0);
  const base = displacement.length ? `, base ${shown(plain(x), "length")}` : "";
  return `rotation ${digits(plain(theta / summary.alpha))} \u03b1, ${shown(plain(theta), "angle")}${base}`;
}

// ---- over the size or the friction

const POINTS = 60;
const PART = 6;
/** @type {{key: string, xs: Float64Array, ratios: Float64Array} | null} */
let found = null;
let point = 0;

/** Whether the chart is over the coefficient of friction, or over the height of blocks of the same shape. */
const ofMu = () => hasMu(settings) && element("over").value === "mu";

const axis = () =>
  ofMu()
    ? { name: "\u03bc", csv: "mu", size: 1, at: settings.mu, from: 0.02, to: 2 }
    : { name: "height", csv: "height_m", size: unit("length").size, at: completed(settings).height, from: NaN, to: NaN };

/** Levels around the present one, or of friction. @param {number} count */
function levels(count) {
  const { from, to, at } = axis();
  const [first, last] = ofMu() ? [from, to] : [at / 4, 4 * at];
  return Float64Array.from({ length: count }, (_, i) => first + (last - first) * (i / (count - 1)));
}

/** What the chart depends on: not the coefficient along its axis. */
const overKey = () => JSON.stringify([{ ...completed(settings), ...(ofMu() ? { mu: 1 } : {}) }, ofMu()]);

/** In parts, while nothing else is asked. */
const updateOver = latest(async () => {
  const row = state.selected;
  if (!row?.motion || state.broken || kindOf(settings) !== "block") return;
  element("over-label").hidden = !hasMu(settings);
  const [full, id] = problemOf(settings, row);
  const key = `${id} ${overKey()}`;
  if (found?.key === key) return;
  const [xs, ratios] = [levels(POINTS), new Float64Array(POINTS)];
  for (let i = 0; i < POINTS; i += PART) {
    await untilIdle();
    if (row !== state.selected || state.broken || kindOf(settings) !== "block" || key !== `${id} ${overKey()}`) return;
    const part = await worker.rockOver(id, full, xs.slice(i, i + PART), ofMu()).catch(() => null);
    if (!part) return;
    ratios.set(part, i);
  }
  found = { key, xs, ratios };
  showOver();
});

function showOver() {
  if (!found) return;
  const { xs, ratios } = found;
  const { size, at } = axis();
  const title = ofMu() ? "over \u03bc" : `over the height [${unit("length").name}] of blocks of this shape`;
  element("title-over").textContent = `Peak rotation over \u03b1 ${title}; shaded where they overturn`;
  const middle = (/** @type {number} */ i) => ((xs[Math.max(i, 0)] ?? 0) + (xs[Math.min(i + 1, xs.length - 1)] ?? 0)) / 2 / size;
  const fallen = [...ratios.keys()].filter((i) => ratios[i] === Infinity).map((i) => /** @type {[number, number]} */ ([middle(i - 1), middle(i)]));
  overPlot.show(
    xs.map((x) => x / size),
    [ratios.map((ratio) => (ratio < Infinity ? ratio : NaN))],
    { before: (u, ctx) => shade(u, ctx, fallen), range: [0, 1], key: [found.key, units.length, color("ink")].join(" ") },
  );
  overPlot.marks([{ axis: "x", value: at / size }]);
}

/** @param {number | null} index */
function readOver(index) {
  if (index === null || !found) return;
  point = index;
  const ratio = found.ratios[index] ?? NaN;
  const { name, size } = axis();
  const what = ratio === Infinity ? "overturns" : Number.isNaN(ratio) ? "no result" : `peak ${digits(ratio)} \u03b1`;
  element("read-over").textContent = `${name} = ${digits((found.xs[index] ?? NaN) / size)}${ofMu() ? "" : ` ${unit("length").name}`}: ${what}`;
}

/** @param {number} step */
export function moveOnOver(step) {
  if (!found) return;
  const index = Math.min(found.xs.length - 1, Math.max(0, point + step));
  overPlot.point((found.xs[index] ?? 0) / axis().size);
  readOver(index);
}

export function listenToBlock() {
  element("over").onchange = () => {
    updateOver();
    if (!element("many").hidden) updateCurves();
  };
  element("over-csv").onclick = () => {
    if (!found || !state.selected) return;
    const lines = Array.from(found.xs, (x, i) => [x, found?.ratios[i] ?? NaN]);
    const comment = `stickslip: ${state.selected.label}; ${toLink(completed(settings))}`;
    download(`${fileName(state.selected)}_rocking.csv`, csv([axis().csv, "peak_rotation_ratio"], lines, [comment]), "text/csv");
  };
}

// ---- lines

/** @param {Settings} s  @param {Source} source */
function command(s, source) {
  if (source.files.length === 0 || source.station) return null;
  const words = ["stickslip rock", ...record(source), "--width", s.width, "--height", s.height];
  if (!Number.isNaN(s.mu)) words.push("--mu", s.mu);
  if (!Number.isNaN(s.restitution)) words.push("--restitution", s.restitution);
  if (s.scale !== 1) words.push(`--scale=${s.scale}`);
  return words.join(" ");
}

/** @param {Settings} s  @param {Source} source  @param {Row} _  @param {Found | null} response */
function python(s, source, _, response) {
  const restitution = Number.isNaN(s.restitution) ? "" : `, restitution=${s.restitution}`;
  const size = `width=${s.width}, height=${s.height}`;
  const settles = (response?.summary.restitution ?? 0) < 1 && s.mu !== 0;
  return [
    ...imports(source),
    `block = ss.${Number.isNaN(s.mu) ? `SlenderBlock.from_size(${size}` : `RockingBlock(${size}, mu=${s.mu}`}${restitution})`,
    `response = ss.integrate(block, motion${s.scale === 1 ? "" : `.scaled(${s.scale})`}${settles ? ", settle=True" : ""})`,
    "print(response.peak_rotation_ratio, response.overturned, response.impacts, response.margin)",
  ].join("\n");
}

/** @param {Settings} s  @param {Row} row  @param {Found} found */
function report(s, row, { summary }) {
  const model = Number.isNaN(s.mu) ? "a slender block that does not slip (Housner)" : `a rigid block (\u03bc = ${s.mu})`;
  const peak = summary.overturned ? "" : ` Its rotation reaches ${digits(summary.peak_ratio)} of the angle \u03b1.`;
  return (
    `A uniform block, ${shown(s.width, "length")} wide and ${shown(s.height, "length")} high (p = ${shown(summary.p, "rate")}, ` +
    `\u03b1 = ${shown(summary.alpha, "angle")}, restitution ${digits(summary.restitution)}), was subjected to the ground motion ${row.label} ` +
    `(PGA ${shown(summary.pga, "acceleration")}${s.vertical ? ", with its vertical component" : ""}${s.scale === 1 ? "" : `, scaled by ${s.scale}`}), ` +
    `as ${model}. It ${outcome(summary)}, after ${summary.impacts} impacts.${peak} Computed with stickslip, event by event; the closest ` +
    `decision has a relative margin of ${digits(summary.margin)}. A single history may be chaotic: compare several scales and records.`
  );
}

/** @param {Found} found */
function remark({ summary }) {
  if (summary.condition * 1e-16 > 1e-6) return "The history hangs on round-off: only probabilities mean something.";
  if (summary.overturned) return "Whether a block overturns is not monotone in the scale of a record: it may stand at a larger one.";
  return summary.at_rest ? "" : "It never comes to rest; these are the numbers at the end of the record.";
}

objects.block = {
  caption: "A block on level ground",
  remark,
  plane: false,
  histories: [rotationPlot, basePlot],
  others: [overPlot],
  async respond(full, row) {
    const [s, id] = problemOf(full, row);
    return { kind: "block", ...(await worker.rock(id, s)) };
  },
  update: updateOver,
  answer: ({ summary }) => [summary.overturned ? ["it", outcome(summary)] : ["peak rotation", `${digits(summary.peak_ratio)} \u03b1`]],
  numbers: ({ summary }) => [
    ["peak rotation over \u03b1", summary.peak_ratio, "none", ""],
    ["peak rotation", summary.peak_rotation, "angle", "rad"],
    ["overturned", summary.overturned, "side", ""],
    ["certain at", summary.overturned_at, "time", "s"],
    ["impacts", summary.impacts, "none", ""],
    ["uplifts", summary.uplifts, "none", ""],
    ["time rocking", summary.time_rocking, "time", "s"],
    .../** @type {import("./tables.js").Line[]} */ (
      hasMu(settings)
        ? [
            ["lift-offs", summary.liftoffs, "none", ""],
            ["base displaced", summary.residual, "length", "m"],
            ["sliding distance", summary.sliding_distance, "length", "m"],
          ]
        : [["condition", summary.condition, "none", ""]]
    ),
    ["p", summary.p, "rate", "rad/s"],
    ["\u03b1", summary.alpha, "angle", "rad"],
    ["restitution", summary.restitution, "none", ""],
  ],
  levels: () => [],
  show,
  showTime,
  columns: ({ rotation, displacement }) => ({ rotation_rad: rotation, ...(displacement.length ? { base_displacement_m: displacement } : {}) }),
  panels: ({ summary, rotation }) => [
    { title: `Rotation over \u03b1: ${outcome(summary)}`, lines: [{ values: over(rotation, summary.alpha), stroke: "#d55e00" }], levels: [] },
  ],
  command,
  python,
  report,
  table: {
    title: "Rocking of all records, as recorded (a reversed one is the mirror image)",
    columns: () => [
      ["peak over \u03b1", "none", "peak_rotation_ratio"],
      ["overturned", "none", "overturned"],
      ["impacts", "none", "impacts"],
      ["margin", "none", "margin"],
      ...(hasMu(settings) ? [/** @type {[string, import("./units.js").Quantity, string]} */ (["base displaced", "length", "base_displacement_m"])] : []),
    ],
    async values(row) {
      const [full, id] = problemOf(settings, row);
      const { summary } = await worker.rock(id, full);
      const { peak_ratio, overturned, impacts, margin, residual } = summary;
      return [peak_ratio, overturned, impacts, margin, ...(hasMu(settings) ? [residual] : [])];
    },
    text: (value, column) => (column === 1 ? (Number.isNaN(value) ? "" : shown(value, "side")) : null),
    counts: (column) => column === 0 || column === 4,
    note: (all) => (all.length ? `${all.filter(([, side = 0]) => side !== 0 && !Number.isNaN(side)).length} of ${all.length} overturn.` : ""),
  },
  curves: {
    over: () => {
      const { name, csv, size, at } = axis();
      return { name, csv, size, at, values: () => levels(25), key: overKey() };
    },
    async peaks(row, values) {
      const [full, id] = problemOf(settings, row);
      return worker.rockOver(id, full, values, ofMu());
    },
    csv: "peak rotation over alpha, infinite where it overturns",
    title: () =>
      `Peak rotation over \u03b1 ${ofMu() ? "over \u03bc" : `over the height [${unit("length").name}]`}: each record, to where it overturns; median colored`,
    quantity: "none",
    logarithmic: false,
  },
};
