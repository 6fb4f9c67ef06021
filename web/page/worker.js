// Runs the library beside the page, so that the page never freezes.

import { unpacked } from "./files.js";
import { Library } from "./library.js";
import { GENERATORS } from "./sources.js";
import { angleInPair, byStation, saidByName } from "./stations.js";

/** @import { Component, Measures, ReadOptions, Settings, Summary } from "./library.js" */

/**
 * A ground motion of the worker: a component of a file, or what it generated.
 * @typedef {Component & {measures: Measures, file: string, given: string, number: number, several: boolean, pointed: boolean}} Motion
 *   `given` is what its reader was told; `several`: the file has others; `pointed`: its name or a table says where it points
 */

/**
 * A horizontal component with those of its station.
 * @typedef {Object} Joined
 * @property {number} id
 * @property {number[]} members         of the station, itself among them
 * @property {number | null} verticalId  of its motion with the vertical component
 * @property {number | null} planarId    of its motion with the other components
 * @property {string} reason             why the components do not fit together; empty if they do
 */

/**
 * A response, with its histories at the samples.
 * @typedef {Object} Response
 * @property {Summary} summary
 * @property {Float64Array} time          [s]
 * @property {Float64Array} acceleration  of the ground [m/s^2], zero after the end of the motion
 * @property {Float64Array} velocity      [m/s]
 * @property {Float64Array} displacement  [m]
 * @property {Float64Array} force         on the mass, per unit mass [m/s^2]
 * @property {Float64Array} events        time, displacement, velocity and kind of each
 */

/** @type {Library} */
let library;

/** The stations by the numbers of their components. @type {Map<string, Joined[]>} */
let stations = new Map();

/**
 * Where a component points if only the name of its file says so, as `Suite.read` has it.
 * @param {Component} one
 * @param {string} file
 * @param {string} orientation  that a table states, or none
 */
function pointed(one, file, orientation) {
  const said = one.component ? null : saidByName(file);
  const name = said ? `${said.station}, ${said.component}` : one.name;
  const component = said?.component ?? one.component;
  const known = one.orientation || orientation;
  const angle = angleInPair({ component, orientation: known });
  const direction = angle ?? (known || (said?.component ?? ""));
  if (component === one.component && direction === one.orientation) return { ...one, pointed: false };
  const found = library.point(one.id, component, direction);
  // A pair without azimuths has no north.
  return { ...found, name, pointed: direction !== one.orientation, ...(angle === undefined ? {} : { azimuth: NaN }) };
}

/** The horizontal components of a station with the others. @param {Motion[]} parts  @returns {Joined[]} */
function joined(parts) {
  const vertical = parts.filter((one) => one.vertical);
  const horizontal = parts.filter((one) => !one.vertical);
  const members = parts.map(({ id }) => id);
  let reason = "";
  try {
    if (parts.length > 1 && horizontal.length) library.discard(library.station([...horizontal, ...vertical].map(({ id }) => id)));
  } catch (error) {
    reason = /** @type {Error} */ (error).message.replace("read_station: ", "");
  }
  return horizontal.map((one) => {
    const others = horizontal.filter((another) => another !== one);
    const along = (/** @type {Motion[]} */ ...more) => (more.length && !reason ? library.station([one, ...more].map(({ id }) => id)) : null);
    return {
      id: one.id,
      members: reason ? [one.id] : members,
      verticalId: along(...vertical),
      planarId: others.length ? along(...others, ...vertical) : null,
      reason,
    };
  });
}

