// Pictures of a response: histories over time and the force over the displacement.

import uPlot from "uplot";

/** @typedef {(u: uPlot, ctx: CanvasRenderingContext2D) => void} Draw */

/** What `color` found: to ask again would compute all styles, each time that a text has changed. @type {Map<string, string>} */
const colors = new Map();

/**
 * @param {string} name  of a custom property of the style sheet
 */
export function color(name) {
  const known = colors.get(name);
  if (known !== undefined) return known;
  const found = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  colors.set(name, found);
  return found;
}

/** The style sheet has other colors now. */
export const forgetColors = () => colors.clear();

/** A line across a picture. @typedef {{axis?: "x" | "y", value: number, label?: string, below?: boolean}} Mark */

let nothing = new Float64Array();

/** Values of a line that is not there. @param {number} length */
function none(length) {
  if (nothing.length !== length) nothing = new Float64Array(length).fill(NaN);
  return nothing;
}

const HEIGHT = 150;
const CURVE_HEIGHT = 240;
const FONT = "12px system-ui, sans-serif";

/** @param {boolean} time  whether that over which the lines are drawn is the time */
const axes = (time) => {
  // Functions, because the colors change with the mode.
  const common = {
    stroke: () => color("ink"),
    font: FONT,
    grid: { stroke: () => color("grid"), width: 1 },
    ticks: { show: false },
  };
  const seconds = (/** @type {any} */ _, /** @type {number[]} */ ticks) =>
    ticks.map((t, i) => (i === ticks.length - 1 ? `${t} s` : String(t)));
  return [
    { ...common, size: 28, ...(time ? { values: seconds } : {}) },
    { ...common, size: 56 },
  ];
};

/**
 * Draws at once, because paper does not wait.
 * @param {uPlot} plot
 * @param {HTMLElement} container
 * @param {number} height
 */
const resize = (plot, container, height) => plot.batch(() => plot.setSize({ width: container.clientWidth, height }));

/** A picture of lines over time, whose cursor all pictures over time share; or over another number. */
export class LinePlot {
  /** @type {uPlot} */
  #plot;
  #container;
  /** @type {Draw} */
  #before = () => {};
  /** @type {Draw} */
  #after = () => {};
  /** @type {Parameters<LinePlot["show"]>} */
  #shown = [new Float64Array(), []];
  /** @type {[number, number] | null} */
  #window = null;
  /** @type {Mark[]} */
  #marks = [];
  /** @type {HTMLElement[]} */
  #marked = [];

