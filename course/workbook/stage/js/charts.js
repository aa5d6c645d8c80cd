// Charts beside a film: curves over time with the cursor in them, and one number against another.

import { momentAt, ticks, written } from "./film.js";

const ORDER = ["blue", "vermillion", "grey", "green", "purple", "orange", "sky", "black"];
const DASHES = [[], [7, 4], [2, 3], [9, 3, 2, 3]];

const finite = (list) => list.filter((v) => Number.isFinite(v));
const spread = (low, high) => (high > low ? [low, high] : [low - 0.5, low + 0.5]);

/** Lowest and highest value of a chart's curves, 0 included where areas are stacked; whole
 * powers of ten where it is logarithmic. */
export function limitsOf(chart) {
  if (chart.limits) return chart.limits;
  if (chart.logarithmic) {
    const all = finite(chart.curves.flatMap((c) => Array.from(c.values.values))).filter((v) => v > 0).map(Math.log10);
    const [low, high] = all.length ? [Math.floor(Math.min(...all)), Math.ceil(Math.max(...all))] : [-1, 0];
    return [10 ** low, 10 ** Math.max(high, low + 1)];
  }
  if (!chart.stacked) {
    const all = finite(chart.curves.flatMap((c) => Array.from(c.values.values)));
    const [low, high] = spread(Math.min(...all, Infinity), Math.max(...all, -Infinity));
    const margin = 0.06 * (high - low);
    return [low - margin, high + margin];
  }
  let top = 0;
  for (let k = 0; k < chart.curves[0].values.values.length; k += 1) {
    top = Math.max(top, chart.curves.reduce((sum, c) => sum + c.values.values[k], 0));
  }
  return [0, 1.1 * top || 1];
}

/** How far a value is from the low to the high end of an axis, 0 to 1; NaN where it has no logarithm. */
export function placeOn(value, [low, high], logarithmic = false) {
  const [a, b, v] = logarithmic ? [low, high, value].map(Math.log10) : [low, high, value];
  return Number.isFinite(v) ? (v - a) / (b - a) : NaN;
}

/** Powers of ten between two numbers, about `count` of them, and how they are written. */
export function decades(low, high, count) {
  const [first, last] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
  const step = Math.max(1, Math.ceil((last - first + 1) / Math.max(1, count)));
  const out = [];
  for (let k = last; k >= first; k -= step) out.push(10 ** k);
  return out.reverse();
}

export function tenTo(value) {
  const raised = String(Math.round(Math.log10(value))).replace(/-/, "⁻").replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]);
  return `10${raised}`;
}

const LEAST_PLOT = 4; // heights of a letter

/**
 * How much higher than its width asks for a chart has to be, for something to be seen below its names [pixels].
 * @param {CanvasRenderingContext2D} context @param {object} chart @param {number} width @param {number} height @param {number} font
 */
export function heightMissing(context, chart, width, height, font) {
  context.font = `${font}px system-ui, sans-serif`;
  const rows = chart.kind === "path" && height < 14 * font ? 0 : legendRows(context, chart, width, font).length;
  return Math.max(0, (1.7 + 1.35 * rows + 2.7 + LEAST_PLOT) * font - height);
}

/** Paints a chart at a time; returns the boxes of its texts, and how a place in it is a time. */
export function drawChart(context, chart, film, time, options) {
  const { width, height, theme, font } = options;
  context.fillStyle = theme.paper;
  context.fillRect(0, 0, width, height);
  context.font = `${font}px system-ui, sans-serif`;
  const texts = [];
  const text = (words, x, y, align, color = theme.ink) => {
    context.textAlign = align;
    context.textBaseline = "middle";
    context.fillStyle = color;
    context.fillText(words, x, y);
    const w = context.measureText(words).width;
    const left = align === "left" ? x : align === "right" ? x - w : x - w / 2;
    texts.push({ text: words, box: [left, y - 0.6 * font, left + w, y + 0.6 * font] });
  };
  const path = chart.kind === "path";
  // A small picture of two numbers needs its place for itself.
  const legend = path && height < 14 * font ? [] : legendRows(context, chart, width, font);
  const box = { left: (path ? 4.6 : 3.6) * font, top: 1.7 * font + 1.35 * font * legend.length, right: width - 0.8 * font,
    bottom: height - 2.7 * font };
  const axes = path ? pathAxes(chart) : {
    x: spread(film.times[0], film.times[film.times.length - 1]), y: limitsOf(chart),
    across: "time [s]", up: chart.unit };
  if (path && chart.equal) widen(axes, box);
  const at = {
    x: (v) => box.left + ((v - axes.x[0]) / (axes.x[1] - axes.x[0])) * (box.right - box.left),
    y: (v) => box.bottom - placeOn(v, axes.y, chart.logarithmic) * (box.bottom - box.top),
  };
  const unit = path ? "" : chart.unit && ` [${chart.unit}]`;
  text(`${chart.title}${unit}`, width / 2, 0.85 * font, "center");
  drawLegend(context, legend, theme, font, text);
  drawAxes(context, Object.assign(axes, { logarithmic: chart.logarithmic }), at, box, theme, font, text);
  context.save();
  context.beginPath();
  context.rect(box.left, box.top - 2, box.right - box.left, box.bottom - box.top + 4);
  context.clip();
  const { until = Infinity } = options;
  if (path) drawPath(context, chart, film, time, at, theme, until);
  else {
    context.save();
    if (until < axes.x[1]) {
      context.beginPath(); // curves end where nothing has been played yet
      context.rect(0, 0, at.x(Math.max(until, time)) + 1, height);
      context.clip();
    }
    drawCurves(context, chart, film, at, theme);
    context.restore();
    drawCursor(context, chart, film, time, at, box, theme);
  }
  context.restore();
  return { texts, timeAt: path ? null : (x) => axes.x[0]
    + ((x - box.left) / (box.right - box.left)) * (axes.x[1] - axes.x[0]) };
}

