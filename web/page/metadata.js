// A table with a row for each record, which answers for files that leave their units or time step open: the rule of
// `Suite.read` (python/stickslip/motions/metadata.py).

/** @typedef {{units?: string, dt?: number, orientation?: string}} Stated  what a row states */

const KEYS = ["file", "record", "name"]; // columns that identify the record of a row
const STATED = ["units", "dt", "dt_s", "orientation"];

/**
 * The cells of a line of a CSV file.
 * @param {string} line
 */
function cellsOf(line) {
  const cells = [];
  for (const [, quoted, plain = ""] of `${line},`.matchAll(/\s*(?:"((?:[^"]|"")*)"\s*|([^,]*)),/g))
    cells.push(quoted === undefined ? plain.trim() : quoted.replaceAll('""', '"'));
  return cells;
}

/**
 * The rows of a table by the names of their records; null if the text is no such table.
 * @param {string} text
 * @returns {Map<string, Stated> | null}
 */
export function metadataOf(text) {
  const [head = "", ...lines] = text.replace(/^\uFEFF/, "").split(/\r?\n/).filter((line) => line.trim() !== "");
  const names = cellsOf(head).map((name) => name.toLowerCase());
  const key = KEYS.find((one) => names.includes(one));
  if (key === undefined || !STATED.some((one) => names.includes(one))) return null;
  /** @type {Map<string, Stated>} */
  const rows = new Map();
  for (const line of lines) {
    const cells = cellsOf(line);
    const cell = (/** @type {string} */ name) => cells[names.indexOf(name)] ?? "";
    const dt = Number(cell("dt") || cell("dt_s"));
    rows.set(cell(key), {
      ...(cell("units") ? { units: cell("units") } : {}),
      ...(dt > 0 && Number.isFinite(dt) ? { dt } : {}),
      ...(cell("orientation") ? { orientation: cell("orientation") } : {}),
    });
  }
  return rows;
}

/**
 * What a table states of a file, by its path, name or stem.
 * @param {Map<string, Stated>} rows
 * @param {string} file
 * @returns {Stated}
 */
export function statedOf(rows, file) {
  const path = file.slice(file.lastIndexOf("::") + 1).replace(/^:/, "");
  const name = path.slice(path.lastIndexOf("/") + 1);
  return rows.get(path) ?? rows.get(name) ?? rows.get(name.replace(/(?<=.)\.[^.]*$/, "")) ?? {};
}
