// Random problems in Node against the answers of the native library, which problems.py computed.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { Library } from "../page/library.js";
import { NOT_GIVEN } from "../page/settings.js";

const build = new URL("../../build/web/", import.meta.url);
const problems = JSON.parse(readFileSync(new URL("problems.json", build), "utf8"));
const library = await Library.load(readFileSync(new URL("stickslip.wasm", build)));

/** Ten significant digits, of a value or of what it is a difference of. */
const DIGITS = 1e-10;
/** A decision nearer than this hangs on round-off. */
const DECIDED = 1e-9;

test(`${problems.length} random problems agree with the native library`, (context) => {
  let undecided = 0;
  let refused = 0;
  let worst = 0;
  problems.forEach((/** @type {any} */ problem, /** @type {number} */ number) => {
    const settings = { ...NOT_GIVEN, ...problem.settings };
    const id = library.make(
      Float64Array.from(problem.acceleration),
      problem.dt,
      problem.vertical ? Float64Array.from(problem.vertical) : undefined,
    );
    if (problem.error !== undefined) {
      refused++;
      assert.throws(() => library.slide(id, settings), { message: problem.error }, `problem ${number}`);
      library.discard(id);
      return;
    }
    const summary = library.slide(id, settings);
    const last = library.history("displacement").at(-1);
    const { peak, residual } = library.spectrum(id, settings, Float64Array.of(settings.mu));
    assert.deepEqual([peak[0], residual[0]], [summary.peak, Math.abs(summary.residual)]);
    library.discard(id);
    const { answer } = problem;
    const nearest = Math.min(summary.margin, summary.impact_margin);
    const margin = answer.margin ?? Infinity;
    if (!(Math.min(margin, nearest) > DECIDED)) {
      undecided++;
      return;
    }
    for (const name of ["events", "slips", "samples"])
      assert.equal(/** @type {any} */ (summary)[name], answer[name], `${name} of problem ${number}`);
    assert.ok(nearest === margin || Math.abs(nearest - margin) <= 1e-9, `margin of problem ${number}: ${nearest}, natively ${margin}`);
    for (const [name, scale] of [
      ["peak", answer.peak],
      ["residual", answer.peak],
      ["last", answer.peak],
      ["sliding_distance", answer.sliding_distance],
      ["time_sliding", answer.end],
      ["end", answer.end],
      ["input", Math.max(answer.input, answer.sliding_distance)],
    ]) {
      const found = name === "last" ? last : /** @type {any} */ (summary)[name];
      const off = Math.abs(found - answer[name]) / (scale || 1);
      worst = Math.max(worst, off);
      assert.ok(off <= DIGITS, `${name} of problem ${number}: ${found}, natively ${answer[name]}`);
    }
  });
  context.diagnostic(
    `largest relative difference ${worst.toExponential(1)}; ${undecided} undecided to round-off, ${refused} refused alike`,
  );
  // More than a hundredth of the problems would be another kind of problem.
  assert.ok(undecided <= problems.length / 100, `${undecided} of ${problems.length} are not decided`);
});
