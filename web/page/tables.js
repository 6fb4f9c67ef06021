// The numbers of a response, whatever moves, and of the ground: tables and their downloads.

import { csv, download } from "./csv.js";
import { element, make } from "./dom.js";
import { completed, toLink } from "./settings.js";
import { fileName, objects, settings, state } from "./state.js";
import { shown } from "./values.js";

/** @import { Summary } from "./library.js" */
/** @import { Found, Row } from "./state.js" */
/** @import { Quantity } from "./units.js" */

/** @typedef {[string, number, Quantity, string]} Line  name, value in SI units, quantity, SI unit */

/**
 * @param {Row} row
 * @param {number} times  the scale of the motion
 * @returns {Line[]}
 */
export function groundNumbers({ motion }, times = settings.scale) {
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
export const comments = (lines) => lines.map(([name, value, , si]) => `${name}${si ? ` [${si}]` : ""}: ${value}`);

/** @param {Summary} summary  @returns {Line[]} */
export const slideNumbers = (summary) => [
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

/** How far to trust a response. @param {any} summary  @returns {Line[]} */
export const certificate = (summary) => [
  ["events", summary.events, "none", ""],
  ["energy imbalance over input", summary.imbalance / (summary.input || 1), "none", ""],
  ["margin of the closest decision", Math.min(summary.margin, summary.impact_margin ?? Infinity), "none", ""],
];

/**
 * @param {Found | null} of
 * @param {number} times  the scale of the motion
 * @returns {Line[]}
 */
function numbers(of = state.response, times = settings.scale) {
  if (!of || !state.selected?.motion) return [];
  return [...objects[of.kind].numbers(of), ...groundNumbers(state.selected, times), ...certificate(of.summary)];
}

/**
 * @param {Line} line
 * @param {...HTMLElement} more
 */
export function tableRow([name, value, quantity], ...more) {
  const row = make("tr", {}, make("th", { scope: "row" }, name), make("td", {}, shown(value, quantity)), ...more);
  row.dataset.name = name;
  row.dataset.si = String(value);
  return row;
}

export function showNumbers() {
  const compared = state.pinned?.response?.kind === state.response?.kind && state.pinned ? numbers(state.pinned.response, state.pinned.settings.scale) : [];
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
  if (!state.response) return;
  const { caption, remark } = objects[state.response.kind];
  element("numbers").caption.textContent = caption;
  if (remark(state.response)) body.append(make("tr", {}, make("th", { colSpan: 2 }, remark(state.response))));
}

export function downloadCsv() {
  if (!state.response || !state.selected) return;
  const { kind, time, acceleration } = state.response;
  const columns = { time_s: time, ground_acceleration_m_s2: acceleration, ...objects[kind].columns(state.response) };
  const rows = Array.from(time, (_, i) => Object.values(columns).map((values) => values[i] ?? NaN));
  const notes = [
    `stickslip: ${state.selected.label}; ${toLink(completed(settings))}`,
    ...comments(numbers()),
  ];
  download(`${fileName(state.selected)}.csv`, csv(Object.keys(columns), rows, notes), "text/csv");
}
