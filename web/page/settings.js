// What the page lets its reader choose: laws and mountings by the names of the command's options, the link that holds
// them, and the command and the Python lines that give the same numbers.

/** @import { Part, Range, Settings } from "./library.js" */
/** @import { Source } from "./sources.js" */
/** @import { Quantity } from "./units.js" */

/**
 * @typedef {Object} Field
 * @property {string} key
 * @property {string} [part]          of the law, where it has another name
 * @property {string} label
 * @property {string} [unit]          where it is always the same
 * @property {Quantity} [quantity]    whose chosen unit it has
 * @property {readonly [number, number]} [valid]  least and largest value; any between is allowed; if not given, what the law allows
 * @property {boolean} [open]         the least value itself is not allowed
 * @property {string} [range]         the library's name of the range outside of which another unit is more probable
 * @property {number | readonly number[]} [value]  where the law needs it and the link has none; a list, maybe empty, of a list
 * @property {readonly string[]} [laws]  that have it; all if not given
 * @property {readonly string[]} [choices]  whose number it is
 * @property {readonly number[]} [counts]  of numbers of a list, if it must have one of them
 * @property {string[]} [needs]  the settings without any of which it has no meaning
 * @property {string} hint
 */

const FRICTION = /** @type {const} */ ({ valid: [0, Infinity], range: "coefficient of friction" });
/** @type {Field} */
const MU_STATIC = { key: "mu_static", label: "\u03bc static", ...FRICTION, hint: "at rest, at least \u03bc" };

/** Whether its mounting keeps it from sliding backward; else an infinite level does, as the command has it. @param {Settings} s */
export const isOneWay = (s) => LAWS[s.law]?.name === "one-way" && !(Number.isNaN(s.slope) && Number.isNaN(s.mu_static));

/**
 * What moves, in the order of the numbers: a slider, a block, or a cart; and the coefficient of friction with which it begins. Of
 * a slider all that the page knows of its friction law: the name and the parts that the library gives it, with levels as coefficients
 * of friction, the law in Python, the numbers beside mu, and whether the command has it.
 * @typedef {"slider" | "block" | "cart"} Kind
 * @typedef {Record<string, number | readonly number[]>} Parts
 * @type {readonly {name: string, label: string, kind?: Kind, mu?: number, law?: string, parts?: (s: Settings) => Parts, python?: (s: Settings) => string, fields?: Field[], command?: boolean}[]}
 */