export function pathAxes(chart) {
  if (chart.limits) {
    const [left, bottom, right, top] = chart.limits;
    return { x: [left, right], y: [bottom, top], across: chart.across, up: chart.up };
  }
  const all = { x: Array.from(chart.x.values), y: Array.from(chart.y.values) };
  for (const guide of chart.guides) for (const [x, y] of guide.points) { all.x.push(x); all.y.push(y); }
  const around = (list) => {
    const values = finite(list);
    const [low, high] = spread(Math.min(...values), Math.max(...values));
    const margin = 0.08 * (high - low);
    return [low - margin, high + margin];
  };
  return { x: around(all.x), y: around(all.y), across: chart.across, up: chart.up };
}

/** The same scale on both axes: the shorter one is widened about its middle. */
function widen(axes, box) {
  const perX = (box.right - box.left) / (axes.x[1] - axes.x[0]);
  const perY = (box.bottom - box.top) / (axes.y[1] - axes.y[0]);
  const [name, size] = perX > perY ? ["x", (box.right - box.left) / perY] : ["y", (box.bottom - box.top) / perX];
  const middle = (axes[name][0] + axes[name][1]) / 2;
  axes[name] = [middle - size / 2, middle + size / 2];
}

function drawAxes(context, axes, at, box, theme, font, text) {
  context.lineWidth = 1;
  context.strokeStyle = theme.grid;
  const across = ticks(axes.x[0], axes.x[1], Math.max(2, (box.right - box.left) / (4.6 * font)));
  const rows = Math.max(2, (box.bottom - box.top) / (2.4 * font));
  const up = axes.logarithmic ? decades(axes.y[0], axes.y[1], rows) : ticks(axes.y[0], axes.y[1], rows);
  context.beginPath();
  for (const v of across) { context.moveTo(at.x(v), box.top); context.lineTo(at.x(v), box.bottom); }
  for (const v of up) { context.moveTo(box.left, at.y(v)); context.lineTo(box.right, at.y(v)); }
  context.stroke();
  context.strokeStyle = theme.soft;
  context.strokeRect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  for (const v of across) text(written(v, 6), at.x(v), box.bottom + 0.8 * font, "center", theme.soft);
  for (const v of up) text(axes.logarithmic ? tenTo(v) : written(v, 6), box.left - 0.35 * font, at.y(v), "right", theme.soft);
  text(axes.across, (box.left + box.right) / 2, box.bottom + 2 * font, "center", theme.soft);
  if (axes.across === "time [s]") return;
  context.save();
  context.translate(0.75 * font, (box.top + box.bottom) / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.fillStyle = theme.soft;
  context.fillText(axes.up, 0, 0);
  context.restore();
}

function colorOf(chart, k) {
  return (chart.colors && chart.colors[k]) || ORDER[k % ORDER.length];
}

/** The names of a chart's curves in rows that are no wider than the picture. */
function legendRows(context, chart, width, font) {
  const look = (k) => ({ dash: DASHES[k % DASHES.length], stacked: Boolean(chart.stacked) });
  const names = chart.kind === "path"
    ? chart.guides.map((g, k) => ({ name: g.name, color: "grey", ...look(k) }))
    : chart.curves.map((c, k) => ({ name: c.name, color: colorOf(chart, k), ...look(k) }));
  if (names.length < 2 && !chart.stacked && chart.kind !== "path") return names.length && names[0].name !== chart.title ? [names] : [];
  const rows = [[]];
  let used = 0;
  for (const item of names) {
    const w = context.measureText(item.name).width + 3.2 * font;
    if (used + w > width - 2 * font && rows[rows.length - 1].length) { rows.push([]); used = 0; }
    rows[rows.length - 1].push(Object.assign(item, { width: w }));
    used += w;
  }
  return rows[0].length ? rows : [];
}

function drawLegend(context, rows, theme, font, text) {
  rows.forEach((row, r) => {
    let x = 1.2 * font;
    const y = (2.1 + 1.35 * r) * font;
    for (const item of row) {
      context.strokeStyle = theme.palette[item.color];
      context.fillStyle = theme.palette[item.color];
      context.lineWidth = 2.5;
      context.setLineDash(item.stacked ? [] : item.dash);
      context.beginPath();
      if (item.stacked) context.fillRect(x, y - 0.35 * font, 1.6 * font, 0.7 * font);
      else { context.moveTo(x, y); context.lineTo(x + 1.8 * font, y); context.stroke(); }
      context.setLineDash([]);
      text(item.name, x + 2.1 * font, y, "left");
      x += item.width || context.measureText(item.name).width + 3.2 * font;
    }
  });
}

function drawCurves(context, chart, film, at, theme) {
  const times = film.times;
  if (chart.stacked) { drawAreas(context, chart, times, at, theme); return; }
  chart.curves.forEach((curve, k) => {
    context.strokeStyle = theme.palette[colorOf(chart, k)];
    context.lineWidth = 2.2;
    context.setLineDash(DASHES[k % DASHES.length]);
    context.beginPath();
    let drawing = false;
    curve.values.values.forEach((v, i) => {
      if (!Number.isFinite(at.y(v))) { drawing = false; return; }
      if (drawing) context.lineTo(at.x(times[i]), at.y(v)); else context.moveTo(at.x(times[i]), at.y(v));
      drawing = true;
    });
    context.stroke();
    context.setLineDash([]);
  });
}

/** The line at the present time, and a dot on each curve. */
function drawCursor(context, chart, film, time, at, box, theme) {
  context.strokeStyle = theme.ink;
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(at.x(time), box.top);
  context.lineTo(at.x(time), box.bottom);
  context.stroke();
  if (chart.stacked) return;
  const { index, part } = momentAt(film.times, time);
  chart.curves.forEach((curve, k) => {
    const v = curve.values.values;
    const here = v[index] + (part ? part * (v[index + 1] - v[index]) : 0);
    if (Number.isFinite(at.y(here))) disc(context, at.x(time), at.y(here), 4, theme.palette[colorOf(chart, k)]);
  });
}

function drawAreas(context, chart, times, at, theme) {
  let foot = new Float64Array(times.length);
  chart.curves.forEach((curve, k) => {
    const top = foot.map((v, i) => v + curve.values.values[i]);
    context.fillStyle = theme.palette[colorOf(chart, k)];
    context.beginPath();
    for (let i = 0; i < times.length; i += 1) context.lineTo(at.x(times[i]), at.y(top[i]));
    for (let i = times.length - 1; i >= 0; i -= 1) context.lineTo(at.x(times[i]), at.y(foot[i]));
    context.closePath();
    context.globalAlpha = 0.85;
    context.fill();
    context.globalAlpha = 1;
    foot = top;
  });
}

function drawPath(context, chart, film, time, at, theme, until) {
  context.lineWidth = 1.4;
  context.strokeStyle = theme.soft;
  const closed = chart.answers && until < Infinity;
  if (!closed) chart.guides.forEach((guide, k) => {
    context.setLineDash(DASHES[k % DASHES.length]);
    context.beginPath();
    for (const [x, y] of guide.points) context.lineTo(at.x(x), at.y(y));
    context.stroke();
  });
  context.setLineDash([]);
  const { index, part } = momentAt(film.times, time);
  const [x, y] = [chart.x.values, chart.y.values];
  context.strokeStyle = theme.palette.blue;
  context.lineWidth = 1.8;
  context.beginPath();
  for (let k = 0; k <= index; k += 1) context.lineTo(at.x(x[k]), at.y(y[k]));
  const here = [x, y].map((v) => v[index] + (part ? part * (v[index + 1] - v[index]) : 0));
  context.lineTo(at.x(here[0]), at.y(here[1]));
  context.stroke();
  if (!closed) disc(context, at.x(here[0]), at.y(here[1]), 5, theme.palette.vermillion);
}

function disc(context, x, y, radius, color) {
  context.fillStyle = color;
  context.beginPath();
  context.arc(x, y, radius, 0, 7);
  context.fill();
}
