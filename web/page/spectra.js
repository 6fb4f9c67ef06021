// The sliding spectrum and the response spectrum.

import { latest } from "./client.js";
import { csv, download } from "./csv.js";
import { element } from "./dom.js";
import { color, LinePlot } from "./plots.js";
import { completed, kindOf, PERIODS, spectrumCommand, spectrumPython, toLink } from "./settings.js";
import {
  fileName,
  GRAVITY,
  NO_COMMAND,
  problemOf,
  settings,
  sourceOf,
  state,
  units,
  untilIdle,
  worker,
  zeta,
} from "./state.js";
import { comments, groundNumbers } from "./tables.js";
import { digits } from "./units.js";
import { inUnits, shown, unit } from "./values.js";

/** @import { Row } from "./state.js" */

export const slidingPlot = new LinePlot(element("plot-sliding"), ["displacement", "velocity"], (i) => readSpectrum("sliding", i), "number");
export const responsePlot = new LinePlot(element("plot-response"), ["acceleration"], (i) => readSpectrum("response", i), "logarithm");

/** @type {{key: string, mus: Float64Array, peak: Float64Array, residual: Float64Array} | null} */
let sliding = null;

const LEVELS = 100;
const PART_TIME = 20; // of a part [ms]: a change waits for it

/** What the spectrum depends on: not mu, to which the coefficients of several surfaces are scaled. @param {Row} row */
const slidingKey = (row) => JSON.stringify(problemOf({ ...settings, mu: 1 }, row));

/** In parts, while nothing else is asked: it does not depend on mu, so that a moving slider can wait for it. */
export const updateSliding = latest(async () => {
  const row = state.selected;
  if (!row?.motion || state.broken || kindOf(settings) !== "slider") return;
  const [full, id] = problemOf(settings, row);
  const key = slidingKey(row);
  if (sliding?.key === key) return; // `show` has drawn it
  const highest = Math.max((row.motion.measures.pga * Math.abs(full.scale)) / GRAVITY, 0.01);
  const mus = Float64Array.from({ length: LEVELS }, (_, i) => ((i + 1) / LEVELS) * highest);
  const [peak, residual] = [new Float64Array(LEVELS), new Float64Array(LEVELS)];
  for (let i = 0, count = 4; i < LEVELS; ) {
    await untilIdle();
    if (row !== state.selected || state.broken || key !== slidingKey(row)) return;
    const begin = performance.now();
    const part = await worker.spectrum(id, full, mus.slice(i, i + count)).catch(() => null);
    if (!part) return;
    peak.set(part.peak, i);
    residual.set(part.residual, i);
    i += part.peak.length;
    count = Math.max(1, Math.min(25, Math.floor((count * PART_TIME) / (performance.now() - begin))));
  }
  sliding = { key, mus, peak, residual };
  showSliding();
});

export function showSliding() {
  if (!sliding) return;
  const { mus, peak, residual } = sliding;
  element("title-sliding").textContent = `Sliding spectrum: peak and residual (dashed) [${unit("length").name}] over \u03bc`;
  const drawn = [sliding.key, units.length, color("ink")].join(" ");
  slidingPlot.show(mus, [inUnits(peak, "length"), inUnits(residual, "length")], { key: drawn });
  slidingPlot.marks([{ axis: "x", value: settings.mu }]);
}

/** Of the motion as it was recorded. @type {{key: string, row: Row, values: Float64Array} | null} */
let spectrum = null;

export const updateResponseSpectrum = latest(async () => {
  const row = state.selected;
  if (!row?.motion || state.broken) return;
  const [{ id }, damping] = [row.motion, zeta()];
  const key = `${id} ${damping}`;
  if (spectrum?.key !== key) {
    await untilIdle();
    const values = await worker.responseSpectrum(id, PERIODS, damping).catch(() => null);
    if (row !== state.selected || !values) return;
    spectrum = { key, row, values };
  }
  // It does not depend on the slider, so that a moving one does not draw it.
  const drawn = [key, settings.scale, units.acceleration, color("ink")].join(" ");
  if (element("figure-response").dataset.drawn !== drawn) showResponseSpectrum();
  element("figure-response").dataset.drawn = drawn;
});

/** @returns {Float64Array}  of the scaled motion [m/s^2] */
const spectralAccelerations = () => (spectrum?.values ?? new Float64Array()).map((value) => value * Math.abs(settings.scale));

function showResponseSpectrum() {
  if (!spectrum) return;
  const { row } = spectrum;
  element("title-response").textContent =
    `Response spectrum: pseudo-acceleration [${unit("acceleration").name}] over the period [s], damping ratio ${zeta()}`;
  const values = spectralAccelerations();
  element("figure-response").dataset.si = JSON.stringify([...values]);
  responsePlot.show(PERIODS, [inUnits(values, "acceleration")]);
  const source = sourceOf(row, false);
  element("response-command").textContent = spectrumCommand(source, zeta(), settings.scale) ?? NO_COMMAND;
  element("response-python").textContent = spectrumPython(source, zeta(), settings.scale);
}

/** The point of each spectrum whose values are shown. */
const points = { sliding: 0, response: 0 };

/**
 * @param {"sliding" | "response"} which
 * @param {number | null} index
 */
function readSpectrum(which, index) {
  if (index === null) return;
  points[which] = index;
  const at = (/** @type {Float64Array | undefined} */ values) => values?.[index] ?? NaN;
  element(`read-${which}`).textContent =
    which === "sliding"
      ? `\u03bc = ${digits(at(sliding?.mus))}: peak ${shown(at(sliding?.peak), "length")}, ` +
        `residual ${shown(at(sliding?.residual), "length")}`
      : `T = ${digits(at(PERIODS))} s: ${shown(at(spectralAccelerations()), "acceleration")}`;
}

/**
 * @param {keyof typeof points} which
 * @param {number} step
 */
export function moveOnSpectrum(which, step) {
  const xs = { sliding: sliding?.mus, response: PERIODS }[which] ?? new Float64Array();
  const index = Math.min(xs.length - 1, Math.max(0, points[which] + step));
  (which === "sliding" ? slidingPlot : responsePlot).point(xs[index] ?? 0);
  readSpectrum(which, index);
}

export function downloadSliding() {
  if (!sliding || !state.selected) return;
  const { mus, peak, residual } = sliding;
  const lines = Array.from(mus, (mu, i) => [mu, peak[i] ?? NaN, residual[i] ?? NaN]);
  const comment = `stickslip: ${state.selected.label}; ${toLink({ ...completed(settings), mu: NaN })}`;
  download(`${fileName(state.selected)}_sliding_spectrum.csv`, csv(["mu", "peak_m", "residual_m"], lines, [comment]), "text/csv");
}

export function downloadResponse() {
  if (!spectrum) return;
  const values = spectralAccelerations();
  const lines = Array.from(PERIODS, (period, i) => [period, values[i] ?? NaN]);
  const notes = [
    `stickslip: ${spectrum.row.label}; damping ratio ${zeta()}; scale ${settings.scale}`,
    ...comments(groundNumbers(spectrum.row)),
  ];
  const header = ["period_s", "pseudo_acceleration_m_s2"];
  download(`${fileName(spectrum.row)}_response_spectrum.csv`, csv(header, lines, notes), "text/csv");
}
