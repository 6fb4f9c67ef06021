// The page: what it shows, and what its reader does.

import "./block.js";
import "./cart.js";
import { latest } from "./client.js";
import { listen, showForm, showGenerator, showRemarks } from "./controls.js";
import { element, make } from "./dom.js";
import { show, showKind } from "./drawing.js";
import { slideMany } from "./many.js";
import { generate, showSample, UNIT_NAMES } from "./records.js";
import { kindOf, LAWS } from "./settings.js";
import "./slider.js";
import { GENERATORS } from "./sources.js";
import { updateResponseSpectrum } from "./spectra.js";
import { objects, onChange, problemOf, refuse, settings, state, unpacked, worker } from "./state.js";

const update = latest(async () => {
  const row = state.selected;
  if (!row?.motion || state.broken) return;
  const now = problemOf(settings, row)[0];
  const change = state.changes;
  const done = (/** @type {string} */ how) => {
    if (change === state.changes) document.body.dataset.state = how; // else the next one is coming
  };
  try {
    const found = await objects[kindOf(now)].respond(now, row);
    if (state.pinned) {
      const others = problemOf(state.pinned.settings, row)[0];
      state.pinned.response = await objects[kindOf(others)].respond(others, row).catch(() => null);
    }
    if (row !== state.selected || state.broken) return;
    state.response = found;
    element("trouble").textContent = "";
    done("shown");
  } catch (error) {
    if (row !== state.selected || state.broken) return;
    refuse(/** @type {Error} */ (error).message);
    done("failed");
  }
  show(now, row);
});

onChange(() => {
  state.broken = showRemarks();
  if (state.broken) {
    document.body.dataset.state = "failed";
    return refuse(state.broken);
  }
  update();
  objects[kindOf(settings)].update();
  updateResponseSpectrum();
  if (!element("many").hidden) slideMany();
});

async function start() {
  for (const [kind, label] of Object.entries({ slider: "an object that slides", block: "a block that rocks", cart: "a cart that rolls" }))
    element("law").append(
      make("optgroup", { label }, ...LAWS.flatMap((one, i) => ((one.kind ?? "slider") === kind ? [make("option", { value: String(i) }, one.label)] : []))),
    );
  element("asking-units").append(...UNIT_NAMES.map((name) => make("option", {}, name)));
  element("generator-name").append(...GENERATORS.map(({ name, label }) => make("option", { value: name }, label)));
  element("mounting").open = innerWidth > 800;
  listen();
  showForm();
  showKind();
  showGenerator();
  Object.assign(state, await worker.load(unpacked("library")));
  if (!state.generator && (await showSample())) return;
  state.generator ??= GENERATORS[0];
  showGenerator();
  generate();
}

start();
