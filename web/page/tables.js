// The numbers of a response: tables, their downloads, and a paragraph for a report.

import { csv, download } from "./csv.js";
import { element, make } from "./dom.js";
import { applies, completed, FIELDS, given, LAWS, toLink } from "./settings.js";
import { fileName, settings, state } from "./state.js";
import { digits } from "./units.js";
import { inField, listOf, shown } from "./values.js";

/** @import { Settings, Summary } from "./library.js" */
/** @import { Row } from "./state.js" */
/** @import { Quantity } from "./units.js" */
/** @import { Response } from "./worker.js" */

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

/** How far to trust a response. @param {Summary} summary  @returns {Line[]} */
export const certificate = (summary) => [
  ["events", summary.events, "none", ""],
  ["energy imbalance over input", summary.imbalance / (summary.input || 1), "none", ""],
  ["margin of the closest decision", Math.min(summary.margin, summary.impact_margin), "none", ""],
];

/**
 * @param {Response | null} of
 * @param {number} times  the scale of the motion
 * @returns {Line[]}
 */
function numbers(of = state.response, times = settings.scale) {
  if (!of || !state.selected?.motion) return [];
  return [...slideNumbers(of.summary), ...groundNumbers(state.selected, times), ...certificate(of.summary)];
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
  const compared = state.pinned ? numbers(state.pinned.response, state.pinned.settings.scale) : [];
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
  if (state.response && !state.response.summary.at_rest)
    body.append(
      make("tr", {}, make("th", { colSpan: 2 }, "It never comes to rest; these are the numbers at the end of the record.")),
    );
}

/**
 * A paragraph for a report.
 * @param {Settings} s
 * @param {Row} row
 */
export function report(s, row) {
  if (!state.response || !row.motion) return "";
  const { summary } = state.response;
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

export function downloadCsv() {
  if (!state.response || !state.selected) return;
  const { time, acceleration, velocity, displacement, force } = state.response;
  const rows = Array.from(time, (t, i) =>
    [t, acceleration[i], velocity[i], displacement[i], force[i]].map((value) => value ?? NaN),
  );
  const notes = [
    `stickslip: ${state.selected.label}; ${toLink(completed(settings))}`,
    ...comments(numbers()),
  ];
  const header = ["time_s", "ground_acceleration_m_s2", "velocity_m_s", "displacement_m", "force_m_s2"];
  download(`${fileName(state.selected)}.csv`, csv(header, rows, notes), "text/csv");
}
