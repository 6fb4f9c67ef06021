// Objects that slide: their pictures, numbers and lines.

import { history, padded } from "./drawing.js";
import { element } from "./dom.js";
import { pathPlot, showPointOfPath, updatePath } from "./path.js";
import { CurvePlot, levelLine, shade } from "./plots.js";
import { drawSlider } from "./scene.js";
import { applies, command, completed, FIELDS, given, LAWS, python } from "./settings.js";
import { showSliding, slidingPlot, updateSliding } from "./spectra.js";
import { GRAVITY, objects, problemOf, settings, state, worker } from "./state.js";
import { slideNumbers } from "./tables.js";
import { digits } from "./units.js";
import { inField, inUnits, listOf, plain, shown, unit } from "./values.js";

/** @import { Settings, Summary } from "./library.js" */
/** @import { Found, Row } from "./state.js" */

const KINDS = ["breakaway", "reversal", "arrest", "end", "impact", "liftoff", "landing"];
const plots = {
  velocity: history("velocity", ["velocity", "pinned"]),
  displacement: history("displacement", ["displacement", "pinned"]),
  hysteresis: new CurvePlot(element("plot-hysteresis"), ["force"]),
};

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

/** @param {Found} found  @param {Found | null} other  @param {Float64Array} time */
function show({ summary, velocity, displacement, force, events }, other, time) {
  const [length, speed, ground] = [unit("length"), unit("velocity"), unit("acceleration")];
  element("title-velocity").textContent = `Velocity relative to the ground [${speed.name}]; shaded where it sticks`;
  const rests = sticks(events, time.at(-1) ?? 0);
  const speeds = [padded(time, velocity, 0), other ? padded(time, other.velocity, 0) : new Float64Array()];
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
    padded(time, displacement, summary.residual),
    other ? padded(time, other.displacement, other.summary.residual) : new Float64Array(),
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
  showSliding();
}

/** @param {Found} found  @param {(values: Float64Array) => number} at  @param {HTMLCanvasElement} scene */
function showTime({ summary, displacement, velocity, acceleration, force }, at, scene) {
  const [x, f] = [plain(at(displacement)), plain(at(force))];
  drawSlider(scene, {
    settings: completed(settings),
    x: at(displacement),
    peak: summary.peak,
    acceleration: at(acceleration),
    pga: summary.pga,
    ruler: unit("length"),
  });
  plots.hysteresis.point(x / unit("length").size, f / unit("acceleration").size);
  element("read-hysteresis").textContent =
    `t = ${state.now.toFixed(2)} s: displacement ${shown(x, "length")}, force per unit mass ${shown(f, "acceleration")}`;
  showPointOfPath();
  return `velocity ${shown(plain(at(velocity)), "velocity")}, displacement ${shown(x, "length")}`;
}

/** @param {Found} found */
function panels({ summary, velocity, displacement }) {
  const [length, speed] = [unit("length"), unit("velocity")];
  const residual = summary.residual / length.size;
  return [
    { title: `Velocity relative to the ground [${speed.name}]`, lines: [{ values: inUnits(velocity, "velocity"), stroke: "#0072b2" }], levels: [] },
    {
      title: `Displacement relative to the ground [${length.name}], peak ${digits(summary.peak / length.size)}`,
      lines: [{ values: inUnits(displacement, "length"), stroke: "#d55e00" }],
      levels: [{ stroke: "#a0417a", value: residual, label: `residual ${digits(residual)}` }],
    },
  ];
}

/**
 * A paragraph for a report.
 * @param {Settings} s
 * @param {Row} row
 * @param {Found} found
 */
function report(s, row, { summary }) {
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

const SIDES = ["normal", "inverse", "mean"]; // as SLAMMER calls a record reversed, as recorded, and the mean of both
const CURVE_LEVELS = 25;

objects.slider = {
  caption: "On one axis: an object that can slide along it alone",
  remark: ({ summary }) => (summary.at_rest ? "" : "It never comes to rest; these are the numbers at the end of the record."),
  plane: false,
  histories: [plots.velocity, plots.displacement],
  others: [plots.hysteresis, pathPlot, slidingPlot],
  async respond(full, row) {
    const [s, id] = problemOf(full, row);
    return { kind: "slider", ...(await worker.slide(id, s)) };
  },
  update() {
    updateSliding();
    updatePath();
  },
  answer: ({ summary }) => [
    ["peak", shown(summary.peak, "length")],
    ["residual", shown(summary.residual, "length")],
  ],
  numbers: ({ summary }) => slideNumbers(summary),
  levels: (s, { summary }) => slipLevels(s, summary),
  show,
  showTime,
  columns: ({ velocity, displacement, force }) => ({ velocity_m_s: velocity, displacement_m: displacement, force_m_s2: force }),
  panels,
  command,
  python: (s, source, _, found) => python(s, source, found?.summary.at_rest !== 0),
  report,
  table: {
    title: "Peak and residual: of each record reversed (normal, as SLAMMER calls it), as recorded (inverse), and the mean of both",
    columns: () => ["peak", "residual"].flatMap((what) => SIDES.map((side) => /** @type {const} */ ([`${what} ${side}`, "length", `${what}_${side}_m`]))).map((one) => [...one]),
    async values(row) {
      const [full, id] = problemOf(settings, row);
      const { normal, inverse } = await worker.bothWays(id, full);
      return /** @type {const} */ (["peak", "residual"]).flatMap((what) => [normal[what], inverse[what], (normal[what] + inverse[what]) / 2]);
    },
    text: () => null,
    counts: () => true,
    note: () => "",
  },
  curves: {
    over: () => ({
      name: "\u03bc",
      csv: "mu",
      size: 1,
      at: settings.mu,
      values: (highest) => Float64Array.from({ length: CURVE_LEVELS }, (_, i) => 0.01 * (100 * Math.max(0.02, highest)) ** (i / (CURVE_LEVELS - 1))),
      key: JSON.stringify({ ...completed(settings), mu: 1 }), // not mu
    }),
    async peaks(row, mus) {
      const [full, id] = problemOf(settings, row);
      const both = await Promise.all([1, -1].map((sign) => worker.spectrum(id, { ...full, scale: sign * full.scale }, mus).catch(() => null)));
      return mus.map((_, i) => both.reduce((sum, one) => sum + (one?.peak[i] ?? NaN), 0) / 2);
    },
    csv: "peak [m], mean of both polarities",
    title: () => `Peak [${unit("length").name}] over \u03bc: each record, mean of both polarities; median colored`,
    quantity: "length",
    logarithmic: true,
  },
};
