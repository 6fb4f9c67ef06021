// The form and the buttons: what the reader enters and does.

import { listenToBlock, moveOnOver } from "./block.js";
import { element, make } from "./dom.js";
import { downloadSvg, goTo, play, playing, resizePlots, setTime, setWindow, showKind, zoom } from "./drawing.js";
import { indexAt } from "./histories.js";
import { cancelMany, downloadCurves, downloadMany, moveOnCurves, resizeCurves, slideMany, view } from "./many.js";
import { downloadPath } from "./path.js";
import { forgetColors } from "./plots.js";
import { addFiles, answer, asks, generate, showRows, stopReading } from "./records.js";
import { measureScene } from "./scene.js";
import { applies, completed, FIELDS, hasMu, kindOf, LAWS, listed, MU, NOT_GIVEN, remark } from "./settings.js";
import { GENERATORS } from "./sources.js";
import { downloadResponse, downloadSliding, moveOnSpectrum } from "./spectra.js";
import { changed, others, rows, saveLink, settings, state, units, zeta } from "./state.js";
import { downloadCsv } from "./tables.js";
import { digits, fromUnit, toUnit } from "./units.js";
import { inField, listOf, unit, unitOfField } from "./values.js";

/** @import { Settings } from "./library.js" */
/** @import { Field } from "./settings.js" */

/** What is wrong with the numbers of the generator; empty if nothing. */
let generatorTrouble = "";

/** Shows beside each field what is wrong with it. @returns {string} what must be mended; empty if nothing */
export function showRemarks() {
  const full = completed(settings);
  let wrong = "";
  const say = (/** @type {HTMLElement} */ place, /** @type {HTMLInputElement} */ input, /** @type {Field} */ field) => {
    const found = unreadable.has(field.key)
      ? { text: `${field.label} must be a number`, refused: true }
      : remark(field, full, (value) => inField(field, [value]), state);
    const scaled = field.key === "mus" && full.mus.join() !== typedMus().join() ? `scaled to ${full.mus.map(digits).join(", ")}` : "";
    place.textContent = found?.text ?? scaled;
    place.classList.toggle("wrong", found?.refused ?? false);
    input.setAttribute("aria-invalid", String(found?.refused ?? false));
    if (found?.refused) wrong ||= found.text;
  };
  if (hasMu(full)) say(element("mu-remark"), element("mu"), MU);
  element("mu-label").hidden = element("mu-remark").hidden = !hasMu(full);
  for (const label of element("fields").children) {
    const field = fieldOf(label.dataset.key, full);
    if (field && !field.choices) say(label.querySelector(".remark"), label.querySelector("input"), field);
  }
  if (element("fields").textContent.includes("is its unit right?")) element("mounting").open = true; // to be seen
  return wrong || (state.selected === state.generated ? generatorTrouble : "");
}

/** @param {string} key  @param {Settings} full */
const fieldOf = (key, full) => FIELDS.find((field) => field.key === key && applies(field, full));

export function showGenerator() {
  generatorTrouble = "";
  element("generator-name").value = state.generator?.name ?? "";
  element("generate").hidden = !state.generator;
  element("generator-values").replaceChildren(
    ...(state.generator?.parameters ?? []).map((one) => {
      const of = one.quantity ? unit(one.quantity) : { name: one.unit ?? "", size: 1 };
      const held = String(toUnit(Number(others[one.key] ?? one.value), of));
      const made = entry(one.label, of.name, held, "", (text) => {
        const value = fromUnit(Number(text), of);
        const valid = text !== "" && value >= one.min && value <= one.max;
        const bounds = [one.min, one.max].map((bound) => digits(bound / of.size));
        const remark = valid ? "" : `${one.label} must be between ${bounds.join(" and ")} ${of.name}`;
        /** @type {HTMLElement} */ (made.querySelector(".remark")).textContent = remark;
        generatorTrouble = remark;
        if (!valid) return changed();
        others[one.key] = String(value);
        generate();
      });
      made.querySelector(".remark")?.classList.add("wrong");
      return made;
    }),
  );
}

/**
 * @param {string} label
 * @param {string} unitName
 * @param {string} value
 * @param {string} hint
 * @param {(text: string, input: HTMLInputElement) => void} onInput
 */
