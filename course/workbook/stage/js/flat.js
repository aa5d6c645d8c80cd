// A flat picture of a pane on a canvas: bodies as outlines, to scale, and what is drawn on them.

import { between, dot, hull, momentAt, turned, turnedBetween, written } from "./film.js";
import { covers, drawLabels, inSight } from "./labels.js";
import { drawArrow } from "./look.js";

const POINT = 0.25; // pixels of radius below which a ball is no more than the place of its label

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

/** Paints a pane at a time; returns the boxes of its labels, how many were wanted, and what they keep clear of. */
export function drawFlat(context, film, pane, time, options) {
  const { width, height, theme, font, hidden, trails, handles, memory } = options;
  const view = film.view;
  const frame = flatFrame(view, width, height);
  const moment = momentAt(film.times, time);
  context.fillStyle = theme.paper;
  context.fillRect(0, 0, width, height);
  const [labels, lines, bodies] = [[], [], []];
  const order = pane.solids.map((_, i) => i)
    .sort((a, b) => Number(pane.solids[b].fixed) - Number(pane.solids[a].fixed));
  if (trails) for (const body of pane.trails) drawTrail(context, film, pane, body, time, frame, theme);
  for (const body of order) drawBody(context, pane, body, moment, frame, theme, font, labels, bodies);
  for (const s of pane.segments) if (!hidden.has(s.name)) drawSegments(context, s, moment, frame, theme, labels, lines, font);
  for (const a of pane.arrows) if (!hidden.has(a.name)) drawArrows(context, a, view, moment, frame, theme, labels, lines, font);
  const surroundings = { lines, bodies, handles, bounds: [width, height], memory };
  const seen = inSight(labels, surroundings.bounds);
  return { labels: drawLabels(context, seen, theme, font, surroundings), wanted: seen.length, lines };
}

function pose(pane, body, moment) {
  return [between(pane.position, moment, 3 * body, 3), turnedBetween(pane.orientation, moment, 4 * body)];
}

function drawBody(context, pane, body, moment, frame, theme, font, labels, bodies) {
  const solid = pane.solids[body];
  const [x, q] = pose(pane, body, moment);
  const shapes = solid.parts.map((part) => ({ fixed: solid.fixed, radius: part.radius * frame.scale,
    points: hull(part.core.map((p) => frame.screen(turned(q, p).map((v, i) => v + x[i])))) }));
  const colors = solid.parts.map((part) => (solid.fixed ? theme.fixed : theme.palette[part.color]));
  shapes.forEach(({ points, radius }, k) => outline(context, points, radius, colors[k], theme, solid.fixed));
  if (!solid.fixed && solid.parts.length === 1 && solid.parts[0].core.length === 1) {
    mark(context, solid.parts[0].radius * frame.scale, frame, x, q, theme);
  }
  bodies.push(...shapes);
  if (solid.label) labels.push(nameOf(solid, body, frame.screen(x), shapes, colors[0], theme, font));
}

/** A body's name: within it where there is room, else beside it. */
function nameOf(solid, body, [x, y], shapes, fill, theme, font) {
  const inside = shapes.find(({ points: p, radius }) => covers([x - 1, y - 1, x + 1, y + 1], { points: p, radius })) || shapes[0];
  const reach = solid.parts.length === 1 && inside.points.length === 1 ? inside.radius : 0.6 * font;
  const [aside, over] = [0.3 * (solid.label.length + 2) * font + reach, 0.7 * font + reach];
  const places = [[0, 0], [0, 0.5], [0, -0.5], [0.5, 0], [-0.5, 0]].map(([a, b]) => [x + a * reach, y + b * reach]);
  return { key: `body ${body}`, text: solid.label, color: theme.ink, fill, inside, anchor: [x, y],
    places: [...places, [x + aside, y], [x - aside, y], [x, y - over], [x, y + over]] };
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
  if (points.length === 1 && radius < POINT) return;
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

function drawArrows(context, arrows, view, moment, frame, theme, labels, lines, font) {
  const width = Math.max(2, 0.17 * font);
  arrows.colors.forEach((color, k) => {
    const [start, tip, vector] = arrowEnds(arrows, k, view, moment, frame);
    drawArrow(context, start, tip, theme.palette[color], width);
    const length = Math.hypot(tip[0] - start[0], tip[1] - start[1]);
    if (length < 3) return;
    lines.push([...start, ...tip, 1.5 * width]);
    if (!arrows.numbers) return;
    const said = arrows.unit ? `${written(Math.hypot(...vector))} ${arrows.unit}` : arrows.name;
    const [ux, uy] = [(tip[0] - start[0]) / length, (tip[1] - start[1]) / length];
    const middle = [(start[0] + tip[0]) / 2, (start[1] + tip[1]) / 2];
    // Beside the arrow, as far as its words reach in that direction.
    const off = 0.95 * font;
    const [wide, high] = [0.3 * said.length * font + 0.6 * font, off];
    const aside = (far) => [far * Math.abs(uy) * wide, -far * Math.abs(ux) * high];
    const at = ([x, y], [dx, dy]) => [x + dx, y + dy];
    labels.push({ key: `${arrows.name} ${k}`, text: said, color: theme.palette[color], anchor: middle, places: [
      at(middle, aside(1)), at(middle, aside(-1)), at(tip, [ux * wide, uy * high]),
      at(tip, aside(1)), at(tip, aside(-1)), at(middle, aside(2.2)), at(middle, aside(-2.2))] });
  });
}

function drawSegments(context, segments, moment, frame, theme, labels, lines, font) {
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
    lines.push([...a, ...b, 1]);
    if (!segments.value) continue;
    const value = between(segments.value, moment, k, 1)[0];
    const [x, y] = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    labels.push({ key: `${segments.name} ${k}`, text: `${segments.name} ${written(value)} ${segments.unit}`, color, anchor: [x, y],
      places: [[x + 3 * font, y], [x - 3 * font, y], [x, y - font], [x, y + font]] });
  }
}
