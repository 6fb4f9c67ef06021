// The list of records: files, stations, generated motions.

import { latest } from "./client.js";
import { element, make } from "./dom.js";
import { setWindow } from "./drawing.js";
import { slideMany } from "./many.js";
import { metadataOf, statedOf } from "./metadata.js";
import { recorded } from "./sources.js";
import { changed, others, refuse, rows, slides, state, unpacked, worker } from "./state.js";
import { digits } from "./units.js";
import { shown } from "./values.js";

/** @import { Stated } from "./metadata.js" */
/** @import { Row } from "./state.js" */
/** @import { Motion } from "./worker.js" */

let readingStopped = false;

export const stopReading = () => void (readingStopped = true);

/** A table that states what files leave open. @type {Map<string, Stated> | null} */
let metadata = null;

/** @param {FileList | File[]} files */
export async function addFiles(files) {
  let done = 0;
  const before = new Set(rows);
  readingStopped = false;
  element("reading-cancel").hidden = files.length === 1;
  for (const file of files) {
    element("progress").textContent = files.length > 1 ? `Reading file ${++done} of ${files.length}` : "Reading";
    const inside = await worker.unpack(file.name, new Uint8Array(await file.arrayBuffer()));
    for (const one of inside) {
      if ("error" in one) rows.push(failedRow(one.name, one.error));
      else if (!takeMetadata(one.bytes)) await addFile(one.name, one.bytes);
      if (readingStopped) break;
    }
    if (readingStopped) break;
  }
  if (metadata) for (const row of rows.filter(asks)) await addFile(row.file, /** @type {Uint8Array} */ (row.bytes), {}, rows.indexOf(row));
  element("reading-cancel").hidden = true;
  // What the page showed before the first record was there is no record of its reader.
  if (rows.some((row) => slides(row) && !before.has(row))) for (const row of rows.filter(({ counts, motion }) => motion && !counts)) forget(row);
  await join();
  element("progress").textContent = "";
  select(rows.find((row) => slides(row) && !before.has(row)) ?? state.selected);
}

/** Joins the components of stations. */
async function join() {
  const found = await worker.join(rows.flatMap(({ motion }) => (motion ? [motion] : [])));
  const byId = new Map(found.map((one) => [one.id, one]));
  for (const row of rows) row.joined = row.motion && byId.get(row.motion.id);
}

/** @param {string} file  @param {string} error  @param {Uint8Array} [bytes]  @returns {Row} */
const failedRow = (file, error, bytes) => ({ label: file, file, error, counts: false, source: () => ({ files: [], python: [] }), ...(bytes ? { bytes } : {}) });

/** Whether a file is a table of metadata, which is then used for all files that leave something open. @param {Uint8Array} bytes */
function takeMetadata(bytes) {
  const found = metadataOf(new TextDecoder().decode(bytes.subarray(0, 1 << 20)));
  if (found) metadata = new Map([...(metadata ?? []), ...found]);
  return found !== null;
}

/**
 * @param {string} file
 * @param {Uint8Array} bytes
 * @param {Stated} [entered]  by the reader
 * @param {number} [place]    of the row that this replaces
 */
async function addFile(file, bytes, entered = {}, place = rows.length) {
  const row = metadata ? statedOf(metadata, file) : {};
  const { orientation = "" } = row;
  /** @type {Row[]} */
  let found;
  try {
    const motions = await worker.read(file, bytes, { ...entered, orientation }).catch((/** @type {Error} */ error) => {
      // What the file leaves open, as the table states it.
      const { units, dt } = asked(error.message);
      const stated = { ...(units && row.units ? { units: row.units } : {}), ...(dt && row.dt ? { dt: row.dt } : {}) };
      if (Object.keys(stated).length === 0) throw error;
      return worker.read(file, bytes, { ...stated, ...entered, orientation });
    });
    found = motions.map((motion) => ({
      label: motions.length > 1 ? `${file} (${motion.component || motion.number})` : file,
      file,
      motion,
      counts: true,
      source: (station) => recorded(motion, station),
    }));
  } catch (error) {
    found = [failedRow(file, /** @type {Error} */ (error).message, bytes)];
  }
  rows.splice(place, rows[place] ? 1 : 0, ...found);
  showRowsSoon();
  return found.find(slides);
}