function entry(label, unitName, value, hint, onInput, type = "number") {
  const input = make("input", { type, step: "any", value, title: hint });
  input.oninput = () => onInput(input.value, input);
  return make("label", { title: hint }, make("span", {}, label), input, make("small", {}, unitName), make("small", { className: "remark" }));
}

/** A field of words. @param {Field} field  @param {Settings} full */
function choice({ key, label, choices = [], hint }, full) {
  const select = make("select", { title: hint }, ...choices.map((one, i) => make("option", { value: String(i) }, one)));
  select.value = String(full[key]);
  select.onchange = () => {
    /** @type {any} */ (settings)[key] = Number(select.value);
    changed();
  };
  return make("label", { className: "choice", title: hint }, make("span", {}, label), select);
}

/** Settings whose fields do not hold numbers. @type {Set<keyof Settings>} */
const unreadable = new Set();

/** The coefficients of the surfaces as they were entered: the slider scales them. */
const typedMus = () => (settings.mus.length ? settings.mus : listOf(FIELDS.find(({ key }) => key === "mus")?.value ?? []));

export function showForm() {
  element("law").value = String(settings.law);
  element("mu").value = String(settings.mu);
  element("mu-slider").value = String(settings.mu);
  element("pendulum").checked = settings.pendulum === 1;
  element("vertical").checked = settings.vertical === 1;
  element("clipped").checked = settings.clipped === 1;
  showFields();
}

/**
 * A setting as its field holds it.
 * @param {Field} field
 * @param {Settings} s
 */
const entered = (field, s) =>
  listOf(s[field.key])
    .map((value) => toUnit(value, unitOfField(field)))
    .join(" ");

/**
 * @param {Field} field
 * @param {HTMLInputElement} input
 */
function enter(field, input) {
  const { key } = field;
  const values = listed(input.value);
  const isList = typeof NOT_GIVEN[key] !== "number";
  const valid = values.every(Number.isFinite) && (isList || values.length <= 1) && !input.validity.badInput;
  unreadable[valid ? "delete" : "add"](key);
  if (valid) {
    const si = values.map((value) => fromUnit(value, unitOfField(field)));
    /** @type {any} */ (settings)[key] = isList ? si : (si[0] ?? NaN);
    if (key === "mus" && si.length) setMu(Math.max(...si));
  }
  if (FIELDS.some((one) => one.needs?.includes(key))) refreshFields();
  changed();
}

function showFields() {
  element("fields").replaceChildren();
  refreshFields();
}

/** Shows and hides the fields that depend on others; those that stay are not made anew, because one may be typed in. */
function refreshFields() {
  const full = completed(settings);
  element("pendulum").disabled = Number.isNaN(full.period) || LAWS[full.law]?.name === "pendulum";
  const fields = FIELDS.filter((field) => applies(field, full));
  const place = element("fields");
  for (const shown of [...place.children]) if (!fields.some(({ key }) => key === shown.dataset.key)) shown.remove();
  fields.forEach((field, i) => {
    if (place.children[i]?.dataset.key === field.key) return;
    const type = typeof full[field.key] === "number" ? "number" : "text";
    const held = entered(field, { ...full, mus: typedMus() });
    const made = field.choices ? choice(field, full) : entry(field.label, unitOfField(field).name, held, field.hint, (_, input) => enter(field, input), type);
    made.dataset.key = field.key;
    place.insertBefore(made, place.children[i] ?? null);
  });
}

/** @param {number} mu */
function setMu(mu) {
  settings.mu = mu;
  unreadable.delete("mu");
  if (document.activeElement !== element("mu")) element("mu").value = String(mu);
  element("mu-slider").value = String(mu);
  changed();
}

