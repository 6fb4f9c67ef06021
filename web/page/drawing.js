// The pictures of a response over time, and the present time in them.

import { download } from "./csv.js";
import { element, make } from "./dom.js";
import { interpolated } from "./histories.js";
import { pathPlot, showPointOfPath } from "./path.js";
import { color, CurvePlot, levelLine, LinePlot, shade } from "./plots.js";
import { drawScene } from "./scene.js";
import { command, completed, LAWS, python } from "./settings.js";
import { showSliding, spectrumPlots } from "./spectra.js";
import { fileName, GRAVITY, NO_COMMAND, settings, sourceOf, state, units } from "./state.js";
import { svg } from "./svg.js";
import { report, showNumbers } from "./tables.js";
import { digits } from "./units.js";
import { inUnits, inWords, plain, shown, unit } from "./values.js";

/** @import { Settings, Summary } from "./library.js" */
/** @import { Row } from "./state.js" */
/** @import { Line } from "./tables.js" */
/** @import { Quantity } from "./units.js" */

const KINDS = ["breakaway", "reversal", "arrest", "end", "impact", "liftoff", "landing"];
const plots = makePlots();

function makePlots() {
  const onCursor = (/** @type {number | null} */ index) => {
    if (!playing && !moving && state.response && index !== null) setTime(state.response.time[index] ?? 0, false);
  };
  const history = (/** @type {string} */ name, /** @type {string[]} */ strokes) =>
    new LinePlot(element(`plot-${name}`), strokes, onCursor, "time", { onWindow: setWindow });
  return {
    acceleration: history("acceleration", ["acceleration"]),
    velocity: history("velocity", ["velocity", "pinned"]),
    displacement: history("displacement", ["displacement", "pinned"]),
    hysteresis: new CurvePlot(element("plot-hysteresis"), "force"),
  };
}

export function resizePlots() {
  for (const plot of [...Object.values(plots), pathPlot, ...Object.values(spectrumPlots)]) plot.resize();
}

/**
 * @param {Settings} s
 * @param {Row} row
 */
export function show(s, row) {
  const source = sourceOf(row, s.vertical === 1);
  element("command").textContent = command(s, source) ?? NO_COMMAND;
  element("python").textContent = python(s, source, state.response?.summary.at_rest !== 0);
  element("pinned").textContent = state.pinned ? `Compared with ${inWords(completed(state.pinned.settings))} (dashed).` : "";
  element("output").classList.toggle("empty", state.response === null);
  if (!state.response) return;
  element("subject").textContent = `${row.label}: ${inWords(s)}`;
  element("answer").replaceChildren(
    ...["peak", "residual"].map((name) =>
      make("span", {}, `${name} `, make("b", {}, shown(/** @type {any} */ (state.response).summary[name], "length"))),
    ),
  );
  const { summary, acceleration, velocity, displacement, force, events } = state.response;
  const other = state.pinned?.response ?? null;
  // Both on the longer time base: the one that rested earlier stays where it is.
  const time = other && other.time.length > state.response.time.length ? other.time : state.response.time;
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
    if (strong) state.now = strong[0];
    setWindow(strong);
  }
  setTime(Math.min(state.now, time.at(-1) ?? 0));
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

export function downloadSvg() {
  if (!state.response || !state.selected) return;
  const { summary, time, acceleration, velocity, displacement } = state.response;
  const { length, ground, speed } = { length: unit("length"), ground: unit("acceleration"), speed: unit("velocity") };
  const level = { stroke: "#a0417a", label: "" };
  const picture = svg(state.selected.label, time, [
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
  download(`${fileName(state.selected)}.svg`, picture, "image/svg+xml");
}

export let playing = false;

let moving = false; // whether the page moves the cursors

/**
 * @param {number} time  [s]
 * @param {boolean} [cursors]  whether the pictures' cursors follow
 */
export function setTime(time, cursors = true) {
  if (!state.response) return;
  state.now = time;
  const { summary, displacement, velocity, acceleration, force } = state.response;
  const at = interpolated(state.response.time, time);
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
export function goTo(time) {
  setTime(time);
  if (span && (time < span[0] || time > span[1])) zoom(1);
}

/** The times that the histories show; null for all. @type {[number, number] | null} */
let span = null;

/** @param {[number, number] | null} range */
export function setWindow(range) {
  if (range?.[0] === span?.[0] && range?.[1] === span?.[1]) return;
  span = range;
  element("whole").hidden = range === null;
  element("whole").title = range ? `instead of ${range.map((time) => time.toFixed(3)).join(" to ")} s` : "";
  for (const plot of [plots.acceleration, plots.velocity, plots.displacement]) plot.window(range);
  setTime(state.now);
}

const SHORTEST = 0.1; // window [s]

/** Changes the width of the window, about the present time. @param {number} factor */
export function zoom(factor) {
  const end = state.response?.time.at(-1) ?? 0;
  const [from, to] = span ?? [0, end];
  const width = Math.max(factor * (to - from), SHORTEST);
  if (width >= end) return setWindow(null);
  const begin = Math.min(Math.max(state.now - width / 2, 0), end - width);
  setWindow([begin, begin + width]);
}

/** @param {boolean} on */
export function play(on) {
  playing = on;
  element("play").textContent = on ? "Pause" : "Play";
  if (!on || !state.response) return;
  const end = state.response.time.at(-1) ?? 0;
  if (state.now >= end) state.now = 0;
  let last = performance.now();
  const step = (/** @type {number} */ at) => {
    if (!playing) return;
    const next = state.now + ((at - last) / 1000) * Number(element("speed").value);
    last = at;
    goTo(Math.min(next, end));
    if (next >= end) play(false);
    else requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}
