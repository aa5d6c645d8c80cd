// The stage in a page: pictures, charts, controls, hands and keys around one clock.

import { asker, draggedValue, learnedGain, slid, unslid } from "./asking.js";
import { drawChart } from "./charts.js";
import { Clock } from "./clock.js";
import { between, decoded, momentAt, written } from "./film.js";
import { arrowTip, drawFlat, flatFrame } from "./flat.js";
import { onDark, themeOf } from "./look.js";
import { SpaceView, cameraOf, drawAbove, spaceFrame } from "./space.js";

const LEAST_PANE = 240; // pixels, before a room
const LEAST_CHART = 10; // lines of text
const REST = 150; // milliseconds without a picture, after which one is drawn finely
const MOST_TRIES = 5; // films until what is held has come to where the pointer stands
const TOLD_AFTER = 2; // repetitions of a question, after which it is said that no answer comes
const UNANSWERED = "Python has not answered yet. While it runs another cell it cannot; where its kernel was started anew, run this cell again.";
const SPEEDS = [1, 0.5, 0.25, 0.1];

// Drawn, since not every machine's fonts have these signs.
const ICONS = {
  play: "M5 3l12 7-12 7z", pause: "M5 3h4v14H5zM11 3h4v14h-4z", start: "M4 3h3v14H4zM17 3v14L7 10z",
  back: "M13 4v12l-7-6zM14 4h2v12h-2z", on: "M7 4v12l7-6zM4 4h2v12H4z",
  full: "M3 3h5v2H5v3H3zM12 3h5v5h-2V5h-3zM3 12h2v3h3v2H3zM15 12h2v5h-5v-2h3z",
};

function icon(name) {
  return `<svg viewBox="0 0 20 20" width="1em" height="1em" aria-hidden="true"><path fill="currentColor" d="${ICONS[name]}"/></svg>`;
}

// What takes the keys of whoever works it. JupyterLab looks from the element that has the focus
// upward for who wants a key, and takes it itself before it comes to our root: each has to say so.
const KEYED = new Set(["button", "input", "select"]);

/** An element with attributes, properties that begin with a dot, and children. */
export function made(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  if (KEYED.has(tag)) element.setAttribute("data-lm-suppress-shortcuts", "true");
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name.startsWith(".")) element[name.slice(1)] = value;
    else if (value !== false && value !== null) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.filter((c) => c !== null && c !== undefined));
  return element;
}

