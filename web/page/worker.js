// Runs the library beside the page, so that the page never freezes.

import { unpacked } from "./files.js";
import { Library } from "./library.js";
import { GENERATORS } from "./sources.js";

/** @import { Component, Measures, ReadOptions, Settings, Summary } from "./library.js" */

/**
 * A ground motion of the worker.
 * @typedef {Component & {measures: Measures, verticalId: number | null, planarId: number | null, several: boolean}} Motion
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

/** What the page calls; each answer is cloned. */
const calls = {
  /** @param {Uint8Array<ArrayBuffer>} bytes */
  async load(bytes) {
    library = await Library.load(bytes);
  },

  /**
   * The components of a plain file; the vertical one joins those of the same file.
   * @param {string} name
   * @param {Uint8Array} bytes
   * @param {ReadOptions} options
   * @returns {Motion[]}
   */
  read(name, bytes, options) {
    const components = library.read(name, bytes, options);
    const vertical = components.find((one) => one.vertical);
    const horizontal = components.filter((one) => !one.vertical);
    const several = components.length > 1;
    const motions = (horizontal.length ? horizontal : components).map((one) => {
      /** @type {number | null} */
      let verticalId = null;
      if (vertical && !one.vertical)
        try {
          verticalId = library.station([one.id, vertical.id]);
        } catch {
          // No orientation, or another time base: the component slides alone.
        }
      /** @type {number | null} */
      let planarId = null;
      const other = horizontal.find((another) => another !== one);
      if (other && !one.vertical && horizontal.length === 2)
        try {
          planarId = library.station([one.id, other.id, ...(vertical ? [vertical.id] : [])]);
        } catch {
          // As above: there is no path in the plane.
        }
      return { ...one, measures: library.measures(one.id), verticalId, planarId, several };
    });
    if (vertical && horizontal.length) library.discard(vertical.id);
    return motions;
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
    const measures = library.measures(id);
    const named = { name: generator.label, component: "", orientation: "", units: "" };
    return { id, ...named, vertical: false, measures, verticalId: null, planarId: null, several: false };
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
   * Peak and magnitude of the residual [m] with the record as it is and reversed.
   * @param {number} id
   * @param {Settings} settings
   */
  bothWays(id, settings) {
    const [normal, inverse] = [1, -1].map((sign) => {
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
