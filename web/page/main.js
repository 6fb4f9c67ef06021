// The page: what it shows, and what its reader does.

import { decompress } from "fzstd";

import { latest, startWorker } from "./client.js";
import { csv, download } from "./csv.js";
import { color, CurvePlot, forgetColors, levelLine, LinePlot, shade } from "./plots.js";
import { drawScene, measureScene } from "./scene.js";
import {
  applies,
  command,
  completed,
  FIELDS,
  fromLink,
  given,
  LAWS,
  listed,
  pathCommand,
  pathPython,
  PERIODS,
  python,
  spectrumCommand,
  spectrumPython,
  toLink,
} from "./settings.js";
import { GENERATORS, recorded } from "./sources.js";
import { fromText } from "./packed.js";
import { statistics } from "./statistics.js";
import { svg } from "./svg.js";
import { digits, unitOf } from "./units.js";

/** @import { Settings, Summary } from "./library.js" */
/** @import { Field } from "./settings.js" */
/** @import { Motion, Response } from "./worker.js" */
/** @import { Source } from "./sources.js" */
/** @import { Choice, Quantity } from "./units.js" */

/**
 * A line of the list of records: a ground motion, or a file that could not be read.
 * @typedef {Object} Row
 * @property {string} label
 * @property {string} file
 * @property {Motion} [motion]
 * @property {(vertical: boolean) => Source} source
 * @property {string} [error]
 * @property {Uint8Array} [bytes]  of a file that could not be read, to try again
 * @property {HTMLLIElement} [failed]  what says that it could not
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
const worker = startWorker(element("worker").textContent ?? "");

let { settings, others } = fromLink(location.hash.slice(1));
/** @type {Choice} */
const units = {
  length: others.length === "in" ? "in" : "cm",
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
let generator = GENERATORS.find((one) => one.name === others.motion) ?? GENERATORS[0];

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
    new LinePlot(element(`plot-${name}`), strokes, onCursor, "time", setWindow);
  return {
    acceleration: history("acceleration", ["acceleration"]),
    velocity: history("velocity", ["velocity", "pinned"]),
    displacement: history("displacement", ["displacement", "pinned"]),
    hysteresis: new CurvePlot(element("plot-hysteresis"), "force"),
    path: new CurvePlot(element("plot-path"), "displacement"),
    sliding: new LinePlot(element("plot-sliding"), ["displacement", "velocity"], (i) => readSpectrum("sliding", i), "number"),
    response: new LinePlot(element("plot-response"), ["acceleration"], (i) => readSpectrum("response", i), "logarithm"),
  };
}

const update = latest(async () => {
  const row = selected;
  if (!row?.motion) return;
  const [now, id] = problemOf(settings, row.motion);
  const change = changes;
  const done = (/** @type {string} */ state) => {
    if (change === changes) document.body.dataset.state = state; // else the next one is coming
  };
  try {
    const found = await worker.slide(id, now);
    if (pinned) {
      const [others, other] = problemOf(pinned.settings, row.motion);
      pinned.response = await worker.slide(other, others).catch(() => null);
    }
    if (row !== selected) return;
    response = found;
    element("trouble").textContent = "";
    done("shown");
  } catch (error) {
    response = null;
    element("trouble").textContent = /** @type {Error} */ (error).message;
    done("failed");
  }
  show(now, row);
});

/**
 * What a motion slides with: the settings that have a meaning, and the motion with or without its vertical component.
 * @param {Settings} given
 * @param {Motion} motion
 * @returns {[Settings, number]}
 */
function problemOf(given, motion) {
  const full = completed(given);
  if (motion.verticalId === null) full.vertical = 0;
  return [full, full.vertical && motion.verticalId !== null ? motion.verticalId : motion.id];
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
  update();
  updateSliding();
  updateResponseSpectrum();
  updatePath();
  if (!element("many").hidden) slideMany();
}

// ---- spectra

/** @type {{key: string, mus: Float64Array, peak: Float64Array, residual: Float64Array} | null} */
let sliding = null;
const LEVELS = 100;
const PART_TIME = 20; // of a part [ms]: a change waits for it

/** What the spectrum depends on: not mu, to which the coefficients of several surfaces are scaled. @param {Motion} motion */
const slidingKey = (motion) => JSON.stringify(problemOf({ ...settings, mu: 1 }, motion));