/** The stage for one exhibit. `ask(values, id)` asks Python for a film; none: nobody answers. */
export class Stage {
  constructor(root, exhibit, ask = null) {
    Object.assign(this, { root, exhibit, hidden: new Set(), trails: true, pictures: [], charts: [], painting: false, seen: true });
    this.values = Object.fromEntries((exhibit.knobs || []).map((k) => [k.name, k.value]));
    this.clock = new Clock((time) => { this.#passed(time); this.paintSoon(); });
    // Where there is a question, curves and numbers wait until it has been voted on and played.
    this.told = !exhibit.question;
    this.questions = ask && asker(ask, { repeated: (times) => { if (times >= TOLD_AFTER) this.say(UNANSWERED); } });
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
      if (answers && this.held) this.#follow(this.questions.sent);
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
    this.#set(preset.values || {});
    this.clock.reset();
    this.reached = this.clock.first;
    if (preset.film) { this.receive(preset.film, null); this.clock.play(); } else { this.startsAgain = true; this.#ask(); }
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
        oninput: () => { this.told = true; this.#set({ [knob.name]: unslid(knob, Number(slider.value)) }); this.#ask(); } });
      this.sliders[knob.name] = { knob, slider, said };
      this.parts.knobs.append(made("label", {}, made("span", {}, knob.label), slider, said));
    }
    if (this.exhibit.film && !this.questions) this.parts.knobs.hidden = true;
    this.#set(this.values);
  }

  #set(values) {
    Object.assign(this.values, values);
    for (const [name, { knob, slider, said }] of Object.entries(this.sliders)) {
      slider.value = slid(knob, this.values[name]);
      said.textContent = `${written(this.values[name])} ${knob.unit || ""}`.trim();
      slider.setAttribute("aria-valuetext", said.textContent);
    }
  }

  #ask() {
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
      const picture = { k, canvas, caption, frame, figure: made("figure", {}, caption, frame), labels: [] };
      this.#hands(picture, canvas);
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
    this.wide = !space && this.#aspect() > 1.9;
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

  #aspect() {
    if (this.film.view.kind === "space") return 1.35;
    const { window: w, low, high, right, up } = this.film.view;
    const size = (axis) => Math.abs(high.reduce((s, v, i) => s + (v - low[i]) * axis[i], 0));
    const aspect = w ? (w[2] - w[0]) / (w[3] - w[1]) : (size(right) || 1) / (size(up) || 1);
    return Math.min(6, Math.max(0.6, aspect));
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
      const size = fitted(drawn.canvas, drawn.frame, 1.5, room.chart);
      Object.assign(drawn, drawChart(size.context, film.charts[k], film, clock.time,
        Object.assign({}, options, size, { font: room.large ? font : 0.9 * font })));
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
    root.labels = [...this.pictures.map((p) => p.labels), ...this.charts.map((c) => c.texts)];
    root.hands = this.pictures.map((p) => p.hands);
    root.paints = (root.paints || 0) + 1;
    root.films = this.films;
    root.now = clock.time;
    if (this.startsAgain && !this.questions.busy) { this.startsAgain = false; this.clock.play(); }
  }

  /** How high pictures may be. Before a room everything else must be on the screen too. */
  #room(font) {
    const { root, parts, exhibit } = this;
    const large = Boolean(exhibit.large) || document.fullscreenElement === root;
    root.classList.toggle("large", large);
    parts.pictures.classList.toggle("wide", this.wide);
    parts.pictures.classList.toggle("below", this.below);
    if (!large) return { large, pane: exhibit.height || 440, chart: Infinity, charts: this.charts.length };
    const others = Object.values(parts).filter((p) => p.parentElement === root && p !== parts.pictures).reduce((sum, p) => sum + p.offsetHeight, 0);
    const left = innerHeight - others - 3 * font;
    const titles = this.film.panes[0].title ? 1.6 * font : 0;
    const least = LEAST_CHART * font;
    // Where that makes several panes larger, the charts stand beside them after all.
    const each = parts.pictures.clientWidth / this.pictures.length / this.#aspect();
    const under = Math.max(least, (this.wide ? 0.47 : 0.4) * left);
    const below = this.below && Math.min(each, left - titles - under) > 0.6 * each;
    parts.pictures.classList.toggle("below", below);
    if (!this.wide && !below) {
      const charts = Math.min(this.charts.length, Math.max(1, Math.floor(left / least)));
      return { large, pane: Math.max(LEAST_PANE, left - titles), chart: Math.max(least, left / (charts || 1) - 8), charts };
    }
    const charts = Math.min(this.charts.length, Math.max(1, Math.floor(this.root.clientWidth / (1.6 * least))));
    let chart = charts ? under : 0;
    if (this.wide) return { large, pane: Math.max(LEAST_PANE, (left - chart) / this.pictures.length - titles), chart, charts };
    if (charts) chart = Math.max(chart, left - titles - each);
    return { large, pane: Math.max(LEAST_PANE, left - titles - chart), chart, charts };
  }

  /** Where not all charts have room, the next of them comes up. */
  nextChart() { this.firstChart = (this.firstChart || 0) + 1; this.paintSoon(); }

  #paintPane(picture, pane, options) {
    const { film, clock } = this;
    const size = fitted(picture.canvas, picture.frame, this.#aspect(), options.most);
    const all = Object.assign({ camera: picture.camera }, options, size);
    if (film.view.kind === "flat") {
      picture.labels = drawFlat(size.context, film, pane, clock.time, all);
    } else {
      if (!picture.space) picture.space = new SpaceView(() => this.paintSoon());
      const eye = picture.space.draw(size.context, film, pane, clock.time, all);
      picture.labels = drawAbove(size.context, film, pane, clock.time, eye, all);
    }
    this.#paintHands(picture, size, all);
  }

  // ---- hands

