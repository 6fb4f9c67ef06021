// Histories at a time.

/**
 * Reads histories at a time.
 * @param {Float64Array} times
 * @param {number} time  [s]
 * @returns {(values: Float64Array) => number}
 */
export function interpolated(times, time) {
  const i = indexAt(times, time);
  const [before = 0, after = before] = [times[i], times[i + 1]];
  const part = after > before ? Math.min((time - before) / (after - before), 1) : 0;
  return (values) => {
    const [a = 0, b = a] = [values[i], values[i + 1]];
    return a + part * (b - a);
  };
}

/**
 * The last sample at or before a time.
 * @param {Float64Array} times
 * @param {number} time
 */
export function indexAt(times, time) {
  let [low, high] = [0, times.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((times[middle] ?? 0) <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}
