// A flat picture of a pane on a canvas: bodies as outlines, to scale, and what is drawn on them.

import { between, dot, hull, momentAt, turned, turnedBetween, written } from "./film.js";
import { drawArrow, drawLabels } from "./look.js";

/**
 * How the plane of a view lies on a canvas: the whole window, to one scale, in its middle.
 * @returns {{scale: number, screen: (p: number[]) => number[],
 *   dragged: (start: number[], directions: number[][], point: number[]) => number[]}}
 */
export function flatFrame(view, width, height) {
  const across = [dot(view.low, view.right), dot(view.high, view.right)].sort((a, b) => a - b);
  const along = [dot(view.low, view.up), dot(view.high, view.up)].sort((a, b) => a - b);
  let [left, bottom, right, top] = view.window || [across[0], along[0], across[1], along[1]];
  if (!view.window) {
    const margin = 0.06 * Math.max(right - left, top - bottom) || 1;
    [left, right, bottom, top] = [left - margin, right + margin, bottom - margin, top + margin];
  }
  const scale = Math.min(width / (right - left), height / (top - bottom));
  const x0 = width / 2 - (scale * (left + right)) / 2;
  const y0 = height / 2 + (scale * (bottom + top)) / 2;
  return {
    scale,
    width,
    height,
    screen: (p) => [x0 + scale * dot(p, view.right), y0 - scale * dot(p, view.up)],
    /** The way in the plane from a place to a point of the canvas, whatever moves along it. */
    dragged: (start, directions, [x, y]) => {
      const [a, b] = [(x - x0) / scale - dot(start, view.right), (y0 - y) / scale - dot(start, view.up)];
      return view.right.map((r, i) => a * r + b * view.up[i]);
    },
  };
}

/** Paints a pane at a time; returns the boxes of its labels. */
export function drawFlat(context, film, pane, time, options) {
  const { width, height, theme, font, hidden, trails } = options;
  const view = film.view;
  const frame = flatFrame(view, width, height);
  const moment = momentAt(film.times, time);
  context.fillStyle = theme.paper;
  context.fillRect(0, 0, width, height);
  const labels = [];
  const order = pane.solids.map((_, i) => i)
    .sort((a, b) => Number(pane.solids[b].fixed) - Number(pane.solids[a].fixed));
  if (trails) for (const body of pane.trails) drawTrail(context, film, pane, body, time, frame, theme);
  for (const body of order) drawBody(context, pane, body, moment, frame, theme, font, labels);
  for (const s of pane.segments) if (!hidden.has(s.name)) drawSegments(context, s, moment, frame, theme, labels, font);
  for (const a of pane.arrows) if (!hidden.has(a.name)) drawArrows(context, a, view, moment, frame, theme, labels, font);
  const drawn = drawLabels(context, labels.filter((l) => l.onBody), theme, font, [width, height]);
  const rest = drawLabels(context, labels.filter((l) => !l.onBody), theme, font, [width, height], drawn.map((l) => l.box));
  return [...drawn, ...rest];
}

function pose(pane, body, moment) {
  return [between(pane.position, moment, 3 * body, 3), turnedBetween(pane.orientation, moment, 4 * body)];
}

function drawBody(context, pane, body, moment, frame, theme, font, labels) {
  const solid = pane.solids[body];
  const [x, q] = pose(pane, body, moment);
  for (const part of solid.parts) {
    const points = part.core.map((p) => frame.screen(turned(q, p).map((v, i) => v + x[i])));
    outline(context, hull(points), part.radius * frame.scale, solid.fixed ? theme.fixed : theme.palette[part.color], theme, solid.fixed);
  }
  if (!solid.fixed && solid.parts.length === 1 && solid.parts[0].core.length === 1) {
    mark(context, solid.parts[0].radius * frame.scale, frame, x, q, theme);
  }
  if (solid.label) {
    labels.push({ text: solid.label, color: solid.fixed ? theme.ink : "#ffffff", places: [frame.screen(x)],
      veil: false, onBody: true });
  }
}

/** A dot near the rim of a ball, so that its turning is seen. */
function mark(context, radius, frame, x, q, theme) {
  if (Math.abs(q[0]) + Math.abs(q[1]) + Math.abs(q[2]) < 1e-9 || radius < 8) return;
  const [a, b] = [frame.screen(x), frame.screen(turned(q, [0.7, 0, 0]).map((v, i) => x[i] + v))];
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
  context.fillStyle = theme.paper;
  context.beginPath();
  context.arc(a[0] + (0.7 * radius * (b[0] - a[0])) / length, a[1] + (0.7 * radius * (b[1] - a[1])) / length,
    Math.max(2, 0.1 * radius), 0, 7);
  context.fill();
}