/** In parts, while nothing else is asked: it does not depend on mu, so that a moving slider can wait for it. */
const updateSliding = latest(async () => {
  const row = selected;
  if (!row?.motion) return;
  const [full, id] = problemOf(settings, row.motion);
  const key = slidingKey(row.motion);
  if (sliding?.key === key) return; // `show` has drawn it
  const highest = Math.max((row.motion.measures.pga * Math.abs(full.scale)) / GRAVITY, 0.01);
  const mus = Float64Array.from({ length: LEVELS }, (_, i) => ((i + 1) / LEVELS) * highest);
  const [peak, residual] = [new Float64Array(LEVELS), new Float64Array(LEVELS)];
  for (let i = 0, count = 4; i < LEVELS; ) {
    await untilIdle();
    if (row !== selected || key !== slidingKey(row.motion)) return;
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
  if (!row?.motion) return;
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
  const source = row.source(false);
  element("response-command").textContent = spectrumCommand(source, zeta(), settings.scale) ?? NO_COMMAND;
  element("response-python").textContent = spectrumPython(source, zeta(), settings.scale);
}

/** The point of each spectrum whose values are shown. */
const points = { sliding: 0, response: 0 };

/**
 * @param {keyof typeof points} which
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
  const xs = which === "sliding" ? (sliding?.mus ?? new Float64Array()) : PERIODS;
  const index = Math.min(xs.length - 1, Math.max(0, points[which] + step));
  plots[which].point(xs[index] ?? 0);
  readSpectrum(which, index);
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
  const comments = [
    `stickslip: ${spectrum.row.label}; damping ratio ${zeta()}; scale ${settings.scale}`,
    ...described(groundNumbers(spectrum.row)),
  ];
  const header = ["period_s", "pseudo_acceleration_m_s2"];
  download(`${fileName(spectrum.row)}_response_spectrum.csv`, csv(header, lines, comments), "text/csv");
}

// ---- the path in the plane

/** @type {{row: Row, summary: Summary, time: Float64Array, axis: Float64Array, transverse: Float64Array} | null} */
let path = null;

const SLOW = 100; // [ms]: a path that takes longer waits until the slider rests
let pathTime = 0; // that the last path took [ms]

const updatePath = latest(async () => {
  if (pathTime > SLOW) await untilIdle();
  const row = selected;
  const id = row?.motion?.planarId ?? null;
  const full = completed(settings);
  let trouble = "";
  const figure = element("figure-path");
  const change = changes;
  const refuse = (/** @type {Error} */ error) => ((trouble = error.message), null);
  const begin = performance.now();
  const found = id === null ? null : await worker.path(id, full).catch(refuse);
  pathTime = performance.now() - begin;
  if (row !== selected) return;
  figure.hidden = id === null;
  element("path").hidden = found === null;
  path = row && found ? { row, ...found } : null;
  element("title-path").textContent = path
    ? `Path in the plane [${unit("length").name}], friction along the velocity`
    : `No path in the plane: ${trouble}`;
  if (!path || !row?.motion) return;
  plots.path.resize();
  plots.path.show(inUnits(path.axis, "length"), inUnits(path.transverse, "length"), true);
  showPointOfPath();
  element("path-numbers").tBodies[0].replaceChildren(...pathNumbers().map((line) => tableRow(line)));
  const hasVertical = row.motion.verticalId !== null;
  element("path-command").textContent = pathCommand(full, row.source(false), hasVertical) ?? NO_COMMAND;
  const even = !Number.isNaN(row.motion.measures.dt);
  element("path-python").textContent = pathPython(full, row.source(true), hasVertical, even, path.summary.at_rest === 1);
  if (change === changes) figure.dataset.state = "shown";
});

/** @returns {Line[]} */
const pathNumbers = () => (path ? [...slideNumbers(path.summary), ...certificate(path.summary)] : []);

function downloadPath() {
  if (!path) return;
  const { row, time, axis, transverse } = path;
  const lines = Array.from(time, (t, i) => [t, axis[i] ?? NaN, transverse[i] ?? NaN]);
  const comments = [`stickslip: ${row.label}, in the plane; ${toLink(completed(settings))}`, ...described(pathNumbers())];
  download(`${fileName(row)}_path.csv`, csv(["time_s", "axis_m", "transverse_m"], lines, comments), "text/csv");
}

// ---- many records

/** @typedef {{row: Row, normal: {peak: number, residual: number}, inverse: {peak: number, residual: number}, error?: string}} Pair */

/** @type {Pair[]} */
let pairs = [];
let cancelled = false;

const slideMany = latest(async () => {
  cancelled = false;
  const found = [];
  const motions = rows.filter((row) => row.motion);
  const given = JSON.stringify(settings);
  element("many-cancel").hidden = false;
  for (const row of motions) {
    element("many-progress").textContent = `Record ${found.length + 1} of ${motions.length}`;
    const [full, id] = problemOf(settings, /** @type {Motion} */ (row.motion));
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
});

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
  element("view-one").setAttribute("aria-pressed", String(!many));
  element("view-many").setAttribute("aria-pressed", String(many));
  if (many) {
    showMany(); // in the present units
    slideMany();
  } else for (const plot of Object.values(plots)) plot.resize();
}

/**
 * @param {Settings} s
 * @param {Row} row
 */
function show(s, row) {
  const source = row.source(s.vertical === 1);
  element("command").textContent = command(s, source) ?? NO_COMMAND;
  element("python").textContent = python(s, source, response?.summary.at_rest !== 0);
  element("pinned").textContent = pinned ? `Compared with ${toLink(completed(pinned.settings)).replaceAll("&", ", ")} (dashed).` : "";
  element("output").classList.toggle("empty", response === null);
  if (!response) return;
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
  element("title-displacement").textContent = `Displacement relative to the ground [${length.name}]`;
  const [peak, residual] = [summary.peak / length.size, summary.residual / length.size];
  let [low, high] = [0, 0];
  for (let i = 0; i < displacement.length; ++i) {
    low = Math.min(low, displacement[i] ?? 0);
    high = Math.max(high, displacement[i] ?? 0);
  }
  const signed = -low > high ? -peak : peak;
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
        const label = `peak ${digits(peak)}`;
        const apart = Math.abs(u.valToPos(signed, "y") - u.valToPos(residual, "y")) > 16;
        const indent = apart ? 4 : ctx.measureText(label).width + 16;
        levelLine(u, ctx, signed, { stroke: "level", dash: [2, 3], label, below: signed > 0 });
        levelLine(u, ctx, residual, {
          stroke: "displacement",
          dash: [6, 3],
          label: `residual ${digits(residual)}`,
          below: residual < signed,
          indent,
        });
      },
    },
  );
  element("title-hysteresis").textContent = `Force per unit mass [${ground.name}] over displacement [${length.name}]`;
  plots.hysteresis.show(inUnits(displacement, "length"), inUnits(force, "acceleration"));
  showNumbers();
  showSliding();
  element("report").textContent = report(s, row);
  element("time").max = String(time.at(-1) ?? 1);
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
const described = (lines) => lines.map(([name, value, , si]) => `${name}${si ? ` [${si}]` : ""}: ${value}`);

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
    (field) => `${field.label} ${entered(field, s)}${field.unit ? ` ${field.unit}` : ""}`,
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
  plots.path.point(x / size, y / size);
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