/** What the page calls; each answer is cloned. */
const calls = {
  /** @param {Uint8Array<ArrayBuffer>} bytes */
  async load(bytes) {
    library = await Library.load(bytes);
    return { laws: library.laws, ranges: library.ranges() };
  },

  /**
   * The components of a plain file.
   * @param {string} file
   * @param {Uint8Array} bytes
   * @param {ReadOptions & {orientation?: string}} options  the orientation of a file that states none
   * @returns {Motion[]}
   */
  read(file, bytes, { orientation = "", ...options }) {
    const components = library.read(file, bytes, options);
    const alone = components.length === 1;
    return components.map((one, i) => ({
      ...(alone ? pointed(one, file, orientation) : pointed(one, "", "")),
      measures: library.measures(one.id),
      file,
      given: JSON.stringify(options),
      number: i + 1,
      several: !alone,
    }));
  },

  /**
   * Joins components to stations.
   * @param {Motion[]} motions  all that there are
   * @returns {Joined[]}  one for each horizontal component
   */
  join(motions) {
    /** @type {typeof stations} */
    const now = new Map();
    for (const parts of byStation(motions)) {
      const key = parts.map(({ id }) => id).join(" ");
      now.set(key, stations.get(key) ?? joined(parts));
    }
    for (const [key, old] of stations)
      if (!now.has(key)) for (const { verticalId, planarId } of old) for (const id of [verticalId, planarId]) if (id !== null) library.discard(id);
    stations = now;
    return [...now.values()].flat();
  },

  /** @param {string} name  @param {Uint8Array} bytes */
  async unpack(name, bytes) {
    const files = [];
    for await (const file of unpacked(name, bytes)) files.push(file);
    return files;
  },

  /**
   * @param {string} name  of a generator
   * @param {Record<string, number>} values
   * @returns {Motion}
   */
  generate(name, values) {
    const generator = GENERATORS.find((one) => one.name === name);
    if (!generator) throw new Error(`unknown motion ${name}`);
    const id = generator.make(library, values);
    const named = { name: generator.label, component: "", orientation: "", units: "", start: "", sensor: "", file: "", given: "{}" };
    return { id, ...named, azimuth: NaN, vertical: false, measures: library.measures(id), number: 1, several: false, pointed: false };
  },

  /** @param {number[]} ids */
  discard(ids) {
    for (const id of ids) library.discard(id);
  },

  /**
   * @param {number} id
   * @param {Settings} settings
   * @returns {Response}
   */
  slide(id, settings) {
    const summary = library.slide(id, settings);
    const displacement = library.history("displacement");
    const own = library.history("acceleration");
    const acceleration = new Float64Array(displacement.length);
    acceleration.set(own);
    return {
      summary,
      time: library.times(id, displacement.length - own.length),
      acceleration,
      velocity: library.history("velocity"),
      displacement,
      force: library.history("force"),
      events: library.history("events"),
    };
  },

  /**
   * A block that rocks.
   * @param {number} id
   * @param {Settings} settings
   */
  rock(id, settings) {
    const summary = library.rock(id, settings);
    const [rotation, displacement, gap] = [library.blockHistory("rotation"), library.blockHistory("displacement"), library.blockHistory("gap")];
    const own = library.blockHistory("acceleration");
    const acceleration = new Float64Array(rotation.length);
    acceleration.set(own);
    const events = library.blockHistory("events");
    return { summary, time: library.times(id, rotation.length - own.length), acceleration, rotation, displacement, gap, events };
  },

  /**
   * @param {number} id
   * @param {Settings} settings
   * @param {Float64Array} values
   * @param {boolean} ofMu
   */
  rockOver(id, settings, values, ofMu) {
    return library.rockOver(id, settings, values, ofMu);
  },

  /**
   * A cart.
   * @param {number} id
   * @param {Settings} settings
   */
  roll(id, settings) {
    const summary = library.roll(id, settings);
    const [axis, own] = [library.cartHistory("axis"), library.cartHistory("acceleration")];
    const acceleration = new Float64Array(axis.length);
    acceleration.set(own);
    const time = library.times(id, axis.length - own.length);
    const [transverse, yaw] = [library.cartHistory("transverse"), library.cartHistory("yaw")];
    const headings = library.cartHistory("headings");
    const casters = headings.length / axis.length;
    const each = Array.from({ length: casters }, (_, i) => headings.filter((_, k) => k % casters === i));
    return { summary, time, acceleration, axis, transverse, yaw, headings: each, plan: library.cartHistory("plan") };
  },

  /**
   * @param {number} id
   * @param {Settings} settings
   * @param {{first: number, count: number, seed: number}} members
   */
  rollAtRandom(id, settings, members) {
    return library.rollAtRandom(id, settings, members);
  },

  /**
   * @param {number} id
   * @param {Settings} settings
   */
  path(id, settings) {
    const found = library.path(id, settings);
    const more = found.axis.length - library.times(id).length;
    return { ...found, time: library.times(id, more) };
  },

  /**
   * @param {number} id
   * @param {Settings} settings
   * @param {Float64Array} mus
   */
  spectrum(id, settings, mus) {
    return library.spectrum(id, settings, mus);
  },

  /**
   * @param {number} id
   * @param {Float64Array} periods
   * @param {number} damping
   */
  responseSpectrum(id, periods, damping) {
    return library.responseSpectrum(id, periods, damping);
  },

  /**
   * Peak and magnitude of the residual [m] with the record reversed and as it is, which SLAMMER calls normal and inverse.
   * @param {number} id
   * @param {Settings} settings
   */
  bothWays(id, settings) {
    const [inverse, normal] = [1, -1].map((sign) => {
      const { peak, residual } = library.spectrum(
        id,
        { ...settings, scale: sign * settings.scale },
        Float64Array.of(settings.mu),
      );
      return { peak: peak[0] ?? NaN, residual: residual[0] ?? NaN };
    });
    return { normal: normal ?? { peak: NaN, residual: NaN }, inverse: inverse ?? { peak: NaN, residual: NaN } };
  },

  /** Size of the memory of the library [bytes]. */
  memory() {
    return library.memory;
  },
};

/** @typedef {typeof calls} Calls */

/** @param {any} value */
const buffersOf = (value) =>
  value && typeof value === "object" && value.time instanceof Float64Array
    ? Object.values(value).flatMap((one) => (one instanceof Float64Array ? [one.buffer] : []))
    : [];

self.onmessage = async ({ data: { number, call, args } }) => {
  try {
    const result = await /** @type {any} */ (calls)[call](...args);
    /** @type {any} */ (self).postMessage({ number, result }, buffersOf(result));
  } catch (error) {
    self.postMessage({ number, error: /** @type {Error} */ (error).message });
  }
};