  /** The handles of a pane, where they are on the canvas now. */
  #handles(picture, size) {
    const pane = this.film.panes[picture.k];
    const moment = momentAt(this.film.times, this.clock.time);
    const { view } = this.film;
    const frame = view.kind === "flat" ? flatFrame(view, size.width, size.height) : spaceFrame(picture.camera, size.width, size.height);
    return (this.exhibit.hands || [])
      .filter((h) => this.questions && (h.until === null || this.clock.time <= h.until))
      .map((hand) => {
        const arrows = hand.body === null && pane.arrows.find((a) => a.name === hand.arrows);
        const place = arrows ? arrowTip(arrows, hand.index, view, moment) : between(pane.position, moment, 3 * hand.body, 3);
        // Each film counts from a middle of its own: what is compared between films is in the world.
        return { hand, frame, place: place.map((v, i) => v + view.middle[i]), at: frame.screen(place), scale: arrows ? arrows.scale : 1 };
      });
  }

  #paintHands(picture, size, { theme, font }) {
    const { context } = size;
    const handles = this.#handles(picture, size);
    picture.hands = handles.map((h) => h.at);
    for (const { hand, at } of handles) {
      const held = this.held && this.held.hand === hand;
      context.beginPath();
      context.arc(at[0], at[1], 0.5 * font + (held ? 3 : 0), 0, 7);
      context.fillStyle = theme.veil;
      context.fill();
      context.lineWidth = held ? 3 : 2;
      context.strokeStyle = theme.ink;
      context.stroke();
    }
  }

  #hands(picture, canvas) {
    const size = () => ({ width: canvas.clientWidth, height: canvas.clientHeight });
    const nearest = (event) => this.#handles(picture, size())
      .map((h) => Object.assign(h, { far: Math.hypot(h.at[0] - event.offsetX, h.at[1] - event.offsetY) }))
      .filter((h) => h.far < 26).sort((a, b) => a.far - b.far)[0];
    // A finger on a flat picture scrolls the page, unless it takes hold of something.
    canvas.addEventListener("touchstart", (event) => {
      const { left, top } = canvas.getBoundingClientRect();
      const [{ clientX, clientY }] = event.touches;
      if (nearest({ offsetX: clientX - left, offsetY: clientY - top })) event.preventDefault();
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      const found = nearest(event);
      if (found) {
        this.clock.pause();
        this.told = true;
        const { hand, place, at } = found;
        hand.gains = hand.gains || hand.knobs.map(() => 1);
        this.held = { hand, picture, place, off: [event.offsetX - at[0], event.offsetY - at[1]], point: at,
          scale: found.scale, values: Object.assign({}, this.values) };
      } else if (picture.camera) this.turning = { x: event.offsetX, y: event.offsetY };
      else return;
      event.preventDefault();
      this.root.focus({ preventScroll: true });
      canvas.setPointerCapture(event.pointerId);
      this.paintSoon();
    });
    canvas.addEventListener("pointermove", (event) => {
      if (this.held) this.#drag(event);
      else if (this.turning && picture.camera) this.#turn(event);
      else canvas.style.cursor = nearest(event) ? "grab" : picture.camera ? "move" : "default";
    });
    for (const name of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(name, () => { this.held = null; this.turning = null; this.paintSoon(); });
    }
    canvas.addEventListener("wheel", (event) => {
      if (!picture.camera || document.activeElement !== this.root) return; // else the page scrolls
      event.preventDefault();
      for (const p of this.pictures) p.camera.distance *= Math.exp(0.001 * event.deltaY);
      this.paintSoon();
    }, { passive: false });
  }

  #drag(event) {
    const { off } = this.held;
    this.held.point = [event.offsetX - off[0], event.offsetY - off[1]];
    this.held.tries = 0;
    this.#pull();
    this.#ask();
    this.paintSoon();
  }

  /** Knobs for which what is held comes to lie under the pointer; whether they are others than before. */
  #pull() {
    const { hand, picture, place, point, scale, values } = this.held;
    const { clientWidth: width, clientHeight: height } = picture.canvas;
    const { view } = this.film;
    const frame = view.kind === "flat" ? flatFrame(view, width, height) : spaceFrame(picture.camera, width, height);
    const moved = frame.dragged(place.map((v, i) => v - view.middle[i]), hand.knobs.map((k) => k.direction), point);
    const before = Object.assign({}, this.values);
    hand.knobs.forEach(({ knob: name, direction }, k) => {
      const { knob } = this.sliders[name];
      this.#set({ [name]: draggedValue(knob, values[name], moved, direction, scale, hand.gains[k]) });
    });
    return hand.knobs.some(({ knob: name }) => this.values[name] !== before[name]);
  }

  /** A film came while something is held: how well it followed, and a question more where it did not. */
  #follow(values) {
    const { held } = this;
    const { clientWidth: width, clientHeight: height } = held.picture.canvas;
    const now = this.#handles(held.picture, { width, height }).find((h) => h.hand === held.hand);
    if (!now) return;
    const moved = now.place.map((v, i) => v - held.place[i]);
    held.hand.knobs.forEach(({ knob: name, direction }, k) => {
      const { knob } = this.sliders[name];
      held.hand.gains[k] = learnedGain(held.hand.gains[k], values[name] - held.values[name], moved, direction, held.scale, knob.step);
    });
    Object.assign(held, { place: now.place, scale: now.scale, values });
    held.tries += 1;
    if (this.#pull() && held.tries < MOST_TRIES) this.#ask();
  }

  /** All panes are seen from the same side. */
  #turn(event) {
    const [dx, dy] = [event.offsetX - this.turning.x, event.offsetY - this.turning.y];
    this.turning = { x: event.offsetX, y: event.offsetY };
    for (const { camera } of this.pictures) {
      camera.yaw -= 0.008 * dx;
      camera.pitch = Math.min(1.56, Math.max(-1.56, camera.pitch + 0.008 * dy));
    }
    this.paintSoon();
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

/** Seconds of motion in one of playing, as it is said: "real time", "5 times slower". */
export function speedInWords(speed) {
  if (Math.abs(speed - 1) < 1e-9) return "real time";
  return speed < 1 ? `${written(1 / speed, 2)} times slower` : `${written(speed, 2)} times faster`;
}

/** A canvas as wide as its frame, sharp on this display; its size in the page's pixels. */
function fitted(canvas, frame, aspect, most) {
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