/** @param {FileList | File[]} files */
async function addFiles(files) {
  let done = 0;
  const first = rows.length;
  readingStopped = false;
  element("reading-cancel").hidden = files.length === 1;
  for (const file of files) {
    element("progress").textContent = files.length > 1 ? `Reading file ${++done} of ${files.length}` : "Reading";
    const inside = await worker.unpack(file.name, new Uint8Array(await file.arrayBuffer()));
    for (const one of inside) {
      if ("error" in one) rows.push({ label: one.name, file: one.name, error: one.error, source: () => recordedAs(one.name) });
      else await addFile(one.name, one.bytes);
      if (readingStopped) break;
    }
    if (readingStopped) break;
  }
  element("reading-cancel").hidden = true;
  element("progress").textContent = "";
  select(rows.slice(first).find((row) => row.motion) ?? selected);
}

/**
 * @param {string} file
 * @param {{units?: string, dt?: number, component?: string, along?: string, vertical?: boolean}} [more]
 */
const recordedAs = (file, { units = "", dt = NaN, component = "", along = "", vertical = false } = {}) =>
  recorded({ file, units, dt, component, along, vertical });

/**
 * @param {string} file
 * @param {Uint8Array} bytes
 * @param {{units?: string, dt?: number}} [options]
 * @param {number} [place]  of the row that this replaces
 */
