// Words in a picture: they cover neither each other nor an arrow, and keep off bodies where there is room.

/** @typedef {[number, number, number, number]} Box left, top, right, bottom */
/** @typedef {{points: number[][], radius: number, fixed?: boolean}} Shape a convex polygon, grown by a radius */
/**
 * @typedef {{text: string, color: string, places: number[][], key: string, inside?: Shape,
 *   fill?: string, anchor: number[]}} Label places: middles (x, y) in order of preference; inside, fill: the body it names, and
 *   its colour; *   anchor: the middle of what it belongs to
 */
/** @typedef {{lines: number[][], bodies: Shape[], handles?: Shape[], taken?: Box[], bounds: [number, number], memory?: Map<string, number[]>}} Surroundings
 *   lines: x, y of both ends, and how far beside it is still the line; memory: what was chosen before, kept from picture to picture */

// What a place costs, beside one for each place that would be liked better.
const OVER_ARROW = 1000;
const OVER_LINE = 30; // a thin one, which a veil interrupts
const OVER_HANDLE = 200;
const OVER_BODY = 40;
const OVER_FIXED = 3; // a floor or a wall
const FARTHER = 4; // for each height of a line of text, once all places of its own are bad
const AS_BEFORE = 1.5; // less, for the place it had: a label that jumps to and fro cannot be read
const RING = 12;
const THIN = 1; // pixels, half as wide as a line that is no arrow

/** @param {Box} box @param {number[]} line x, y, x, y, half its width */
export function crosses([left, top, right, bottom], [x0, y0, x1, y1, wide = 0]) {
  let [from, to] = [0, 1];
  const clipped = [[x0, x1 - x0, left - wide, right + wide], [y0, y1 - y0, top - wide, bottom + wide]];
  for (const [start, way, low, high] of clipped) {
    if (Math.abs(way) < 1e-9) {
      if (start <= low || start >= high) return false;
      continue;
    }
    const [a, b] = [(low - start) / way, (high - start) / way].sort((p, q) => p - q);
    [from, to] = [Math.max(from, a), Math.min(to, b)];
  }
  return from < to;
}

/** Whether a box covers some of a body, by separating axes. @param {Box} box @param {Shape} shape */
export function covers([left, top, right, bottom], { points, radius }) {
  const corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
  const middle = [(left + right) / 2, (top + bottom) / 2];
  const toward = points.length === 1 ? [[points[0][0] - middle[0], points[0][1] - middle[1]]] : [];
  const edges = points.map((p, k) => {
    const q = points[(k + 1) % points.length];
    return [p[1] - q[1], q[0] - p[0]];
  });
  return [[1, 0], [0, 1], ...toward, ...edges].every(([a, b]) => {
    const size = Math.hypot(a, b);
    if (size < 1e-9) return true;
    const along = (list) => list.map(([x, y]) => (a * x + b * y) / size);
    const [mine, other] = [along(corners), along(points)];
    return Math.min(...mine) < Math.max(...other) + radius && Math.min(...other) - radius < Math.max(...mine);
  });
}

/** Whether a box lies within a body's outline, its corners at least. @param {Box} box @param {Shape} shape */
export function within([left, top, right, bottom], { points, radius }) {
  return [[left, top], [right, top], [right, bottom], [left, bottom]].every(([x, y]) => {
    if (points.length === 1) return Math.hypot(x - points[0][0], y - points[0][1]) <= radius;
    const sides = points.map((p, k) => {
      const q = points[(k + 1) % points.length];
      return ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / (Math.hypot(q[0] - p[0], q[1] - p[1]) || 1);
    });
    return Math.min(...sides) >= -radius || Math.max(...sides) <= radius;
  });
}

/** The box of a label's letters, without what is kept free around them. */
function letters({ width, height }, [x, y]) {
  const [a, b] = [0.5 * width - 0.08 * height, 0.3 * height];
  return [x - a, y - b, x + a, y + b];
}

const apart = (a, b) => a[2] <= b[0] || b[2] <= a[0] || a[3] <= b[1] || b[3] <= a[1];

/** Places around the first of a label's own, nearer ones first. */
function around([x, y], height) {
  const out = [];
  for (let far = 1.2; far <= 9; far += 0.65) {
    for (let k = 0; k < RING; k += 1) {
      const turn = (2 * Math.PI * k) / RING;
      out.push([x + 1.6 * far * height * Math.cos(turn), y + far * height * Math.sin(turn), far]);
    }
  }
  return out;
}

