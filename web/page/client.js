// The worker, as functions that return promises.

/** @import { Calls } from "./worker.js" */

/**
 * @typedef {{[Name in keyof Calls]: (...args: Parameters<Calls[Name]>) => Promise<Awaited<ReturnType<Calls[Name]>>>}} Client
 */

/**
 * @param {string} source  of the worker
 * @returns {Client}
 */
export function startWorker(source) {
  const worker = new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
  /** @type {Map<number, {resolve: (value: any) => void, reject: (error: Error) => void}>} */
  const waiting = new Map();
  let last = 0;
  worker.onmessage = ({ data: { number, result, error } }) => {
    const { resolve, reject } = waiting.get(number) ?? {};
    waiting.delete(number);
    if (error === undefined) resolve?.(result);
    else reject?.(new Error(error));
  };
  return new Proxy(/** @type {any} */ ({}), {
    get:
      (_, call) =>
      (/** @type {any[]} */ ...args) =>
        new Promise((resolve, reject) => {
          waiting.set(++last, { resolve, reject });
          worker.postMessage({ number: last, call, args });
        }),
  });
}

/**
 * A function that runs one call at a time, and of those that come meanwhile the last only.
 * @template {any[]} A
 * @param {(...args: A) => Promise<void>} work
 * @returns {(...args: A) => void}
 */
export function latest(work) {
  /** @type {A | null} */
  let next = null;
  let busy = false;
  return async (...args) => {
    next = args;
    if (busy) return;
    busy = true;
    while (next) {
      const now = next;
      next = null;
      await work(...now);
    }
    busy = false;
  };
}