export const LAWS = Object.freeze([
  { name: "coulomb", label: "Coulomb", law: "Coulomb", command: true, fields: [MU_STATIC],
    parts: ({ mu }) => ({ slip_level: mu, backward: mu }),
    python: ({ mu }) => `Coulomb(mu=${mu})` },
  { name: "caster", label: "casters", law: "Caster", command: true, fields: [
      { key: "reach", label: "reach", quantity: "length", range: "length", value: 0.05, hint: "distance over which the level falls" },
      MU_STATIC ],
    parts: ({ mu, reach }) => ({ slip_level: mu, reach, rolling: 0 }),
    python: ({ mu, reach }) => `Caster(mu=${mu}, reach=${reach})` },
  { name: "one-way", label: "one-way (Newmark)", law: "Coulomb", command: true, fields: [MU_STATIC],
    parts: (s) => ({ slip_level: s.mu, backward: isOneWay(s) ? s.mu : Infinity }),
    python: (s) => `Coulomb(mu=${s.mu}${isOneWay(s) ? "" : ', backward=float("inf")'})` },
  { name: "speed", label: "speed-dependent", law: "VelocityDependent", fields: [
      { key: "mu_fast", part: "fast", label: "\u03bc fast", range: "coefficient of friction", value: 0.15, hint: "at high speed; \u03bc is that at rest" },
      { key: "rate", label: "rate", unit: "s/m", range: "rate", value: 20, hint: "of the change with the speed" },
      MU_STATIC ],
    parts: ({ mu, mu_fast, rate }) => ({ slow: mu, fast: mu_fast, rate }),
    python: ({ mu, mu_fast, rate }) => `VelocityDependent(mu_slow=${mu}, mu_fast=${mu_fast}, rate=${rate})` },
  { name: "degrading", label: "degrading", law: "Degrading", fields: [
      { key: "mu_residual", part: "levels", label: "\u03bc residual", range: "coefficient of friction", value: 0.05, hint: "after the distance" },
      { key: "distance", label: "distance", quantity: "length", valid: [0, Infinity], open: true, range: "distance slid", value: 0.1, hint: "slid until \u03bc is residual" },
      MU_STATIC ],
    parts: ({ mu, mu_residual, distance }) => ({ distances: [0, distance], levels: [mu, mu_residual], backward: [mu, mu_residual] }),
    python: ({ mu, mu_residual, distance }) => `Degrading(distance=[0, ${distance}], mu=[${mu}, ${mu_residual}])` },
  { name: "stribeck", label: "Stribeck", law: "Stribeck", fields: [
      { key: "mu_static", part: "static", label: "\u03bc static", range: "coefficient of friction", value: 0.15, hint: "at rest, at least \u03bc, which is that at high speed" },
      { key: "stribeck_speed", part: "velocity", label: "speed", quantity: "velocity", range: "sliding velocity", value: 0.05, hint: "at which 63 % of the difference is gone" },
      { key: "exponent", label: "exponent", value: 1, hint: "a whole number from 1 to 31" } ],
    parts: ({ mu, mu_static, stribeck_speed, exponent }) => ({ static: mu_static, kinetic: mu, velocity: stribeck_speed, exponent }),
    python: (s) => `Stribeck(mu_static=${s.mu_static}, mu_kinetic=${s.mu}, velocity=${s.stribeck_speed}, exponent=${s.exponent})` },
  { name: "pendulum", label: "multi-surface pendulum", law: "MultiPendulum", command: true, fields: [
      { key: "radii", label: "radii", quantity: "length", range: "radius", counts: [2, 3, 5], value: [0.3937, 3.7465, 3.7465], hint: "effective; lower and upper, or inner, lower and upper outer, or inner, two middle, two outer" },
      { key: "mus", part: "mu", label: "\u03bc of each", range: "coefficient of friction", value: [0.01, 0.04, 0.08], hint: "of the surfaces; the slider is the largest and scales all" },
      { key: "capacities", label: "capacities", quantity: "length", range: "length", value: [], hint: "travel of each surface to its stop; empty for none" } ],
    parts: ({ radii, mus, capacities, restitution }) =>
      ({ radii, mu: mus, capacities: capacities.length ? capacities : radii.map(() => Infinity), restitution: restitution || 0, nested: radii.length > 2 ? 1 : 0 }),
    python({ radii, mus, capacities, restitution }) {
      const name = /** @type {Record<number, string>} */ ({ 2: "Double", 3: "Triple", 5: "Quintuple" })[radii.length] ?? "Multi";
      const stops = capacities.length ? `, capacities=[${capacities.join(", ")}], restitution=${restitution}` : "";
      return `${name}Pendulum(radii=[${radii.join(", ")}], mu=[${mus.join(", ")}]${stops})`;
    } },
  { name: "kumar", label: "pressure, speed, temperature (Kumar)", law: "KumarFriction", fields: [
      { key: "static_pressure", label: "pressure", unit: "Pa", range: "pressure", value: 50e6, hint: "on the sliding surface under the weight alone" },
      { key: "reference_pressure", label: "reference p", unit: "Pa", range: "pressure", value: 50e6, hint: "pressure at which \u03bc holds, at high speed and 20 \u00b0C" },
      { key: "contact_radius", label: "contact radius", quantity: "length", range: "length", value: 0.2, hint: "of the slider, which heats the middle of the surface while it covers it" },
      { key: "temperature", label: "temperature", unit: "\u00b0C", range: "temperature", value: 20, hint: "of the surface at the start" },
      { key: "rate", label: "rate", unit: "s/m", range: "rate", value: 100, hint: "of the change with the speed; \u03bc at rest is half that at high speed" },
      { key: "diffusivity", label: "diffusivity", unit: "m\u00b2/s", range: "diffusivity", value: 4.44e-6, hint: "thermal, of the steel" },
      { key: "conductivity", label: "conductivity", unit: "W/(m K)", range: "conductivity", value: 18, hint: "thermal, of the steel" } ],
    parts: ({ mu, ...others }) => ({ mu_ref: mu, ...others }),
    python: (s) => `KumarFriction(mu_ref=${s.mu}, ${LAWS[s.law]?.fields?.map(({ key }) => `${key}=${s[key]}`).join(", ")})` },
  { name: "slender-block", label: "slender block", kind: "block" },
  { name: "rigid-block", label: "rigid block", kind: "block", mu: 0.5 },
  { name: "cart", label: "cart on four casters", kind: "cart", mu: 0.5 },
]);

