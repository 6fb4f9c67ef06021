// Statistics of a column.

/**
 * The value that a fraction of all values does not exceed, as `Ensemble.quantile` has it.
 * @param {number[]} values
 * @param {number} probability
 */
export function quantile(values, probability) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.max(Math.ceil(probability * sorted.length) - 1, 0)] ?? NaN;
}

/**
 * @param {number[]} values  NaN is left out
 * @returns {{mean: number, median: number, deviation: number}}  the deviation is that of a sample, with n - 1
 */
export function statistics(values) {
  const sorted = values.filter((value) => !Number.isNaN(value)).sort((a, b) => a - b);
  const n = sorted.length;
  const mean = sorted.reduce((sum, value) => sum + value, 0) / n;
  const [low = NaN, high = NaN] = [sorted[(n - 1) >> 1], sorted[n >> 1]];
  const squares = sorted.reduce((sum, value) => sum + (value - mean) ** 2, 0);
  return { mean, median: (low + high) / 2, deviation: Math.sqrt(squares / (n - 1)) };
}
