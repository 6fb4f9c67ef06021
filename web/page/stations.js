// Which components belong to one station: the rule of `Suite.read` (python/stickslip/motions/stations.py).

/** @import { Component } from "./library.js" */

/** What a file's name may end in: an azimuth, or letters after a mark; KOBE_NIS000, NIS-UP, CPM_090. */
const ENDING = /^(?:(.*?)(?:(?<=[A-Za-z])|[-_. ])([0-3]\d\d)|(.+?)[-_. ](N|E|S|W|NS|EW|UD|UP|DN|DWN|V|VER|VERT|Z|H1|H2))$/i;

/** Two perpendicular horizontal components without an azimuth, and the angles that combine them. @type {Record<string, string>} */
const UNNAMED = { H1: "0", H2: "90" };

/**
 * Archive, folder and name of a file.
 * @param {string} file
 */
function placeOf(file) {
  const archive = file.lastIndexOf("::");
  const member = archive < 0 ? file : file.slice(archive + 2);
  const folder = member.lastIndexOf("/");
  return { archive: file.slice(0, Math.max(archive, 0)), folder: member.slice(0, Math.max(folder, 0)), name: member.slice(folder + 1) };
}

/**
 * What a file's name says of its only component; null if nothing.
 * @param {string} file
 * @returns {{station: string, component: string} | null}
 */
export function saidByName(file) {
  const stem = placeOf(file).name.replace(/(?<=.)\.[^.]*$/, "");
  const [, station, azimuth, other, letters] = ENDING.exec(stem) ?? [];
  const component = azimuth ?? letters;
  return component === undefined ? null : { station: station ?? other ?? "", component };
}

/**
 * The angle of a horizontal component that states none, but is one of a pair: H1 and H2, and SEED's BH1, HN2, BH100.
 * @param {{component: string, orientation: string}} of
 * @returns {string | undefined}
 */
export function angleInPair({ component, orientation }) {
  const numbered = /^[A-Z][HLGNM]([12])(?:\d\d)?$/.exec(component.toUpperCase());
  return orientation ? undefined : UNNAMED[numbered ? `H${numbered[1]}` : component.toUpperCase()];
}

/**
 * Components by their stations, in the order of the first ones; a component of unknown direction is alone.
 * @template {Component & {file: string, given: string}} T
 * @param {readonly T[]} parts  `given` is what the reader was told
 * @returns {T[][]}
 */
export function byStation(parts) {
  /** @type {Map<string, T[]>} */
  const groups = new Map();
  parts.forEach((part, i) => {
    const { archive, folder } = placeOf(part.file);
    const end = `, ${part.component}`;
    const station = part.component && part.name.endsWith(end) ? part.name.slice(0, -end.length) : part.name;
    const key = part.orientation ? JSON.stringify([archive, folder, station, part.sensor, part.start, part.given]) : String(i);
    groups.set(key, [...(groups.get(key) ?? []), part]);
  });
  return [...groups.values()];
}
