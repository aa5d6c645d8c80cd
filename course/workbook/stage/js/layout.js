// How large pictures and charts are, in a notebook and before a room.

const LEAST_PANE = 240; // pixels, before a room
const LEAST_CHART = 10; // lines of text
const NARROW = 36; // widths of a letter's height: before a room charts then have no place beside a pane

/** Width over height of a film's pictures. @param {object} view of the film @returns {number} */
export function aspectOf(view) {
  if (view.kind === "space") return 1.35;
  const { window: w, low, high, right, up } = view;
  const size = (axis) => Math.abs(high.reduce((s, v, i) => s + (v - low[i]) * axis[i], 0));
  const aspect = w ? (w[2] - w[0]) / (w[3] - w[1]) : (size(right) || 1) / (size(up) || 1);
  return Math.min(6, Math.max(0.6, aspect));
}

/**
 * How high pictures may be, in pixels, and how many charts are seen. Before a room everything else must be on the screen too.
 * @param {{width: number, left: number, font: number, title: boolean, panes: number, charts: number, aspect: number,
 *   wide: boolean, below: boolean}} page width of the stage; left: what others leave of the screen's height;
 *   title: whether panes have one; wide: one below the other; below: charts would stand below the panes
 * @returns {{pane: number, chart: number, charts: number, below: boolean}}
 */
export function roomFor({ width, left, font, title, panes, charts: count, aspect, wide, below: wished }) {
  const titles = title ? 1.6 * font : 0;
  const least = LEAST_CHART * font;
  // Where that makes several panes larger, the charts stand beside them after all.
  const each = width / panes / aspect;
  const under = Math.max(least, (wide ? 0.47 : 0.4) * left);
  const narrow = width < NARROW * font;
  const below = !wide && (narrow || (wished && Math.min(each, left - titles - under) > 0.6 * each));
  if (!wide && !below) {
    const charts = Math.min(count, Math.max(1, Math.floor(left / least)));
    return { below, pane: Math.max(LEAST_PANE, left - titles), chart: Math.max(least, left / (charts || 1) - 8), charts };
  }
  const charts = Math.min(count, Math.max(1, Math.floor(width / (1.6 * least))));
  let chart = charts ? under : 0;
  if (wide) return { below, pane: Math.max(LEAST_PANE, (left - chart) / panes - titles), chart, charts };
  if (charts) chart = Math.max(chart, left - titles - each);
  return { below, pane: Math.max(LEAST_PANE, left - titles - chart), chart, charts };
}

/**
 * A canvas as wide as its frame, sharp on this display.
 * @param {HTMLCanvasElement} canvas @param {HTMLElement} frame @param {number} aspect @param {number} most of its height [pixels]
 * @returns {{width: number, height: number, context: CanvasRenderingContext2D}} in the page's pixels
 */
export function fitted(canvas, frame, aspect, most) {
  const width = Math.max(160, Math.floor(frame.clientWidth));
  const height = Math.round(Math.min(width / aspect, most || Infinity));
  const dense = Math.min(2, devicePixelRatio || 1);
  const [w, h] = [Math.round(width * dense), Math.round(height * dense)];
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  const context = canvas.getContext("2d");
  context.setTransform(dense, 0, 0, dense, 0, 0);
  return { width, height, context };
}
