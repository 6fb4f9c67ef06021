// Histories as a picture for print.

/**
 * A panel of a picture.
 * @typedef {Object} Panel
 * @property {string} title
 * @property {{values: Float64Array, stroke: string, dash?: string}[]} lines
 * @property {{value: number, stroke: string, label: string}[]} levels
 */

const [WIDTH, HEIGHT, LEFT, TITLE, FOOT] = [720, 150, 60, 24, 30];

/** @param {string} text */
const escaped = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
/** @param {number} value */
const short = (value) => String(Number(value.toFixed(2)));

/**
 * 1, 2 or 5 times a power of ten, of which about `count` fit in a length.
 * @param {number} length
 * @param {number} count
 */
function stepOf(length, count) {
  const power = 10 ** Math.floor(Math.log10(length / count));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => length / step <= count) ?? power;
}

/**
 * The extremes of each column of pixels, in their order: what one sees of a line.
 * @param {Float64Array} time
 * @param {Float64Array} values
 * @param {(t: number) => number} x
 * @param {(value: number) => number} y
 */
function pathOf(time, values, x, y) {
  /** @type {[number, number][]} */
  const points = [];
  for (let i = 0; i < values.length; ) {
    const column = Math.floor(2 * x(time[i] ?? 0));
    let [low, high] = [i, i];
    let last = i;
    for (; i < values.length && Math.floor(2 * x(time[i] ?? 0)) === column; last = i++) {
      if ((values[i] ?? 0) < (values[low] ?? 0)) low = i;
      if ((values[i] ?? 0) > (values[high] ?? 0)) high = i;
    }
    for (const k of new Set([low, high, last].sort((a, b) => a - b))) points.push([x(time[k] ?? 0), y(values[k] ?? 0)]);
  }
  return `M${points.map(([px, py]) => `${short(px)},${short(py)}`).join("L")}`;
}

/**
 * @param {string} title
 * @param {Float64Array} time  [s]
 * @param {Panel[]} panels
 */
export function svg(title, time, panels) {
  const [begin, end] = [time[0] ?? 0, time.at(-1) ?? 1];
  const x = (/** @type {number} */ t) => LEFT + ((t - begin) / (end - begin)) * (WIDTH - LEFT - 10);
  const height = panels.length * (HEIGHT + TITLE) + FOOT;
  const parts = [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${height}" width="${WIDTH}" height="${height}" font-family="sans-serif" font-size="11">`,
    `<title>${escaped(title)}</title><rect width="100%" height="100%" fill="#fff"/>`,
  ];
  panels.forEach(({ title: heading, lines, levels }, place) => {
    const top = place * (HEIGHT + TITLE) + TITLE;
    let [low, high] = [0, 0];
    for (const value of [...lines.flatMap(({ values }) => [...values]), ...levels.map((one) => one.value)]) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
    if (low === high) high = low + 1;
    const y = (/** @type {number} */ value) => top + 4 + ((high - value) / (high - low)) * (HEIGHT - 12);
    parts.push(`<text x="${LEFT}" y="${top - 6}" font-weight="bold">${escaped(heading)}</text>`);
    const step = stepOf(high - low, 5);
    for (let mark = Math.ceil(low / step) * step; mark <= high + step / 1e6; mark += step)
      parts.push(
        `<path d="M${LEFT},${short(y(mark))}H${WIDTH - 10}" stroke="#e6e6e6"/>` +
          `<text x="${LEFT - 6}" y="${short(y(mark) + 4)}" text-anchor="end">${Number(mark.toPrecision(6))}</text>`,
      );
    for (const { value, stroke, label } of levels)
      parts.push(
        `<path d="M${LEFT},${short(y(value))}H${WIDTH - 10}" stroke="${stroke}" stroke-dasharray="5 4"/>` +
          `<text x="${WIDTH - 14}" y="${short(y(value) - 4)}" text-anchor="end" fill="${stroke}">${escaped(label)}</text>`,
      );
    for (const { values, stroke, dash = "" } of lines)
      parts.push(
        `<path d="${pathOf(time, values, x, y)}" fill="none" stroke="${stroke}" stroke-width="1.1" stroke-dasharray="${dash}"/>`,
      );
  });
  const step = stepOf(end - begin, 10);
  for (let mark = Math.ceil(begin / step) * step; mark <= end; mark += step)
    parts.push(`<text x="${short(x(mark))}" y="${height - 14}" text-anchor="middle">${Number(mark.toPrecision(6))}</text>`);
  parts.push(`<text x="${WIDTH - 10}" y="${height - 2}" text-anchor="end">time [s]</text></svg>`);
  return parts.join("\n");
}
