// The stage in a page: pictures, charts, controls, hands and keys around one clock.

import { asker } from "./asking.js";
import { cameraOf } from "./camera.js";
import { drawChart, heightMissing } from "./charts.js";
import { Clock, speedInWords } from "./clock.js";
import { actOnKey, clockRow, knobSliders, numbersTable, overlayBoxes, putOnSliders } from "./controls.js";
import { icon, made } from "./elements.js";
import { between, decoded, momentAt, written } from "./film.js";
import { drawFlat } from "./flat.js";
import { Hands } from "./hands.js";
import { aspectOf, fitted, roomFor } from "./layout.js";
import { onDark, themeOf } from "./look.js";
import { SpaceView, drawAbove } from "./space.js";

const CHART_ASPECT = 1.5; // width over height
const REST = 150; // milliseconds without a picture, after which one is drawn finely
const TOLD_AFTER = 2; // repetitions of a question, after which it is said that no answer comes
const UNANSWERED = "Python has not answered yet. While it runs another cell it cannot; where its kernel was started anew, run this cell again.";

/** The stage for one exhibit. `ask(values, id)` asks Python for a film; none: nobody answers. */
export class Stage {
  constructor(root, exhibit, ask = null) {
    Object.assign(this, { root, exhibit, hidden: new Set(), trails: true, pictures: [], charts: [], painting: false, seen: true });
    this.values = Object.fromEntries((exhibit.knobs || []).map((k) => [k.name, k.value]));
    this.clock = new Clock((time) => { this.#passed(time); this.paintSoon(); });
    // Where there is a question, curves and numbers wait until it has been voted on and played.
    this.told = !exhibit.question;
    this.questions = ask && asker(ask, { repeated: (times) => { if (times >= TOLD_AFTER) this.say(UNANSWERED); } });
    this.hands = new Hands(this);
    this.#build();
    this.receive(exhibit.film, null);
    for (const { arrows, segments } of this.film.panes) {
      for (const item of [...arrows, ...segments]) if (!item.shown) this.hidden.add(item.name);
    }
    overlayBoxes(this);
    this.sizes = new ResizeObserver(() => this.paintSoon());
    this.sizes.observe(root);
    this.sight = new IntersectionObserver((found) => {
      this.seen = found[found.length - 1].isIntersecting;
      if (this.seen) this.paintSoon();
    });
    this.sight.observe(root);
    this.dark = matchMedia("(prefers-color-scheme: dark)");
    this.dark.addEventListener("change", this.repaint = () => this.paintSoon());
    this.themes = new MutationObserver(this.repaint);
    this.themes.observe(document.body, { attributes: true });
  }

  /** Another film: the answer to a question, or a preset's (`id` null). Whatever is wrong with it, the next may come. */
  receive(film, id) {
    const answers = this.questions && id !== null;
    try {
      this.#show(film);
      if (answers) this.hands.follow(this.questions.sent);
    } finally {
      if (answers) this.questions.answered(id);
    }
  }

  #show(film) {
    const before = this.film;
    this.films = (this.films || 0) + 1;
    this.film = decoded(film);
    this.clock.load(this.film);
    if (this.clock.last <= this.clock.first) this.told = true;
    if (!before || before.panes.length !== this.film.panes.length || before.charts.length !== this.film.charts.length) {
      this.#pictures();
    }
    const { view } = this.film;
    for (const picture of this.pictures) {
      if (!picture.camera && view.kind === "space") picture.camera = cameraOf(view, view.camera);
    }
    this.#words();
    this.paintSoon();
  }

  /** Words in place of the film's caption, until the next film. @param {string} words */
  say(words) { this.parts.caption.textContent = words; }

  destroy() {
    this.clock.pause();
    if (this.questions) this.questions.stop();
    clearTimeout(this.later);
    this.sizes.disconnect();
    this.sight.disconnect();
    this.themes.disconnect();
    this.dark.removeEventListener("change", this.repaint);
    for (const picture of this.pictures) if (picture.space) picture.space.release();
  }

  // ---- what stands on the page

  #build() {
    const { root, exhibit } = this;
    root.classList.add("stage");
    root.classList.toggle("large", Boolean(exhibit.large));
    root.tabIndex = 0;
    root.setAttribute("role", "group");
    root.setAttribute("aria-roledescription", "film");
    root.setAttribute("data-lm-suppress-shortcuts", "true"); // JupyterLab leaves our keys alone
    root.addEventListener("keydown", (event) => actOnKey(this, event));
    this.parts = Object.fromEntries(["heading", "caption", "question", "pictures", "clock", "overlays", "knobs", "numbers"]
      .map((name) => [name, made("div", { class: name })]));
    root.replaceChildren(...Object.values(this.parts));
    this.parts.title = this.parts.heading.appendChild(made("span", { class: "title" }));
    this.parts.presets = this.parts.heading.appendChild(made("span", { class: "presets" }));
    this.#question();
    this.#presets();
    clockRow(this);
    this.sliders = knobSliders(this);
    this.setKnobs(this.values);
  }