/** The settings of all laws that are lists, or numbers, none given. @param {boolean} lists */
const settingsOfLaws = (lists) =>
  Object.fromEntries(LAWS.flatMap(({ fields = [] }) => fields.flatMap(({ key, value }) => (value instanceof Array === lists ? [[key, lists ? Object.freeze([]) : NaN]] : []))));

/** Settings in which nothing is given, in the order of a link. @type {Settings} */
export const NOT_GIVEN = Object.freeze({
  law: 0,
  mu: NaN,
  ...settingsOfLaws(false),
  period: NaN,
  damping_ratio: NaN,
  pendulum: 0,
  slope: NaN,
  stop_gap: NaN,
  restitution: NaN,
  vertical: 0,
  clipped: 0,
  scale: 1,
  width: NaN,
  height: NaN,
  wheels: 0,
  headings: Object.freeze([]),
  base_length: NaN,
  base_width: NaN,
  body_length: NaN,
  body_width: NaN,
  gyration: NaN,
  trail: NaN,
  wheel_width: NaN,
  rolling_mu: NaN,
  ...settingsOfLaws(true),
});

/** @param {Settings} settings  @returns {Kind} */
export const kindOf = ({ law }) => LAWS[law]?.kind ?? "slider";

/** Whether there is a coefficient of friction: a slender block does not slip. @param {Settings} settings */
export const hasMu = ({ law }) => LAWS[law]?.name !== "slender-block";

/** The casters of a cart, in the order of their numbers. */
const WHEELS = ["four casters", "one locked", "two locked", "all locked", "two fixed wheels behind"];

/** @param {Kind} kind */
const lawsOf = (kind) => LAWS.filter((one) => (one.kind ?? "slider") === kind).map(({ name }) => name);
const [SLIDERS, BLOCKS, CARTS] = [lawsOf("slider"), lawsOf("block"), lawsOf("cart")];
const SINGLE = SLIDERS.filter((name) => name !== "pendulum");

const CART_LENGTH = /** @type {const} */ ({ quantity: "length", valid: [0, Infinity], open: true, range: "length of a cart", laws: CARTS });
const LENGTH = /** @type {const} */ ({ quantity: "length", valid: [0, Infinity], open: true, range: "length" });
/** What is above 0. @param {string} range */
const positive = (range) => /** @type {const} */ ({ valid: [0, Infinity], open: true, range });

/** The coefficient that the slider moves. @type {Field} */
export const MU = { key: "mu", label: "\u03bc", ...FRICTION, hint: "" };

