// Units in which the page shows values; everything else is in SI units.

/**
 * @typedef {Object} Unit
 * @property {string} name
 * @property {number} size  in SI units
 */

export const GRAVITY = 9.80665;

/** @type {Record<"length" | "acceleration" | "velocity" | "time" | "temperature" | "angle" | "rate" | "side" | "none", Record<string, Unit>>} */
export const UNITS = {
  length: { cm: { name: "cm", size: 0.01 }, m: { name: "m", size: 1 }, in: { name: "in", size: 0.0254 } },
  velocity: { cm: { name: "cm/s", size: 0.01 }, m: { name: "m/s", size: 1 }, in: { name: "in/s", size: 0.0254 } },
  acceleration: { g: { name: "g", size: GRAVITY }, si: { name: "m/s\u00b2", size: 1 } },
  time: { s: { name: "s", size: 1 } },
  temperature: { celsius: { name: "\u00b0C", size: 1 } },
  angle: { rad: { name: "rad", size: 1 } },
  rate: { rad: { name: "rad/s", size: 1 } },
  side: { none: { name: "", size: 1 } }, // right, left or none
  none: { none: { name: "", size: 1 } },
};

/**
 * @typedef {{length: "cm" | "m" | "in", acceleration: "g" | "si"}} Choice
 * @typedef {keyof typeof UNITS} Quantity
 */

/**
 * @param {Quantity} quantity
 * @param {Choice} choice
 * @returns {Unit}
 */
export function unitOf(quantity, choice) {
  const key = {
    length: choice.length,
    velocity: choice.length,
    acceleration: choice.acceleration,
    time: "s",
    temperature: "celsius",
    angle: "rad",
    rate: "rad",
    side: "none",
    none: "none",
  }[quantity];
  return /** @type {Unit} */ (UNITS[quantity][key]);
}

/**
 * Four significant digits, as a person reads them.
 * @param {number} value
 */
export function digits(value) {
  if (Number.isNaN(value)) return "\u2013";
  if (!Number.isFinite(value)) return value > 0 ? "\u221e" : "\u2212\u221e";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size < 1e-3 || size >= 1e6 ? value.toExponential(2) : String(Number(value.toPrecision(4)));
  return text.replaceAll("-", "\u2212");
}

/**
 * A value as a field holds it: twelve digits.
 * @param {number} value
 * @param {Unit} unit
 */
export const toUnit = (value, { size }) => Number((value / size).toPrecision(12));

/**
 * What a field holds, in SI units: 0.3937 m of 39.37 cm.
 * @param {number} value
 * @param {Unit} unit
 */
export const fromUnit = (value, { size }) => Number((value * size).toPrecision(12));
