// The page: what it shows, and what its reader does.

import { latest, startWorker } from "./client.js";
import { csv, download } from "./csv.js";
import { CurvePlot, levelLine, shade, TimePlot } from "./plots.js";
import { drawScene } from "./scene.js";
import { applies, command, completed, FIELDS, fromLink, LAWS, python, toLink } from "./settings.js";
import { GENERATORS, recorded } from "./sources.js";
import { digits, unitOf } from "./units.js";

/** @import { Settings } from "./library.js" */
/** @import { Motion, Response } from "./worker.js" */
/** @import { Source } from "./sources.js" */
/** @import { Choice, Quantity } from "./units.js" */

/**
 * A line of the list of records: a ground motion, or a file that could not be read.
 * @typedef {Object} Row
 * @property {string} label
 * @property {string} file
 * @property {Motion} [motion]
 * @property {(vertical: boolean) => Source} source
 * @property {string} [error]
 * @property {Uint8Array} [bytes]  of a file that could not be read, to try again
 */

/**
 * @template {HTMLElement} [T=any]
 * @param {string} id
 * @returns {T}
 */
const element = (id) => /** @type {T} */ (document.getElementById(id));

/**
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {Record<string, any>} [properties]
 * @param {...(Node | string)} children
 */
function make(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

const GRAVITY = 9.80665;
const KINDS = ["breakaway", "reversal", "arrest", "end", "impact", "liftoff", "landing"];
const worker = startWorker(element("worker").textContent ?? "");

let { settings, others } = fromLink(location.hash.slice(1));
/** @type {Choice} */
const units = {
  length: others.length === "in" ? "in" : "cm",
  acceleration: others.acceleration === "si" ? "si" : "g",
};
/** @type {Row[]} */
const rows = [];
/** @type {Row | null} */
let selected = null;
/** @type {Response | null} */
let response = null;
let now = 0; // [s]
let generator = GENERATORS.find((one) => one.name === others.motion) ?? GENERATORS[0];

// ---- the response

/** @param {Quantity} quantity */
const unit = (quantity) => unitOf(quantity, units);
/** @param {number} value  @param {Quantity} quantity */
const shown = (value, quantity) => {
  const { name, size } = unit(quantity);
  return `${digits(value / size)}${name ? ` ${name}` : ""}`;
};
/** @param {Float64Array} values  @param {Quantity} quantity */
const inUnits = (values, quantity) => {
  const { size } = unit(quantity);
  return values.map((value) => value / size);
};

const plots = makePlots();

function makePlots() {
  const onCursor = (/** @type {number | null} */ index) => {
    if (!playing && !moving && response && index !== null) setTime(response.time[index] ?? 0, false);
  };
  return {
    acceleration: new TimePlot(element("plot-acceleration"), "acceleration", onCursor),
    velocity: new TimePlot(element("plot-velocity"), "velocity", onCursor),
    displacement: new TimePlot(element("plot-displacement"), "displacement", onCursor),
    hysteresis: new CurvePlot(element("plot-hysteresis"), "force"),
  };
}

const update = latest(async () => {
  const row = selected;
  if (!row?.motion) return;
  const now = completed(settings);
  if (!row.motion.verticalId) now.vertical = 0;
  const id = now.vertical && row.motion.verticalId ? row.motion.verticalId : row.motion.id;
  try {
    const found = await worker.slide(id, now);
    if (row !== selected) return;
    response = found;
    element("trouble").textContent = "";
    document.body.dataset.state = "shown";
  } catch (error) {
    response = null;
    element("trouble").textContent = /** @type {Error} */ (error).message;
    document.body.dataset.state = "failed";
  }
  show(now, row);
});

/** Before the answer comes, the page is not up to date. */
function changed() {
  document.body.dataset.state = "busy";
  history.replaceState(null, "", `#${linkText()}`);
  update();
}

/**
 * @param {Settings} s
 * @param {Row} row
 */
function show(s, row) {
  const source = row.source(s.vertical === 1);
  element("command").textContent =
    command(s, source) ?? "The command has no option for this; the lines in Python give the same numbers.";
  element("python").textContent = python(s, source);
  element("output").classList.toggle("empty", response === null);
  if (!response) return;
  const { summary, time, acceleration, velocity, displacement, force, events } = response;
  const [length, speed, ground] = [unit("length"), unit("velocity"), unit("acceleration")];

  element("title-acceleration").textContent = `Ground acceleration [${ground.name}]`;
  const levels = slipLevels(s).map((level) => level / ground.size);
  plots.acceleration.show(time, inUnits(acceleration, "acceleration"), {
    after: (u, ctx) =>
      levels.forEach((level, i) =>
        levelLine(u, ctx, level, { stroke: "level", dash: [5, 4], label: i ? "" : "slip level", below: level < 0 }),
      ),
  });
  element("title-velocity").textContent = `Velocity relative to the ground [${speed.name}]; shaded where it sticks`;
  const rests = sticks(events, time.at(-1) ?? 0);
  plots.velocity.show(time, inUnits(velocity, "velocity"), { before: (u, ctx) => shade(u, ctx, rests) });
  element("title-displacement").textContent = `Displacement relative to the ground [${length.name}]`;
  const [peak, residual] = [summary.peak / length.size, summary.residual / length.size];
  const extremes = displacement.reduce((most, x) => (Math.abs(x) > Math.abs(most) ? x : most), 0);
  const signed = extremes < 0 ? -peak : peak;
  plots.displacement.show(time, inUnits(displacement, "length"), {
    range: [Math.min(0, signed), Math.max(0, signed)],
    after: (u, ctx) => {
      levelLine(u, ctx, signed, { stroke: "level", dash: [2, 3], label: `peak ${digits(peak)}`, below: signed > 0 });
      levelLine(u, ctx, residual, {
        stroke: "displacement",
        dash: [6, 3],
        label: `residual ${digits(residual)}`,
        below: residual < signed,
      });
    },
  });
  element("title-hysteresis").textContent = `Force over the weight [g] over displacement [${length.name}]`;
  plots.hysteresis.show(inUnits(displacement, "length"), force.map((value) => value / GRAVITY));
  showNumbers();
  element("time").max = String(time.at(-1) ?? 1);
  setTime(Math.min(now, time.at(-1) ?? 0));
}

/**
 * The ground accelerations at which the slider at x = 0 starts to slide forward and backward [m/s^2].
 * @param {Settings} s
 */
function slipLevels({ mu, mu_static, slope, law }) {
  const held = Number.isNaN(mu_static) ? mu : mu_static;
  const angle = ((Number.isNaN(slope) ? 0 : slope) * Math.PI) / 180;
  const [c, d] = [Math.cos(angle), Math.sin(angle)];
  const forward = (-GRAVITY * (held * c - d)) / (c + held * d);
  return LAWS[law]?.name === "one-way" ? [forward] : [(GRAVITY * (held * c + d)) / (c - held * d), forward];
}

/**
 * When the slider sticks.
 * @param {Float64Array} events
 * @param {number} end
 * @returns {[number, number][]}
 */
function sticks(events, end) {
  /** @type {[number, number][]} */
  const intervals = [];
  /** @type {number | null} */
  let since = 0;
  for (let i = 0; i < events.length; i += 4) {
    const [time = 0, kind = 0] = [events[i], events[i + 3]];
    if (KINDS[kind] === "breakaway" && since !== null) {
      intervals.push([since, time]);
      since = null;
    } else if (KINDS[kind] === "arrest") {
      since = time;
    }
  }
  if (since !== null) intervals.push([since, end]);
  return intervals;
}

/** @returns {[string, number, Quantity, string][]}  name, value in SI units, quantity, SI unit */
function numbers() {
  if (!response || !selected?.motion) return [];
  const { summary } = response;
  const { measures } = selected.motion;
  const times = settings.scale;
  return [
    ["peak", summary.peak, "length", "m"],
    ["residual", summary.residual, "length", "m"],
    ["sliding distance", summary.sliding_distance, "length", "m"],
    ["time sliding", summary.time_sliding, "time", "s"],
    ["slips", summary.slips, "none", ""],
    ["impacts", summary.impacts, "none", ""],
    ["lift-offs", summary.liftoffs, "none", ""],
    ["PGA", measures.pga * Math.abs(times), "acceleration", "m/s^2"],
    ["PGV", measures.pgv * Math.abs(times), "velocity", "m/s"],
    ["Arias intensity", measures.arias * times ** 2, "velocity", "m/s"],
    ["D5-95", measures.d5_95, "time", "s"],
    ["Tm", measures.mean_period, "time", "s"],
    ["events", summary.events, "none", ""],
    ["energy imbalance over input", summary.imbalance / (summary.input || 1), "none", ""],
    ["margin of the closest decision", Math.min(summary.margin, summary.impact_margin), "none", ""],
  ];
}

function showNumbers() {
  element("numbers").tBodies[0].replaceChildren(
    ...numbers().map(([name, value, quantity]) => {
      const row = make("tr", {}, make("th", { scope: "row" }, name), make("td", {}, shown(value, quantity)));
      row.dataset.name = name;
      row.dataset.si = String(value);
      return row;
    }),
  );
  if (response && !response.summary.at_rest)
    element("numbers").tBodies[0].append(
      make("tr", {}, make("th", { colSpan: 2 }, "It never comes to rest; these are the numbers at the end of the record.")),
    );
}

// ---- time

let playing = false;
let moving = false; // whether the page moves the cursors

/**
 * @param {number} time  [s]
 * @param {boolean} [cursors]  whether the pictures' cursors follow
 */
function setTime(time, cursors = true) {
  if (!response) return;
  now = time;
  const { summary, displacement, velocity, acceleration } = response;
  const i = indexAt(response.time, time);
  const [before = 0, after = before] = [response.time[i], response.time[i + 1]];
  const part = after > before ? (time - before) / (after - before) : 0;
  const at = (/** @type {Float64Array} */ values) => {
    const [a = 0, b = a] = [values[i], values[i + 1]];
    return a + part * (b - a);
  };
  drawScene(element("scene"), {
    settings: completed(settings),
    x: at(displacement),
    peak: summary.peak,
    acceleration: at(acceleration),
    pga: summary.pga,
    ruler: unit("length"),
  });
  element("readout").textContent =
    `t = ${time.toFixed(2)} s: ground ${shown(plain(at(acceleration)), "acceleration")}, ` +
    `velocity ${shown(plain(at(velocity)), "velocity")}, displacement ${shown(plain(at(displacement)), "length")}`;
  element("time").value = String(time);
  if (!cursors) return;
  moving = true;
  for (const plot of [plots.acceleration, plots.velocity, plots.displacement]) plot.point(time);
  moving = false;
}

/** Round-off as zero: nobody reads 1e-17 m. @param {number} value */
const plain = (value) => (Math.abs(value) < 1e-12 ? 0 : value);

/**
 * The last sample at or before a time.
 * @param {Float64Array} times
 * @param {number} time
 */
function indexAt(times, time) {
  let [low, high] = [0, times.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((times[middle] ?? 0) <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** @param {boolean} on */
function play(on) {
  playing = on;
  element("play").textContent = on ? "Pause" : "Play";
  if (!on || !response) return;
  const end = response.time.at(-1) ?? 0;
  if (now >= end) now = 0;
  let last = performance.now();
  const step = (/** @type {number} */ at) => {
    if (!playing) return;
    const next = now + ((at - last) / 1000) * Number(element("speed").value);
    last = at;
    setTime(Math.min(next, end));
    if (next >= end) play(false);
    else requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

// ---- records

/** @param {FileList | File[]} files */
async function addFiles(files) {
  let done = 0;
  const first = rows.length;
  for (const file of files) {
    element("progress").textContent = files.length > 1 ? `Reading file ${++done} of ${files.length}` : "Reading";
    const inside = await worker.unpack(file.name, new Uint8Array(await file.arrayBuffer()));
    for (const one of inside) {
      if ("error" in one) rows.push({ label: one.name, file: one.name, error: one.error, source: () => recordedAs(one.name) });
      else await addFile(one.name, one.bytes);
    }
  }
  element("progress").textContent = "";
  select(rows.slice(first).find((row) => row.motion) ?? selected);
}

/**
 * @param {string} file
 * @param {{units?: string, dt?: number, component?: string, along?: string, vertical?: boolean}} [more]
 */
const recordedAs = (file, { units = "", dt = NaN, component = "", along = "", vertical = false } = {}) =>
  recorded({ file, units, dt, component, along, vertical });

/**
 * @param {string} file
 * @param {Uint8Array} bytes
 * @param {{units?: string, dt?: number}} [options]
 * @param {number} [place]  of the row that this replaces
 */
async function addFile(file, bytes, options = {}, place = rows.length) {
  /** @type {Row[]} */
  let found;
  try {
    const motions = await worker.read(file, bytes, options);
    found = motions.map((motion, i) => ({
      label: motions.length > 1 ? `${file} (${motion.component || i + 1})` : file,
      file,
      motion,
      source: (vertical) =>
        recordedAs(file, {
          ...options,
          component: motion.several ? motion.component || String(i + 1) : "",
          along: motion.orientation,
          vertical,
        }),
    }));
  } catch (error) {
    const message = /** @type {Error} */ (error).message;
    found = [{ label: file, file, error: message, bytes, source: () => recordedAs(file) }];
  }
  rows.splice(place, 1, ...found);
  showRows();
  return found[0];
}

/** @param {Row | null} row */
function select(row) {
  selected = row;
  showRows();
  element("vertical").disabled = !row?.motion?.verticalId;
  if (row?.motion) changed();
}

function showRows() {
  element("records").replaceChildren(...rows.map(rowElement));
}

/** @param {Row} row */
function rowElement(row) {
  const remove = make("button", { type: "button", textContent: "\u00d7", onclick: () => removeRow(row) });
  remove.setAttribute("aria-label", `Remove ${row.label}`);
  if (!row.motion) {
    const reason = row.error?.replace(`read_record: ${row.file}: `, "") ?? "";
    const line = make("li", { className: "failed" }, make("b", {}, row.label), remove, make("p", {}, reason));
    if (row.bytes && /units|time step|\bdt\b/.test(reason)) line.append(retryForm(row));
    return line;
  }
  const radio = make("input", { type: "radio", name: "record", checked: row === selected, onchange: () => select(row) });
  const { pga, duration } = row.motion.measures;
  return make(
    "li",
    {},
    make("label", {}, radio, ` ${row.label} `, make("small", {}, `${shown(pga, "acceleration")}, ${digits(duration)} s`)),
    remove,
  );
}

/**
 * Asks for what a file leaves open.
 * @param {Row} row
 */
function retryForm(row) {
  const choice = make("select", {}, make("option", { value: "" }, "as the file states"));
  for (const name of ["g", "m/s^2", "cm/s^2", "mm/s^2", "ft/s^2", "in/s^2"]) choice.append(make("option", {}, name));
  const dt = make("input", { type: "number", min: "0", step: "any" });
  const form = make("form", {}, make("label", {}, "units ", choice), make("label", {}, "dt [s] ", dt), make("button", {}, "Read"));
  form.onsubmit = async (event) => {
    event.preventDefault();
    const options = { units: choice.value, ...(dt.value ? { dt: Number(dt.value) } : {}) };
    const found = await addFile(row.file, /** @type {Uint8Array} */ (row.bytes), options, rows.indexOf(row));
    if (found?.motion) select(found);
  };
  return form;
}

/** @param {Row} row */
function removeRow(row) {
  const place = rows.indexOf(row);
  rows.splice(place, 1);
  const { id, verticalId } = row.motion ?? {};
  worker.discard([id, verticalId].filter((one) => one != null));
  if (row === selected) select(rows.slice(place).find((one) => one.motion) ?? rows.findLast((one) => one.motion) ?? null);
  else showRows();
}

/** The motion of the generator is one row, which changes with its numbers. @type {Row | null} */
let generated = null;

const generate = latest(async () => {
  const made = /** @type {NonNullable<typeof generator>} */ (generator);
  const values = Object.fromEntries(made.parameters.map(({ key, value }) => [key, Number(others[key] ?? value)]));
  try {
    const motion = await worker.generate(made.name, values);
    const old = generated;
    generated = { label: made.label, file: "", motion, source: () => ({ file: null, python: made.python(values) }) };
    const place = old ? rows.indexOf(old) : -1;
    if (place >= 0) rows[place] = generated;
    else rows.unshift(generated);
    if (old?.motion) worker.discard([old.motion.id]);
    select(generated);
  } catch (error) {
    element("trouble").textContent = /** @type {Error} */ (error).message;
  }
});

// ---- the form

function linkText() {
  return toLink(settings, { ...others, ...units, ...(selected === generated && generator ? { motion: generator.name } : {}) });
}

function showGenerator() {
  element("generator-name").value = generator?.name ?? "";
  element("generator-values").replaceChildren(
    ...(generator?.parameters ?? []).map((one) =>
      numberInput(one.label, one.unit, others[one.key] ?? String(one.value), "", (text) => {
        const value = Number(text);
        if (text === "" || !(value >= one.min && value <= one.max)) return false;
        others[one.key] = text;
        generate();
        return true;
      }),
    ),
  );
}

/**
 * @param {string} label
 * @param {string} unitName
 * @param {string} value
 * @param {string} hint
 * @param {(text: string) => boolean} onInput  returns whether the text is valid
 */
function numberInput(label, unitName, value, hint, onInput) {
  const input = make("input", { type: "number", step: "any", value, title: hint });
  input.oninput = () => input.setCustomValidity(onInput(input.value) ? "" : "out of range");
  return make("label", { title: hint }, make("span", {}, label), input, make("small", {}, unitName));
}

function showForm() {
  element("law").value = String(settings.law);
  element("mu").value = String(settings.mu);
  element("mu-slider").value = String(settings.mu);
  element("pendulum").checked = settings.pendulum === 1;
  element("vertical").checked = settings.vertical === 1;
  element("clipped").checked = settings.clipped === 1;
  showFields();
}

function showFields() {
  const full = completed(settings);
  element("pendulum").disabled = Number.isNaN(full.period);
  element("fields").replaceChildren(
    ...FIELDS.filter((field) => applies(field, full)).map((field) => {
      const value = full[field.key];
      return numberInput(field.label, field.unit, Number.isNaN(value) ? "" : String(value), field.hint, (text) => {
        settings[field.key] = text === "" ? NaN : Number(text);
        changed();
        if (FIELDS.some((one) => one.needs === field.key)) refreshDependents();
        return true;
      });
    }),
  );
}

/** Shows or hides the fields that depend on another, which keeps the focus. */
function refreshDependents() {
  const inputs = [...element("fields").querySelectorAll("input")];
  const place = inputs.indexOf(document.activeElement);
  showFields();
  if (place >= 0) element("fields").querySelectorAll("input")[place]?.focus();
}

/** @param {number} mu */
function setMu(mu) {
  if (!(mu >= 0)) return;
  settings.mu = mu;
  if (document.activeElement !== element("mu")) element("mu").value = String(mu);
  element("mu-slider").value = String(mu);
  changed();
}

function listen() {
  element("files").onchange = async () => {
    await addFiles(element("files").files);
    element("files").value = "";
  };
  document.ondragover = (event) => event.preventDefault();
  document.ondrop = (event) => {
    event.preventDefault();
    if (event.dataTransfer?.files.length) addFiles([...event.dataTransfer.files]);
  };
  element("generator-name").onchange = () => {
    generator = GENERATORS.find((one) => one.name === element("generator-name").value);
    showGenerator();
    generate();
  };
  element("law").onchange = () => {
    settings.law = Number(element("law").value);
    showFields();
    changed();
  };
  element("mu-slider").oninput = () => setMu(Number(element("mu-slider").value));
  element("mu").oninput = () => element("mu").value !== "" && setMu(Number(element("mu").value));
  for (const flag of /** @type {const} */ (["pendulum", "vertical", "clipped"]))
    element(flag).onchange = () => {
      settings[flag] = element(flag).checked ? 1 : 0;
      changed();
    };
  for (const quantity of /** @type {const} */ (["length", "acceleration"])) {
    const choice = element(`unit-${quantity}`);
    choice.value = units[quantity];
    choice.onchange = () => {
      /** @type {any} */ (units)[quantity] = choice.value;
      showRows();
      changed();
    };
  }
  element("theme").onchange = () => {
    document.documentElement.dataset.theme = element("theme").value;
    changed();
  };
  matchMedia("(prefers-color-scheme: dark)").onchange = () => changed();
  element("play").onclick = () => play(!playing);
  element("time").oninput = () => {
    play(false);
    setTime(Number(element("time").value));
  };
  for (const figure of document.querySelectorAll("figure[tabindex]"))
    /** @type {HTMLElement} */ (figure).onkeydown = (event) => {
      const step = { ArrowLeft: -1, ArrowRight: 1, PageUp: -50, PageDown: 50 }[event.key];
      if (step === undefined || !response) return;
      event.preventDefault();
      const last = response.time.length - 1;
      const index = Math.min(last, Math.max(0, indexAt(response.time, now) + step));
      setTime(response.time[index] ?? 0);
    };
  element("csv").onclick = downloadCsv;
  element("link").onclick = () => copy(location.href, element("link"));
  for (const button of /** @type {NodeListOf<HTMLButtonElement>} */ (document.querySelectorAll(".copy")))
    button.onclick = () => copy(element(button.dataset.of ?? "").textContent ?? "", button);
  new ResizeObserver(() => {
    for (const plot of Object.values(plots)) plot.resize();
    setTime(now);
  }).observe(element("output"));
}

/**
 * @param {string} text
 * @param {HTMLButtonElement} button
 */
async function copy(text, button) {
  const was = button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = "Copied";
  } catch {
    prompt("Copy with Ctrl+C:", text); // where the clipboard is not allowed
  }
  setTimeout(() => (button.textContent = was), 1500);
}

function downloadCsv() {
  if (!response || !selected) return;
  const { time, acceleration, velocity, displacement, force } = response;
  const rows = Array.from(time, (t, i) =>
    [t, acceleration[i], velocity[i], displacement[i], force[i]].map((value) => value ?? NaN),
  );
  const comments = [
    `stickslip: ${selected.label}; ${toLink(completed(settings))}`,
    ...numbers().map(([name, value, , si]) => `${name}${si ? ` [${si}]` : ""}: ${value}`),
  ];
  const header = ["time_s", "ground_acceleration_m_s2", "velocity_m_s", "displacement_m", "force_m_s2"];
  const name = selected.label.replace(/[^\w.-]+/g, "_");
  download(`${name}.csv`, csv(header, rows, comments), "text/csv");
}

// ---- start

async function start() {
  element("law").append(...LAWS.map(({ label }, i) => make("option", { value: String(i) }, label)));
  element("generator-name").append(...GENERATORS.map(({ name, label }) => make("option", { value: name }, label)));
  element("mounting").open = innerWidth > 800;
  listen();
  showForm();
  showGenerator();
  const packed = Uint8Array.from(atob((element("library").textContent ?? "").trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  await worker.load(await new globalThis.Response(stream).arrayBuffer());
  generate();
}

start();