  /**
   * @param {HTMLElement} container
   * @param {string[]} strokes  names of the colors; the second line is dashed
   * @param {(index: number | null) => void} onCursor
   * @param {"time" | "number" | "logarithm"} [over]  that over which the lines are drawn
   * @param {(range: [number, number] | null) => void} [onWindow]  where the mouse draws a window, or wants none
   */
  constructor(container, strokes, onCursor, over = "time", onWindow = () => {}) {
    this.#container = container;
    const draw = (/** @type {() => Draw} */ what) => (/** @type {uPlot} */ u) => {
      const { ctx, bbox } = u;
      ctx.save();
      ctx.beginPath();
      ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
      ctx.clip();
      ctx.scale(devicePixelRatio, devicePixelRatio);
      ctx.font = FONT;
      what()(u, ctx);
      ctx.restore();
    };
    this.#plot = new uPlot(
      {
        width: container.clientWidth || 300,
        height: HEIGHT,
        padding: [8, over === "time" ? 24 : 12, 0, 0], // half of the last label
        legend: { show: false },
        scales: { x: { time: false, distr: over === "logarithm" ? 3 : 1 } },
        axes: axes(over === "time"),
        cursor: {
          y: false,
          drag: { x: over === "time", y: false, setScale: false },
          bind: { dblclick: () => () => (onWindow(null), null) },
          points: { size: 6 },
          // Of the mouse, only where it is: its window goes by way of `onWindow`.
          ...(over === "time" ? { sync: { key: "time", filters: { pub: (type) => /^mouse(move|leave)$/.test(type) } } } : {}),
        },
        series: [
          {},
          ...strokes.map((stroke, i) => ({
            stroke: () => color(stroke),
            width: 1.25,
            points: { show: false },
            ...(i ? { dash: [6, 3] } : {}),
          })),
        ],
        hooks: {
          drawClear: [draw(() => this.#before)],
          draw: [draw(() => this.#after), () => this.#place()], // the scales may be new
          setSelect: [
            (/** @type {uPlot} */ u) => {
              const { left, width } = u.select;
              if (width < 5) return; // a click
              onWindow([u.posToVal(left, "x"), u.posToVal(left + width, "x")]);
              u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
            },
          ],
          setCursor: [(/** @type {uPlot} */ u) => onCursor(u.cursor.idx ?? null)],
        },
      },
      [[], ...strokes.map(() => [])],
      container,
    );
  }

  /**
   * @param {Float64Array} time     or the other number
   * @param {Float64Array[]} lines  as long, or empty
   * @param {{before?: Draw, after?: Draw, range?: [number, number], key?: string}} [more]  drawn below and above the line, in CSS
   *   pixels; the least range of values; what the picture depends on, which is not drawn again for the same key
   */
  show(time, lines, more = {}) {
    const { key } = more;
    if (key !== undefined && key === this.#shown[2]?.key) return;
    this.#shown = [time, lines, more];
    this.#draw();
  }

  #draw() {
    const [time, lines, { before = () => {}, after = () => {}, range = [0, 0] } = {}] = this.#shown;
    this.#before = before;
    this.#after = after;
    const [from, to] = this.#window ?? [time[0] ?? 0, time.at(-1) ?? 1];
    let [first, last] = [0, time.length - 1];
    while (first < last && (time[first + 1] ?? 0) <= from) ++first;
    while (first < last && (time[last - 1] ?? 0) >= to) --last;
    const [least = 0, most = 0] = range;
    let [low, high] = this.#window ? [Infinity, -Infinity] : [least, most];
    for (const values of lines)
      for (let i = first; i <= last && i < values.length; ++i) {
        const value = values[i] ?? 0; // a loop over values takes five times as long
        if (value < low) low = value;
        if (value > high) high = value;
      }
    if (!(low <= high)) [low, high] = [least, most];
    const room = 0.06 * (high - low || 1);
    this.#plot.batch(() => {
      const filled = lines.map((values) => (values.length ? values : none(time.length)));
      this.#plot.setData(/** @type {any} */ ([time, ...filled]), false);
      lines.forEach((values, i) => {
        const show = values.length > 0;
        if (this.#plot.series[i + 1]?.show !== show) this.#plot.setSeries(i + 1, { show });
      });
      this.#plot.setScale("x", { min: from, max: to });
      this.#plot.setScale("y", { min: low - room, max: high + room });
    });
  }

  /** Shows a part of the time, with the values in it, or all. @param {[number, number] | null} range */
  window(range) {
    this.#window = range;
    this.#draw();
  }

  /** Lines across the picture, which move without drawing it again. @param {Mark[]} marks */
  marks(marks) {
    this.#marks = marks;
    while (this.#marked.length < marks.length) {
      const made = document.createElement("div");
      made.append(document.createElement("span"));
      this.#plot.over.append(made);
      this.#marked.push(made);
    }
    this.#place();
  }

  #place() {
    const [wide, high] = [this.#plot.bbox.width / devicePixelRatio, this.#plot.bbox.height / devicePixelRatio];
    this.#marked.forEach((made, i) => {
      const { axis = "y", value = NaN, label = "", below = false } = this.#marks[i] ?? {};
      const at = this.#plot.valToPos(value, axis);
      made.hidden = !(at >= 0 && at <= (axis === "x" ? wide : high));
      if (made.hidden) return;
      made.className = `line-${axis}${below || at < 16 ? " below" : ""}`;
      made.style.transform = axis === "x" ? `translateX(${at}px)` : `translateY(${at}px)`;
      if (made.firstChild?.textContent !== label) /** @type {Node} */ (made.firstChild).textContent = label;
    });
  }

  /** @param {number} time  or the other number, where the cursor goes */
  point(time) {
    const left = this.#plot.valToPos(time, "x");
    const within = left >= 0 && left <= this.#plot.bbox.width / devicePixelRatio;
    this.#plot.setCursor({ left: within ? left : -10, top: 0 }, false);
  }

  resize() {
    resize(this.#plot, this.#container, HEIGHT);
  }

  destroy() {
    this.#plot.destroy();
  }
}

/** A curve in a plane, with a mark on it: the force over the displacement. */
export class CurvePlot {
  /** @type {uPlot} */
  #plot;
  #container;
  #mark = document.createElement("div");
  #marked = [NaN, NaN];