/** The numbers beside mu, in the order of the form. @type {readonly Field[]} */
export const FIELDS = Object.freeze([
  ...LAWS.flatMap(({ name, fields = [] }) => fields.map((field) => ({ ...field, laws: [name] }))),
  { key: "period", label: "period", unit: "s", ...positive("period"), laws: SLIDERS, hint: "of the mass on its spring; empty without a spring" },
  { key: "damping_ratio", label: "damping ratio", valid: [0, Infinity], range: "damping ratio", laws: SLIDERS, needs: ["period"], hint: "of a damper beside the spring" },
  { key: "slope", label: "slope", unit: "degrees", valid: [-90, 90], range: "slope", laws: SINGLE, hint: "of the ground; downhill is forward" },
  { key: "stop_gap", label: "stop gap", ...LENGTH, laws: SLIDERS, hint: "from the start to a stop, both ways" },
  { key: "restitution", label: "restitution", valid: [0, 1], value: 0.5, laws: SLIDERS, needs: ["stop_gap", "capacities"], hint: "speed after an impact over that before" },
  { key: "width", label: "width", quantity: "length", ...positive(""), value: 0.6, laws: BLOCKS, hint: "of a uniform block" },
  { key: "height", label: "height", quantity: "length", ...positive(""), value: 2, laws: BLOCKS, hint: "of a uniform block" },
  { key: "restitution", label: "restitution", valid: [0, 1], laws: BLOCKS, hint: "rate of the rotation after an impact over that before; empty for that of Housner" },
  { key: "wheels", label: "wheels", valid: [0, 4], choices: WHEELS, laws: CARTS, hint: "a locked caster neither rolls nor swivels: the front right one, then the front left one, or all" },
  { key: "headings", label: "headings", unit: "\u00b0", valid: [-360, 360], counts: [4], value: [20, 110, -50, 160], laws: CARTS, hint: "of the casters at the start, front right, front left, rear right, rear left: from the wheel to the pivot, clockwise from the axis of the cart" },
  { key: "base_length", label: "wheel base", ...CART_LENGTH, value: 0.6, hint: "between the casters, along the cart" },
  { key: "base_width", label: "track", ...CART_LENGTH, value: 0.4, hint: "between the casters, across the cart" },
  { key: "body_length", label: "length", ...CART_LENGTH, value: 0.8, hint: "of the outline of the cart" },
  { key: "body_width", label: "width", ...CART_LENGTH, value: 0.6, hint: "of the outline of the cart" },
  { key: "gyration", label: "gyration radius", ...CART_LENGTH, value: 0.25, hint: "about the center of mass, in the middle" },
  { key: "trail", label: "trail", ...LENGTH, value: 0.03, laws: CARTS, hint: "of a caster, from its pivot to the axis of its wheel" },
  { key: "wheel_width", label: "wheel width", ...LENGTH, value: 0.02, laws: CARTS, hint: "of the line on which a wheel stands" },
  { key: "rolling_mu", label: "rolling \u03bc", ...FRICTION, range: "", value: 0.01, laws: CARTS, hint: "rolling resistance over the load" },
  { key: "scale", label: "scale", valid: [-Infinity, Infinity], value: 1, hint: "factor on the ground acceleration" },
]);

/**
 * What is wrong with a value, or hard to believe.
 * @param {Field} field
 * @param {Settings} settings
 * @param {(value: number) => string} shown  with its unit
 * @param {{ranges: Record<string, Range>, laws: Record<string, Part[]>}} library  what it says of them, once it is there
 * @returns {{text: string, refused: boolean} | null}
 */
