// The compiled library: what web/bindings.cpp, web/blocks.cpp and web/carts.cpp export, with JavaScript's types.

import { isOneWay, LAWS } from "./settings.js";
import { GRAVITY } from "./units.js";

/** @import { Kind } from "./settings.js" */

/**
 * What moves; the names are those of the command's options, SI units; NaN is not given. With the fields of the friction laws,
 * which settings.js lists.
 * @typedef {Record<string, any> & OfAll} Settings
 * @typedef {Object} OfAll
 * @property {number} law            the place in `LAWS` of settings.js
 * @property {number} mu             coefficient of friction, where there are several as the hints of settings.js say: at rest, of a
 *   new surface, at high speed, or the largest of all surfaces; NaN for a slender block
 * @property {number} period         [s]
 * @property {number} damping_ratio
 * @property {number} pendulum       1: the spring is a pendulum
 * @property {number} slope          [degrees]
 * @property {number} stop_gap       [m]
 * @property {number} restitution
 * @property {number} vertical       1: the vertical component acts
 * @property {number} clipped        1: the slider never leaves the ground
 * @property {number} scale          factor on the ground acceleration
 * @property {number} width          of a block [m]
 * @property {number} height         of a block [m]
 * @property {number} wheels         of a cart: 0 four casters, of which 1 one, 2 two or 3 all are locked, 4 two fixed wheels behind
 * @property {readonly number[]} headings  of four casters at the start [degrees]
 * @property {number} base_length    between the casters, along the cart [m]
 * @property {number} base_width     and across it [m]
 * @property {number} body_length    of the outline of the cart [m]
 * @property {number} body_width     [m]
 * @property {number} gyration       radius [m]
 * @property {number} trail          of a caster [m]
 * @property {number} wheel_width    [m]
 * @property {number} rolling_mu     rolling resistance over the load
 */

/**
 * @typedef {Object} Summary
 * @property {number} peak              [m]
 * @property {number} residual          [m]
 * @property {number} sliding_distance  [m]
 * @property {number} time_sliding      [s]
 * @property {number} slips
 * @property {number} impacts
 * @property {number} liftoffs
 * @property {number} at_rest           1 or 0
 * @property {number} events
 * @property {number} samples
 * @property {number} end               [s]
 * @property {number} input             work of the ground [m^2/s^2]
 * @property {number} imbalance         of the energy [m^2/s^2]
 * @property {number} margin
 * @property {number} impact_margin
 * @property {number} pga               of the scaled motion; in the plane, of both components together [m/s^2]
 * @property {number} hold              what friction holds at the start [m/s^2]
 * @property {number} temperature       the highest of the sliding surface [degrees Celsius]; NaN if friction does not depend on it
 */

/**
 * @typedef {Object} Component
 * @property {number} id           of the ground motion
 * @property {string} name
 * @property {string} component
 * @property {string} orientation
 * @property {string} units
 * @property {boolean} vertical
 * @property {number} azimuth      [degrees]; NaN if it states none
 * @property {string} start        as the file writes it
 * @property {string} sensor       where it is, if the file says so
 */

/**
 * @typedef {Object} Measures
 * @property {number} dt             [s]; NaN for uneven times
 * @property {number} duration       [s]
 * @property {number} pga            [m/s^2]
 * @property {number} pgv            [m/s]
 * @property {number} pgd            [m]
 * @property {number} cav            [m/s]
 * @property {number} arias          [m/s]
 * @property {number} mean_period    [s]
 * @property {number} d5_95          [s]
 * @property {number} d5_75          [s]
 * @property {number} begin          of both durations [s]
 */

/**
 * @typedef {Object} ReadOptions
 * @property {string} [units]
 * @property {string} [component]
 * @property {number} [dt]        [s]
 * @property {boolean} [gaps]
 */

/**
 * A part of a friction law, as the library says it.
 * @typedef {Object} Part
 * @property {string} name
 * @property {string} unit
 * @property {number} size    in this unit, of 1 on the page: a level [m/s^2] is a coefficient of friction there
 * @property {number} low     the least value, on the page
 * @property {number} high    the largest value
 * @property {boolean} open   the least value itself is not allowed
 * @property {boolean} whole  it is a whole number
 */

