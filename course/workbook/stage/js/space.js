// A view into space: bodies, their shadows on a ground, arrows and trails by WebGL2; measured lines
// and labels are painted above them.

import { eyeOf, eyePlace, pixelSize } from "./camera.js";
import { INSTANCE, LIGHT, sharedDrawing } from "./drawing.js";
import { between, hull, momentAt, turned, turnedBetween, written } from "./film.js";
import { drawLabels, inSight } from "./labels.js";
import { corners, cross, frameAlong, projected, putPlace, shadowOn, unit } from "./matrices.js";

const TRAIL = 1.8; // pixels
const THROUGH = 0.35; // how much is seen of an arrow that a body hides
const MOST_OF_TRAIL = 1500; // pieces

/** The colour of a palette as three numbers from 0 to 1. @param {string} hex "#rrggbb" @returns {number[]} */
export function rgb(hex) {
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
}

/** The lines of a ground plane at round distances, as wide as everything; nine numbers an end. */
function groundLines(view, color) {
  const half = 0.75 * Math.hypot(...view.high.map((v, i) => v - view.low[i])) || 1;
  const z = view.ground - 2e-3 * half;
  const power = 10 ** Math.floor(Math.log10(half / 4));
  const step = power * [5, 2, 1].find((s) => s * power <= half / 4);
  const out = [];
  const line = (a, b) => out.push(...a, z, 0, 0, 1, ...color, ...b, z, 0, 0, 1, ...color);
  [0, 1].forEach((axis) => {
    const middle = view.middle[axis];
    for (let k = Math.ceil((middle - half) / step); k * step <= middle + half; k += 1) {
      const at = k * step - middle;
      if (axis) line([-half, at], [half, at]); else line([at, -half], [at, half]);
    }
  });
  return new Float32Array(out);
}

/** The drawing of one pane in space. */
export class SpaceView {
  /** @param {() => void} again is called when it must be drawn anew */
  constructor(again) {
    Object.assign(this, { again, drawing: sharedDrawing(), meshes: [], loaded: [] });
    this.drawing.views.add(this);
  }

