// Times of the page in a headless Chromium, and of the library in Node: `node web/bench.js`, after script/web build.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

import { Library } from "./page/library.js";
import { NOT_GIVEN } from "./page/settings.js";

const build = new URL("../build/web/", import.meta.url);
const puppeteer = createRequire(new URL("package.json", build))("puppeteer-core");

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu"],
});
const page = await browser.newPage();
await page.setViewport({ width: 1280, height: 900 });
await page.goto(`${new URL("stickslip.html", build).href}#mu=0.1`);
await page.waitForFunction(() => document.body.dataset.state === "shown");

/** Drops files of two columns; the time until the first is drawn and all are listed [ms], and the longest pause. */
const drop = (/** @type {number} */ files, /** @type {number} */ samples) =>
  page.evaluate(
    async (/** @type {number} */ files, /** @type {number} */ samples) => {
      const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
      const transfer = new DataTransfer();
      for (let k = 0; k < files; ++k) {
        const lines = ["time (s), acceleration (m/s^2)"];
        for (let i = 0; i < samples; ++i) {
          const t = i * 0.005;
          const a = Math.exp(-(((t - 20) / 9) ** 2)) * (3 * Math.sin(7 * t + Math.sin(t)) + Math.sin((19 + k) * t));
          lines.push(`${t.toFixed(3)},${a.toFixed(6)}`);
        }
        transfer.items.add(new File([lines.join("\n")], `${k}.csv`));
      }
      const before = document.querySelectorAll("#records li").length;
      const rows = files + (/not in the table/.test(document.querySelector("#records")?.textContent ?? "") ? before - 1 : before);
      let [pause, last] = [0, performance.now()];
      const watch = setInterval(() => {
        pause = Math.max(pause, performance.now() - last);
        last = performance.now();
      });
      await frame();
      const begin = (last = performance.now());
      pause = 0;
      document.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
      const done = () =>
        document.querySelectorAll("#records li").length === rows &&
        document.querySelector("#progress")?.textContent === "" &&
        document.body.dataset.state === "shown";
      while (!done()) await new Promise((resolve) => setTimeout(resolve));
      await frame();
      clearInterval(watch);
      return { time: performance.now() - begin, pause };
    },
    files,
    samples,
  );

/** Time of a step of the slider, with its drawing [ms]: the smallest, which a busy machine disturbs least, the median and the largest. */
const steps = () =>
  page.evaluate(async () => {
    const slider = /** @type {HTMLInputElement} */ (document.querySelector("#mu-slider"));
    const times = [];
    const channel = new MessageChannel();
    for (let i = 0; i < 100; ++i) {
      slider.value = String(0.1 + 0.005 * (i % 40));
      const begin = performance.now();
      slider.dispatchEvent(new Event("input"));
      while (document.body.dataset.state !== "shown")
        await new Promise((resolve) => {
          channel.port1.onmessage = resolve;
          channel.port2.postMessage(0);
        });
      await Promise.resolve(); // uPlot draws in a microtask
      times.push(performance.now() - begin);
    }
    times.sort((a, b) => a - b);
    return { smallest: times[0] ?? 0, median: times[50] ?? 0, largest: times[99] ?? 0 };
  });

const ms = (/** @type {number} */ value) => `${value.toFixed(0)} ms`;
await drop(1, 20_000); // compiles
const one = await drop(1, 20_000);
console.log(`from drop to picture, 20,000 samples: ${ms(one.time)}; longest pause of the page ${ms(one.pause)}`);
const { smallest, median, largest } = await steps();
console.log(`step of the slider, 20,000 samples: smallest ${ms(smallest)}, median ${ms(median)}, largest ${ms(largest)}`);
const many = await drop(50, 10_000);
console.log(`50 files of 10,000 samples: ${ms(many.time)}; longest pause of the page ${ms(many.pause)}`);
await browser.close();

const library = await Library.load(readFileSync(new URL("stickslip.wasm", build)));
const motion = library.make(
  Float64Array.from({ length: 20_000 }, (_, i) => {
    const t = i * 0.005;
    return Math.exp(-(((t - 20) / 9) ** 2)) * (3 * Math.sin(7 * t + Math.sin(t)) + Math.sin(19 * t));
  }),
  0.005,
);
const mus = Float64Array.from({ length: 100 }, (_, i) => (i + 1) * 0.004);
const times = Array.from({ length: 20 }, () => {
  const begin = performance.now();
  library.spectrum(motion, { ...NOT_GIVEN, mu: 0.1 }, mus);
  return performance.now() - begin;
}).sort((a, b) => a - b);
console.log(`100 levels of a sliding spectrum, 20,000 samples, in Node: smallest ${ms(times[0] ?? 0)}, median ${ms(times[10] ?? 0)}`);