/**
 * Beyond `bounds`, another unit is more probable, unless a value is so large that it can only be meant; SI units.
 * @typedef {Object} Range
 * @property {string} where              what has such values
 * @property {[number, number]} bounds
 * @property {[number, number]} usual
 * @property {number} meant              from where on a value can only be meant
 */

/**
 * What a block did; overturned is 1 to the right, -1 to the left, 0 if it stands; infinity and NaN as `RockingResponse` has them.
 * @typedef {Object} BlockSummary
 * @property {number} peak_rotation     [rad]
 * @property {number} peak_ratio        of the rotation over alpha
 * @property {number} overturned
 * @property {number} overturned_at     [s]
 * @property {number} impacts
 * @property {number} uplifts
 * @property {number} liftoffs
 * @property {number} residual          displacement of the base [m]
 * @property {number} sliding_distance  [m]
 * @property {number} time_rocking      [s]
 * @property {number} p                 [rad/s]
 * @property {number} alpha             [rad]
 * @property {number} restitution
 * @property {number} margin
 * @property {number} condition
 * @property {number} impacts_with_slip
 * @property {number} at_rest           1 or 0
 * @property {number} events
 * @property {number} samples
 * @property {number} input             work of the ground
 * @property {number} imbalance         of the energy
 * @property {number} pga               of the scaled motion [m/s^2]
 */

/**
 * What a cart did.
 * @typedef {Object} CartSummary
 * @property {number} peak                 of the center [m]
 * @property {number} peak_yaw             [rad]
 * @property {number} peak_outline         of the corner that moved farthest [m]
 * @property {number} peak_time            of that [s]
 * @property {number} peak_corner          which corner of the outline it is
 * @property {number} residual_axis        [m]
 * @property {number} residual_transverse  [m]
 * @property {number} residual_yaw         [rad]
 * @property {number} time_moving          [s]
 * @property {number} rests
 * @property {number} margin
 * @property {number} at_rest              1 or 0
 * @property {number} events
 * @property {number} samples
 * @property {number} input                work of the ground [m^2/s^2]
 * @property {number} imbalance            of the energy [m^2/s^2]
 * @property {number} pga                  of both components together [m/s^2]
 */

const BLOCK_HISTORIES = /** @type {const} */ (["rotation", "rate", "displacement", "top", "gap", "acceleration", "events"]);
const CART_HISTORIES = /** @type {const} */ (["axis", "transverse", "yaw", "headings", "acceleration", "plan"]);

const HISTORIES = /** @type {const} */ ([
  "displacement",
  "velocity",
  "force",
  "acceleration",
  "friction",
  "events",
  "gap",
]);

export class Library {
  /** The names of the numbers of settings and summaries. @type {Record<Kind, {settings: string[], summary: string[]}>} */
  #names;
  /** @type {any} */
  #wasm;

  /** @param {any} wasm  the exports of the module */
  constructor(wasm) {
    this.#wasm = wasm;
    wasm._initialize?.();
    const names = (/** @type {() => void} */ say) => {
      say();
      const [settings = [], summary = []] = this.#text().split("\n").map((line) => line.split(" "));
      return { settings, summary };
    };
    this.laws = this.#laws();
    this.#names = { slider: names(wasm.names), block: names(wasm.block_names), cart: names(wasm.cart_names) };
  }

  /**
   * @param {BufferSource} bytes  of the module
   * @returns {Promise<Library>}
   */
  static async load(bytes) {
    const module = await WebAssembly.compile(bytes);
    /** @type {Record<string, Record<string, () => number>>} */
    const imports = {};
    // Nothing of what the module imports is used: files, clocks and exits of a program.
    for (const { module: from, name } of WebAssembly.Module.imports(module))
      (imports[from] ??= {})[name] = () => 0;
    return new Library((await WebAssembly.instantiate(module, imports)).exports);
  }

  /** Size of the memory in use [bytes]; it never shrinks. */
  get memory() {
    return this.#wasm.memory.buffer.byteLength;
  }

