// The page: what it shows, and what its reader does.

import { latest } from "./client.js";
import { listen, showForm, showGenerator, showRemarks } from "./controls.js";
import { element, make } from "./dom.js";
import { show } from "./drawing.js";
import { slideMany } from "./many.js";
import { updatePath } from "./path.js";
import { generate, showSample, UNIT_NAMES } from "./records.js";
import { LAWS } from "./settings.js";
import { GENERATORS } from "./sources.js";
import { updateResponseSpectrum, updateSliding } from "./spectra.js";
import { onChange, problemOf, refuse, settings, state, unpacked, worker } from "./state.js";

const update = latest(async () => {
  const row = state.selected;
  if (!row?.motion || state.broken) return;
  const [now, id] = problemOf(settings, row);
  const change = state.changes;
  const done = (/** @type {string} */ how) => {
    if (change === state.changes) document.body.dataset.state = how; // else the next one is coming
  };
  try {
    const found = await worker.slide(id, now);
    if (state.pinned) {
      const [others, other] = problemOf(state.pinned.settings, row);
      state.pinned.response = await worker.slide(other, others).catch(() => null);
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
  updateSliding();
  updateResponseSpectrum();
  updatePath();
  if (!element("many").hidden) slideMany();
});

async function start() {
  element("law").append(...LAWS.map(({ label }, i) => make("option", { value: String(i) }, label)));
  element("asking-units").append(...UNIT_NAMES.map((name) => make("option", {}, name)));
  element("generator-name").append(...GENERATORS.map(({ name, label }) => make("option", { value: name }, label)));
  element("mounting").open = innerWidth > 800;
  listen();
  showForm();
  showGenerator();
  state.ranges = await worker.load(unpacked("library"));
  if (!state.generator && (await showSample())) return;
  state.generator ??= GENERATORS[0];
  showGenerator();
  generate();
}

start();
