// What is written on the stage's page, by canvas and by element, with boxes in the page's pixels.
// Canvas texts are noted as they are painted, so that none is left out.
(() => {
  const painted = new Map();
  const paint = CanvasRenderingContext2D.prototype.fillText;
  CanvasRenderingContext2D.prototype.fillText = function fillText(words, x, y, ...rest) {
    paint.call(this, words, x, y, ...rest);
    if (!this.canvas.isConnected) return;
    const m = this.measureText(words);
    const corners = [[x - m.actualBoundingBoxLeft, y - m.actualBoundingBoxAscent], [x + m.actualBoundingBoxRight, y + m.actualBoundingBoxDescent]]
      .map(([a, b]) => this.getTransform().transformPoint(new DOMPoint(a, b)));
    const dense = this.canvas.width / this.canvas.clientWidth;
    const [xs, ys] = ["x", "y"].map((c) => corners.map((p) => p[c] / dense).sort((a, b) => a - b));
    if (!painted.has(this.canvas)) painted.set(this.canvas, []);
    painted.get(this.canvas).push({ text: words, size: parseFloat(this.font), box: [xs[0], ys[0], xs[1], ys[1]] });
  };

  const visible = (element) => element.checkVisibility({ visibilityProperty: true });

  function written() {
    const out = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
      const parent = node.parentElement;
      if (!node.data.trim() || !visible(parent) || parent.closest("script, style, noscript, option")) continue;
      const range = document.createRange();
      range.selectNodeContents(node);
      const size = parseFloat(getComputedStyle(parent).fontSize);
      for (const r of range.getClientRects()) {
        if (r.width < 1) continue;
        const less = Math.max(0, (r.height - 0.8 * size) / 2); // a line is higher than its letters
        out.push({ text: node.data.trim(), size, box: [r.left, r.top + less, r.right, r.bottom - less] });
      }
    }
    for (const select of document.querySelectorAll("select")) {
      if (visible(select)) out.push({ text: select.value, size: parseFloat(getComputedStyle(select).fontSize), box: [0, 0, 0, 0] });
    }
    return out;
  }

  const over = (a, b) => Math.min(a[2], b[2]) - Math.max(a[0], b[0]) > 1 && Math.min(a[3], b[3]) - Math.max(a[1], b[1]) > 1;

  function covering(texts) {
    const out = [];
    texts.forEach((a, i) => texts.slice(0, i).forEach((b) => { if (over(a.box, b.box)) out.push(`"${a.text}" over "${b.text}"`); }));
    return out;
  }

  /** Whether an arrow's line runs through a box: a point of it every half pixel. */
  function cut([left, top, right, bottom], [x, y, a, b]) {
    const steps = Math.ceil(2 * Math.hypot(a - x, b - y)) + 1;
    return Array.from({ length: steps + 1 }, (_, k) => k / steps)
      .some((p) => x + p * (a - x) > left && x + p * (a - x) < right && y + p * (b - y) > top && y + p * (b - y) < bottom);
  }

  /** What is wrong on the page when the stage shows each of these parts of its time. */
  window.faults = (parts, least) => {
    const out = [];
    const { stage } = window;
    stage.told = true; // all that is ever written
    for (const part of parts) {
      const wrong = (words) => out.push(`at ${part}: ${words}`);
      painted.clear();
      stage.clock.seek(stage.clock.first + part * (stage.clock.last - stage.clock.first));
      stage.paint();
      const sized = [...written()];
      for (const [canvas, texts] of painted) {
        if (!visible(canvas)) continue;
        const [width, height] = [canvas.clientWidth, canvas.clientHeight];
        covering(texts).forEach(wrong);
        for (const { text, box } of texts) {
          if (box[0] < -1 || box[1] < -1 || box[2] > width + 1 || box[3] > height + 1) {
            wrong(`"${text}" leaves its picture: ${box.map(Math.round)} in ${width} x ${height}`);
          }
        }
        sized.push(...texts);
      }
      covering(written()).forEach(wrong);
      stage.pictures.forEach(({ drawn: { labels, wanted, lines } }, k) => {
        if (labels.length < wanted) wrong(`${wanted - labels.length} of ${wanted} labels of picture ${k} are not there`);
        for (const { text, box } of labels) {
          for (const line of lines) if (line[4] > 1 && cut(box, line)) wrong(`"${text}" over an arrow`);
        }
      });
      for (const { text, size } of sized) if (size < least - 0.01) wrong(`"${text}" is ${size} px high`);
      const page = document.documentElement;
      if (page.scrollWidth > innerWidth) wrong(`the page is ${page.scrollWidth} px wide in ${innerWidth}`);
    }
    return out;
  };
})();