/** A polygon grown by a radius: filled, with an edge of its own outside. */
function outline(context, points, radius, color, theme, fixed) {
  const path = () => {
    context.beginPath();
    if (points.length === 1) context.arc(points[0][0], points[0][1], Math.max(radius, 0.5), 0, 7);
    else {
      points.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
      context.closePath();
    }
  };
  context.lineJoin = "round";
  context.lineCap = "round";
  const edge = fixed ? theme.soft : theme.ink;
  path();
  if (points.length === 1) {
    context.fillStyle = color;
    context.fill();
    context.strokeStyle = edge;
    context.lineWidth = 1;
    context.stroke();
    return;
  }
  context.strokeStyle = edge;
  context.lineWidth = 2 * radius + 1.5;
  context.stroke();
  context.fillStyle = color;
  context.fill();
  if (radius > 0) {
    context.strokeStyle = color;
    context.lineWidth = 2 * radius;
    context.stroke();
  }
  if (fixed) hatch(context, path, theme);
}

function hatch(context, path, theme) {
  context.save();
  path();
  context.clip();
  const { width, height } = context.canvas;
  context.strokeStyle = theme.soft;
  context.globalAlpha = 0.45;
  context.lineWidth = 1;
  context.beginPath();
  for (let k = -height; k < width; k += 9) {
    context.moveTo(k, height);
    context.lineTo(k + height, 0);
  }
  context.stroke();
  context.restore();
}

function drawTrail(context, film, pane, body, time, frame, theme) {
  const last = momentAt(film.times, time);
  context.strokeStyle = theme.palette[pane.solids[body].parts[0].color];
  context.globalAlpha = 0.55;
  context.lineWidth = 1.5;
  context.lineJoin = "round";
  context.beginPath();
  const step = Math.max(1, Math.floor(last.index / 2000));
  for (let k = 0; k <= last.index; k += step) {
    const [x, y] = frame.screen(between(pane.position, { index: k, part: 0 }, 3 * body, 3));
    if (k) context.lineTo(x, y); else context.moveTo(x, y);
  }
  context.lineTo(...frame.screen(between(pane.position, last, 3 * body, 3)));
  context.stroke();
  context.globalAlpha = 1;
}

/** Start and tip of an arrow on the canvas. */
export function arrowEnds(arrows, k, view, moment, frame) {
  const lift = arrows.lift[k];
  const start = between(arrows.at, moment, 3 * k, 3).map((v, i) => v + lift * view.up[i]);
  // A jump is not smeared out: an arrow holds its value until the next moment of a jump.
  const vector = between(arrows.vector, moment, 3 * k, 3);
  return [frame.screen(start), frame.screen(start.map((v, i) => v + arrows.scale * vector[i])), vector];
}

/** The tip of an arrow in the world: what a hand holds. */
export function arrowTip(arrows, k, view, moment) {
  const lift = view.up ? arrows.lift[k] : 0;
  const vector = between(arrows.vector, moment, 3 * k, 3);
  return between(arrows.at, moment, 3 * k, 3).map((v, i) => v + arrows.scale * vector[i] + (lift && lift * view.up[i]));
}

function drawArrows(context, arrows, view, moment, frame, theme, labels, font) {
  const width = Math.max(2, 0.17 * font);
  arrows.colors.forEach((color, k) => {
    const [start, tip, vector] = arrowEnds(arrows, k, view, moment, frame);
    drawArrow(context, start, tip, theme.palette[color], width);
    const length = Math.hypot(tip[0] - start[0], tip[1] - start[1]);
    if (!arrows.numbers || length < 3) return;
    const said = arrows.unit ? `${written(Math.hypot(...vector))} ${arrows.unit}` : arrows.name;
    const [ux, uy] = [(tip[0] - start[0]) / length, (tip[1] - start[1]) / length];
    const middle = [(start[0] + tip[0]) / 2, (start[1] + tip[1]) / 2];
    // Beside the arrow, as far as its words reach in that direction.
    const off = 0.95 * font;
    const [wide, high] = [0.3 * said.length * font + 0.6 * font, off];
    const aside = (far) => [far * Math.abs(uy) * wide, -far * Math.abs(ux) * high];
    const at = ([x, y], [dx, dy]) => [x + dx, y + dy];
    labels.push({ text: said, color: theme.palette[color], places: [
      at(middle, aside(1)), at(middle, aside(-1)), at(tip, [ux * wide, uy * high]),
      at(tip, aside(1)), at(tip, aside(-1)), at(middle, aside(2.2)), at(middle, aside(-2.2))] });
  });
}

function drawSegments(context, segments, moment, frame, theme, labels, font) {
  const count = segments.start.stride / 3;
  const color = theme.palette[segments.color];
  context.strokeStyle = color;
  context.lineWidth = 2;
  for (let k = 0; k < count; k += 1) {
    const a = frame.screen(between(segments.start, moment, 3 * k, 3));
    const b = frame.screen(between(segments.end, moment, 3 * k, 3));
    context.beginPath();
    context.moveTo(a[0], a[1]);
    context.lineTo(b[0], b[1]);
    context.stroke();
    if (!segments.value) continue;
    const value = between(segments.value, moment, k, 1)[0];
    const [x, y] = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    labels.push({ text: `${segments.name} ${written(value)} ${segments.unit}`, color,
      places: [[x + 3 * font, y], [x - 3 * font, y], [x, y - font], [x, y + font]] });
  }
}
