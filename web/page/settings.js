// What the page lets its reader choose: laws and mountings by the names of the command's options.

/** @import { Settings } from "./library.js" */

/** Settings in which nothing is given. @type {Settings} */
export const NOT_GIVEN = Object.freeze({
  law: 0,
  mu: NaN,
  mu_static: NaN,
  reach: NaN,
  mu_fast: NaN,
  rate: NaN,
  mu_residual: NaN,
  distance: NaN,
  period: NaN,
  damping_ratio: NaN,
  pendulum: 0,
  slope: NaN,
  stop_gap: NaN,
  restitution: NaN,
  vertical: 0,
  clipped: 0,
  scale: 1,
});
