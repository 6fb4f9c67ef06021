// Random problems in Node against the answers of the native library, which problems.py computed.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { Library } from "../page/library.js";
import { LAWS, NOT_GIVEN } from "../page/settings.js";

const build = new URL("../../build/web/", import.meta.url);
const { sliders: problems, blocks, carts } = JSON.parse(readFileSync(new URL("problems.json", build), "utf8"));
const library = await Library.load(readFileSync(new URL("stickslip.wasm", build)));

/** Ten significant digits, of a value or of what it is a difference of. */
const DIGITS = 1e-10;
/** A decision nearer than this hangs on round-off. */
const DECIDED = 1e-9;

/** @param {any} given  with the name of the law */
const settingsOf = (given) => ({ ...NOT_GIVEN, ...given, law: LAWS.findIndex(({ name }) => name === given.law) });

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

test("the page offers each law of the library, by its parts and in their units", () => {
  assert.deepEqual(new Set(LAWS.flatMap(({ law }) => law ?? [])), new Set(Object.keys(library.laws)));
  const quantities = { "m/s^2": "", m: "length", "m/s": "velocity", "m^2/s": "m\u00b2/s", "degrees Celsius": "\u00b0C" };
  for (const { law = "", parts, fields = [] } of LAWS) {
    const of = library.laws[law] ?? [];
    for (const { name } of of) assert.ok(name in (parts?.(NOT_GIVEN) ?? {}), `${law}: ${name}`);
    for (const { key, part = key, unit = "", quantity, valid } of fields) {
      const found = of.find(({ name }) => name === part);
      assert.ok(valid ?? found, `${law}: ${part}`);
      if (found) assert.equal(quantity ?? unit, /** @type {any} */ (quantities)[found.unit] ?? found.unit, `${law}: ${part}`);
    }
  }
});

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
      const settings = settingsOf(problem.settings);
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
        const digits = problem.settings.law === "kumar" ? 1e-8 : DIGITS;
        assert.ok(off <= digits && late <= digits, `${named} differs by ${off}, its times by ${late}`);
        if (problem.settings.law !== "kumar") [worst, latest] = [Math.max(worst, off), Math.max(latest, late)];
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

/** What blocks and carts have in common. @type {[string, any[], (id: number, settings: any) => any, string[], Record<string, (answer: any) => number>][]} */
const OTHERS = [
  [
    "blocks",
    blocks,
    (id, settings) => ({ ...library.rock(id, settings), last: library.blockHistory("rotation").at(-1) }),
    ["overturned", "impacts", "events", "samples"],
    // Rotations over alpha; lengths over the width.
    { peak_rotation: ({ alpha }) => alpha, last: ({ alpha }) => alpha, residual: () => 1, sliding_distance: () => 1, p: ({ p }) => p, alpha: ({ alpha }) => alpha, restitution: () => 1 },
  ],
  [
    "carts",
    carts,
    (id, settings) => library.roll(id, settings),
    ["rests", "events", "samples"],
    Object.fromEntries([
      ...["peak", "peak_outline", "residual_axis", "residual_transverse"].map((name) => [name, (/** @type {any} */ { peak_outline }) => peak_outline || 1]), // it may not move
      ...["peak_yaw", "residual_yaw"].map((name) => [name, (/** @type {any} */ { peak_yaw }) => Math.max(peak_yaw, 0.01)]),
    ]),
  ],
];

for (const [name, chosen, run, counts, sizes] of OTHERS)
  test(`${chosen.length} random ${name} agree with the native library`, (context) => {
    let [sensitive, worst, refused, stopped] = [0, 0, 0, 0];
    for (const [number, { settings: given, dt, acceleration, transverse, vertical, answer }] of chosen.entries()) {
      const named = `problem ${number} of ${name}`;
      const id = library.make(Float64Array.from(acceleration), dt, {
        transverse: Float64Array.from(transverse),
        vertical: Float64Array.from(vertical ?? []),
      });
      const settings = settingsOf(given);
      if (answer.error !== undefined) {
        refused++;
        assert.throws(() => run(id, settings), { message: answer.error }, named);
        continue;
      }
      const off = (/** @type {any} */ found, expected = answer) =>
        counts.some((one) => found[one] !== expected[one])
          ? Infinity
          : Math.max(...Object.entries(sizes).map(([one, size]) => Math.abs(found[one] - expected[one]) / size(answer)));
      let found;
      try {
        found = run(id, settings);
      } catch (error) {
        assert.match(/** @type {Error} */ (error).message, /so often that the page stops/, named); // it would take seconds
        stopped++;
        continue;
      }
      if (off(found) <= DIGITS) {
        worst = Math.max(worst, off(found));
        const margin = answer.margin ?? Infinity;
        assert.ok(found.margin === margin || Math.abs(found.margin - margin) <= 1e-9, `margin of ${named}: ${found.margin}, natively ${margin}`);
      } else {
        // A history that hangs on round-off: it changes as much where the ground changes by a few ulps.
        const ulps = [-1, 1].flatMap((sign) => Array.from({ length: 10 }, (_, i) => sign * (i + 1)));
        const changed = ulps.map((some) => off(run(id, { ...settings, scale: settings.scale * (1 + some * 2 ** -52) }), found));
        assert.ok(Math.max(...changed) >= off(found) / 100, `${named} differs by ${off(found)}, and by ${changed} where the ground changes by ulps`);
        sensitive++;
      }
      library.discard(id);
    }
    context.diagnostic(`largest relative difference ${worst.toExponential(1)}; ${sensitive} sensitive to round-off, ${refused} refused alike, ${stopped} too long for the page`);
    assert.ok(sensitive <= chosen.length / 20 && stopped <= chosen.length / 20);
  });
