// The path in the plane.

import { latest } from "./client.js";
import { csv, download } from "./csv.js";
import { element } from "./dom.js";
import { interpolated } from "./histories.js";
import { CurvePlot } from "./plots.js";
import { completed, kindOf, pathCommand, pathPython, toLink } from "./settings.js";
import { fileName, NO_COMMAND, settings, sourceOf, state, untilIdle, worker } from "./state.js";
import { certificate, comments, slideNumbers, tableRow } from "./tables.js";
import { inUnits, plain, shown, unit } from "./values.js";

/** @import { Summary } from "./library.js" */
/** @import { Row } from "./state.js" */
/** @import { Line } from "./tables.js" */

export const pathPlot = new CurvePlot(element("plot-path"), ["displacement"], true);

/** @type {{row: Row, summary: Summary, time: Float64Array, axis: Float64Array, transverse: Float64Array} | null} */
let path = null;

const SLOW = 100; // [ms]: a path that takes longer waits until the slider rests
let pathTime = 0; // that the last path took [ms]

export const updatePath = latest(async () => {
  if (pathTime > SLOW) await untilIdle();
  const row = state.selected;
  if (state.broken || kindOf(settings) !== "slider") return;
  const id = row?.joined?.planarId ?? null;
  const full = completed(settings);
  let trouble = row?.joined?.reason ?? "";
  const figure = element("figure-path");
  const change = state.changes;
  const begin = performance.now();
  const found = id === null ? null : await worker.path(id, full).catch((/** @type {Error} */ error) => ((trouble = error.message), null));
  pathTime = performance.now() - begin;
  if (row !== state.selected || state.broken) return;
  figure.hidden = id === null && trouble === "";
  element("path").hidden = found === null;
  path = row && found ? { row, ...found } : null;
  element("title-path").textContent = path
    ? `Path in the plane [${unit("length").name}], seen from above: under both horizontal components, friction along the velocity`
    : `No path in the plane: ${trouble}`;
  if (!path || !row?.motion) return;
  showPath();
  showPointOfPath();
  element("path-numbers").tBodies[0].replaceChildren(...pathNumbers().map((line) => tableRow(line)));
  const source = sourceOf(row, full.vertical === 1, true);
  element("path-command").textContent = pathCommand(full, source) ?? NO_COMMAND;
  const even = !Number.isNaN(row.motion.measures.dt);
  element("path-python").textContent = pathPython(full, source, even, path.summary.at_rest === 1);
  if (change === state.changes) figure.dataset.state = "shown";
});

/** As a map: the axis upward, the transverse direction, clockwise from it, to the right. */
function showPath() {
  if (!path?.row.motion) return;
  const [axis, transverse] = [inUnits(path.axis, "length"), inUnits(path.transverse, "length")];
  const { name } = unit("length");
  const { azimuth, component, orientation } = path.row.motion;
  const right = Number.isNaN(azimuth) ? "" : ` (${(azimuth + 90) % 360}\u00b0)`;
  let far = 0;
  axis.forEach((x, i) => {
    if (Math.hypot(x, transverse[i] ?? 0) > Math.hypot(axis[far] ?? 0, transverse[far] ?? 0)) far = i;
  });
  const { peak, residual } = path.summary;
  const last = axis.length - 1;
  pathPlot.resize();
  pathPlot.map([[transverse, axis]], {
    right: `transverse${right} [${name}]`,
    up: `along ${Number.isNaN(azimuth) ? component : orientation.replace(/^[\d.]+$/, "$&\u00b0")} [${name}]`,
    marks: [
      { name: "start", x: 0, y: 0, label: "start" },
      { name: "peak", x: transverse[far] ?? 0, y: axis[far] ?? 0, label: `peak ${shown(peak, "length")}` },
      { name: "residual", x: transverse[last] ?? 0, y: axis[last] ?? 0, label: `residual ${shown(residual, "length")}` },
    ],
    north: azimuth,
  });
}

/** The point of the path at the present time. */
export function showPointOfPath() {
  if (!path) return;
  const at = interpolated(path.time, state.now);
  const [x, y] = [plain(at(path.axis)), plain(at(path.transverse))];
  const { size } = unit("length");
  pathPlot.point(y / size, x / size);
  element("read-path").textContent =
    `t = ${state.now.toFixed(2)} s: ${shown(x, "length")} along, ${shown(y, "length")} across, ` +
    `${shown(Math.hypot(x, y), "length")} from the start`;
}

/** @returns {Line[]} */
const pathNumbers = () => (path ? [...slideNumbers(path.summary), ...certificate(path.summary)] : []);

export function downloadPath() {
  if (!path) return;
  const { row, time, axis, transverse } = path;
  const lines = Array.from(time, (t, i) => [t, axis[i] ?? NaN, transverse[i] ?? NaN]);
  const notes = [`stickslip: ${row.label}, in the plane; ${toLink(completed(settings))}`, ...comments(pathNumbers())];
  download(`${fileName(row)}_path.csv`, csv(["time_s", "axis_m", "transverse_m"], lines, notes), "text/csv");
}