  /**
   * @param {HTMLElement} container
   * @param {string} stroke
   */
  constructor(container, stroke) {
    this.#container = container;
    this.#plot = new uPlot(
      {
        mode: 2,
        width: container.clientWidth || 300,
        height: CURVE_HEIGHT,
        padding: [8, 12, 0, 0],
        legend: { show: false },
        scales: { x: { time: false } },
        axes: axes(false),
        cursor: { show: false },
        hooks: { draw: [() => this.#place()] }, // the scales may be new
        series: [
          {},
          {
            stroke: () => color(stroke),
            width: 1.25,
            facets: [
              { scale: "x", auto: true },
              { scale: "y", auto: true },
            ],
            paths: (u, series) => {
              const [xs, ys] = /** @type {any} */ (u.data[series]);
              const stroke = new Path2D();
              const [left, top] = [u.valToPos(0, "x", true), u.valToPos(0, "y", true)];
              const [wide, high] = [u.valToPos(1, "x", true) - left, u.valToPos(1, "y", true) - top];
              let [lastX, lastY] = [NaN, NaN];
              for (let i = 0; i < xs.length; ++i) {
                const [x, y] = [left + wide * xs[i], top + high * ys[i]];
                if (Math.abs(x - lastX) < 0.5 && Math.abs(y - lastY) < 0.5) continue; // nobody would see it
                stroke.lineTo((lastX = x), (lastY = y));
              }
              return /** @type {any} */ ({ stroke, fill: null, clip: null });
            },
          },
        ],
      },
      /** @type {any} */ ([null, [[], []]]),
      container,
    );
    this.#mark.className = "mark";
    this.#plot.over.append(this.#mark);
  }

  /**
   * Marks a point, without drawing the curve again.
   * @param {number} x
   * @param {number} y
   */
  point(x, y) {
    this.#marked = [x, y];
    this.#place();
  }

  #place() {
    const [x = NaN, y = NaN] = this.#marked;
    const [left, top] = [this.#plot.valToPos(x, "x"), this.#plot.valToPos(y, "y")];
    this.#mark.hidden = !Number.isFinite(left + top);
    if (!this.#mark.hidden) this.#mark.style.transform = `translate(${left}px, ${top}px)`;
  }

  /**
   * @param {Float64Array} xs
   * @param {Float64Array} ys
   * @param {boolean} [equal]  whether both axes have one scale
   */
  show(xs, ys, equal = false) {
    this.#plot.setData(/** @type {any} */ ([null, [xs, ys]]), !equal);
    if (!equal) return;
    const [wide, high] = [this.#plot.over.clientWidth, this.#plot.over.clientHeight];
    const largest = (/** @type {Float64Array} */ values) => values.reduce((most, value) => Math.max(most, Math.abs(value)), 1e-9);
    const scale = 0.55 * Math.max(largest(xs) / (wide / 2), largest(ys) / (high / 2));
    this.#plot.batch(() => {
      this.#plot.setScale("x", { min: -scale * wide, max: scale * wide });
      this.#plot.setScale("y", { min: -scale * high, max: scale * high });
    });
  }

  resize() {
    resize(this.#plot, this.#container, CURVE_HEIGHT);
  }

  destroy() {
    this.#plot.destroy();
  }
}

/**
 * A horizontal line, with a label at its right end.
 * @param {uPlot} u
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} value
 * @param {{stroke: string, dash?: number[], label?: string, below?: boolean, indent?: number}} how  `indent` of the label from the
 *   right end [pixels]
 */
export function levelLine(u, ctx, value, { stroke, dash = [], label = "", below = false, indent = 4 }) {
  const ratio = devicePixelRatio;
  const y = u.valToPos(value, "y", true) / ratio;
  const [left, right] = [u.bbox.left / ratio, (u.bbox.left + u.bbox.width) / ratio];
  ctx.strokeStyle = color(stroke);
  ctx.fillStyle = color(stroke);
  ctx.setLineDash(dash);
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.moveTo(left, y);
  ctx.lineTo(right, y);
  ctx.stroke();
  ctx.textAlign = "right";
  ctx.textBaseline = "alphabetic";
  const place = /** @type {const} */ ([label, right - indent, below ? y + 13 : y - 4]);
  // On what is drawn there.
  ctx.setLineDash([]);
  ctx.strokeStyle = color("paper");
  ctx.lineWidth = 3;
  ctx.strokeText(...place);
  ctx.fillText(...place);
}

/**
 * Shades intervals of time.
 * @param {uPlot} u
 * @param {CanvasRenderingContext2D} ctx
 * @param {[number, number][]} intervals
 */
export function shade(u, ctx, intervals) {
  const ratio = devicePixelRatio;
  const { top, height } = u.bbox;
  ctx.fillStyle = color("stick");
  for (const [begin, end] of intervals) {
    const left = u.valToPos(begin, "x", true) / ratio;
    ctx.fillRect(left, top / ratio, u.valToPos(end, "x", true) / ratio - left, height / ratio);
  }
}
