// The scene of what moves: the object that slides on its floor.

import { color } from "./plots.js";
import { LAWS } from "./settings.js";

/** @import { Settings } from "./library.js" */

let [width, height] = [0, 0];

/** Takes the size of the canvas, which to ask for at each drawing would lay the page out anew. @param {HTMLCanvasElement} canvas */
export function measureScene(canvas) {
  [width, height] = [canvas.clientWidth, canvas.clientHeight];
}

/** An empty canvas, in CSS pixels. @param {HTMLCanvasElement} canvas */
export function emptied(canvas) {
  const ratio = devicePixelRatio;
  if (width === 0) measureScene(canvas);
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const ctx = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, width, height);
  ctx.font = "11px system-ui, sans-serif";
  return { ctx, width, height };
}

/**
 * The acceleration of the ground, to the right.
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} part  of the largest
 * @param {[number, number]} [from]  default: below the floor
 * @param {number} [longest]  [pixels]
 */
export function drawArrow(ctx, part, [x, y] = [width / 2, height - 6], longest = width / 5) {
  const arrow = part * longest;
  ctx.strokeStyle = ctx.fillStyle = color("acceleration");
  ctx.lineWidth = 3;
  line(ctx, x, y, x + arrow, y);
  if (Math.abs(arrow) <= 6) return;
  const back = Math.sign(arrow) * 6;
  ctx.beginPath();
  ctx.moveTo(x + arrow + back, y);
  ctx.lineTo(x + arrow, y - 5);
  ctx.lineTo(x + arrow, y + 5);
  ctx.fill();
}

/**
 * Draws the object at a displacement.
 * @param {HTMLCanvasElement} canvas
 * @param {{settings: Settings, x: number, peak: number, acceleration: number, pga: number, ruler: {size: number, name: string}}} of
 *   displacements [m], accelerations [m/s^2]; the unit of the ruler
 */
export function drawSlider(canvas, { settings, x, peak, acceleration, pga, ruler }) {
  const { ctx } = emptied(canvas);
  const [ink, block, pale] = [color("ink"), color("displacement"), color("quiet")];
  const box = Math.min(64, width / 5);
  const room = Math.max(peak, Number.isNaN(settings.stop_gap) ? 0 : settings.stop_gap, 1e-4);
  const scale = (width / 2 - box - 8) / room; // pixels per meter
  const floor = height - 34;

  ctx.save();
  ctx.translate(width / 2, floor);
  // A steep slope would leave the canvas.
  if (!Number.isNaN(settings.slope)) ctx.rotate((Math.min(settings.slope, 12) * Math.PI) / 180);

  // The floor, and a ruler of the displacement.
  ctx.strokeStyle = ink;
  ctx.fillStyle = ink;
  ctx.lineWidth = 1.5;
  line(ctx, -width, 0, width, 0);
  ctx.lineWidth = 1;
  const step = niceStep((width / 2 / scale / ruler.size) * 0.5);
  ctx.textAlign = "center";
  for (let mark = -2; mark <= 2; ++mark) {
    const at = mark * step * ruler.size * scale;
    line(ctx, at, 0, at, 5);
    ctx.fillText(`${String(Number((mark * step).toPrecision(6))).replace("-", "\u2212")}${mark === 0 ? ` ${ruler.name}` : ""}`, at, 17);
  }

  const at = x * scale;
  if (!Number.isNaN(settings.stop_gap))
    for (const side of [-1, 1]) {
      ctx.fillStyle = ink;
      ctx.fillRect(side * (settings.stop_gap * scale + box / 2) - (side < 0 ? 5 : 0), -26, 5, 26);
    }
  ctx.strokeStyle = ink;
  if (settings.pendulum || settings.radii.length) {
    ctx.beginPath();
    ctx.moveTo(-width / 2, -14);
    ctx.quadraticCurveTo(0, 14, width / 2, -14);
    ctx.stroke();
  }
  if (!Number.isNaN(settings.period) && !settings.pendulum) {
    const [from, to] = [-width / 2 + 8, at - box / 2];
    ctx.fillRect(from - 4, -box * 0.7, 4, box * 0.7);
    ctx.beginPath();
    ctx.moveTo(from, -box / 3);
    for (let turn = 0; turn <= 12; ++turn)
      ctx.lineTo(from + ((to - from) * (turn + 0.5)) / 13, -box / 3 + (turn % 2 ? 6 : -6));
    ctx.lineTo(to, -box / 3);
    ctx.stroke();
  }
  // Where it began.
  ctx.strokeStyle = pale;
  ctx.setLineDash([4, 3]);
  ctx.strokeRect(-box / 2, -box, box, box);
  ctx.setLineDash([]);

  const wheels = LAWS[settings.law]?.name === "caster" ? 12 : 0;
  ctx.fillStyle = block;
  ctx.fillRect(at - box / 2, -box, box, box - wheels);
  ctx.fillStyle = ink;
  if (wheels)
    for (const side of [-1, 1]) {
      ctx.beginPath();
      ctx.arc(at + (side * box) / 3, -wheels / 2, wheels / 2, 0, 2 * Math.PI);
      ctx.fill();
    }
  ctx.restore();

  drawArrow(ctx, pga > 0 ? acceleration / pga : 0);
}

/** @param {CanvasRenderingContext2D} ctx  @param {number} x0  @param {number} y0  @param {number} x1  @param {number} y1 */
export function line(ctx, x0, y0, x1, y1) {
  ctx.beginPath();
  ctx.moveTo(x0, y0);
  ctx.lineTo(x1, y1);
  ctx.stroke();
}

/**
 * 1, 2 or 5 times a power of ten, at most a length.
 * @param {number} length
 */
export function niceStep(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return power * (length / power >= 5 ? 5 : length / power >= 2 ? 2 : 1);
}