  /** New bodies, or the old ones in other colours. */
  #load(view, pane, theme) {
    const { drawing } = this;
    const now = [pane, theme, drawing.age];
    if (now.every((v, k) => v === this.loaded[k])) return;
    if (this.loaded[2] === drawing.age) drawing.drop(this.meshes);
    this.bodies = pane.meshes.map((m) => {
      const colors = m.colors.map((k) => rgb(m.fixed ? theme.fixed : theme.palette[m.names[k]]));
      const bodies = pane.solids.map((_, k) => k).filter((k) => pane.solids[k].mesh === pane.meshes.indexOf(m));
      const mesh = drawing.mesh(corners(m.vertices.values, m.triangles.values, colors, m.smooth), [3, 3, 3]);
      return { mesh, bodies, fixed: m.fixed, values: new Float32Array(INSTANCE * bodies.length).fill(1) };
    });
    this.ground = view.ground === null ? null : drawing.mesh(groundLines(view, rgb(theme.grid)), [3, 3, 3]);
    this.meshes = [...this.bodies.map((b) => b.mesh), ...(this.ground ? [this.ground] : [])];
    this.loaded = now;
  }

  /**
   * Paints a time onto a canvas.
   * @param {CanvasRenderingContext2D} context @param {object} film @param {object} pane @param {number} time [s]
   * @param {object} options theme, hidden (names), trails, camera, width, height, hurried
   * @returns {Float32Array} the matrix from the world to the screen
   */
  draw(context, film, pane, time, options) {
    const { theme, camera, width, height, hurried } = options;
    const { drawing } = this;
    const { gl } = drawing;
    const eye = eyeOf(camera, width / height);
    const dense = drawing.slow && !hurried ? 2 : 1;
    const [w, h] = [context.canvas.width, context.canvas.height].map((v) => dense * v);
    if (!gl || gl.isContextLost()) { sheet(context, theme, width, height, gl ? "" : "This browser draws no WebGL2."); return eye; }
    this.#load(film.view, pane, theme);
    const moment = momentAt(film.times, time);
    drawing.begin(w, h, eye, rgb(theme.paper));
    for (const { mesh, bodies, values } of this.bodies) {
      bodies.forEach((k, i) => putPlace(values, INSTANCE * i,
        between(pane.position, moment, 3 * k, 3), turnedBetween(pane.orientation, moment, 4 * k)));
      drawing.draw(mesh, values);
    }
    this.#arrows(pane, moment, options);
    if (options.trails) this.#trails(film, pane, moment, options);
    if (this.ground) this.#floor(film.view, theme, camera);
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(drawing.canvas, 0, drawing.canvas.height - h, w, h, 0, 0, context.canvas.width, context.canvas.height);
    context.restore();
    return eye;
  }

  #floor({ ground }, theme, camera) {
    const { drawing } = this;
    const { gl, uniform } = drawing;
    drawing.draw(this.ground, Float32Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1), [...rgb(theme.grid), 1], true);
    gl.uniformMatrix4fv(uniform.flatten, false, shadowOn(ground - 0.001 * camera.reach, LIGHT));
    const shadow = rgb(theme.paper).map((v) => (theme.dark ? 0.45 * v : 0.82 * v));
    for (const { mesh, fixed } of this.bodies) if (!fixed) drawing.draw(mesh, null, [...shadow, 1]);
  }

  /** Lines that bodies leave behind them, hidden where something is before them. */
  #trails(film, pane, moment, { theme, camera, width, height }) {
    const eye = eyePlace(camera, width / height);
    const wide = 0.5 * TRAIL * pixelSize(height);
    for (const body of pane.trails) {
      const step = Math.max(1, Math.floor(moment.index / MOST_OF_TRAIL));
      const points = [];
      for (let k = 0; k <= moment.index; k += step) points.push(between(pane.position, { index: k, part: 0 }, 3 * body, 3));
      points.push(between(pane.position, moment, 3 * body, 3));
      const values = strips(points, eye, wide);
      if (!values.length) continue;
      const color = rgb(theme.palette[pane.solids[body].parts[0].color]);
      const faint = rgb(theme.paper).map((v, i) => 0.35 * v + 0.65 * color[i]);
      this.drawing.draw(this.drawing.ribbon, values, [...faint, 1]);
    }
  }

  #arrows(pane, moment, { theme, hidden, camera, hurried }) {
    const thick = 0.012 * camera.reach;
    const [shafts, heads] = [[], []];
    for (const arrows of pane.arrows) {
      if (hidden.has(arrows.name)) continue;
      arrows.colors.forEach((color, k) => {
        const start = between(arrows.at, moment, 3 * k, 3);
        const vector = between(arrows.vector, moment, 3 * k, 3).map((v) => arrows.scale * v);
        const length = Math.hypot(...vector);
        if (length < 1e-4 * camera.reach) return;
        const head = Math.min(5 * thick, 0.6 * length);
        const radius = Math.min(thick, 0.2 * length);
        const [first, second, along] = frameAlong(vector);
        const neck = start.map((v, i) => v + (length - head) * along[i]);
        const paint = rgb(theme.palette[color]);
        const wide = (v, r) => v.map((c) => r * c);
        shafts.push(...wide(first, radius), ...wide(second, radius), ...wide(along, length - head), ...start, ...paint);
        heads.push(...wide(first, radius), ...wide(second, radius), ...wide(along, head), ...neck, ...paint);
      });
    }
    if (!shafts.length) return;
    const { drawing } = this;
    const both = [shafts, heads].map((values) => new Float32Array(values));
    const draw = (again) => both.forEach((values, which) => drawing.draw(drawing.arrows[which], again ? null : values));
    const through = !(drawing.slow && hurried); // where the processor draws, only of what stands
    if (through) drawing.through(THROUGH, () => draw(false));
    draw(through);
  }

  release() {
    const { drawing } = this;
    drawing.views.delete(this);
    if (drawing.gl && this.loaded[2] === drawing.age) drawing.drop(this.meshes);
    Object.assign(this, { meshes: [], loaded: [] });
  }
}

/** Strips that face the eye between points; INSTANCE numbers each. @param {number} wide half of it, at 1 m from the eye [m] */
function strips(points, eye, wide) {
  const out = [];
  for (let k = 1; k < points.length; k += 1) {
    const [a, b] = [points[k - 1], points[k]];
    const along = b.map((v, i) => v - a[i]);
    const away = eye.map((v, i) => v - a[i]);
    const aside = cross(along, away);
    if (Math.hypot(...aside) < 1e-12) continue;
    const half = wide * Math.hypot(...away);
    out.push(...unit(aside).map((v) => half * v), ...unit(away), ...along, ...a, 1, 1, 1);
  }
  return new Float32Array(out);
}

