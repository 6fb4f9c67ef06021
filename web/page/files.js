// Files as they are dropped: alone, in gzip files, and in zip and tar archives.

/**
 * @typedef {Object} PlainFile
 * @property {string} name  `archive.zip::member` in an archive
 * @property {Uint8Array} bytes
 */

const LARGEST = 64 << 20; // bytes of a record: 500,000 samples of three components take 20 MB
const DEEPEST = 4; // archives within archives
const BLOCK = 512; // of a tar archive

/**
 * @param {Uint8Array} bytes
 * @param {"gzip" | "deflate-raw"} format
 * @param {string} name
 * @returns {Promise<Uint8Array>}
 */
async function inflated(bytes, format, name) {
  const stream = new Blob([/** @type {any} */ (bytes)]).stream().pipeThrough(new DecompressionStream(format));
  const chunks = [];
  let size = 0;
  try {
    for await (const chunk of /** @type {any} */ (readAll(stream))) {
      size += chunk.length;
      if (size > LARGEST) throw new RangeError(`unpacks to more than ${LARGEST >> 20} MiB`);
      chunks.push(chunk);
    }
  } catch (error) {
    const reason = error instanceof RangeError ? error.message : `damaged ${format === "gzip" ? "gzip file" : "archive"}`;
    throw new Error(`read_record: ${name}: ${reason}`);
  }
  const whole = new Uint8Array(size);
  let at = 0;
  for (const chunk of chunks) {
    whole.set(chunk, at);
    at += chunk.length;
  }
  return whole;
}

/** @param {ReadableStream<Uint8Array>} stream  which not every browser iterates over */
async function* readAll(stream) {
  const reader = stream.getReader();
  for (let next = await reader.read(); !next.done; next = await reader.read()) yield next.value;
}

/**
 * @typedef {Object} Member
 * @property {string} name
 * @property {number} method  0 stored, 8 deflated
 * @property {Uint8Array} packed
 */

/**
 * The files in a zip archive, from its central directory (PKWARE's APPNOTE, 4.3).
 * @param {Uint8Array} bytes
 * @param {string} name
 * @returns {Member[]}
 */
function membersOfZip(bytes, name) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const damaged = new Error(`read_record: ${name}: damaged zip archive`);
  try {
    let end = bytes.length - 22;
    while (end >= 0 && view.getUint32(end, true) !== 0x06054b50) --end;
    if (end < 0) throw damaged;
    const members = [];
    let at = view.getUint32(end + 16, true);
    for (let left = view.getUint16(end + 10, true); left > 0; --left) {
      if (view.getUint32(at, true) !== 0x02014b50) throw damaged;
      const [flags, method] = [view.getUint16(at + 8, true), view.getUint16(at + 10, true)];
      const size = view.getUint32(at + 20, true);
      const [nameSize, extra, comment] = [28, 30, 32].map((offset) => view.getUint16(at + offset, true));
      const local = view.getUint32(at + 42, true);
      const called = new TextDecoder().decode(bytes.subarray(at + 46, at + 46 + (nameSize ?? 0)));
      at += 46 + (nameSize ?? 0) + (extra ?? 0) + (comment ?? 0);
      if (called.endsWith("/") || called.startsWith("__MACOSX/") || /(^|\/)\._/.test(called)) continue;
      if (flags & 1) throw new Error(`read_record: ${name}::${called}: the archive is encrypted`);
      const start = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
      if (start + size > bytes.length) throw damaged;
      members.push({ name: called, method, packed: bytes.subarray(start, start + size) });
    }
    return members;
  } catch (error) {
    throw error instanceof RangeError ? damaged : error;
  }
}

/**
 * The files in a tar archive (POSIX.1-2001, pax and ustar; long names of GNU).
 * @param {Uint8Array} bytes
 * @param {string} name
 * @returns {Member[]}
 */
function membersOfTar(bytes, name) {
  const text = (/** @type {number} */ from, /** @type {number} */ size) =>
    new TextDecoder().decode(bytes.subarray(from, from + size)).replace(/\0.*$/s, "");
  const members = [];
  let longer = ""; // the name of the next member, where its own field is too short
  for (let at = 0; at + BLOCK <= bytes.length && bytes[at] !== 0; ) {
    const size = Number(`0o${text(at + 124, 12).trim() || "0"}`);
    const [start, kind] = [at + BLOCK, text(at + 156, 1)];
    if (!(size >= 0) || start + size > bytes.length) throw new Error(`read_record: ${name}: damaged tar archive`);
    const prefix = isTar(bytes.subarray(at)) && bytes[at + 263] === 0x30 ? text(at + 345, 155) : "";
    const called = longer || (prefix && `${prefix}/`) + text(at, 100);
    longer = "";
    if (kind === "L") longer = text(start, size);
    else if (kind === "x") longer = /^\d+ path=(.*)$/m.exec(text(start, size))?.[1] ?? "";
    else if ((kind === "" || kind === "0") && !/(^|\/)\._/.test(called))
      members.push({ name: called, method: 0, packed: bytes.subarray(start, start + size) });
    at = start + Math.ceil(size / BLOCK) * BLOCK;
  }
  return members;
}

/** @param {Uint8Array} bytes */
const isZip = (bytes) => bytes[0] === 0x50 && bytes[1] === 0x4b && (bytes[2] === 3 || bytes[2] === 5);

/** @param {Uint8Array} bytes */
const isTar = (bytes) => new TextDecoder().decode(bytes.subarray(257, 262)) === "ustar";

/**
 * The files that a dropped one stands for: itself, or those in it.
 * @param {string} name
 * @param {Uint8Array} bytes
 * @param {number} [depth]
 * @returns {AsyncGenerator<PlainFile | {name: string, error: string}>}
 */
export async function* unpacked(name, bytes, depth = 0) {
  try {
    if (depth > DEEPEST) throw new Error(`read_record: ${name}: archives within archives, more than ${DEEPEST} deep`);
    if (bytes[0] === 0x1f && bytes[1] === 0x8b) {
      yield* unpacked(name, await inflated(bytes, "gzip", name), depth + 1);
    } else if (isZip(bytes) || isTar(bytes)) {
      for (const { name: member, method, packed } of (isZip(bytes) ? membersOfZip : membersOfTar)(bytes, name)) {
        const inside = `${name}::${member}`;
        try {
          if (method !== 0 && method !== 8)
            throw new Error(`read_record: ${inside}: unknown compression method ${method}`);
          const content = method === 0 ? packed : await inflated(packed, "deflate-raw", inside);
          yield* unpacked(inside, content, depth + 1);
        } catch (error) {
          yield { name: inside, error: /** @type {Error} */ (error).message };
        }
      }
    } else {
      yield { name, bytes };
    }
  } catch (error) {
    yield { name, error: /** @type {Error} */ (error).message };
  }
}
