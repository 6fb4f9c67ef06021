// Values as the page shows them: in the chosen units, and settings in words.

import { described } from "./settings.js";
import { units } from "./state.js";
import { digits, toUnit, unitOf } from "./units.js";

/** @import { Settings } from "./library.js" */
/** @import { Field } from "./settings.js" */
/** @import { Quantity } from "./units.js" */

/** @param {Quantity} quantity */
export const unit = (quantity) => unitOf(quantity, units);

/** @param {number} value  @param {Quantity} quantity */
export const shown = (value, quantity) => {
  if (Number.isNaN(value)) return digits(value);
  if (quantity === "side") return value > 0 ? "right" : value < 0 ? "left" : "no";
  const { name, size } = unit(quantity);
  return `${digits(value / size)}${name ? ` ${name}` : ""}`;
};

/** @param {Float64Array} values  @param {Quantity} quantity */
export const inUnits = (values, quantity) => {
  const { size } = unit(quantity);
  const result = new Float64Array(values.length);
  for (let i = 0; i < result.length; ++i) result[i] = (values[i] ?? 0) / size;
  return result;
};

/** Round-off as zero: nobody reads 1e-17 m. @param {number} value */
export const plain = (value) => (Math.abs(value) < 1e-12 ? 0 : value);

/** @param {number | readonly number[]} value */
export const listOf = (value) => (typeof value === "number" ? (Number.isNaN(value) ? [] : [value]) : value);

/** @param {Field} field */
export const unitOfField = ({ quantity, unit: name = "" }) => (quantity ? unit(quantity) : { name, size: 1 });

/** Values of a setting in its unit, as they are held. @param {Field} field  @param {readonly number[]} values  @param {number} [precision]  digits */
export function inField(field, values, precision = 12) {
  const of = unitOfField(field);
  if (field.choices) return field.choices[values[0] ?? 0] ?? "";
  return values.map((value) => Number(toUnit(value, of).toPrecision(precision))).join(" ") + (of.name ? ` ${of.name}` : "");
}

/** @param {Settings} s */
export const inWords = (s) => described(s, (field) => inField(field, listOf(s[field.key]), 5));
