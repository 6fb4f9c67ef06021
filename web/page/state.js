// What the page holds and who follows its changes: settings, units, records, and the response that it shows.

import { startWorker } from "./client.js";
import { element } from "./dom.js";
import { completed, fromLink, toLink } from "./settings.js";
import { GENERATORS } from "./sources.js";

/** @import { Part, Range, Settings } from "./library.js" */
/** @import { Stated } from "./metadata.js" */
/** @import { Source } from "./sources.js" */
/** @import { Choice, Quantity } from "./units.js" */
/** @import { Unpack } from "./loader.js" */
/** @import { Kind } from "./settings.js" */
/** @import { CurvePlot, LinePlot } from "./plots.js" */
/** @import { Panel } from "./svg.js" */
/** @import { Line } from "./tables.js" */
/** @import { Joined, Motion } from "./worker.js" */

export { GRAVITY } from "./units.js";

export const NO_COMMAND = "The command has no option for this; the lines in Python give the same numbers.";

export const unpacked = /** @type {{unpacked: Unpack}} */ (/** @type {unknown} */ (globalThis)).unpacked;

export const worker = startWorker(new TextDecoder().decode(unpacked("worker")));

export const { settings, others } = fromLink(location.hash.slice(1));

/** @type {Choice} */
export const units = {
  length: others.length === "in" || others.length === "m" ? others.length : "cm",
  acceleration: others.acceleration === "si" ? "si" : "g",
};

/** @type {Row[]} */
export const rows = [];

/**
 * A line of the list of records: a ground motion, or a file that could not be read.
 * @typedef {Object} Row
 * @property {string} label
 * @property {string} file
 * @property {Motion} [motion]
 * @property {Joined} [joined]     with the other components of its station
 * @property {boolean} counts      whether it is among the records that the reader chose
 * @property {(station: readonly Motion[]) => Source} source  of the components that act
 * @property {string} [error]
 * @property {Uint8Array} [bytes]  of a file that could not be read, to try again
 * @property {HTMLLIElement} [failed]  what says that it could not
 * @property {() => Stated} [entered]  what the reader entered for it
 */

/**
 * A response of what moves, with its histories by their names.
 * @typedef {{kind: Kind, summary: any, time: Float64Array, acceleration: Float64Array} & Record<string, any>} Found
 */

/**
 * A table of many records: names, quantities and units of its columns, and the values of a record.
 * @typedef {Object} Table
 * @property {string} title
 * @property {() => [string, Quantity, string][]} columns  heading, quantity, name in a CSV file
 * @property {(row: Row) => Promise<number[]>} values
 * @property {(value: number, column: number) => string | null} text  where a number is none to a reader
 * @property {(column: number) => boolean} counts                     whether a column has a mean
 * @property {(values: number[][]) => string} note
 */

/**
 * Curves of many records over a number.
 * @typedef {Object} Curves
 * @property {() => {name: string, csv: string, size: number, at: number, values: (highest: number) => Float64Array, key: string}} over
 *   what is along the axis, with its unit, and where the present settings are
 * @property {(row: Row, values: Float64Array) => Promise<Float64Array>} peaks
 * @property {string} csv        what they are
 * @property {() => string} title
 * @property {Quantity} quantity
 * @property {boolean} logarithmic  whether both axes are
 */

/**
 * What the page does with a kind of object.
 * @typedef {Object} Moving
 * @property {string} caption   of the numbers
 * @property {(found: Found) => string} remark  below them
 * @property {boolean} plane      whether both horizontal components act
 * @property {(full: Settings, row: Row) => Promise<Found>} respond
 * @property {LinePlot[]} histories
 * @property {(LinePlot | CurvePlot)[]} others
 * @property {() => void} update  other pictures, after a change
 * @property {(found: Found) => [string, string][]} answer
 * @property {(found: Found) => Line[]} numbers
 * @property {(s: Settings, found: Found) => number[]} levels  of the ground acceleration, at which it begins to move [m/s^2]
 * @property {(found: Found, other: Found | null, time: Float64Array) => void} show
 * @property {(found: Found, at: (values: Float64Array) => number, scene: HTMLCanvasElement) => string} showTime  and says what is then
 * @property {(found: Found) => Record<string, Float64Array>} columns
 * @property {(found: Found) => Panel[]} panels
 * @property {(s: Settings, source: Source) => string | null} command
 * @property {(s: Settings, source: Source, row: Row, found: Found | null) => string} python
 * @property {(s: Settings, row: Row, found: Found) => string} report
 * @property {Table} table
 * @property {Curves | null} curves
 */

