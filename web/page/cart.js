// Carts on casters and wheels: their pictures, numbers and lines.

import { latest } from "./client.js";
import { element, make } from "./dom.js";
import { history, padded } from "./drawing.js";
import { color, CurvePlot } from "./plots.js";
import { drawArrow, emptied } from "./scene.js";
import { completed, imports, kindOf, record } from "./settings.js";
import { objects, problemOf, settings, state, untilIdle, worker } from "./state.js";
import { quantile } from "./statistics.js";
import { digits } from "./units.js";
import { inUnits, inWords, plain, shown, unit } from "./values.js";

/** @import { CartSummary, Settings } from "./library.js" */
/** @import { Found, Row } from "./state.js" */
/** @import { Source } from "./sources.js" */
/** @import { Quantity } from "./units.js" */

const [FIXED, FOOT] = [1, 2]; // kinds of supports; 0 is a caster that swivels
const WHEELS = 4;

const centerPlot = history("center", ["displacement", "velocity"]);
const yawPlot = history("yaw", ["displacement", "pinned"]);
const planPlot = new CurvePlot(element("plot-plan"), ["displacement", "velocity"], true);

/**
 * The settings and the motion: both horizontal components, or the one that there is.
 * @param {Settings} given
 * @param {Row} row
 * @returns {[Settings, number]}
 */
function problem(given, row) {
  const [full, id] = problemOf(given, row);
  return [full, row.joined?.planarId ?? id];
}

/** Whether both horizontal components act. @param {Row | null} row */
const isPair = (row) => row?.joined?.planarId != null;

/**
 * Where a point of the cart is.
 * @param {[number, number]} point  from the center [m]
 * @param {number} axis             place of the center [m]
 * @param {number} transverse
 * @param {number} yaw
 * @returns {[number, number]}
 */
function moved([x, y], axis, transverse, yaw) {
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  return [axis + c * x - s * y, transverse + s * x + c * y];
}

/** @param {Float64Array} plan  @returns {{supports: {kind: number, at: [number, number]}[], outline: [number, number][]}} */
function planOf(plan) {
  const at = (/** @type {number} */ i) => /** @type {[number, number]} */ ([plan[i] ?? 0, plan[i + 1] ?? 0]);
  const first = 3 * WHEELS;
  return {
    supports: Array.from({ length: WHEELS }, (_, i) => ({ kind: plan[3 * i] ?? 0, at: at(3 * i + 1) })),
    outline: Array.from({ length: (plan.length - first) / 2 }, (_, i) => at(first + 2 * i)),
  };
}

/** The displacement of the corner that moves farthest. @param {any} found  @returns {[Float64Array, Float64Array]} */
function cornerOf({ summary, axis, transverse, yaw, plan }) {
  const corner = planOf(plan).outline[summary.peak_corner] ?? [0, 0];
  const places = Array.from(axis, (x, i) => moved(corner, /** @type {number} */ (x), transverse[i], yaw[i]));
  return [Float64Array.from(places, ([x]) => x - corner[0]), Float64Array.from(places, ([, y]) => y - corner[1])];
}