  #question() {
    const { question, answer } = this.exhibit;
    if (!question) return;
    this.answer = made("span", { class: "answer", hidden: true }, answer || "");
    const show = made("button", { type: "button", onclick: () => this.showAnswer(), title: "key a" }, "answer");
    this.parts.question.append(made("span", {}, question), " ", answer ? show : null, " ", this.answer);
  }

  showAnswer() {
    if (!this.answer) return;
    this.answer.hidden = !this.answer.hidden;
    this.told = true;
    this.paintSoon();
  }

  /** Charts are drawn as far as the film has been seen; at its end all is told. */
  #passed(time) {
    this.reached = Math.max(this.reached ?? time, time);
    if (time >= this.clock.last && this.clock.last > this.clock.first) this.told = true;
  }

  #presets() {
    (this.exhibit.presets || []).forEach((preset, k) => {
      const button = made("button", { type: "button", title: `key ${k + 1}`, onclick: () => this.choose(k) }, preset.label);
      this.parts.presets.append(button);
    });
  }

  /** A preset: its values on the knobs, its film from the start. */
  choose(k) {
    const preset = (this.exhibit.presets || [])[k];
    if (!preset) return;
    this.setKnobs(preset.values || {});
    this.clock.reset();
    this.reached = this.clock.first;
    if (preset.film) { this.receive(preset.film, null); this.clock.play(); } else { this.startsAgain = true; this.ask(); }
  }

  look(preset) {
    for (const picture of this.pictures) picture.camera = cameraOf(this.film.view, preset);
    this.paintSoon();
  }

  fullScreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else if (this.root.requestFullscreen) this.root.requestFullscreen();
  }

  /** Values onto their sliders. @param {Record<string, number>} values by the knob's name */
  setKnobs(values) {
    Object.assign(this.values, values);
    putOnSliders(this.sliders, this.values);
  }

  /** Asks Python for the film of the present values. */
  ask() {
    if (!this.questions) return;
    this.asked = performance.now();
    this.questions.ask(Object.assign({}, this.values));
  }

  #pictures() {
    for (const picture of this.pictures) if (picture.space) picture.space.release();
    const space = this.film.view.kind === "space";
    this.pictures = this.film.panes.map((pane, k) => {
      const canvas = made("canvas", { role: "img", class: space ? "turns" : null });
      const caption = made("figcaption", {});
      const frame = made("div", { class: "picture" }, canvas);
      const picture = { k, canvas, caption, frame, figure: made("figure", {}, caption, frame),
        memory: new Map(), drawn: { labels: [], wanted: 0, lines: [] } };
      this.hands.listen(picture);
      return picture;
    });
    this.charts = this.film.charts.map((chart, k) => {
      const canvas = made("canvas", { role: "img", "aria-label": chart.title });
      const seek = (event) => {
        if (!(event.buttons & 1) || !this.charts[k].timeAt) return;
        this.clock.pause();
        this.clock.seek(this.charts[k].timeAt(event.offsetX));
      };
      canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); seek(event); });
      canvas.addEventListener("pointermove", seek);
      return { canvas, frame: made("div", { class: "chart" }, canvas), texts: [] };
    });
    // Wide panes stand one below the other, several others beside each other: charts have their place below both.
    this.wide = !space && aspectOf(this.film.view) > 1.9;
    this.below = !this.wide && this.film.panes.length > 1;
    this.parts.pictures.replaceChildren(
      made("div", { class: "panes" }, ...this.pictures.map((p) => p.figure)),
      this.charts.length ? made("div", { class: "charts" }, ...this.charts.map((c) => c.frame)) : "");
    this.cameras.hidden = !space;
    if (space) {
      this.cameras.replaceChildren(...Object.keys(this.film.view.cameras).map((name) => made("option", { value: name }, name)));
      this.cameras.value = this.film.view.camera;
    }
  }

  #words() {
    const { parts, film, root } = this;
    parts.title.textContent = film.title;
    parts.caption.textContent = film.caption;
    for (const option of this.slow.options) option.textContent = speedInWords(film.speed * Number(option.value));
    root.setAttribute("aria-label", film.title || "film");
    for (const picture of this.pictures) {
      const pane = film.panes[picture.k];
      picture.caption.textContent = pane.title;
      picture.canvas.setAttribute("aria-label", `${pane.title ? `${pane.title}. ` : ""}${film.description}`);
    }
    parts.numbers.hidden = !film.numbers.rows.length;
    parts.numbers.classList.toggle("several", film.numbers.panes.length > 1);
    parts.numbers.replaceChildren(numbersTable(film.numbers));
  }

  // ---- painting

  /** Paint at the display's next frame, once however often this is called. */
  paintSoon() {
    if (this.painting) return;
    this.painting = true;
    requestAnimationFrame(() => { this.painting = false; this.paint(this.#hurried()); });
  }

  /** Whether pictures come so fast that they may be a little coarser; a fine one follows when they rest. */
  #hurried() {
    const now = performance.now();
    const soon = now - (this.painted ?? -Infinity) < REST;
    this.painted = now;
    clearTimeout(this.later);
    if (soon && !this.clock.playing && this.film.view.kind === "space") this.later = setTimeout(() => this.paintSoon(), 1.3 * REST);
    return soon;
  }

  paint(hurried = false) {
    // What is out of sight is painted when it is seen again.
    if (!this.root.isConnected || !this.seen) return;
    const { film, clock, root, parts } = this;
    const dark = onDark(root.parentElement || document.body);
    if (!this.theme || this.theme.dark !== dark) this.theme = themeOf(dark, film.palette);
    root.dataset.theme = dark ? "dark" : "light";
    const font = parseFloat(getComputedStyle(root).fontSize);
    for (const key of root.querySelectorAll("[data-color]")) key.style.background = this.theme.palette[key.dataset.color];
    parts.numbers.classList.toggle("waiting", !this.told);
    const until = this.told ? Infinity : this.reached ?? clock.first;
    const options = { hurried: hurried || clock.playing, until, theme: this.theme, font, hidden: this.hidden, trails: this.trails };
    const room = this.#room(font);
    for (const picture of this.pictures) this.#paintPane(picture, film.panes[picture.k], Object.assign({ most: room.pane }, options));
    const count = this.charts.length;
    this.more.hidden = room.charts >= count;
    this.charts.forEach((drawn, k) => {
      drawn.frame.hidden = (k - (this.firstChart || 0) % count + count) % count >= room.charts;
      if (drawn.frame.hidden) { drawn.texts = []; return; }
      const letters = room.large ? font : 0.9 * font;
      const width = drawn.frame.clientWidth;
      const height = Math.min(width / CHART_ASPECT, room.chart);
      const missing = heightMissing(drawn.canvas.getContext("2d"), film.charts[k], width, height, letters);
      const size = fitted(drawn.canvas, drawn.frame, width / (height + missing), Infinity);
      Object.assign(drawn, drawChart(size.context, film.charts[k], film, clock.time, Object.assign({}, options, size, { font: letters })));
    });
    const counted = film.counters.map((c) => `${c.name} ${written(between(c.values, { index: momentAt(film.times, clock.time).index, part: 0 }, 0, 1)[0], 6)}`);
    const span = clock.last - clock.first;
    const digits = span && span < 0.6 ? 3 : 2;
    this.now.textContent = [`${clock.time.toFixed(digits)} s`, ...counted].join("   ");
    this.scrub.value = span ? Math.round((1000 * (clock.time - clock.first)) / span) : 0;
    this.scrub.setAttribute("aria-valuetext", `${clock.time.toFixed(digits)} s of ${clock.last.toFixed(digits)} s`);
    const sign = clock.playing ? "pause" : "play";
    if (this.playButton.getAttribute("aria-label") !== sign) {
      this.playButton.innerHTML = icon(sign);
      this.playButton.setAttribute("aria-label", sign);
      this.playButton.title = `${sign} (space)`;
    }
    root.drawn = this.pictures.map((p) => p.drawn);
    root.labels = [...this.pictures.map((p) => p.drawn.labels), ...this.charts.map((c) => c.texts)];
    root.hands = this.pictures.map((p) => p.hands);
    root.paints = (root.paints || 0) + 1;
    root.films = this.films;
    root.now = clock.time;
    if (this.startsAgain && !this.questions.busy) { this.startsAgain = false; this.clock.play(); }
  }

  #room(font) {
    const { root, parts, exhibit } = this;
    const large = Boolean(exhibit.large) || document.fullscreenElement === root;
    root.classList.toggle("large", large);
    parts.pictures.classList.toggle("wide", this.wide);
    parts.pictures.classList.toggle("below", this.below);
    if (!large) return { large, pane: exhibit.height || 440, chart: Infinity, charts: this.charts.length };
    const others = Object.values(parts).filter((p) => p.parentElement === root && p !== parts.pictures).reduce((sum, p) => sum + p.offsetHeight, 0);
    const room = roomFor({ width: parts.pictures.clientWidth, left: innerHeight - others - 3 * font, font, title: Boolean(this.film.panes[0].title),
      panes: this.pictures.length, charts: this.charts.length, aspect: aspectOf(this.film.view), wide: this.wide, below: this.below });
    parts.pictures.classList.toggle("below", room.below);
    return { large, ...room };
  }

  /** Where not all charts have room, the next of them comes up. */
  nextChart() { this.firstChart = (this.firstChart || 0) + 1; this.paintSoon(); }

  #paintPane(picture, pane, options) {
    const { film, clock } = this;
    const size = fitted(picture.canvas, picture.frame, aspectOf(this.film.view), options.most);
    const handles = this.hands.seen(picture, size).map((h) => ({ points: [h.at], radius: 0.5 * options.font }));
    const all = Object.assign({ camera: picture.camera, handles, memory: picture.memory }, options, size);
    if (film.view.kind === "flat") {
      picture.drawn = drawFlat(size.context, film, pane, clock.time, all);
    } else {
      if (!picture.space) picture.space = new SpaceView(() => this.paintSoon());
      const eye = picture.space.draw(size.context, film, pane, clock.time, all);
      picture.drawn = drawAbove(size.context, film, pane, clock.time, eye, all);
    }
    this.hands.paint(picture, size, all);
  }


}

/** A widget's view: the exhibit from Python, films as answers to questions. */
function render({ model, el }) {
  const root = el.appendChild(document.createElement("div"));
  const ask = model.get("answers") ? (values, id) => model.send({ kind: "ask", id, values }) : null;
  const stage = new Stage(root, model.get("exhibit"), ask);
  const receive = (message) => {
    if (message.kind === "film") stage.receive(message.film, message.id);
    if (message.kind === "failed") { stage.say(message.words); stage.questions.answered(message.id); }
  };
  const replace = () => { stage.receive(model.get("exhibit").film, null); };
  model.on("msg:custom", receive);
  model.on("change:exhibit", replace);
  return () => { model.off("msg:custom", receive); model.off("change:exhibit", replace); stage.destroy(); };
}

export default { render };