async function addFile(file, bytes, options = {}, place = rows.length) {
  /** @type {Row[]} */
  let found;
  try {
    const motions = await worker.read(file, bytes, options);
    found = motions.map((motion, i) => ({
      label: motions.length > 1 ? `${file} (${motion.component || i + 1})` : file,
      file,
      motion,
      source: (vertical) =>
        recordedAs(file, {
          ...options,
          // The command slides along a vertical component only if it is named.
          component: motion.several || motion.vertical ? motion.component || String(i + 1) : "",
          along: motion.orientation,
          vertical,
        }),
    }));
  } catch (error) {
    const message = /** @type {Error} */ (error).message;
    found = [{ label: file, file, error: message, bytes, source: () => recordedAs(file) }];
  }
  rows.splice(place, 1, ...found);
  showRowsSoon();
  return found[0];
}

/** @param {Row | null} row */
function select(row) {
  if (row !== selected) setWindow(null);
  selected = row;
  showRows();
  element("vertical").disabled = !row?.motion?.verticalId;
  if (row?.motion) return changed();
  response = null;
  element("output").classList.add("empty");
}

function showRows() {
  const list = element("records");
  const focused = /** @type {HTMLElement} */ (document.activeElement);
  const within = list.contains(focused);
  list.replaceChildren(...rows.map(rowElement));
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
function rowElement(row) {
  const remove = make("button", { type: "button", textContent: "\u00d7", onclick: () => removeRow(row) });
  remove.setAttribute("aria-label", `Remove ${row.label}`);
  if (!row.motion) {
    if (row.failed) return row.failed; // with what is typed in it
    row.failed = make("li", { className: "failed" }, make("b", {}, row.label), remove, make("p", {}, reason(row)));
    if (asks(row)) row.failed.append(retryForm(row));
    row.failed.classList.toggle("asks", asks(row));
    return row.failed;
  }
  const radio = make("input", { type: "radio", name: "record", checked: row === selected, onchange: () => select(row) });
  const { pga, duration } = row.motion.measures;
  return make(
    "li",
    {},
    make("label", {}, radio, ` ${row.label} `, make("small", {}, `${shown(pga, "acceleration")}, ${digits(duration)} s`)),
    remove,
  );
}

/** Why a file could not be read. @param {Row} row */
const reason = ({ file, error = "" }) => error.replace(`read_record: ${file}: `, "");

/** Whether a file leaves its units or its time step open. @param {Row} row */
const asks = (row) => row.bytes !== undefined && /units|time step|\bdt\b/.test(reason(row));

/**
 * Asks for what a file leaves open.
 * @param {Row} row
 */
function retryForm(row) {
  const choice = make("select", {}, make("option", { value: "" }, "as the file states"));
  for (const name of ["g", "m/s^2", "cm/s^2", "mm/s^2", "ft/s^2", "in/s^2"]) choice.append(make("option", {}, name));
  const dt = make("input", { type: "number", min: "0", step: "any" });
  const form = make(
    "form",
    {},
    make("label", {}, "units ", choice),
    make("label", {}, "dt [s] ", dt),
    make("button", {}, "Read"),
    make("button", { className: "all", value: "all" }, "Read all that ask"),
  );
  form.onsubmit = async (event) => {
    event.preventDefault();
    const options = { units: choice.value, ...(dt.value ? { dt: Number(dt.value) } : {}) };
    const all = /** @type {HTMLButtonElement | null} */ (event.submitter)?.value === "all";
    /** @type {Row | undefined} */
    let first;
    for (const one of all ? rows.filter(asks) : [row]) {
      const found = await addFile(one.file, /** @type {Uint8Array} */ (one.bytes), options, rows.indexOf(one));
      first ??= found?.motion && found;
    }
    if (first) select(first);
    else showRows();
  };
  return form;
}

/** @param {Row} row */
function removeRow(row) {
  const place = rows.indexOf(row);
  rows.splice(place, 1);
  const { id, verticalId, planarId } = row.motion ?? {};
  worker.discard([id, verticalId, planarId].filter((one) => one != null));
  if (row === selected) select(rows.slice(place).find((one) => one.motion) ?? rows.findLast((one) => one.motion) ?? null);
  else showRows();
  if (!element("many").hidden) slideMany();
}

/** The motion of the generator is one row, which changes with its numbers. @type {Row | null} */
let generated = null;

const generate = latest(async () => {
  const made = /** @type {NonNullable<typeof generator>} */ (generator);
  const values = Object.fromEntries(made.parameters.map(({ key, value }) => [key, Number(others[key] ?? value)]));
  try {
    const motion = await worker.generate(made.name, values);
    const old = generated;
    generated = { label: made.label, file: "", motion, source: () => ({ file: null, python: made.python(values) }) };
    const place = old ? rows.indexOf(old) : -1;
    if (place >= 0) rows[place] = generated;
    else rows.unshift(generated);
    if (old?.motion) worker.discard([old.motion.id]);
    select(generated);
  } catch (error) {
    element("trouble").textContent = /** @type {Error} */ (error).message;
  }
});

// ---- the form

function linkText() {
  return toLink(settings, { ...others, ...units, ...(selected === generated && generator ? { motion: generator.name } : {}) });
}

function showGenerator() {
  element("generator-name").value = generator?.name ?? "";
  element("generator-values").replaceChildren(
    ...(generator?.parameters ?? []).map((one) =>
      entry(one.label, one.unit, others[one.key] ?? String(one.value), "", (text) => {
        const value = Number(text);
        if (text === "" || !(value >= one.min && value <= one.max)) return false;
        others[one.key] = text;
        generate();
        return true;
      }),
    ),
  );
}

/**
 * @param {string} label
 * @param {string} unitName
 * @param {string} value
 * @param {string} hint
 * @param {(text: string) => boolean} onInput  returns whether the text is valid
 */
function entry(label, unitName, value, hint, onInput, type = "number") {
  const input = make("input", { type, step: "any", value, title: hint });
  input.oninput = () => input.setCustomValidity(onInput(input.value) ? "" : "out of range");
  return make("label", { title: hint }, make("span", {}, label), input, make("small", {}, unitName));
}

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
function entered({ key }, s) {
  const value = s[key];
  if (typeof value !== "number") return value.join(" ");
  return Number.isNaN(value) ? "" : String(value);
}

/**
 * @param {Field} field
 * @param {string} text
 * @returns {boolean}  whether it is valid
 */
function enter({ key }, text) {
  const values = listed(text);
  const isList = typeof settings[key] !== "number";
  if (!values.every(Number.isFinite) || (!isList && values.length > 1)) return false;
  if (key === "mus" && values.length) setMu(Math.max(...values));
  /** @type {any} */ (settings)[key] = isList ? values : (values[0] ?? NaN);
  changed();
  if (FIELDS.some((one) => one.needs?.includes(key))) refreshFields();
  return true;
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
    const made = entry(field.label, field.unit, entered(field, full), field.hint, (text) => enter(field, text), type);
    made.dataset.key = field.key;
    place.insertBefore(made, place.children[i] ?? null);
  });
}

