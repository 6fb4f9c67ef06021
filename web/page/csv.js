// Tables of numbers with full digits.

/**
 * A field of a CSV file; JavaScript prints the shortest decimal that reads back as the same double.
 * @param {string | number} value
 */
const field = (value) => {
  const text = String(value);
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

/**
 * @param {readonly string[]} header
 * @param {Iterable<readonly (string | number)[]>} rows
 * @param {readonly string[]} [comments]  each becomes a line after `#`
 */
export function csv(header, rows, comments = []) {
  const lines = comments.map((line) => `# ${line}`);
  lines.push(header.map(field).join(","));
  for (const row of rows) lines.push(row.map(field).join(","));
  return lines.join("\n") + "\n";
}

/**
 * Offers a text as a file.
 * @param {string} name
 * @param {string} text
 * @param {string} type
 */
export function download(name, text, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