/** @param {Row | null} row */
function select(row) {
  if (row !== state.selected) setWindow(null);
  state.selected = row;
  showRows();
  element("vertical").disabled = row?.joined?.verticalId == null;
  if (row?.motion) return changed();
  refuse("No record: drop files on the page, or choose a motion that it generates.");
  if (!element("many").hidden) slideMany();
}

export function showRows() {
  const list = element("records");
  const focused = /** @type {HTMLElement} */ (document.activeElement);
  const within = list.contains(focused);
  const joined = new Set(rows.flatMap((row) => row.joined?.members ?? []));
  const hidden = (/** @type {Row} */ { motion }) => motion?.vertical && joined.has(motion.id); // it acts with those of its station
  list.replaceChildren(...rows.filter((row) => row.motion && !hidden(row)).map(rowElement));
  const failed = rows.filter((row) => !row.motion).map(failedElement);
  if (failed.some((one, i) => one !== element("asking").children[i]) || failed.length !== element("asking").children.length)
    element("asking").replaceChildren(...failed); // with what is typed in them
  const asking = rows.filter(asks).length;
  element("asking-note").hidden = asking === 0;
  element("asking-all").hidden = asking < 2;
  if (within) (list.contains(focused) ? focused : list.querySelector("[type=radio]:checked"))?.focus();
}

let rowsWait = false;

/** Once for many files. */
function showRowsSoon() {
  if (rowsWait) return;
  rowsWait = true;
  setTimeout(() => {
    rowsWait = false;
    showRows();
  }, 100);
}

/** @param {Row} row */
function removeButton(row) {
  const remove = make("button", { type: "button", textContent: "\u00d7", onclick: () => removeRow(row) });
  remove.setAttribute("aria-label", `Remove ${row.label}`);
  return remove;
}

/** @param {Row} row */
function failedElement(row) {
  if (row.failed) return row.failed;
  row.failed = make("li", { className: "failed" }, make("b", {}, row.label), removeButton(row), make("p", {}, reason(row)));
  if (asks(row)) row.failed.append(retryForm(row));
  row.failed.classList.toggle("asks", asks(row));
  return row.failed;
}

/** @param {Row} row */
function rowElement(row) {
  const { measures, vertical, orientation } = /** @type {Motion} */ (row.motion);
  if (vertical) {
    const note = `vertical (${orientation}): left out; it acts once a horizontal component of its station is here`;
    return make("li", { className: "aside" }, make("span", {}, `${row.label} `, make("small", {}, note)), removeButton(row));
  }
  const radio = make("input", { type: "radio", name: "record", checked: row === state.selected, onchange: () => select(row) });
  const facts = [
    shown(measures.pga, "acceleration"),
    `${digits(measures.duration)} s`,
    ...(row.joined?.planarId != null ? ["path"] : []),
    ...(row.joined?.verticalId != null ? ["vertical"] : []),
    ...(row.counts ? [] : ["not in the table"]),
  ];
  return make("li", {}, make("label", {}, radio, ` ${row.label} `, make("small", {}, facts.join(", "))), removeButton(row));
}

/** Why a file could not be read, in words of this page. @param {Row} row */
const reason = ({ file, error = "" }) =>
  error
    .replace(`read_record: ${file}: `, "")
    .replace(/: pass (units|dt), .*/s, "") // the page has fields
    .replace(/; pass gaps to keep it as a straight line/, "")
    .replace(/\bdt given\b/, "the time step entered")
    .replace(/\bunits given\b/, "the units entered");

/** What a message says that a file leaves open. @param {string} message */
const asked = (message) => ({ units: /pass units/.test(message), dt: /pass dt/.test(message) });

/** Whether a file leaves its units or its time step open. @param {Row} row */
export const asks = ({ bytes, error = "" }) => bytes !== undefined && Object.values(asked(error)).some(Boolean);

/**
 * Asks for what a file leaves open.
 * @param {Row} row
 */