function sheet(context, theme, width, height, words) {
  context.fillStyle = theme.paper;
  context.fillRect(0, 0, width, height);
  context.fillStyle = theme.ink;
  context.fillText(words, 12, 24);
}

/**
 * What lies above the bodies: measured lines and labels.
 * @param {CanvasRenderingContext2D} context @param {object} film @param {object} pane @param {number} time [s]
 * @param {Float32Array} eye from the world to the screen @param {object} options as for `SpaceView.draw`; and font, handles, memory
 * @returns {{labels: object[], wanted: number, lines: number[][]}} boxes, how many there should be, what they keep clear of
 */
export function drawAbove(context, film, pane, time, eye, options) {
  const { width, height, theme, font, hidden, handles, memory } = options;
  const moment = momentAt(film.times, time);
  const at = (p) => projected(eye, p, width, height).point;
  const [labels, lines] = [[], []];
  pane.solids.forEach((solid, k) => {
    if (!solid.label) return;
    const [x, y] = at(between(pane.position, moment, 3 * k, 3));
    labels.push({ key: `body ${k}`, text: solid.label, color: theme.ink, anchor: [x, y],
      places: [[x, y + 1.1 * font], [x, y - 1.1 * font], [x + font, y], [x - font, y]] });
  });
  for (const s of pane.segments) if (!hidden.has(s.name)) measuredLines(context, s, moment, at, theme, font, labels, lines);
  for (const a of pane.arrows) if (!hidden.has(a.name)) arrowLabels(a, moment, at, theme, font, labels, lines);
  const bodies = labels.length ? outlines(pane, moment, at, eye, height) : [];
  const surroundings = { lines, bodies, handles, bounds: [width, height], memory };
  const seen = inSight(labels, surroundings.bounds);
  return { labels: drawLabels(context, seen, theme, font, surroundings), wanted: seen.length, lines };
}

function measuredLines(context, segments, moment, at, theme, font, labels, lines) {
  const color = theme.palette[segments.color];
  for (let k = 0; k < segments.start.stride / 3; k += 1) {
    const [a, b] = [segments.start, segments.end].map((track) => at(between(track, moment, 3 * k, 3)));
    context.strokeStyle = color;
    context.lineWidth = 2.2;
    context.beginPath();
    context.moveTo(...a);
    context.lineTo(...b);
    context.stroke();
    lines.push([...a, ...b, 1]);
    if (!segments.value) continue;
    const [x, y] = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    labels.push({ key: `${segments.name} ${k}`, color, anchor: [x, y],
      text: `${segments.name} ${written(between(segments.value, moment, k, 1)[0])} ${segments.unit}`,
      places: [[x + 3 * font, y], [x - 3 * font, y], [x, y - font], [x, y + font]] });
  }
}

function arrowLabels(arrows, moment, at, theme, font, labels, lines) {
  arrows.colors.forEach((color, k) => {
    const vector = between(arrows.vector, moment, 3 * k, 3);
    if (Math.hypot(...vector) * arrows.scale < 1e-6) return;
    const start = between(arrows.at, moment, 3 * k, 3);
    const [from, [x, y]] = [at(start), at(start.map((v, i) => v + arrows.scale * vector[i]))];
    lines.push([...from, x, y, 0.25 * font]);
    if (!arrows.numbers) return;
    const text = arrows.unit ? `${written(Math.hypot(...vector))} ${arrows.unit}` : arrows.name;
    const aside = 0.3 * (text.length + 2) * font;
    const [a, b] = [(from[0] + x) / 2, (from[1] + y) / 2];
    labels.push({ key: `${arrows.name} ${k}`, text, color: theme.palette[color], anchor: [a, b],
      places: [[x, y - font], [x, y + font], [x + aside, y], [x - aside, y], [a + aside, b], [a - aside, b]] });
  });
}

/** What bodies cover of the picture, nearly: the outline of each part. */
function outlines(pane, moment, at, eye, height) {
  return pane.solids.flatMap((solid, k) => {
    if (solid.fixed) return [];
    const [x, q] = [between(pane.position, moment, 3 * k, 3), turnedBetween(pane.orientation, moment, 4 * k)];
    const depth = eye[3] * x[0] + eye[7] * x[1] + eye[11] * x[2] + eye[15];
    return solid.parts.map((part) => ({ radius: part.radius / (pixelSize(height) * Math.max(depth, 1e-9)),
      points: hull(part.core.map((p) => at(turned(q, p).map((v, i) => v + x[i])))) }));
  });
}