/**
 * Where labels go, each to the place that costs least; one that can only cover another is left out.
 * @param {(Label & {width: number, height: number})[]} labels @param {Surroundings} surroundings
 * @returns {(Label & {x: number, y: number, box: Box, far: number})[]} far: from its own places, in heights
 */
export function placedLabels(labels, { lines, bodies, handles = [], taken = [], bounds: [wide, high], memory }) {
  const boxes = taken.slice();
  const out = [];
  for (const label of labels) {
    const { width, height } = label;
    const seen = ([x, y]) => [Math.min(wide - width / 2 - 1, Math.max(width / 2 + 1, x)),
      Math.min(high - height / 2, Math.max(height / 2, y))];
    const before = memory && memory.get(label.key);
    let best = null;
    const tried = ([x, y], liked, far) => {
      const middle = seen([x, y]);
      const box = [middle[0] - width / 2, middle[1] - height / 2, middle[0] + width / 2, middle[1] + height / 2];
      if (!boxes.every((other) => apart(box, other))) return;
      const inside = Boolean(label.inside) && within(letters(label, middle), label.inside);
      const cost = liked + FARTHER * far
        + lines.filter((line) => crosses(box, line)).reduce((sum, [, , , , half]) => sum + (half > THIN ? OVER_ARROW : inside ? 1 : OVER_LINE), 0)
        + OVER_HANDLE * handles.filter((shape) => covers(box, shape)).length
        + (inside ? 0 : bodies.filter((shape) => covers(box, shape)).reduce((sum, { fixed }) => sum + (fixed ? OVER_FIXED : OVER_BODY), 0))
        - (before && before[0] === liked && before[1] === far ? AS_BEFORE : 0);
      if (!best || cost < best.cost) best = { x: middle[0], y: middle[1], box, cost, far, inside, choice: [liked, far] };
    };
    label.places.forEach((place, liked) => tried(place, liked, 0));
    if (!best || best.cost >= OVER_LINE) {
      around(label.anchor, height).forEach(([x, y, far], k) => tried([x, y], label.places.length + k % RING / RING, far));
    }
    if (!best) continue;
    boxes.push(best.box);
    if (memory) memory.set(label.key, best.choice);
    out.push(Object.assign({}, label, best));
  }
  return out;
}

/** Those whose body or arrow is in the picture: a name of what is outside names nothing. @param {Label[]} labels @param {[number, number]} bounds */
export function inSight(labels, [width, height]) {
  return labels.filter(({ anchor: [x, y] }) => x >= 0 && y >= 0 && x <= width && y <= height);
}

/**
 * Paints labels; returns their boxes, and what had no place.
 * @param {CanvasRenderingContext2D} context @param {Label[]} wanted @param {{veil: string, ink: string}} theme
 * @param {number} font height of letters [pixels] @param {Surroundings} surroundings
 * @returns {{text: string, box: Box}[]}
 */
export function drawLabels(context, wanted, theme, font, surroundings) {
  context.font = `${font}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  const measured = wanted.map((label) => Object.assign({}, label,
    { width: context.measureText(label.text).width + (label.inside ? 0.2 : 0.5) * font, height: 1.25 * font }));
  const placed = placedLabels(measured, surroundings);
  for (const label of placed) {
    const { box, inside, fill } = label;
    // Behind the letters, so that no thin line runs through them.
    const [left, top, right, bottom] = inside ? letters(label, [label.x, label.y]) : box;
    context.fillStyle = inside ? fill : theme.veil;
    context.fillRect(left, top, right - left, bottom - top);
    if (label.far) lead(context, label);
    context.fillStyle = inside ? inkOn(fill) : label.color;
    context.fillText(label.text, label.x, label.y);
  }
  return placed.map(({ text, box }) => ({ text, box }));
}

/** A thin line from a label that is far from what it names. */
function lead(context, { box, anchor, color }) {
  const [x, y] = anchor;
  const [a, b] = [Math.min(box[2], Math.max(box[0], x)), Math.min(box[3], Math.max(box[1], y))];
  context.strokeStyle = color;
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(a, b);
  context.lineTo(x, y);
  context.stroke();
}

/** Black or white, whichever is read better on a colour. @param {string} hex "#rrggbb" */
export function inkOn(hex) {
  const [red, green, blue] = [1, 3, 5].map((i) => {
    const v = parseInt(hex.slice(i, i + 2), 16) / 255;
    return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  });
  const light = 0.2126 * red + 0.7152 * green + 0.0722 * blue; // WCAG's relative luminance
  return 1.05 / (light + 0.05) >= (light + 0.05) / 0.055 ? "#ffffff" : "#111418";
}
