// Files in archives.
import assert from "node:assert/strict";
import { test } from "node:test";
import { gzipSync } from "node:zlib";

import { unpacked } from "../page/files.js";

/** @param {string} name  @param {Uint8Array} bytes */
async function all(name, bytes) {
  const found = [];
  for await (const one of unpacked(name, bytes)) found.push("error" in one ? one : { ...one, bytes: new TextDecoder().decode(one.bytes) });
  return found;
}

/** A member of a tar archive. @param {string} name  @param {string} content  @param {string} [kind]  @param {string} [prefix] */
function member(name, content, kind = "0", prefix = "") {
  const bytes = Buffer.alloc(512 + Math.ceil(content.length / 512) * 512);
  bytes.write(name, 0);
  bytes.write(`${content.length.toString(8).padStart(11, "0")}\0`, 124);
  bytes.write(kind, 156);
  bytes.write("ustar\x0000", 257);
  bytes.write(prefix, 345);
  bytes.write(content, 512);
  return bytes;
}

test("tar archives, also packed, with long names and folders", async () => {
  const long = `${"x".repeat(120)}.txt`;
  const record = `path=${long}\n`;
  const pax = `${record.length + 4} ${record}`;
  const archive = Buffer.concat([
    member("folder/", "", "5"),
    member("a.txt", "first", "0", "folder"),
    member("x.txt", pax, "x"),
    member(long.slice(0, 100), "second"),
    member("././@LongLink", `${long}\0`, "L"),
    member(long.slice(0, 100), "third".repeat(200)),
    Buffer.alloc(1024),
  ]);
  for (const [name, bytes] of /** @type {[string, Buffer][]} */ ([
    ["b.tar", archive],
    ["b.tar.gz", gzipSync(archive)],
  ]))
    assert.deepEqual(await all(name, bytes), [
      { name: `${name}::folder/a.txt`, bytes: "first" },
      { name: `${name}::${long}`, bytes: "second" },
      { name: `${name}::${long}`, bytes: "third".repeat(200) },
    ]);
});

test("a damaged tar archive says so", async () => {
  const archive = member("a.txt", "x".repeat(2000));
  assert.deepEqual(await all("b.tar", archive.subarray(0, 1024)), [
    { name: "b.tar", error: "read_record: b.tar: damaged tar archive" },
  ]);
});