  #text() {
    const { memory, text, text_size } = this.#wasm;
    return new TextDecoder().decode(new Uint8Array(memory.buffer, text(), text_size()));
  }

  /** A copy of the numbers of the last call. */
  #numbers() {
    const { memory, numbers, numbers_size } = this.#wasm;
    return new Float64Array(memory.buffer, numbers(), numbers_size()).slice();
  }

  /** @param {Uint8Array} bytes */
  #give(bytes) {
    const place = this.#wasm.input(bytes.length);
    new Uint8Array(this.#wasm.memory.buffer, place, bytes.length).set(bytes);
  }

  /** @param {ArrayBufferView} view */
  #giveView(view) {
    this.#give(new Uint8Array(view.buffer, view.byteOffset, view.byteLength));
  }

  /** @param {number} answer  of a function that returns a negative number if it failed */
  #checked(answer) {
    if (answer < 0) throw new Error(this.#text());
    return answer;
  }

  /** The parts of each law, in the order of their numbers. @returns {Record<string, Part[]>} */
  #laws() {
    this.#wasm.laws();
    const numbers = this.#numbers();
    /** @type {Record<string, Part[]>} */
    const laws = {};
    for (const [i, line] of this.#text().trimEnd().split("\n").entries()) {
      const [law = "", name = "", unit = ""] = line.split("\t");
      const [low = NaN, high = NaN, open, whole] = numbers.slice(4 * i, 4 * i + 4);
      const size = unit === "m/s^2" ? GRAVITY : 1;
      (laws[law] ??= []).push({ name, unit, size, low: low / size, high: high / size, open: open === 1, whole: whole === 1 });
    }
    return laws;
  }

  /** @returns {Record<string, Range>} by their quantities */
  ranges() {
    this.#wasm.ranges();
    const numbers = this.#numbers();
    const lines = this.#text().trimEnd().split("\n");
    return Object.fromEntries(
      lines.map((line, i) => {
        const [quantity = "", where = ""] = line.split("\t");
        const [low = NaN, high = NaN, least = NaN, most = NaN, meant = NaN] = numbers.slice(5 * i, 5 * i + 5);
        return [quantity, { where, bounds: [low, high], usual: [least, most], meant }];
      }),
    );
  }

  /**
   * All components of a record.
   * @param {string} name
   * @param {Uint8Array} content
   * @param {ReadOptions} [options]
   * @returns {Component[]}
   * @throws {Error} with the reader's message
   */
  read(name, content, { units = "", component = "", dt = NaN, gaps = false } = {}) {
    const texts = new TextEncoder().encode(`${name}\0${units}\0${component}\0`);
    const bytes = new Uint8Array(texts.length + content.length);
    bytes.set(texts);
    bytes.set(content, texts.length);
    this.#give(bytes);
    const first = this.#checked(this.#wasm.read(dt, gaps ? 1 : 0));
    return this.#components(first);
  }

  /**
   * Says where a component points.
   * @param {number} id
   * @param {string} component    its name
   * @param {string} orientation
   * @returns {Component}
   */
  point(id, component, orientation) {
    this.#give(new TextEncoder().encode(`${component}\0${orientation}\0`));
    this.#checked(this.#wasm.point(id));
    return /** @type {Component} */ (this.#components(id)[0]);
  }

  /** Components from their lines. @param {number} first  the number of the first  @returns {Component[]} */
  #components(first) {
    return this.#text()
      .replace(/\n$/, "")
      .split("\n")
      .map((line, i) => {
        const [name = "", component = "", orientation = "", units = "", up = "", azimuth = "", start = "", sensor = ""] = line.split("\t");
        const [vertical, angle] = [up !== "", azimuth === "" ? NaN : Number(azimuth)];
        return { id: first + i, name, component, orientation, units, vertical, azimuth: angle, start, sensor };
      });
  }

  /**
   * @param {Float64Array} acceleration  [m/s^2]
   * @param {number} dt                  [s]
   * @param {{transverse?: Float64Array, vertical?: Float64Array}} [others]  [m/s^2], as many, or none
   * @returns {number} the number of the motion
   */
  make(acceleration, dt, { transverse = new Float64Array(), vertical = new Float64Array() } = {}) {
    const n = acceleration.length;
    const all = new Float64Array(n + transverse.length + vertical.length);
    all.set(acceleration);
    all.set(transverse, n);
    all.set(vertical, n + transverse.length);
    this.#giveView(all);
    return this.#checked(this.#wasm.make(dt, transverse.length / n, vertical.length / n));
  }

  /**
   * A member of a stationary Gaussian process with a Kanai-Tajimi spectrum.
   * @param {{s0: number, frequency: number, damping: number, dt: number, samples: number, seed: number}} of
   *   s0 [m^2/s^3], frequency [rad/s], dt [s]
   */
  kanaiTajimi({ s0, frequency, damping, dt, samples, seed }) {
    return this.#checked(this.#wasm.kanai_tajimi(s0, frequency, damping, dt, samples, seed));
  }

  /**
   * The motion of a station, along its first component.
   * @param {number[]} ids
   */
  station(ids) {
    this.#giveView(Int32Array.from(ids));
    return this.#checked(this.#wasm.station());
  }

  /** @param {number} id */
  discard(id) {
    this.#wasm.discard(id);
  }

  /** @param {number} id */
  acceleration(id) {
    this.#checked(this.#wasm.acceleration(id));
    return this.#numbers();
  }

  /**
   * @param {number} id
   * @param {number} [more]  samples after the last of the motion
   */
  times(id, more = 0) {
    this.#checked(this.#wasm.times(id, more));
    return this.#numbers();
  }

  /**
   * @param {number} id
   * @returns {Measures}
   */
  measures(id) {
    this.#checked(this.#wasm.measures(id));
    const [dt, duration, pga, pgv, pgd, cav, arias, mean_period, d5_95, d5_75, begin] = this.#numbers();
    return /** @type {Measures} */ ({ dt, duration, pga, pgv, pgd, cav, arias, mean_period, d5_95, d5_75, begin });
  }

  /**
   * The largest acceleration of linear oscillators under a motion: wn^2 max |x| [m/s^2].
   * @param {number} id
   * @param {Float64Array} periods  [s]
   * @param {number} damping        ratio
   */
  responseSpectrum(id, periods, damping) {
    this.#giveView(periods);
    this.#checked(this.#wasm.response_spectrum(id, damping));
    return this.#numbers();
  }

  /** @param {any} values  @param {Kind} kind */
  #values(values, kind = "slider") {
    return Float64Array.from(this.#names[kind].settings, (name) => {
      const [key = "", place] = name.split(".");
      return Number(place === undefined ? values[key] : values[key][Number(place)]);
    });
  }

  /** A summary. @param {Float64Array} numbers  @param {Kind} kind  @returns {any} */
  #named(numbers, kind = "slider") {
    return Object.fromEntries(this.#names[kind].summary.map((name, i) => [name, numbers[i]]));
  }

  /** Gives settings, and then numbers. @param {Float64Array} values  @param {Float64Array} numbers */
  #giveBoth(values, numbers) {
    const both = new Float64Array(values.length + numbers.length);
    both.set(values);
    both.set(numbers, values.length);
    this.#giveView(both);
  }

  /**
   * Gives the settings of a slider, and laws: the number of each, its level at rest, and its parts; before a list its length.
   * @param {Settings} settings
   * @param {readonly Settings[]} [each]  of a law
   */
  #giveSlider(settings, each = [settings]) {
    const laws = each.flatMap((one) => {
      const { law = "", parts } = LAWS[one.law] ?? {};
      const given = parts?.(one) ?? {};
      const numbers = (this.laws[law] ?? []).flatMap(({ name, size }) => {
        const value = given[name] ?? NaN;
        return typeof value === "number" ? size * value : [value.length, ...value.map((element) => size * element)];
      });
      return [Object.keys(this.laws).indexOf(law), GRAVITY * one.mu_static, ...numbers];
    });
    this.#giveBoth(this.#values({ ...settings, one_way: isOneWay(settings) ? 1 : 0 }), Float64Array.from(laws));
  }

  /**
   * @param {number} id
   * @param {Settings} settings
   * @returns {Summary}
   */
  slide(id, settings) {
    this.#giveSlider(settings);
    this.#checked(this.#wasm.slide(id));
    return this.#named(this.#numbers());
  }

  /**
   * Peaks and magnitudes of residuals [m] over the friction coefficient; NaN where the slider would slide under its own
   * weight.
   * @param {number} id
   * @param {Settings} settings
   * @param {Float64Array} mus
   */
  spectrum(id, settings, mus) {
    const { mu_static, mus: of } = settings;
    const scaled = (/** @type {number} */ mu) => of.map((/** @type {number} */ one) => one * (mu / Math.max(...of)));
    this.#giveSlider(settings, Array.from(mus, (mu) => ({ ...settings, mu, mu_static: Math.max(mu_static, mu), mus: scaled(mu) })));
    this.#checked(this.#wasm.spectrum(id, mus.length));
    const numbers = this.#numbers();
    return { peak: numbers.filter((_, i) => i % 2 === 0), residual: numbers.filter((_, i) => i % 2 === 1) };
  }

  /**
   * In the plane, under both horizontal components.
   * @param {number} id
   * @param {Settings} settings
   * @returns {{summary: Summary, axis: Float64Array, transverse: Float64Array}}  the residual is a distance; displacements at the
   *   samples [m]
   */
  path(id, settings) {
    this.#giveSlider(settings);
    this.#checked(this.#wasm.path(id));
    const [numbers, first] = [this.#numbers(), this.#names.slider.summary.length];
    const every = (/** @type {number} */ from) =>
      Float64Array.from({ length: (numbers.length - first) / 2 }, (_, i) => numbers[from + 2 * i] ?? NaN);
    return { summary: this.#named(numbers), axis: every(first), transverse: every(first + 1) };
  }

  /**
   * A history of the last response, or its events: time, displacement, velocity and kind of each.
   * @param {typeof HISTORIES[number]} which
   */
  history(which) {
    this.#wasm.history(HISTORIES.indexOf(which));
    return this.#numbers();
  }

  /**
   * A block that rocks.
   * @param {number} id
   * @param {Settings} settings
   * @returns {BlockSummary}
   */
  rock(id, settings) {
    this.#giveView(this.#values(settings, "block"));
    this.#checked(this.#wasm.rock(id));
    return this.#named(this.#numbers(), "block");
  }

  /**
   * The largest rotation over alpha of blocks of other heights and the same shape, or of other coefficients of friction; infinite
   * where they overturn, NaN where they are refused.
   * @param {number} id
   * @param {Settings} settings
   * @param {Float64Array} values
   * @param {boolean} ofMu
   */
  rockOver(id, settings, values, ofMu) {
    this.#giveBoth(this.#values(settings, "block"), values);
    this.#checked(this.#wasm.rock_over(id, ofMu ? 1 : 0));
    return this.#numbers();
  }

  /** A history of the last block, or its events: time, rotation, rate and kind. @param {typeof BLOCK_HISTORIES[number]} which */
  blockHistory(which) {
    this.#wasm.block_history(BLOCK_HISTORIES.indexOf(which));
    return this.#numbers();
  }

  /**
   * A cart under both horizontal components.
   * @param {number} id
   * @param {Settings} settings
   * @returns {CartSummary}
   */
  roll(id, settings) {
    this.#giveView(this.#values(settings, "cart"));
    this.#checked(this.#wasm.roll(id));
    return this.#named(this.#numbers(), "cart");
  }

  /**
   * Members of carts whose casters have headings at random: the peaks of the center [m], of the yaw [rad] and of the outline [m].
   * @param {number} id
   * @param {Settings} settings
   * @param {{first: number, count: number, seed: number}} members
   */
  rollAtRandom(id, settings, { first, count, seed }) {
    this.#giveView(this.#values(settings, "cart"));
    this.#checked(this.#wasm.roll_at_random(id, first, count, seed));
    return this.#numbers();
  }

  /**
   * A history of the last cart; its plan: for each support its kind, 0 swivel caster, 1 fixed wheel or 2 foot, and its place, then
   * the corners of the outline.
   * @param {typeof CART_HISTORIES[number]} which
   */
  cartHistory(which) {
    this.#wasm.cart_history(CART_HISTORIES.indexOf(which));
    return this.#numbers();
  }
}