/** @type {Record<Kind, Moving>} */
export const objects = /** @type {any} */ ({}); // each by its own file

/**
 * What changes while the page is open.
 * @typedef {Object} State
 * @property {Row | null} selected
 * @property {Found | null} response
 * @property {{settings: Settings, response: Found | null} | null} pinned  settings to compare with, and what they give
 * @property {number} now                     the time that is shown [s]
 * @property {import("./sources.js").Generator | undefined} generator
 * @property {Row | null} generated           the motion of the generator is one row, which changes with its numbers
 * @property {string} broken                  why there is no response to the settings; empty if there may be one
 * @property {Record<string, Part[]>} laws    the parts of the friction laws
 * @property {Record<string, Range>} ranges   beyond which another unit is more probable
 * @property {number} lastChange              when it was [ms]
 * @property {number} changes                 how many there were
 */

/** @type {State} */
export const state = {
  selected: null,
  response: null,
  pinned: null,
  now: 0,
  generator: GENERATORS.find((one) => one.name === others.motion),
  generated: null,
  broken: "",
  laws: {},
  ranges: {},
  lastChange: 0,
  changes: 0,
};

/** Shows why there are no numbers, in their place. @param {string} reason */
export function refuse(reason) {
  state.response = null;
  element("trouble").textContent = reason;
  element("output").classList.add("empty");
}

/**
 * What a motion slides with: the settings that have a meaning, and the motion with or without its vertical component.
 * @param {Settings} given
 * @param {Row} row
 * @returns {[Settings, number]}
 */
export function problemOf(given, { motion, joined }) {
  const full = completed(given);
  const both = joined?.verticalId ?? null;
  if (both === null) full.vertical = 0;
  return [full, full.vertical && both !== null ? both : /** @type {Motion} */ (motion).id];
}

/**
 * Where a row and the components that act with it come from.
 * @param {Row} row
 * @param {boolean} vertical
 * @param {boolean} plane
 * @returns {Source}
 */
export function sourceOf(row, vertical, plane = false) {
  const self = /** @type {Motion} */ (row.motion);
  const station = rows.flatMap(({ motion }) => (motion && row.joined?.members.includes(motion.id) ? [motion] : []));
  const acting = station.filter((one) => one === self || (one.vertical ? vertical : plane));
  const source = row.source(acting.length ? acting : [self]);
  return { ...source, dropsVertical: plane && !vertical && station.some((one) => one.vertical && source.files.includes(one.file)) };
}

function linkText() {
  return toLink(settings, { ...others, ...units, ...(state.selected === state.generated && state.generator ? { motion: state.generator.name } : {}) });
}

/** @type {ReturnType<typeof setTimeout> | undefined} */
let linkWaits;
export const saveLink = () => history.replaceState(null, "", `#${linkText()}`);

/** @type {() => void} */
let follow = () => {};

/** What follows each change of the settings or of the record. @param {() => void} work */
export const onChange = (work) => void (follow = work);

/** Before the answer comes, the page is not up to date. */
export function changed() {
  state.lastChange = performance.now();
  ++state.changes;
  document.body.dataset.state = "busy";
  element("figure-path").dataset.state = "busy";
  clearTimeout(linkWaits);
  linkWaits = setTimeout(saveLink, 200); // once for a moving slider: a browser allows 20 a second
  follow();
}

/** Until the response to the last change is drawn, and some time more. */
export async function untilIdle() {
  while (document.body.dataset.state === "busy" || performance.now() - state.lastChange < 200)
    await new Promise((resolve) => setTimeout(resolve, 20));
}

/** The damping ratio of a response spectrum. */
export const zeta = () => Number(others.zeta ?? 0.05);

/** Whether a row is a motion along which an object slides. @param {Row} row */
export const slides = ({ motion }) => motion !== undefined && !motion.vertical;

/** @param {Row} row */
export const fileName = (row) => row.label.replace(/[^\w.-]+/g, "_");
