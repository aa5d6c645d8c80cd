// From where a picture in space is seen, and what the hand does there.

import { lookAt, multiplied, perspective, projected, unit } from "./matrices.js";

/** @typedef {{yaw: number, pitch: number, distance: number, reach: number}} Camera angles [rad], lengths [m] */

const ANGLE = (32 * Math.PI) / 180; // from foot to top of the picture
const ROOM = 1.06; // around what is seen

/**
 * A camera that looks at the middle of the window from a preset's side, as near as shows all of it.
 * @param {object} view of the film: low, high, cameras by name @param {string} preset
 * @returns {Camera}
 */
export function cameraOf(view, preset) {
  const [direction, up] = view.cameras[preset];
  const d = unit(direction);
  const flat = up[2] === 0;
  const camera = { yaw: flat ? -Math.PI / 2 : Math.atan2(d[1], d[0]), pitch: flat ? Math.PI / 2 - 1e-3 : Math.asin(d[2]),
    reach: 0.5 * Math.hypot(...view.high.map((v, i) => v - view.low[i])) || 1 };
  const seen = lookAt(d, [0, 0, 0], flat ? up : [0, 0, 1]);
  let distance = 0;
  for (let k = 0; k < 8; k += 1) {
    const p = view.low.map((v, i) => ((k >> i) & 1 ? view.high[i] : v));
    const [x, y, z] = [0, 1, 2].map((row) => seen[row] * p[0] + seen[4 + row] * p[1] + seen[8 + row] * p[2]);
    distance = Math.max(distance, z + (ROOM * Math.max(Math.abs(x) / 1.2, Math.abs(y))) / Math.tan(ANGLE / 2));
  }
  return Object.assign(camera, { distance: distance || 1 });
}

/**
 * Where the eye is, from what it looks at [m].
 * @param {Camera} camera @param {number} aspect width over height of the picture @returns {number[]}
 */
export function eyePlace({ yaw, pitch, distance }, aspect) {
  const away = distance * Math.max(1, 1.2 / aspect);
  return [Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch)].map((v) => away * v);
}

/** From the world to the screen. @param {Camera} camera @param {number} aspect @returns {Float32Array} */
export function eyeOf(camera, aspect) {
  const eye = eyePlace(camera, aspect);
  const away = Math.hypot(...eye);
  const near = Math.max(0.02 * away, away - 4 * camera.reach);
  return multiplied(perspective(ANGLE, aspect, near, away + 4 * camera.reach), lookAt(eye, [0, 0, 0], [0, 0, 1]));
}

/** How many metres a pixel is, at one metre from the eye. @param {number} height of the picture [pixels] */
export function pixelSize(height) {
  return (2 * Math.tan(ANGLE / 2)) / height;
}

/**
 * How a hand moves in space: where points are on the canvas, and the way from `start` along
 * the knobs' directions (one or two) whose end is nearest to a point of the canvas.
 * @param {Camera} camera @param {number} width @param {number} height of the canvas [pixels]
 * @returns {{screen: (p: number[]) => number[], dragged: (start: number[], directions: number[][], point: number[]) => number[]}}
 */
export function spaceFrame(camera, width, height) {
  const eye = eyeOf(camera, width / height);
  const screen = (p) => projected(eye, p, width, height).point;
  const dragged = (start, directions, [x, y]) => {
    const moved = [0, 0, 0];
    for (let turn = 0; turn < 6; turn += 1) { // Newton's way: the perspective is not linear
      const at = start.map((v, i) => v + moved[i]);
      const here = screen(at);
      const small = 1e-4 * camera.reach;
      const slopes = directions.map((d) => screen(at.map((v, i) => v + small * d[i])).map((v, i) => (v - here[i]) / small));
      const left = [x - here[0], y - here[1]];
      leastSquares(slopes, left).forEach((s, k) => directions[k].forEach((d, i) => { moved[i] += s * d; }));
    }
    return moved;
  };
  return { screen, dragged };
}

/** The one or two factors of plane vectors whose sum is nearest to another. */
function leastSquares(slopes, left) {
  const inner = (a, b) => a[0] * b[0] + a[1] * b[1];
  const [a, b] = slopes;
  if (!b) return [inner(a, left) / (inner(a, a) || 1)];
  // Seen from its edge a plane is a line: what lies across it cannot be taken from the picture.
  const least = 1e-3 * (inner(a, a) + inner(b, b)) || 1;
  const [aa, ab, bb] = [inner(a, a) + least, inner(a, b), inner(b, b) + least];
  const [p, q] = [inner(a, left), inner(b, left)];
  const size = aa * bb - ab * ab;
  return [(bb * p - ab * q) / size, (aa * q - ab * p) / size];
}