/** @param {Found} found  @param {Found | null} other  @param {Float64Array} time */
function show({ summary, axis, transverse, yaw, plan, time: own }, other, time) {
  const { name } = unit("length");
  element("title-center").textContent = `Displacement of the center [${name}]: along the axis, and across it (dashed)`;
  centerPlot.show(
    time,
    [axis, transverse].map((values) => inUnits(padded(time, values, values.at(-1)), "length")),
  );
  element("title-yaw").textContent = `Yaw [rad], clockwise: peak ${digits(summary.peak_yaw)}`;
  const round = (/** @type {Float64Array} */ values) => values.map(plain); // round-off is no turn
  yawPlot.show(time, [round(padded(time, yaw, yaw.at(-1))), other ? round(padded(time, other.yaw, other.yaw.at(-1))) : new Float64Array()]);

  const [along, across] = cornerOf({ summary, axis, transverse, yaw, plan });
  let peak = 0;
  while (peak < own.length - 1 && (own[peak] ?? 0) < summary.peak_time) ++peak;
  const inLengths = (/** @type {Float64Array} */ values) => inUnits(values, "length");
  const row = state.selected;
  const { azimuth = NaN, component = "", orientation = "" } = row?.motion ?? {};
  const curves = /** @type {[Float64Array, Float64Array][]} */ ([
    [transverse, axis],
    [across, along],
  ].map((curve) => curve.map(inLengths)));
  const size = unit("length").size;
  planPlot.resize();
  planPlot.map(curves, {
    right: `across [${name}]`,
    up: `along ${Number.isNaN(azimuth) ? component : orientation.replace(/^[\d.]+$/, "$&\u00b0")} [${name}]`,
    marks: [
      { name: "start", x: 0, y: 0, label: "start" },
      { name: "peak", x: (across[peak] ?? 0) / size, y: (along[peak] ?? 0) / size, label: `corner ${shown(summary.peak_outline, "length")}` },
      { name: "residual", x: transverse.at(-1) / size, y: axis.at(-1) / size, label: "center at the end" },
    ],
    north: azimuth,
  });
  element("title-plan").textContent =
    `Paths in the plane [${name}], seen from above: of the center, and of the corner that moves farthest (blue), each from its start` +
    (isPair(row) ? "" : ". The record has one horizontal component: nothing acts across it");
  showDraws();
}

/** @param {Found} found  @param {(values: Float64Array) => number} at  @param {HTMLCanvasElement} canvas */
function showTime({ summary, axis, transverse, yaw, headings, plan, acceleration }, at, canvas) {
  const { supports, outline } = planOf(plan);
  const { ctx, width, height } = emptied(canvas);
  const reach = Math.max(...outline.map(([x, y]) => Math.hypot(x, y))) + summary.peak_outline;
  const scale = Math.min(width / 2 - 8, (height - 16) / 2 - 6) / reach;
  const [x, y, turn] = [at(axis), at(transverse), at(yaw)];
  const middle = [width / 2, (height - 16) / 2];
  /** The axis upward, the transverse direction to the right. @param {[number, number]} place  @returns {[number, number]} */
  const onCanvas = ([along, across]) => [(middle[0] ?? 0) + across * scale, (middle[1] ?? 0) - along * scale];
  const polygon = (/** @type {[number, number][]} */ points) => {
    ctx.beginPath();
    for (const point of points) ctx.lineTo(...onCanvas(point));
    ctx.closePath();
  };
  ctx.lineWidth = 1;
  ctx.strokeStyle = color("quiet");
  ctx.setLineDash([4, 3]);
  polygon(outline);
  ctx.stroke();
  ctx.setLineDash([]);
  // The way so far.
  ctx.strokeStyle = color("displacement");
  ctx.beginPath();
  const every = Math.max(1, Math.floor(axis.length / 1000));
  for (let i = 0; i < axis.length && (state.response?.time[i] ?? 0) <= state.now; i += every) ctx.lineTo(...onCanvas([axis[i], transverse[i]]));
  ctx.lineTo(...onCanvas([x, y]));
  ctx.stroke();

  const corners = outline.map((corner) => moved(corner, x, y, turn));
  polygon(corners);
  ctx.globalAlpha = 0.25;
  ctx.fillStyle = color("displacement");
  ctx.fill();
  ctx.globalAlpha = 1;
  ctx.lineWidth = 1.5;
  ctx.stroke();
  ctx.fillStyle = ctx.strokeStyle = color("ink");
  let caster = 0;
  for (const { kind, at: place } of supports) {
    const [left, top] = onCanvas(moved(place, x, y, turn));
    if (kind === FOOT) {
      ctx.fillRect(left - 5, top - 5, 10, 10);
      continue;
    }
    const heading = turn + (kind === FIXED ? 0 : at(headings[caster++]));
    const [right, up] = [Math.sin(heading), -Math.cos(heading)]; // from the wheel to the pivot
    const trail = kind === FIXED ? 0 : 8; // longer than it is, to be seen
    const [wheelX, wheelY] = [left - trail * right, top - trail * up];
    ctx.lineWidth = 5;
    ctx.beginPath();
    ctx.moveTo(wheelX - 6 * right, wheelY - 6 * up);
    ctx.lineTo(wheelX + 6 * right, wheelY + 6 * up);
    ctx.stroke();
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    ctx.moveTo(wheelX, wheelY);
    ctx.lineTo(left, top);
    ctx.stroke();
    ctx.beginPath();
    ctx.arc(left, top, 3, 0, 2 * Math.PI);
    ctx.fill();
  }
  // The front.
  const [front = [0, 0], other = [0, 0]] = corners;
  ctx.fillStyle = color("quiet");
  ctx.textAlign = "center";
  const [frontX, frontY] = onCanvas([0.44 * (front[0] + other[0]) + 0.12 * x, 0.44 * (front[1] + other[1]) + 0.12 * y]);
  ctx.fillText("front", frontX, frontY + 4);
  drawArrowUp(ctx, width, summary.pga > 0 ? at(acceleration) / summary.pga : 0, middle[1] ?? 0);
  planPlot.point(y / unit("length").size, x / unit("length").size);
  const place = `${shown(plain(x), "length")} along, ${shown(plain(y), "length")} across`;
  element("read-plan").textContent = `t = ${state.now.toFixed(2)} s: center ${place}`;
  return `center ${place}, yaw ${shown(plain(turn), "angle")}`;
}