export function listen() {
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
    state.generator = GENERATORS.find((one) => one.name === element("generator-name").value);
    showGenerator();
    generate();
  };
  element("law").onchange = () => {
    const [before, { mu, name } = {}] = [LAWS[settings.law], LAWS[Number(element("law").value)]];
    const kind = kindOf(settings);
    settings.law = Number(element("law").value);
    if (kind !== kindOf(settings)) settings.restitution = NaN; // of something else
    unreadable.clear();
    showFields();
    showKind();
    if (name === "pendulum") setMu(Math.max(...typedMus()));
    else if (mu !== undefined || before?.mu !== undefined) setMu(mu ?? 0.1);
    else changed();
  };
  element("mu-slider").oninput = () => setMu(Number(element("mu-slider").value));
  element("mu").oninput = () => setMu(element("mu").value === "" ? NaN : Number(element("mu").value));
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
      showFields();
      showGenerator();
      changed();
    };
  }
  element("theme").onchange = () => {
    document.documentElement.dataset.theme = element("theme").value;
    forgetColors();
    changed();
  };
  matchMedia("(prefers-color-scheme: dark)").onchange = () => {
    forgetColors();
    changed();
  };
  element("play").onclick = () => play(!playing);
  element("time").oninput = () => {
    play(false);
    goTo(Number(element("time").value));
  };
  for (const figure of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("figure[tabindex]"))) {
    const { spectrum } = figure.dataset;
    figure.onkeydown = (event) => {
      if (event.target !== figure || !state.response) return;
      const width = { "+": 0.5, "-": 2, Escape: Infinity }[event.key];
      if (width !== undefined && !spectrum) return zoom(width);
      const step = { ArrowLeft: -1, ArrowRight: 1, PageUp: -1, PageDown: 1 }[event.key];
      if (step === undefined) return;
      event.preventDefault();
      const far = event.key.startsWith("Page");
      if (spectrum === "over") return moveOnOver(far ? 10 * step : step);
      if (spectrum === "curves") return moveOnCurves(far ? 10 * step : step);
      if (spectrum === "sliding" || spectrum === "response") return moveOnSpectrum(spectrum, far ? 10 * step : step);
      const last = state.response.time.length - 1;
      const index = Math.min(last, Math.max(0, indexAt(state.response.time, state.now) + (far ? 50 * step : step)));
      goTo(state.response.time[index] ?? 0);
    };
  }
  const damping = element("zeta");
  damping.value = String(zeta());
  damping.oninput = () => {
    const valid = damping.value !== "" && Number(damping.value) >= 0 && Number(damping.value) < 2;
    damping.setCustomValidity(valid ? "" : "out of range");
    if (!valid) return;
    others.zeta = damping.value;
    changed();
  };
  element("whole").onclick = () => setWindow(null);
  element("csv").onclick = downloadCsv;
  element("svg").onclick = downloadSvg;
  element("sliding-csv").onclick = downloadSliding;
  element("response-csv").onclick = downloadResponse;
  element("path-csv").onclick = downloadPath;
  element("many-csv").onclick = downloadMany;
  element("curves-csv").onclick = downloadCurves;
  element("asking-read").onclick = () => answer(rows.filter(asks));
  element("asking-units").onchange = () => {
    for (const one of element("asking").querySelectorAll("select")) one.value = element("asking-units").value;
  };
  element("generate").onclick = () => {
    if (!state.generated) return;
    state.generated.counts = true;
    state.generated = null;
    showRows();
    if (!element("many").hidden) slideMany();
  };
  element("reading-cancel").onclick = () => stopReading();
  element("many-cancel").onclick = () => cancelMany();
  element("view-one").onclick = () => view(false);
  element("view-many").onclick = () => view(true);
  element("pin").onclick = () => {
    state.pinned = state.pinned ? null : { settings: { ...settings }, response: state.response };
    element("pin").setAttribute("aria-pressed", String(state.pinned !== null));
    changed();
  };
  listenToBlock();
  element("link").onclick = () => {
    saveLink();
    copy(location.href, element("link"));
  };
  for (const button of /** @type {NodeListOf<HTMLButtonElement>} */ (document.querySelectorAll(".copy")))
    button.onclick = () => copy(element(button.dataset.of ?? "").textContent ?? "", button);
  new ResizeObserver(resize).observe(element("output"));
  addEventListener("beforeprint", () => onPaper(true));
  addEventListener("afterprint", () => onPaper(false));
}

function resize() {
  measureScene(element("scene"));
  resizePlots();
  resizeCurves();
  setTime(state.now);
}

/** Draws in light colors and as wide as a sheet, or as before. @param {boolean} on */
function onPaper(on) {
  document.documentElement.classList.toggle("paper", on);
  document.documentElement.dataset.theme = on ? "light" : element("theme").value;
  forgetColors();
  resize();
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