/** @param {number} mu */
function setMu(mu) {
  if (!(mu >= 0)) return;
  settings.mu = mu;
  if (document.activeElement !== element("mu")) element("mu").value = String(mu);
  element("mu-slider").value = String(mu);
  if (settings.mus.length || LAWS[settings.law]?.name === "pendulum") showOthers();
  changed();
}

/** The coefficients of the surfaces, which follow mu, unless they are being entered. */
function showOthers() {
  const input = element("fields").querySelectorAll("input")[1];
  if (input && document.activeElement !== input) input.value = completed(settings).mus.join(" ");
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
    showFields();
    changed();
  };
  element("mu-slider").oninput = () => setMu(Number(element("mu-slider").value));
  element("mu").oninput = () => element("mu").value !== "" && setMu(Number(element("mu").value));
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
      if (spectrum === "sliding" || spectrum === "response") return moveOnSpectrum(spectrum, far ? 10 * step : step);
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
  const comments = [
    `stickslip: ${selected.label}; ${toLink(completed(settings))}`,
    ...described(numbers()),
  ];
  const header = ["time_s", "ground_acceleration_m_s2", "velocity_m_s", "displacement_m", "force_m_s2"];
  download(`${fileName(selected)}.csv`, csv(header, rows, comments), "text/csv");
}

// ---- start

async function start() {
  element("law").append(...LAWS.map(({ label }, i) => make("option", { value: String(i) }, label)));
  element("generator-name").append(...GENERATORS.map(({ name, label }) => make("option", { value: name }, label)));
  element("mounting").open = innerWidth > 800;
  listen();
  showForm();
  showGenerator();
  const packed = fromText((element("library").textContent ?? "").trim());
  await worker.load(/** @type {Uint8Array<ArrayBuffer>} */ (decompress(packed)));
  generate();
}

start();