/** The acceleration of the ground along the axis, which points up. @param {CanvasRenderingContext2D} ctx  @param {number} width  @param {number} part  @param {number} middle */
function drawArrowUp(ctx, width, part, middle) {
  ctx.save();
  ctx.translate(width - 14, middle);
  ctx.rotate(-Math.PI / 2);
  drawArrow(ctx, part, [0, 0], middle - 12);
  ctx.restore();
}

// ---- headings at random

const [MEMBERS, SEED, PART] = [30, 1, 2];
const SLOW = 3000; // of a part [ms]: it keeps the worker from all else
/** @type {{key: string, peaks: number[][], slow: boolean} | null} */
let draws = null;

const drawsKey = (/** @type {number} */ id) => `${id} ${JSON.stringify({ ...completed(settings), headings: [] })}`;

/** In parts, while nothing else is asked. */
const updateDraws = latest(async () => {
  const row = state.selected;
  if (!row?.motion || state.broken || kindOf(settings) !== "cart") return;
  const [full, id] = problem(settings, row);
  const key = drawsKey(id);
  if (draws?.key === key) return;
  draws = { key, peaks: [], slow: false };
  showDraws();
  if (WHEELS_THAT_SWIVEL[full.wheels] === 0) return;
  for (let first = 0; first < MEMBERS; first += PART) {
    await untilIdle();
    if (row !== state.selected || state.broken || kindOf(settings) !== "cart" || key !== drawsKey(id)) return;
    const begin = performance.now();
    const part = await worker.rollAtRandom(id, full, { first, count: PART, seed: SEED }).catch(() => null);
    if (draws.key !== key) return;
    if (!part || performance.now() - begin > SLOW) {
      draws.slow = true;
      return showDraws();
    }
    for (let i = 0; i < PART; ++i) draws.peaks.push([...part.slice(3 * i, 3 * i + 3)]);
    showDraws();
  }
});

const WHEELS_THAT_SWIVEL = [4, 3, 2, 0, 2];

