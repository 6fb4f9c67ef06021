// Ground motions that the page generates, and how Python obtains the same motion.

/** @import { Library } from "./library.js" */
/** @import { Motion } from "./worker.js" */
/** @import { Quantity } from "./units.js" */

/**
 * Where a ground motion comes from.
 * @typedef {Object} Source
 * @property {string[]} files      none if the page generates it
 * @property {string} [units]      as the reader entered them
 * @property {number} [dt]         as the reader entered it [s]
 * @property {string} [component]  where the file has several
 * @property {boolean} [station]   several components of them act
 * @property {boolean} [dropsVertical]  the files hold a vertical component, which does not act
 * @property {string[]} python     lines that define `motion`
 */

/**
 * A number of a generated motion.
 * @typedef {Object} Parameter
 * @property {string} key
 * @property {string} label
 * @property {string} [unit]          where it is always the same
 * @property {Quantity} [quantity]    whose chosen unit it has
 * @property {number} value  by default
 * @property {number} min
 * @property {number} max
 */

/**
 * @typedef {Object} Generator
 * @property {string} name
 * @property {string} label
 * @property {readonly Parameter[]} parameters
 * @property {(library: Library, values: Record<string, number>) => number} make  the number of the motion
 * @property {(values: Record<string, number>) => string[]} python
 */

const DT = 0.005;

/**
 * @param {number} duration  [s]
 * @param {(t: number) => number} at  [m/s^2]
 */
function sampled(duration, at) {
  return Float64Array.from({ length: Math.round(duration / DT) + 1 }, (_, i) => at(i * DT));
}

const PGA = { key: "pga", label: "PGA", quantity: /** @type {const} */ ("acceleration"), value: 3, min: 0.01, max: 100 };
const FREQUENCY = { key: "frequency", label: "frequency", unit: "Hz", value: 1, min: 0.05, max: 20 };

/** @type {readonly Generator[]} */
export const GENERATORS = Object.freeze([
  {
    name: "pulse",
    label: "pulse (Ricker)",
    parameters: [PGA, FREQUENCY],
    make: (library, { pga = 0, frequency = 1 }) =>
      library.make(
        sampled(4 / frequency, (t) => {
          const square = (Math.PI * (frequency * t - 2)) ** 2;
          return pga * (1 - 2 * square) * Math.exp(-square);
        }),
        DT,
      ),
    python: ({ pga = 0, frequency = 1 }) => [
      `t = np.arange(${Math.round(4 / frequency / DT) + 1}) * ${DT}`,
      `square = (np.pi * (${frequency} * t - 2)) ** 2`,
      `motion = ss.GroundMotion(${pga} * (1 - 2 * square) * np.exp(-square), ${DT})`,
    ],
  },
  {
    name: "sine",
    label: "sine",
    parameters: [
      PGA,
      FREQUENCY,
      { key: "cycles", label: "cycles", value: 10, min: 1, max: 200 },
    ],
    make: (library, { pga = 0, frequency = 1, cycles = 1 }) =>
      library.make(
        sampled(cycles / frequency, (t) => pga * Math.sin(2 * Math.PI * frequency * t)),
        DT,
      ),
    python: ({ pga = 0, frequency = 1, cycles = 1 }) => [
      `t = np.arange(${Math.round(cycles / frequency / DT) + 1}) * ${DT}`,
      `motion = ss.GroundMotion(${pga} * np.sin(2 * np.pi * ${frequency} * t), ${DT})`,
    ],
  },
  {
    name: "kanai-tajimi",
    label: "Kanai-Tajimi noise",
    parameters: [
      { key: "s0", label: "S\u2080", unit: "m\u00b2/s\u00b3", value: 0.01, min: 1e-6, max: 10 },
      { key: "omega", label: "\u03c9 ground", unit: "rad/s", value: 15, min: 1, max: 300 },
      { key: "damping", label: "\u03b6 ground", value: 0.6, min: 0.05, max: 1 },
      { key: "samples", label: "samples", unit: "\u00d7 0.01 s", value: 2048, min: 64, max: 65536 },
      { key: "seed", label: "seed", value: 1, min: 0, max: 1e9 },
    ],
    make: (library, { s0 = 0, omega = 1, damping = 1, samples = 2, seed = 0 }) =>
      library.kanaiTajimi({ s0, frequency: omega, damping, dt: 0.01, samples, seed }),
    python: ({ s0, omega, damping, samples, seed }) => [
      `spectrum = ss.Spectrum.kanai_tajimi(s0=${s0}, frequency=${omega}, damping=${damping})`,
      `motion = ss.GaussianExcitation(spectrum, 0.01, ${samples}).sample(seed=${seed}, member=0)`,
    ],
  },
]);

/**
 * A string of Python.
 * @param {string} text
 */
const literal = (text) => JSON.stringify(text);

/**
 * The source of a component of a file, or of a station along it.
 * @param {Motion} motion
 * @param {readonly Motion[]} [station]  the components that act, `motion` among them
 * @returns {Source}
 */
export function recorded(motion, station = [motion]) {
  /** @type {{units?: string, dt?: number}} */
  const options = JSON.parse(motion.given);
  const { units, dt } = options;
  const stated = [...(units ? [`units=${literal(units)}`] : []), ...(dt === undefined ? [] : [`dt=${dt}`])];
  const files = [...new Set(station.map(({ file }) => file))];
  const several = station.length > 1;
  const called = motion.component || String(motion.number);
  const direction = Number.isNaN(motion.azimuth) ? motion.component : motion.orientation;
  const component = files.length > 1 ? direction : motion.several ? called : "";
  if (several) {
    stated.unshift(`along=${literal(motion.orientation)}`);
    if (station.some((one) => one.pointed)) stated.push(`orientations=[${station.map((one) => literal(one.orientation)).join(", ")}]`);
  } else if (component) stated.unshift(`component=${/^\d+$/.test(component) ? component : literal(component)}`);
  const from = files.length > 1 ? `[${files.map(literal).join(", ")}]` : literal(motion.file);
  return { ...options, files, component, station: several, python: [`motion = ss.${several ? "read_station" : "read_record"}(${[from, ...stated].join(", ")})`] };
}
