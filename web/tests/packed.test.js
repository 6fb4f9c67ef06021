// Bytes as text, and statistics.
import assert from "node:assert/strict";
import { test } from "node:test";

import { fromText, toText } from "../page/packed.js";
import { statistics } from "../page/statistics.js";

test("bytes read back from text of any length", () => {
  for (let length = 0; length < 300; ++length) {
    const bytes = Uint8Array.from({ length }, (_, i) => (i * 197 + length * 31) % 256);
    const text = toText(bytes);
    assert.deepEqual(fromText(text), bytes);
    assert.ok(!text.includes("<"));
  }
  assert.deepEqual(fromText(toText(new Uint8Array(8).fill(255))), new Uint8Array(8).fill(255));
});

test("statistics of a column", () => {
  assert.deepEqual(statistics([3, 1, NaN, 2]), { mean: 2, median: 2, deviation: 1 });
  assert.deepEqual(statistics([1, 4]), { mean: 2.5, median: 2.5, deviation: Math.sqrt(4.5) });
});