function showDraws() {
  const { peaks, slow } = draws ?? { peaks: [], slow: false };
  const swivels = WHEELS_THAT_SWIVEL[completed(settings).wheels] !== 0;
  element("title-draws").textContent = slow
    ? "Headings at random take too long for this page: take the command, with --members"
    : swivels
    ? `The same cart with the headings of its casters at random: ${peaks.length < MEMBERS ? `${peaks.length} of ` : ""}${MEMBERS} draws`
    : "No caster swivels: the headings decide little";
  element("draws").tHead.replaceChildren(...(swivels ? [make("tr", {}, make("th"), make("td", {}, "median"), make("td", {}, "95 %"))] : []));
  const lines = /** @type {[string, Quantity][]} */ ([["center", "length"], ["yaw", "angle"], ["corner", "length"]]);
  element("draws").tBodies[0].replaceChildren(
    ...(peaks.length < MEMBERS ? [] : lines).map(([name, quantity], i) => {
      const values = [0.5, 0.95].map((probability) => quantile(peaks.map((one) => one[i] ?? NaN), probability));
      const line = make("tr", {}, make("th", { scope: "row" }, name), ...values.map((value) => make("td", {}, shown(value, quantity))));
      line.dataset.si = JSON.stringify(values);
      return line;
    }),
  );
}

// ---- lines

const RADIANS = Math.PI / 180;

/** The cart as `Cart.to_json` writes it. @param {Settings} s */
function cartOf(s) {
  const locked = [0, 1, 2, 4, 0][s.wheels] ?? 0;
  const [half, side] = [s.base_length / 2, s.base_width / 2];
  const supports = [[half, side], [half, -side], [-half, side], [-half, -side]].map((at, i) =>
    s.wheels === 4 && i >= 2
      ? { kind: "FixedWheel", at, mu: s.mu, rolling_mu: s.rolling_mu }
      : {
          kind: "SwivelCaster",
          at,
          heading: (s.headings[i] ?? 0) * RADIANS,
          mu: s.mu,
          trail: s.trail,
          wheel_width: s.wheel_width,
          ...(i < locked ? { lock: "both" } : { rolling_mu: s.rolling_mu }),
        },
  );
  const [long, wide] = [s.body_length / 2, s.body_width / 2];
  const outline = [[long, wide], [long, -wide], [-long, -wide], [-long, wide]];
  return { supports, radius_of_gyration: s.gyration, outline };
}

/** @param {Settings} s  @param {Source} source */
function command(s, source) {
  if (source.files.length === 0 || source.dropsVertical || !isPair(state.selected)) return null;
  const scale = s.scale === 1 ? "" : ` --scale=${s.scale}`;
  return `echo '${JSON.stringify(cartOf(s))}' > cart.json\nstickslip cart cart.json ${record(source).join(" ")}${scale}`;
}

/** @param {Settings} s  @param {Source} source  @param {Row} row */
function python(s, source, row) {
  const time = Number.isNaN(row.motion?.measures.dt) ? "times=motion.time" : "motion.dt";
  const across = isPair(row) ? "motion.transverse" : "0 * motion.acceleration";
  const vertical = s.vertical && !isPair(row) ? ", vertical=motion.vertical" : "";
  const settles = s.rolling_mu > 0 || [1, 2, 3].includes(s.wheels);
  const { supports, outline } = cartOf(s);
  const wheels = supports.map(({ kind, at, ...others }) => {
    const words = Object.entries(others).map(([name, value]) => `${name}=${JSON.stringify(value)}`);
    return `    ss.${kind}(at=(${at.join(", ")}), ${words.join(", ")}),`;
  });
  return [
    ...imports(source),
    ...(source.dropsVertical || !isPair(row) ? [`motion = ss.GroundMotion(motion.acceleration, ${time}, transverse=${across}${vertical})`] : []),
    "supports = [",
    ...wheels,
    "]",
    `cart = ss.Cart(supports, radius_of_gyration=${s.gyration}, outline=${JSON.stringify(outline)})`,
    `response = ss.integrate(cart, motion${s.scale === 1 ? "" : `.scaled(${s.scale})`}${settles ? ", settle=True" : ""})`,
    "print(response.peak, response.peak_yaw, response.peak_outline)",
  ].join("\n");
}

