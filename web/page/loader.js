// Unpacks what the file holds packed, and starts the page.

import { decompress } from "fzstd";

import { fromText } from "./packed.js";

/** What an element holds packed; empty if nothing. @param {string} id */
function unpacked(id) {
  const text = (document.getElementById(id)?.textContent ?? "").trim();
  return /** @type {Uint8Array<ArrayBuffer>} */ (text ? decompress(fromText(text)) : new Uint8Array());
}

/** @typedef {typeof unpacked} Unpack */

Object.assign(globalThis, { unpacked }); // for the page, which then needs no second decoder
document.body.append(
  Object.assign(document.createElement("script"), {
    src: URL.createObjectURL(new Blob([unpacked("page")], { type: "text/javascript" })),
  }),
);
