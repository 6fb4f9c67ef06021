// Pictures of a response: histories over time and the force over the displacement.

import uPlot from "uplot";

import { digits } from "./units.js";

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
export const CURVE_HEIGHT = 240;
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
  const plain = (/** @type {any} */ _, /** @type {number[]} */ ticks) => ticks.map((tick) => (tick === null ? null : digits(tick)));
  return [
    { ...common, size: 28, values: time ? seconds : plain },
    { ...common, size: 56, values: plain },
  ];
};

/** A scale as wide as it is set. @param {boolean} logarithmic  @returns {uPlot.Scale} */
const scale = (logarithmic) => (logarithmic ? { distr: 3, range: (_, low, high) => [low, high] } : { distr: 1 });

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
  #logarithmic;
  #gaps;
  #height;

  /**
   * @param {HTMLElement} container
   * @param {string[]} strokes  names of the colors; the second line is dashed
   * @param {(index: number | null) => void} onCursor
   * @param {"time" | "number" | "logarithm"} [over]  that over which the lines are drawn
   * @param {{onWindow?: (range: [number, number] | null) => void, logarithmic?: boolean, gaps?: boolean, dashed?: boolean, height?: number}} [how]  where
   *   the mouse draws a window, or wants none; whether the values have a logarithmic scale, which omits those that are not
   *   positive; whether values may be missing; whether the lines after the first are dashed, instead of
   *   the last being thick; [pixels]
   */
  constructor(container, strokes, onCursor, over = "time", { onWindow = () => {}, logarithmic = false, gaps = false, dashed = true, height = HEIGHT } = {}) {
    this.#container = container;
    this.#logarithmic = logarithmic;
    this.#gaps = gaps;
    this.#height = height;
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
        height,
        padding: [8, over === "time" ? 24 : 12, 0, 0], // half of the last label
        legend: { show: false },
        scales: { x: { time: false, ...scale(over === "logarithm") }, y: scale(logarithmic) },
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
            width: dashed || i < strokes.length - 1 ? 1.25 : 2.5,
            points: { show: false },
            ...(i && dashed ? { dash: [6, 3] } : {}),
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
    let room = 0.06 * (high - low || 1);
    /** @type {ArrayLike<number | null>[]} */
    let filled = lines.map((values) => (values.length ? values : none(time.length)));
    if (this.#gaps) filled = filled.map((values) => Array.from(values, (value) => (Number.isNaN(value) ? null : value)));
    if (this.#logarithmic) {
      filled = lines.map((values) => Array.from(values, (value) => (value > 0 ? value : null)));
      [low, high, room] = [high / 1e4, high || 1, 0];
    }
    this.#plot.batch(() => {
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
    resize(this.#plot, this.#container, this.#height);
  }

  destroy() {
    this.#plot.destroy();
  }
}

/** A point of a curve with its label. @typedef {{name: string, x: number, y: number, label: string}} Place */

/** Curves in a plane, with a mark: the force over the displacement, or a map. */
export class CurvePlot {
  /** @type {uPlot} */
  #plot;
  #container;
  #mark = document.createElement("div");
  #marked = [NaN, NaN];
  #map = document.createElement("div"); // labels, and the arrow to the north
  /** @type {Place[]} */
  #places = [];
  #names = ["", ""];

  /**
   * @param {HTMLElement} container
   * @param {string[]} strokes  of the curves
   * @param {boolean} [named]    whether the axes have names
   */
  constructor(container, strokes, named = false) {
    this.#container = container;
    this.#plot = new uPlot(
      {
        mode: 2,
        width: container.clientWidth || 300,
        height: CURVE_HEIGHT,
        padding: [8, 12, 0, 0],
        legend: { show: false },
        scales: { x: { time: false } },
        axes: axes(false).map((axis, i) => (named ? { ...axis, label: () => this.#names[i] ?? "", labelSize: 20, labelFont: FONT } : axis)),
        cursor: { show: false },
        hooks: { draw: [() => this.#place()] }, // the scales may be new
        series: [
          {},
          ...strokes.map((stroke) => ({
            stroke: () => color(stroke),
            width: 1.25,
            facets: [
              { scale: "x", auto: true },
              { scale: "y", auto: true },
            ],
            paths: (/** @type {uPlot} */ u, /** @type {number} */ series) => {
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
          })),
        ],
      },
      /** @type {any} */ ([null, ...strokes.map(() => [[], []])]),
      container,
    );
    this.#mark.className = "mark";
    this.#plot.over.append(this.#map, this.#mark);
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
    const wide = this.#plot.over.clientWidth;
    this.#places.forEach(({ x, y }, i) => {
      const [made, at] = [/** @type {HTMLElement} */ (this.#map.children[i]), this.#plot.valToPos(x, "x")];
      made.classList.toggle("left", at > wide / 2);
      made.style.transform = `translate(${at}px, ${this.#plot.valToPos(y, "y")}px)`;
    });
  }

  /**
   * @param {Float64Array} xs
   * @param {Float64Array} ys
   */
  show(xs, ys) {
    this.#plot.setData(/** @type {any} */ ([null, [xs, ys]]));
  }

  /**
   * Curves as on a map, with one scale to the right and up.
   * @param {[Float64Array, Float64Array][]} curves
   * @param {{right: string, up: string, marks: Place[], north: number}} of  names of the axes; marked points; the azimuth of the
   *   upward direction, NaN if it has none
   */
  map(curves, { right, up, marks, north }) {
    this.#names = [right, up];
    this.#places = marks;
    this.#map.replaceChildren(
      ...marks.map(({ name, label }) => {
        const made = document.createElement("div");
        made.className = `place ${name}`;
        made.append(Object.assign(document.createElement("span"), { textContent: label }));
        return made;
      }),
    );
    if (!Number.isNaN(north)) {
      const arrow = Object.assign(document.createElement("div"), { className: "north", textContent: "N" });
      arrow.style.setProperty("--turn", `${-north}deg`);
      this.#map.append(arrow);
    }
    this.#plot.setData(/** @type {any} */ ([null, ...curves]), false);
    const [wide, high] = [this.#plot.over.clientWidth, this.#plot.over.clientHeight];
    const extent = (/** @type {0 | 1} */ way) => {
      const all = curves.map((curve) => curve[way]);
      return [Math.min(...all.map((one) => one.reduce((a, b) => Math.min(a, b), 0))), Math.max(...all.map((one) => one.reduce((a, b) => Math.max(a, b), 0)))];
    };
    const [[left = 0, far = 0], [low = 0, top = 0]] = [extent(0), extent(1)];
    const scale = 0.62 * Math.max((far - left) / wide, (top - low) / high, 1e-9);
    const [x, y] = [(left + far) / 2, (low + top) / 2];
    this.#plot.batch(() => {
      this.#plot.setScale("x", { min: x - scale * wide, max: x + scale * wide });
      this.#plot.setScale("y", { min: y - scale * high, max: y + scale * high });
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
 * A horizontal line.
 * @param {uPlot} u
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} value
 * @param {{stroke: string, dash: number[]}} how
 */
export function levelLine(u, ctx, value, { stroke, dash }) {
  const ratio = devicePixelRatio;
  const y = u.valToPos(value, "y", true) / ratio;
  ctx.strokeStyle = color(stroke);
  ctx.setLineDash(dash);
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.moveTo(u.bbox.left / ratio, y);
  ctx.lineTo((u.bbox.left + u.bbox.width) / ratio, y);
  ctx.stroke();
  ctx.setLineDash([]);
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