/** @param {Settings} s  @param {Row} row  @param {Found} found */
function report(s, row, { summary }) {
  const rest = summary.at_rest ? "comes to rest" : "has not come to rest at the end of the record";
  return (
    `A cart (${inWords(s)}) was subjected to the ground motion ${row.label} (PGA ${shown(summary.pga, "acceleration")}` +
    `${isPair(row) ? " of both horizontal components together" : ", along the axis alone"}${s.vertical ? ", with the vertical component" : ""}` +
    `). Its center moves up to ${shown(summary.peak, "length")}, the farthest corner ` +
    `${shown(summary.peak_outline, "length")}, it turns up to ${shown(summary.peak_yaw, "angle")}, and it ${rest} ` +
    `${shown(Math.hypot(summary.residual_axis, summary.residual_transverse), "length")} from the start. Computed with stickslip, event by ` +
    `event. A history of a cart hangs on the headings of its casters: answer in distributions.`
  );
}

/** @param {CartSummary} summary  @returns {[string, number, Quantity, string][]} */
const rolled = (summary) => [
  ["center", summary.peak, "length", "peak_m"],
  ["yaw", summary.peak_yaw, "angle", "peak_yaw_rad"],
  ["corner", summary.peak_outline, "length", "peak_outline_m"],
  ["left at", summary.residual_axis, "length", "residual_axis_m"],
  ["across", summary.residual_transverse, "length", "residual_transverse_m"],
  ["turned", summary.residual_yaw, "angle", "residual_yaw_rad"],
];

objects.cart = {
  caption: "A cart: peaks, and where it is left",
  remark: ({ summary }) => (summary.at_rest ? "" : "It never comes to rest; these are the numbers at the end of the record."),
  plane: true,
  histories: [centerPlot, yawPlot],
  others: [planPlot],
  async respond(full, row) {
    const [s, id] = problem(full, row);
    return { kind: "cart", ...(await worker.roll(id, s)) };
  },
  update: updateDraws,
  answer: ({ summary }) => [
    ["center", shown(summary.peak, "length")],
    ["corner", shown(summary.peak_outline, "length")],
    ["yaw", shown(plain(summary.peak_yaw), "angle")],
  ],
  numbers: ({ summary }) => [
    ...rolled(summary).map(([name, value, quantity]) => /** @type {import("./tables.js").Line} */ ([name, value, quantity, quantity === "angle" ? "rad" : "m"])),
    ["time moving", summary.time_moving, "time", "s"],
    ["rests", summary.rests, "none", ""],
  ],
  levels: () => [],
  show,
  showTime,
  columns: ({ axis, transverse, yaw, headings }) => ({
    displacement_axis_m: axis,
    displacement_transverse_m: transverse,
    yaw_rad: yaw,
    ...Object.fromEntries(headings.map((/** @type {Float64Array} */ one, /** @type {number} */ i) => [`heading_${i}_rad`, one])),
  }),
  panels: ({ axis, transverse, yaw }) => [
    {
      title: `Displacement of the center [${unit("length").name}]: along the axis, and across it (dashed)`,
      lines: [
        { values: inUnits(axis, "length"), stroke: "#d55e00" },
        { values: inUnits(transverse, "length"), stroke: "#0072b2", dash: "6 3" },
      ],
      levels: [],
    },
    { title: "Yaw [rad]", lines: [{ values: yaw.map(plain), stroke: "#d55e00" }], levels: [] },
  ],
  command,
  python,
  report,
  table: {
    title: "The cart in all records, a line for each station",
    columns: () => rolled(/** @type {any} */ ({})).map(([name, , quantity, csv]) => [name, quantity, csv]),
    async values(row) {
      const [full, id] = problem(settings, row);
      return rolled((await worker.roll(id, full)).summary).map(([, value]) => value);
    },
    text: () => null,
    counts: (column) => column < 3,
    note: () => "",
  },
  curves: null,
};
