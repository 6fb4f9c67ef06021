// The pictures of a response over time, and the present time in them, whatever moves.

import { download } from "./csv.js";
import { element, make } from "./dom.js";
import { interpolated } from "./histories.js";
import { color, LinePlot } from "./plots.js";
import { measureScene } from "./scene.js";
import { completed, kindOf } from "./settings.js";
import { responsePlot } from "./spectra.js";
import { fileName, NO_COMMAND, objects, settings, sourceOf, state, units } from "./state.js";
import { svg } from "./svg.js";
import { showNumbers } from "./tables.js";
import { inUnits, inWords, plain, shown, unit } from "./values.js";

/** @import { Settings } from "./library.js" */
/** @import { Row } from "./state.js" */

/** @param {string} name  of the picture  @param {string[]} strokes  names of the colors */
export const history = (name, strokes) => new LinePlot(element(`plot-${name}`), strokes, onCursor, "time", { onWindow: setWindow });

/** @param {number | null} index */
function onCursor(index) {
  if (!playing && !moving && state.response && index !== null) setTime(state.response.time[index] ?? 0, false);
}

const ground = history("acceleration", ["acceleration"]);

/** What moves now. */
const object = () => objects[kindOf(settings)];
/** The pictures over time. */
const histories = () => [ground, ...object().histories];

export function resizePlots() {
  for (const plot of [ground, ...object().histories, ...object().others, responsePlot]) plot.resize();
}

/** Shows the parts of the page that belong to what moves. */
export function showKind() {
  const { dataset } = document.body;
  if (dataset.kind === kindOf(settings)) return;
  dataset.kind = kindOf(settings);
  measureScene(element("scene"));
  resizePlots();
  for (const plot of histories()) plot.window(span);
}

/**
 * A history of the ground or of the compared settings on the time base of both: the one that rested earlier stays where it is.
 * @param {Float64Array} time
 * @param {Float64Array} values
 * @param {number} rest
 */
export function padded(time, values, rest) {
  if (values.length === time.length) return values;
  const longer = new Float64Array(time.length).fill(rest);
  longer.set(values);
  return longer;
}

/**
 * @param {Settings} s
 * @param {Row} row
 */
export function show(s, row) {
  const found = state.response;
  element("output").classList.toggle("empty", found === null);
  showKind();
  const other = state.pinned?.response?.kind === kindOf(s) ? state.pinned.response : null;
  element("pinned").textContent = state.pinned && other ? `Compared with ${inWords(completed(state.pinned.settings))} (dashed).` : "";
  const { plane } = object();
  const source = sourceOf(row, s.vertical === 1, plane);
  element("command").textContent = object().command(s, source) ?? NO_COMMAND;
  element("python").textContent = object().python(s, source, row, found);
  if (!found) return;
  element("subject").textContent = `${row.label}: ${inWords(s)}`;
  element("answer").replaceChildren(...object().answer(found).map(([name, value]) => make("span", {}, `${name} `, make("b", {}, value))));
  const time = other && other.time.length > found.time.length ? other.time : found.time;
  if (span && span[0] >= (time.at(-1) ?? 0)) setWindow(null);

  element("title-acceleration").textContent = `Ground acceleration${plane ? " along the axis" : ""} [${unit("acceleration").name}]`;
  // It does not depend on what moves, except that its time ends with the object at rest.
  const drawn = [row.motion?.id, s.scale, time.length, units.acceleration, color("ink")].join(" ");
  ground.show(time, [inUnits(padded(time, found.acceleration, 0), "acceleration")], { key: drawn });
  ground.marks(object().levels(s, found).map((level, i) => ({ value: level / unit("acceleration").size, label: i ? "" : "slip level", below: level < 0 })));
  object().show(found, other, time);
  showNumbers();
  element("report").textContent = object().report(s, row, found);
  element("time").max = String(time.at(-1) ?? 1);
  if (row !== windowed) {
    windowed = row;
    const strong = strongWindow(row);
    if (strong) state.now = strong[0];
    setWindow(strong);
  }
  setTime(Math.min(state.now, time.at(-1) ?? 0));
}

/** The row whose window is that of its strong motion. @type {Row | null} */
let windowed = null;

/** The times of D5-95 with a quarter of it before and after, where the record is over three times as long. @param {Row} row  @returns {[number, number] | null} */
function strongWindow({ motion }) {
  const { begin, d5_95, duration } = motion?.measures ?? { begin: NaN, d5_95: NaN, duration: NaN };
  const [from, to] = [Math.max(0, begin - d5_95 / 4), begin + 1.25 * d5_95];
  return to - from < duration / 3 ? [from, to] : null;
}

export function downloadSvg() {
  const { response: found, selected } = state;
  if (!found || !selected) return;
  const { name, size } = unit("acceleration");
  const picture = svg(selected.label, found.time, [
    {
      title: `Ground acceleration [${name}]`,
      lines: [{ values: inUnits(found.acceleration, "acceleration"), stroke: "#56616c" }],
      levels: object().levels(completed(settings), found).map((value) => ({ stroke: "#a0417a", label: "", value: value / size })),
    },
    ...object().panels(found),
  ]);
  download(`${fileName(selected)}.svg`, picture, "image/svg+xml");
}

export let playing = false;

let moving = false; // whether the page moves the cursors

/**
 * @param {number} time  [s]
 * @param {boolean} [cursors]  whether the pictures' cursors follow
 */
export function setTime(time, cursors = true) {
  const found = state.response;
  if (!found || found.kind !== kindOf(settings)) return;
  state.now = time;
  const at = interpolated(found.time, time);
  const { acceleration } = found;
  element("readout").textContent =
    `t = ${time.toFixed(2)} s: ground ${shown(plain(at(acceleration)), "acceleration")}, ${object().showTime(found, at, element("scene"))}`;
  element("time").value = String(time);
  if (!cursors) return;
  moving = true;
  for (const plot of histories()) plot.point(time);
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
  for (const plot of histories()) plot.window(range);
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
