// Colours for light and dark, and arrows, which are drawn the same way in every flat picture.

// The palette is made for white paper; on a dark page the deep tones are lifted.
const LIFTED = {
  blue: "#5bb0ea", vermillion: "#ff8b4d", green: "#35c99d", purple: "#e6a8cb",
  orange: "#f0b429", sky: "#7cc7f2", black: "#f0f0f0", grey: "#9a9fa6",
};

/** What a picture is painted with. @param {boolean} dark @param {Object<string, string>} palette */
export function themeOf(dark, palette) {
  return dark
    ? { dark, palette: Object.assign({}, palette, LIFTED), paper: "#14171c", ink: "#eceff3",
      soft: "#9aa3ad", grid: "#2c323a", fixed: "#3a414b", veil: "rgba(20,23,28,.82)" }
    : { dark, palette, paper: "#ffffff", ink: "#16191d", soft: "#5b6470", grid: "#e2e6ea",
      fixed: "#c9cfd6", veil: "rgba(255,255,255,.85)" };
}

/** Whether the page around an element is dark, by the first background that is painted. */
export function onDark(element) {
  for (let node = element; node; node = node.parentElement || (node.getRootNode() || {}).host) {
    const painted = getComputedStyle(node).backgroundColor.match(/[\d.]+/g);
    if (painted && (painted.length < 4 || Number(painted[3]) > 0.5)) {
      const [red, green, blue] = painted.map(Number);
      return 0.299 * red + 0.587 * green + 0.114 * blue < 110;
    }
  }
  return matchMedia("(prefers-color-scheme: dark)").matches;
}

/** An arrow on a canvas; a short one is all head, and keeps its direction. */
export function drawArrow(context, start, tip, color, width) {
  const dx = tip[0] - start[0];
  const dy = tip[1] - start[1];
  const length = Math.hypot(dx, dy);
  if (length < 0.5) return;
  const head = Math.min(4.2 * width, 0.6 * length);
  const half = 0.42 * head;
  const [ux, uy] = [dx / length, dy / length];
  const neck = [tip[0] - head * ux, tip[1] - head * uy];
  context.strokeStyle = color;
  context.fillStyle = color;
  context.lineWidth = Math.min(width, 0.9 * half);
  context.lineCap = "butt";
  context.beginPath();
  context.moveTo(start[0], start[1]);
  context.lineTo(neck[0] + 0.5 * ux, neck[1] + 0.5 * uy);
  context.stroke();
  context.beginPath();
  context.moveTo(tip[0], tip[1]);
  context.lineTo(neck[0] - half * uy, neck[1] + half * ux);
  context.lineTo(neck[0] + half * uy, neck[1] - half * ux);
  context.closePath();
  context.fill();
}
