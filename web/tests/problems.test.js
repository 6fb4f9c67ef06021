// Random problems in Node against the answers of the native library, which problems.py computed.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { Library } from "../page/library.js";
import { LAWS, NOT_GIVEN } from "../page/settings.js";

const build = new URL("../../build/web/", import.meta.url);
const problems = JSON.parse(readFileSync(new URL("problems.json", build), "utf8"));
const library = await Library.load(readFileSync(new URL("stickslip.wasm", build)));

/** Ten significant digits, of a value or of what it is a difference of. */
const DIGITS = 1e-10;
const KUMAR = LAWS.findIndex((law) => law.name === "kumar");
/** A decision nearer than this hangs on round-off. */
const DECIDED = 1e-9;

/**
 * Whether round-off decides: some decision is nearer than it.
 * @param {any} found
 * @param {any} answer
 */
const undecided = (found, answer) => !(Math.min(found.margin, found.impact_margin, answer.margin ?? Infinity) > DECIDED);

/**
 * The largest difference from the native answer, relative to the sizes of the response.
 * @param {any} found
 * @param {any} answer
 */
const difference = (found, answer) =>
  Math.max(
    ...[
      ["peak", answer.peak],
      ["residual", answer.peak],
      ["sliding_distance", answer.sliding_distance],
      ["input", Math.max(answer.input, answer.sliding_distance)],
    ].map(([name, scale]) => Math.abs(Math.abs(found[name]) - Math.abs(answer[name])) / (scale || 1)),
    ...answer.last.map((/** @type {number} */ native, /** @type {number} */ i) => Math.abs(found.last[i] - native) / (answer.peak || 1)),
  );

/** The same of the times. @param {any} found  @param {any} answer */
const delay = (found, answer) =>
  Math.max(...["end", "time_sliding"].map((name) => Math.abs(found[name] - answer[name]))) / answer.end;

/** @param {any} found  @param {any} answer  @param {string} named */
function agreeInMargin(found, answer, named) {
  const [margin, native] = [Math.min(found.margin, found.impact_margin), answer.margin ?? Infinity];
  assert.ok(margin === native || Math.abs(margin - native) <= 1e-9, `margin of ${named}: ${margin}, natively ${native}`);
}

for (const where of /** @type {const} */ (["axis", "plane"])) {
  const chosen = problems.filter((/** @type {any} */ one) => one[where]);
  test(`${chosen.length} random problems agree with the native library, ${where}`, (context) => {
    let [close, refused, sensitive, worst, latest] = [0, 0, 0, 0, 0];
    for (const problem of chosen) {
      const named = `problem ${problems.indexOf(problem)}, ${where}`;
      const id = library.make(Float64Array.from(problem.acceleration), problem.dt, {
        transverse: Float64Array.from(problem.transverse),
        vertical: Float64Array.from(problem.vertical ?? []),
      });
      const settings = { ...NOT_GIVEN, ...problem.settings };
      const slide = (factor = 1) => {
        const scaled = { ...settings, scale: factor * settings.scale };
        if (where === "plane") {
          const { summary, axis, transverse } = library.path(id, scaled);
          return { ...summary, last: [axis.at(-1), transverse.at(-1)] };
        }
        const summary = library.slide(id, scaled);
        return { ...summary, last: [library.history("displacement").at(-1)] };
      };
      const answer = problem[where];
      if (answer.error !== undefined) {
        refused++;
        assert.throws(slide, { message: answer.error }, named);
        continue;
      }
      const found = slide();
      if (undecided(found, answer)) {
        close++;
        continue;
      }
      for (const name of ["events", "slips", "samples"])
        assert.equal(/** @type {any} */ (found)[name], answer[name], `${name} of ${named}`);
      const [off, late] = [difference(found, answer), delay(found, answer)];
      if (where === "axis") {
        const { peak, residual } = library.spectrum(id, settings, Float64Array.of(settings.mu));
        assert.deepEqual([peak[0], residual[0]], [found.peak, Math.abs(found.residual)]);
        agreeInMargin(found, answer, named);
        // The steps of Kumar's law are as long as an error of 1e-7 allows, and hang on the last bits in that.
        const digits = problem.settings.law === KUMAR ? 1e-8 : DIGITS;
        assert.ok(off <= digits && late <= digits, `${named} differs by ${off}, its times by ${late}`);
        if (problem.settings.law !== KUMAR) [worst, latest] = [Math.max(worst, off), Math.max(latest, late)];
      } else if (off <= DIGITS) {
        agreeInMargin(found, answer, named);
        [worst, latest] = [Math.max(worst, off), Math.max(latest, late)];
      } else {
        // A slider that nearly stops turns fast: such a path magnifies a change of the ground by an ulp or two.
        const change = Math.max(...[1 + 2 ** -50, 1 - 2 ** -50].map((factor) => difference(slide(factor), { ...answer, ...found })));
        assert.ok(off <= 10 * change, `${named} differs by ${off}, and by ${change} where the ground changes by an ulp or two`);
        sensitive++;
      }
      library.discard(id);
    }
    // An arrest in the plane is where a speed vanishes quickly, which its time shows less exactly than its place.
    assert.ok(latest <= (where === "axis" ? DIGITS : 1e-8), `times differ by ${latest} of the duration`);
    context.diagnostic(
      `largest relative difference ${worst.toExponential(1)}, of times ${latest.toExponential(1)}; ${close} undecided to ` +
        `round-off, ${sensitive} sensitive to it, ${refused} refused alike`,
    );
    // More than a hundredth of the problems would be another kind of problem.
    assert.ok(close <= chosen.length / 100 && sensitive <= chosen.length / 100);
  });
}