export function remark({ key, part = key, label, valid, open = false, range = "", counts }, settings, shown, { ranges, laws }) {
  const value = settings[key];
  if (counts && value instanceof Array && !counts.includes(value.length))
    return { text: `${label} must be ${counts.join(", ").replace(/, (\d+)$/, " or $1")} numbers, got ${value.length}`, refused: true };
  const limits = { low: -Infinity, high: Infinity, open, whole: false };
  if (valid) [limits.low, limits.high] = valid;
  else Object.assign(limits, laws[LAWS[settings.law]?.law ?? ""]?.find(({ name }) => name === part));
  if (key === "mu_static") limits.low = Math.max(limits.low, settings.mu); // at rest friction is at least that in motion
  const { low, high, whole } = limits;
  for (const one of typeof value === "number" ? [value] : value) {
    if (Number.isNaN(one) && key !== "mu") continue; // not given
    if (!(one >= low && one <= high && Number.isFinite(one) && (!whole || Number.isInteger(one))) || (limits.open && one === low)) {
      const allowed = high < Infinity ? `between ${shown(low)} and ${shown(high)}` : low > -Infinity ? `${limits.open ? "above" : "at least"} ${shown(low)}` : "a number";
      const got = Number.isNaN(one) ? "" : `, got ${shown(one)}`;
      return { text: `${label} must be ${whole ? "a whole number " : ""}${allowed}${got}`, refused: true };
    }
    const { bounds: [small, large] = [0, Infinity], usual: [from, to] = [0, 0], meant = 0, where = "" } = ranges[range] ?? {};
    if (one > 0 && one < meant && (one < small || one >= large))
      return { text: `${shown(one)} is outside ${shown(from)} to ${shown(to)}, the range of ${where}: is its unit right?`, refused: false };
  }
  return null;
}

/**
 * Whether a setting has a value.
 * @param {Settings} settings
 * @param {keyof Settings} key
 */
export const given = (settings, key) => {
  const value = settings[key];
  return typeof value === "number" ? !Number.isNaN(value) : value.length > 0;
};

/**
 * Whether a field has a meaning with these settings.
 * @param {Field} field
 * @param {Settings} settings
 */
export function applies(field, settings) {
  const law = LAWS[settings.law]?.name ?? "";
  return (field.laws?.includes(law) ?? true) && (field.needs?.some((key) => given(settings, key)) ?? true);
}

/**
 * Coefficients in given ratios whose largest is mu; products of twelve digits.
 * @param {readonly number[]} mus
 * @param {number} mu
 */
function scaled(mus, mu) {
  const most = Math.max(...mus);
  return mus.map((one) => (one === most ? mu : Number(((one * mu) / most).toPrecision(12))));
}

/**
 * The settings without numbers that have no meaning, and with values for those that the law needs.
 * @param {Settings} settings
 * @returns {Settings}
 */
export function completed(settings) {
  /** @type {any} */
  const result = { ...settings };
  for (const field of FIELDS) {
    const { key, value } = field;
    if (!FIELDS.some((one) => one.key === key && applies(one, result))) result[key] = NOT_GIVEN[key] instanceof Array ? [] : NaN;
    else if (applies(field, result) && !given(result, key) && value !== undefined) result[key] = value;
  }
  result.mus = scaled(result.mus, result.mu);
  if (!hasMu(result)) result.mu = NaN;
  if (Number.isNaN(result.period) || LAWS[result.law]?.name === "pendulum") result.pendulum = 0;
  return result;
}

/**
 * The numbers that a reader enters.
 * @param {string} text
 * @returns {number[]}  NaN where it is not a number
 */
export const listed = (text) => text.split(/[\s,;]+/).filter((word) => word !== "").map(Number);

/**
 * As the part of a link after `#`.
 * @param {Settings} settings
 * @param {Record<string, string>} [others]
 */
export function toLink(settings, others = {}) {
  const words = new URLSearchParams();
  for (const [key, value] of Object.entries(settings)) {
    if (key === "law") words.set(key, LAWS[settings.law]?.name ?? "");
    else if (value instanceof Array) value.length && words.set(key, value.join(" "));
    else if (!Number.isNaN(value) && value !== /** @type {any} */ (NOT_GIVEN)[key]) words.set(key, String(value));
  }
  for (const [key, value] of Object.entries(others)) words.set(key, value);
  return words.toString();
}

