// The stage in a page: pictures, charts, controls, hands and keys around one clock.

import { asker, slid, unslid } from "./asking.js";
import { cameraOf } from "./camera.js";
import { drawChart, heightMissing } from "./charts.js";
import { Clock, speedInWords } from "./clock.js";
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
const SPEEDS = [1, 0.5, 0.25, 0.1];

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
    this.#overlays();
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
    root.addEventListener("keydown", (event) => this.#key(event));
    this.parts = Object.fromEntries(["heading", "caption", "question", "pictures", "clock", "overlays", "knobs", "numbers"]
      .map((name) => [name, made("div", { class: name })]));
    root.replaceChildren(...Object.values(this.parts));
    this.parts.title = this.parts.heading.appendChild(made("span", { class: "title" }));
    this.parts.presets = this.parts.heading.appendChild(made("span", { class: "presets" }));
    this.#question();
    this.#presets();
    this.#controls();
    this.#knobs();
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

  #controls() {
    const button = (label, sign, act, key) => made("button",
      { type: "button", "aria-label": label, title: `${label} (${key})`, onclick: act, ".innerHTML": icon(sign) });
    this.playButton = button("play", "play", () => this.clock.toggle(), "space");
    this.scrub = made("input", { type: "range", min: 0, max: 1000, step: 1, value: 0, class: "time", "aria-label": "time",
      oninput: () => { this.clock.pause(); this.clock.seek(this.clock.first + (this.scrub.value / 1000) * (this.clock.last - this.clock.first)); } });
    this.now = made("output", { class: "now" });
    this.slow = made("select", { "aria-label": "speed", onchange: (e) => { this.clock.slow = Number(e.target.value); } },
      ...SPEEDS.map((value) => made("option", { value }, "")));
    this.cameras = made("select", { "aria-label": "view from", hidden: true,
      onchange: () => this.look(this.cameras.value) });
    const full = button("full screen", "full", () => this.fullScreen(), "f");
    this.more = made("button", { type: "button", title: "another chart (c)", hidden: true, onclick: () => this.nextChart() }, "chart");
    this.parts.clock.append(button("back to the start", "start", () => this.clock.reset(), "r"),
      button("a step back", "back", () => this.clock.step(-1), "left arrow"), this.playButton,
      button("a step on", "on", () => this.clock.step(1), "right arrow"), this.scrub, this.now, this.slow, this.cameras, this.more, full);
  }

  look(preset) {
    for (const picture of this.pictures) picture.camera = cameraOf(this.film.view, preset);
    this.paintSoon();
  }

  fullScreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else if (this.root.requestFullscreen) this.root.requestFullscreen();
  }

  #knobs() {
    this.sliders = {};
    for (const knob of this.exhibit.knobs || []) {
      const said = made("output", {});
      const step = knob.log ? 10 : Math.max(1, Math.round((1000 * knob.step) / (knob.high - knob.low)));
      const slider = made("input", { type: "range", min: 0, max: 1000, step,
        "aria-label": `${knob.label}${knob.unit ? `, ${knob.unit}` : ""}`, disabled: !this.questions,
        oninput: () => { this.told = true; this.setKnobs({ [knob.name]: unslid(knob, Number(slider.value)) }); this.ask(); } });
      this.sliders[knob.name] = { knob, slider, said };
      this.parts.knobs.append(made("label", {}, made("span", {}, knob.label), slider, said));
    }
    if (this.exhibit.film && !this.questions) this.parts.knobs.hidden = true;
    this.setKnobs(this.values);
  }

  /** Values onto their sliders. @param {Record<string, number>} values by the knob's name */
  setKnobs(values) {
    Object.assign(this.values, values);
    for (const [name, { knob, slider, said }] of Object.entries(this.sliders)) {
      slider.value = slid(knob, this.values[name]);
      said.textContent = `${written(this.values[name])} ${knob.unit || ""}`.trim();
      slider.setAttribute("aria-valuetext", said.textContent);
    }
  }

  /** Asks Python for the film of the present values. */
  ask() {
    if (!this.questions) return;
    this.asked = performance.now();
    this.questions.ask(Object.assign({}, this.values));
  }

  #overlays() {
    const names = new Set(this.film.panes.flatMap((p) => [...p.arrows, ...p.segments].map((a) => a.name)));
    const toggle = (name, on, act) => {
      const box = made("input", { type: "checkbox", ".checked": on, onchange: () => { act(box.checked); this.paintSoon(); } });
      return made("label", {}, box, this.#key_of(name), name);
    };
    const boxes = [...names].map((name) => toggle(name, !this.hidden.has(name), (on) => {
      if (on) this.hidden.delete(name); else this.hidden.add(name);
    }));
    if (this.film.panes.some((p) => p.trails.length)) boxes.push(toggle("trails", this.trails, (on) => { this.trails = on; }));
    this.parts.overlays.replaceChildren(...boxes);
    this.parts.overlays.hidden = !boxes.length;
  }

  /** The colour in which an overlay is drawn, where all of it has one. */
  #key_of(name) {
    const item = this.film.panes.flatMap((p) => [...p.arrows, ...p.segments]).find((a) => a.name === name);
    const colors = item && (item.colors ? [...new Set(item.colors)] : [item.color]);
    return colors && colors.length === 1 ? made("i", { class: "key", "data-color": colors[0] }) : null;
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
    const { panes, rows } = film.numbers;
    parts.numbers.hidden = !rows.length;
    parts.numbers.classList.toggle("several", panes.length > 1);
    const several = panes.length > 1;
    const head = several ? [made("tr", {}, made("th", {}), ...panes.map((p) => made("th", { scope: "col" }, p)))] : [];
    parts.numbers.replaceChildren(made("table", { "aria-label": "key numbers" }, made("tbody", {}, ...head,
      ...rows.map(([name, unit, ...values]) => made("tr", {}, made("th", { scope: "row" }, name),
        ...values.map((v) => made("td", several && values.length === 1 ? { colspan: panes.length } : {}, `${v} ${unit}`.trim())))))));
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

  // ---- keys

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const tag = event.target.tagName;
    const sliding = tag === "INPUT" && event.target.type === "range" && event.target !== this.scrub;
    if ((event.key.startsWith("Arrow") && (sliding || tag === "SELECT"))
      || (event.key === " " && event.target !== this.root && tag !== "CANVAS" && event.target !== this.scrub)) return;
    const acts = { " ": () => this.clock.toggle(), ArrowLeft: () => this.clock.step(-1), ArrowRight: () => this.clock.step(1),
      r: () => this.clock.reset(), f: () => this.fullScreen(), c: () => this.nextChart(), a: () => this.showAnswer() };
    const act = acts[event.key] || (/^[1-9]$/.test(event.key) && (() => this.choose(Number(event.key) - 1)));
    if (!act) return;
    event.preventDefault();
    act();
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