function retryForm(row) {
  const open = asked(row.error ?? "");
  const stated = metadata ? statedOf(metadata, row.file) : {};
  const choice = make("select", {}, make("option", { value: "" }, "choose"));
  for (const name of UNIT_NAMES) choice.append(make("option", {}, name));
  choice.value = stated.units ?? "";
  const dt = make("input", { type: "number", min: "0", step: "any", value: stated.dt ?? "" });
  const form = make(
    "form",
    {},
    ...(open.units ? [make("label", {}, "units ", choice)] : []),
    ...(open.dt ? [make("label", {}, "time step [s] ", dt)] : []),
    make("button", {}, "Read"),
  );
  form.onsubmit = (event) => {
    event.preventDefault();
    answer([row]);
  };
  row.entered = () => ({ ...(choice.value ? { units: choice.value } : {}), ...(dt.value ? { dt: Number(dt.value) } : {}) });
  return form;
}

export const UNIT_NAMES = ["g", "m/s^2", "cm/s^2", "mm/s^2", "ft/s^2", "in/s^2"];

/** Reads files again, each with what is entered for it. @param {Row[]} asking */
export async function answer(asking) {
  const found = [];
  for (const row of asking) {
    const entered = row.entered?.() ?? {};
    if (Object.keys(entered).length) found.push(await addFile(row.file, /** @type {Uint8Array} */ (row.bytes), entered, rows.indexOf(row)));
  }
  await join();
  const first = found.find((row) => row);
  if (first) select(first);
  else showRows();
}

/** Takes a row from the list. @param {Row} row */
function forget(row) {
  rows.splice(rows.indexOf(row), 1);
  if (row.motion) worker.discard([row.motion.id]);
  if (row === state.generated) state.generated = null;
}

/** @param {Row} row */
async function removeRow(row) {
  const place = rows.indexOf(row);
  forget(row);
  // A vertical component acts with the others of its station alone.
  for (const other of rows.filter(({ motion }) => motion?.vertical && row.joined?.members.includes(motion.id)))
    if (!rows.some((one) => one.joined?.members.includes(other.motion?.id ?? -1))) forget(other);
  await join();
  if (row === state.selected) select(rows.slice(place).find(slides) ?? rows.findLast(slides) ?? null);
  else showRows();
  if (!element("many").hidden) slideMany();
}

/** @param {import("./sources.js").Generator} made  @returns {Record<string, number>} */
const valuesOf = (made) => Object.fromEntries(made.parameters.map(({ key, value }) => [key, Number(others[key] ?? value)]));

export const generate = latest(async () => {
  const made = state.generator;
  if (!made) return;
  const values = valuesOf(made);
  try {
    const motion = await worker.generate(made.name, values);
    const old = state.generated;
    const said = made.parameters.map((one) => `${one.label} ${shown(values[one.key] ?? NaN, one.quantity ?? "none")}${one.unit ? ` ${one.unit}` : ""}`);
    state.generated = { label: `${made.label}, ${said.join(", ")}`, file: "", motion, counts: false, source: () => ({ files: [], python: made.python(values) }) };
    const aside = rows.findIndex((row) => row === old || (row.motion && !row.counts));
    const gone = aside >= 0 ? rows[aside] : undefined;
    if (gone) rows[aside] = state.generated;
    else rows.unshift(state.generated);
    if (gone?.motion) worker.discard([gone.motion.id]);
    select(state.generated);
  } catch (error) {
    refuse(/** @type {Error} */ (error).message);
  }
});

/** The record with which the page opens, if it holds one: it does not count. */
export async function showSample() {
  const { name, dt } = element("sample").dataset;
  const bytes = unpacked("sample");
  const [motion] = bytes.length ? await worker.read(name, bytes, { units: "g", dt: Number(dt) }) : [];
  if (!motion) return false;
  const source = () => ({ files: [`sample:${name}`], python: [`motion = ss.sample_record("${name}")`] });
  const row = { label: `${name.replaceAll("_", " ")} (sample record)`, file: "", motion, counts: false, source };
  rows.unshift(row);
  select(row);
  return true;
}
