// The film's arithmetic: decoding, the moment at a time, poses between moments, outlines.
// Nothing here touches the page, so that node can test it.

/** @typedef {{kind: string, shape: number[], still: boolean, bytes: string}} Packed */
/** @typedef {{values: Float32Array|Float64Array|Uint32Array, stride: number, still: boolean, shape: number[]}} Track */

/** @param {Packed} packed @returns {Track} */
export function unpack(packed) {
  const text = atob(packed.bytes);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i += 1) bytes[i] = text.charCodeAt(i);
  const kinds = { f4: Float32Array, f8: Float64Array, u4: Uint32Array };
  const values = new kinds[packed.kind](bytes.buffer);
  const stride = packed.shape.slice(1).reduce((a, b) => a * b, 1);
  return { values, stride, still: packed.still, shape: packed.shape };
}

/** A film's JSON with its arrays unpacked. */
export function decoded(film) {
  const unpackAll = (object, names) => Object.assign({}, object,
    Object.fromEntries(names.map((name) => [name, object[name] && unpack(object[name])])));
  return Object.assign({}, film, {
    times: unpack(film.times).values,
    panes: film.panes.map((pane) => Object.assign(unpackAll(pane, ["position", "orientation"]), {
      meshes: pane.meshes.map((mesh) => unpackAll(mesh, ["vertices", "triangles"])),
      arrows: pane.arrows.map((a) => unpackAll(a, ["at", "vector"])),
      segments: pane.segments.map((s) => unpackAll(s, ["start", "end", "value"])),
    })),
    charts: film.charts.map((chart) => chart.kind === "path"
      ? unpackAll(chart, ["x", "y"])
      : Object.assign({}, chart, { curves: chart.curves.map((c) => unpackAll(c, ["values"])) })),
    counters: film.counters.map((c) => unpackAll(c, ["values"])),
  });
}

/**
 * Where a time lies among the moments: the last one not after it, and how far to the next.
 * Where a time stands twice the later moment holds.
 * @param {Float64Array} times @param {number} time @returns {{index: number, part: number}}
 */
export function momentAt(times, time) {
  let low = 0;
  let high = times.length - 1;
  if (time >= times[high]) return { index: high, part: 0 };
  if (time < times[0]) return { index: 0, part: 0 };
  while (high - low > 1) {
    const half = (low + high) >> 1;
    if (times[half] <= time) low = half; else high = half;
  }
  return { index: low, part: (time - times[low]) / (times[low + 1] - times[low]) };
}

/**
 * Numbers of a track at a moment, straight between two moments.
 * @param {Track} track @param {{index: number, part: number}} moment
 * @param {number} from first of the numbers in a moment @param {number} count how many
 */
export function between(track, moment, from, count) {
  const { values, stride, still } = track;
  const here = (still ? 0 : moment.index) * stride + from;
  const out = new Array(count);
  const move = still || moment.part === 0 ? 0 : moment.part;
  for (let i = 0; i < count; i += 1) {
    out[i] = values[here + i];
    if (move) out[i] += move * (values[here + stride + i] - values[here + i]);
  }
  return out;
}

/** The same for a quaternion (x, y, z, w): the shorter great circle, at even speed. */
export function turnedBetween(track, moment, from) {
  const a = between(track, { index: moment.index, part: 0 }, from, 4);
  if (track.still || moment.part === 0) return a;
  const b = between(track, { index: moment.index + 1, part: 0 }, from, 4);
  return slerp(a, b, moment.part);
}

/** @param {number[]} a @param {number[]} b @param {number} part */
export function slerp(a, b, part) {
  let cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const sign = cosine < 0 ? -1 : 1;
  cosine = Math.min(1, Math.abs(cosine));
  const angle = Math.acos(cosine);
  const sine = Math.sin(angle);
  // Close together the great circle is a straight line, and its sine no divisor.
  const [first, second] = sine < 1e-6
    ? [1 - part, sign * part]
    : [Math.sin((1 - part) * angle) / sine, (sign * Math.sin(part * angle)) / sine];
  const q = a.map((value, i) => first * value + second * b[i]);
  const length = Math.hypot(q[0], q[1], q[2], q[3]);
  return q.map((value) => value / length);
}

/** A vector turned by a unit quaternion (x, y, z, w). */
export function turned(q, v) {
  const [x, y, z, w] = q;
  const tx = 2 * (y * v[2] - z * v[1]);
  const ty = 2 * (z * v[0] - x * v[2]);
  const tz = 2 * (x * v[1] - y * v[0]);
  return [
    v[0] + w * tx + y * tz - z * ty,
    v[1] + w * ty + z * tx - x * tz,
    v[2] + w * tz + x * ty - y * tx,
  ];
}

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** The convex hull of points in the plane, anticlockwise (Andrew's monotone chain). */
export function hull(points) {
  const sorted = points.slice().sort((a, b) => a[0] - b[0] || a[1] - b[1])
    .filter((p, k, all) => !k || p[0] !== all[k - 1][0] || p[1] !== all[k - 1][1]);
  if (sorted.length < 3) return sorted;
  const turn = (o, a, b) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const chain = (list) => {
    const out = [];
    for (const p of list) {
      while (out.length > 1 && turn(out[out.length - 2], out[out.length - 1], p) <= 0) out.pop();
      out.push(p);
    }
    return out.slice(0, -1);
  };
  const around = [...chain(sorted), ...chain(sorted.reverse())];
  return around.length ? around : [sorted[0]];
}

/** The next moment to stop at in single steps: where something jumps, or an event, or a frame. */
export function stepped(times, events, time, direction, frame) {
  const stops = new Set(events);
  for (let k = 1; k < times.length; k += 1) if (times[k] === times[k - 1]) stops.add(times[k]);
  const wanted = time + direction * frame;
  const passed = [...stops].filter((s) => direction > 0
    ? s > time + 1e-12 && s < wanted : s < time - 1e-12 && s > wanted);
  const best = passed.length ? (direction > 0 ? Math.min(...passed) : Math.max(...passed)) : wanted;
  return Math.min(times[times.length - 1], Math.max(times[0], best));
}

/** Round steps for an axis: about `count` ticks between two numbers. */
export function ticks(low, high, count) {
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span)) return [low];
  const rough = span / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((s) => s * power >= 0.75 * rough);
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) out.push(k * step);
  return out;
}

/** A number for reading: a true minus, no -0, at most `digits` significant ones. */
export function written(value, digits = 3) {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  let text = Number(value.toPrecision(digits));
  if (text === 0) text = 0;
  const plain = Math.abs(text) >= 1e5 || (text !== 0 && Math.abs(text) < 1e-3)
    ? text.toExponential().replace("e+", "e") : String(text);
  return plain.replace(/-/g, "−");
}