/**
 * What a link holds; invalid values are not given.
 * @param {string} text
 * @returns {{settings: Settings, others: Record<string, string>}}
 */
export function fromLink(text) {
  /** @type {any} */
  const settings = { ...NOT_GIVEN };
  /** @type {Record<string, string>} */
  const others = {};
  for (const [key, value] of new URLSearchParams(text)) {
    if (key === "law") settings.law = Math.max(0, LAWS.findIndex((law) => law.name === value));
    else if (!(key in NOT_GIVEN)) others[key] = value;
    else if (NOT_GIVEN[/** @type {keyof Settings} */ (key)] instanceof Array) settings[key] = listed(value).filter(Number.isFinite);
    else if (value.trim() !== "" && Number.isFinite(Number(value))) settings[key] = Number(value);
  }
  if (Number.isNaN(settings.mu)) settings.mu = LAWS[settings.law]?.mu ?? 0.1;
  return { settings, others };
}

/**
 * A word of a shell.
 * @param {string} text
 */
export const quoted = (text) => (/^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replaceAll("'", `'\\''`)}'`);

/**
 * The words that name a record to the command.
 * @param {Source} source  of files
 */
export function record({ files, units, dt, component }) {
  return [
    ...files.map(quoted),
    ...(units ? ["--units", quoted(units)] : []),
    ...(dt ? ["--dt", dt] : []),
    ...(component ? ["--component", quoted(component)] : []),
  ];
}

/** @param {Source} source */
export const imports = (source, needsNumbers = false) => [
  ...(needsNumbers || source.python.some((line) => line.includes("np.")) ? ["import numpy as np"] : []),
  "import stickslip as ss",
  "",
  ...source.python,
];

/** The periods of a response spectrum [s], those of `stickslip spectrum`. */
export const PERIODS = Float64Array.from({ length: 100 }, (_, i) => 10 ** (i / 33 - 2));

/**
 * The command that gives the response spectrum of a motion; null if no file holds it.
 * @param {Source} source
 * @param {number} damping
 * @param {number} scale
 * @returns {string | null}
 */
export function spectrumCommand(source, damping, scale) {
  if (source.files.length === 0) return null;
  const words = ["stickslip spectrum", ...record(source), "--damping", damping];
  if (scale !== 1) words.push(`--scale=${scale}`);
  return [...words, "--csv response_spectrum.csv"].join(" ");
}

/**
 * The Python lines that give the response spectrum.
 * @param {Source} source
 * @param {number} damping
 * @param {number} scale
 */
export function spectrumPython(source, damping, scale) {
  const motion = `motion${scale === 1 ? "" : `.scaled(${scale})`}`;
  return [
    ...imports(source, true),
    `spectrum = ss.response_spectrum(${motion}, np.geomspace(0.01, 10, 100), damping=${damping})`,
    "print(spectrum.values)",
  ].join("\n");
}

/** Settings in words, for a heading. @param {Settings} s  @param {(field: Field) => string} shown  a value with its unit */
export const described = (s, shown) =>
  [
    `${LAWS[s.law]?.label}${hasMu(s) ? `, \u03bc ${s.mu}` : ""}`,
    ...FIELDS.filter((field) => field.key !== "scale" && applies(field, s) && given(s, field.key)).map((field) => `${field.label} ${shown(field)}`),
    ...(s.pendulum ? ["the spring is a pendulum"] : []),
    ...(s.scale === 1 ? [] : [`scaled by ${s.scale}`]),
  ].join(", ");

/**
 * The command that gives the same numbers; null if it has no option for a setting.
 * @param {Settings} settings
 * @param {Source} source
 * @returns {string | null}
 */
