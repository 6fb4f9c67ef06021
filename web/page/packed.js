// Bytes as text in base 85, which is 6 % shorter than base 64.

/** The characters "%" to "z" without "<", which could end the element of the page that holds the text. */
const ALPHABET = Array.from({ length: 86 }, (_, i) => String.fromCharCode(37 + i))
  .filter((c) => c !== "<")
  .join("");

/**
 * @param {Uint8Array} bytes
 * @returns {string} the number of bytes, a blank, and five characters for each four bytes
 */
export function toText(bytes) {
  const view = new DataView(new ArrayBuffer(Math.ceil(bytes.length / 4) * 4));
  new Uint8Array(view.buffer).set(bytes);
  const words = [];
  for (let at = 0; at < view.byteLength; at += 4) {
    let [value, word] = [view.getUint32(at), ""];
    for (let i = 0; i < 5; ++i, value = Math.floor(value / 85)) word += ALPHABET[value % 85];
    words.push(word);
  }
  return `${bytes.length} ${words.join("")}`;
}

/**
 * @param {string} text  of `toText`
 * @returns {Uint8Array<ArrayBuffer>}
 */
export function fromText(text) {
  const start = text.indexOf(" ") + 1;
  const view = new DataView(new ArrayBuffer(((text.length - start) / 5) * 4));
  const values = new Uint8Array(128);
  for (let i = 0; i < 85; ++i) values[ALPHABET.charCodeAt(i)] = i;
  for (let at = 0, from = start; at < view.byteLength; at += 4, from += 5) {
    let word = 0;
    for (let i = 4; i >= 0; --i) word = 85 * word + (values[text.charCodeAt(from + i)] ?? 0);
    view.setUint32(at, word);
  }
  return new Uint8Array(view.buffer, 0, Number(text.slice(0, start)));
}