export function command(settings, source) {
  const { name: law = "", command: has = false } = LAWS[settings.law] ?? {};
  if (source.files.length === 0 || !has || settings.pendulum) return null;
  const words = ["stickslip slide", ...record(source), "--mu", ...(law === "pendulum" ? settings.mus : [settings.mu])];
  if (law !== "coulomb") words.push("--law", law);
  for (const key of /** @type {const} */ (["radii", "capacities"]))
    if (settings[key].length) words.push(`--${key}`, ...settings[key]);
  if (source.station) words.push("--station");
  for (const [option, value] of /** @type {[string, number][]} */ ([
    ["--reach", settings.reach],
    ["--mu-static", settings.mu_static],
    ["--period", settings.period],
    ["--damping-ratio", settings.damping_ratio],
    ["--slope", settings.slope],
    ["--stop-gap", settings.stop_gap],
    ["--restitution", settings.restitution],
  ]))
    if (!Number.isNaN(value)) words.push(option, value);
  if (settings.scale !== 1) words.push(`--scale=${settings.scale}`);
  if (settings.vertical && settings.clipped) words.push("--contact clipped");
  return words.join(" ");
}

/**
 * The command for the path in the plane, where all components of the files act; or null.
 * @param {Settings} settings
 * @param {Source} source  of a station
 */
export function pathCommand(settings, source) {
  if (LAWS[settings.law]?.name !== "coulomb" || source.dropsVertical) return null;
  const line = command({ ...settings, vertical: 0 }, { ...source, station: false });
  return line && `${line} --planar${settings.vertical && settings.clipped ? " --contact clipped" : ""}`;
}

/**
 * The expression of the slider in Python.
 * @param {Settings} s
 */
function slider(s) {
  const { python, fields } = LAWS[s.law] ?? {};
  const law = `ss.${python?.(s)}`;
  const friction = fields?.includes(MU_STATIC) && !Number.isNaN(s.mu_static) ? `ss.StaticKinetic(${law}, mu_static=${s.mu_static})` : law;
  const mounting = [friction];
  if (!Number.isNaN(s.period)) mounting.push(`period=${s.period}`);
  if (!Number.isNaN(s.damping_ratio)) mounting.push(`damping_ratio=${s.damping_ratio}`);
  if (s.pendulum) mounting.push("pendulum=True");
  if (!Number.isNaN(s.slope)) mounting.push(`slope_degrees=${s.slope}`);
  if (isOneWay(s)) mounting.push("one_way=True");
  if (!Number.isNaN(s.stop_gap)) mounting.push(`stops=ss.Stops(gap=${s.stop_gap}, restitution=${s.restitution})`);
  return `ss.Slider(${mounting.join(", ")})`;
}

/**
 * @param {Settings} s
 * @param {boolean} rests  at last; else Python refuses to settle
 */
function integration(s, rests) {
  const contact = s.vertical && s.clipped ? ', contact="clipped"' : "";
  const motion = `motion${s.scale === 1 ? "" : `.scaled(${s.scale})`}`;
  return `response = ss.integrate(slider, ${motion}${rests ? ", settle=True" : ""}${contact})`;
}

/**
 * The Python lines that give the same numbers.
 * @param {Settings} s
 * @param {Source} source
 * @param {boolean} rests  whether the slider comes to rest
 */
export function python(s, source, rests) {
  return [
    ...imports(source),
    `slider = ${slider(s)}`,
    integration(s, rests),
    "print(response.peak, response.residual)",
  ].join("\n");
}

/**
 * The Python lines for the path in the plane.
 * @param {Settings} s
 * @param {Source} source  of a station
 * @param {boolean} even   whether the time step is the same throughout
 * @param {boolean} rests  whether the slider comes to rest
 */
export function pathPython(s, source, even, rests) {
  const time = even ? "motion.dt" : "times=motion.time";
  return [
    ...imports(source),
    ...(source.dropsVertical ? [`motion = ss.GroundMotion(motion.acceleration, ${time}, transverse=motion.transverse)`] : []),
    `slider = ss.PlanarSlider(${slider(s)})`,
    integration(s, rests),
    "print(response.peak, response.residual)",
  ].join("\n");
}
