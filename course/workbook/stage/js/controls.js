// What works a stage besides the pictures: buttons, sliders, boxes, keys; and its table of numbers.

import { slid, unslid } from "./asking.js";
import { icon, made } from "./elements.js";
import { written } from "./film.js";

const SPEEDS = [1, 0.5, 0.25, 0.1];

/** The row with the clock: its elements become the stage's playButton, scrub, now, slow, cameras and more. @param {object} stage */
export function clockRow(stage) {
  const button = (label, sign, act, key) => made("button",
    { type: "button", "aria-label": label, title: `${label} (${key})`, onclick: act, ".innerHTML": icon(sign) });
  stage.playButton = button("play", "play", () => stage.clock.toggle(), "space");
  stage.scrub = made("input", { type: "range", min: 0, max: 1000, step: 1, value: 0, class: "time", "aria-label": "time",
    oninput: () => { stage.clock.pause(); stage.clock.seek(stage.clock.first + (stage.scrub.value / 1000) * (stage.clock.last - stage.clock.first)); } });
  stage.now = made("output", { class: "now" });
  stage.slow = made("select", { "aria-label": "speed", onchange: (e) => { stage.clock.slow = Number(e.target.value); } },
    ...SPEEDS.map((value) => made("option", { value }, "")));
  stage.cameras = made("select", { "aria-label": "view from", hidden: true,
    onchange: () => stage.look(stage.cameras.value) });
  const full = button("full screen", "full", () => stage.fullScreen(), "f");
  stage.more = made("button", { type: "button", title: "another chart (c)", hidden: true, onclick: () => stage.nextChart() }, "chart");
  stage.parts.clock.append(button("back to the start", "start", () => stage.clock.reset(), "r"),
    button("a step back", "back", () => stage.clock.step(-1), "left arrow"), stage.playButton,
    button("a step on", "on", () => stage.clock.step(1), "right arrow"), stage.scrub, stage.now, stage.slow, stage.cameras, stage.more, full);
}

/**
 * A slider for each knob.
 * @param {object} stage @returns {Record<string, {knob: object, slider: HTMLInputElement, said: HTMLElement}>} by the knob's name
 */
export function knobSliders(stage) {
  const sliders = {};
  for (const knob of stage.exhibit.knobs || []) {
    const said = made("output", {});
    const step = knob.log ? 10 : Math.max(1, Math.round((1000 * knob.step) / (knob.high - knob.low)));
    const slider = made("input", { type: "range", min: 0, max: 1000, step,
      "aria-label": `${knob.label}${knob.unit ? `, ${knob.unit}` : ""}`, disabled: !stage.questions,
      oninput: () => { stage.told = true; stage.setKnobs({ [knob.name]: unslid(knob, Number(slider.value)) }); stage.ask(); } });
    sliders[knob.name] = { knob, slider, said };
    stage.parts.knobs.append(made("label", {}, made("span", {}, knob.label), slider, said));
  }
  if (stage.exhibit.film && !stage.questions) stage.parts.knobs.hidden = true;
  return sliders;
}

/** Puts values on their sliders. @param {object} sliders of `knobSliders` @param {Record<string, number>} values by the knob's name */
export function putOnSliders(sliders, values) {
  for (const [name, { knob, slider, said }] of Object.entries(sliders)) {
    slider.value = slid(knob, values[name]);
    said.textContent = `${written(values[name])} ${knob.unit || ""}`.trim();
    slider.setAttribute("aria-valuetext", said.textContent);
  }
}

/** A box for each kind of arrows and lines, and for the trails: what is shown. @param {object} stage */
export function overlayBoxes(stage) {
  const names = new Set(stage.film.panes.flatMap((p) => [...p.arrows, ...p.segments].map((a) => a.name)));
  const toggle = (name, on, act) => {
    const box = made("input", { type: "checkbox", ".checked": on, onchange: () => { act(box.checked); stage.paintSoon(); } });
    return made("label", {}, box, keyOf(stage.film, name), name);
  };
  const boxes = [...names].map((name) => toggle(name, !stage.hidden.has(name), (on) => {
    if (on) stage.hidden.delete(name); else stage.hidden.add(name);
  }));
  if (stage.film.panes.some((p) => p.trails.length)) boxes.push(toggle("trails", stage.trails, (on) => { stage.trails = on; }));
  stage.parts.overlays.replaceChildren(...boxes);
  stage.parts.overlays.hidden = !boxes.length;
}

/** The colour in which an overlay is drawn, where all of it has one. */
function keyOf(film, name) {
  const item = film.panes.flatMap((p) => [...p.arrows, ...p.segments]).find((a) => a.name === name);
  const colors = item && (item.colors ? [...new Set(item.colors)] : [item.color]);
  return colors && colors.length === 1 ? made("i", { class: "key", "data-color": colors[0] }) : null;
}

/** The key numbers of a film. @param {{panes: string[], rows: string[][]}} numbers @returns {HTMLElement} */
export function numbersTable({ panes, rows }) {
  const several = panes.length > 1;
  const head = several ? [made("tr", {}, made("th", {}), ...panes.map((p) => made("th", { scope: "col" }, p)))] : [];
  return made("table", { "aria-label": "key numbers" }, made("tbody", {}, ...head,
    ...rows.map(([name, unit, ...values]) => made("tr", {}, made("th", { scope: "row" }, name),
      ...values.map((v) => made("td", several && values.length === 1 ? { colspan: panes.length } : {}, `${v} ${unit}`.trim()))))));
}

/** What a key does to a stage, unless an element of it needs the key itself. @param {object} stage @param {KeyboardEvent} event */
export function actOnKey(stage, event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const tag = event.target.tagName;
  const sliding = tag === "INPUT" && event.target.type === "range" && event.target !== stage.scrub;
  if ((event.key.startsWith("Arrow") && (sliding || tag === "SELECT"))
    || (event.key === " " && event.target !== stage.root && tag !== "CANVAS" && event.target !== stage.scrub)) return;
  const acts = { " ": () => stage.clock.toggle(), ArrowLeft: () => stage.clock.step(-1), ArrowRight: () => stage.clock.step(1),
    r: () => stage.clock.reset(), f: () => stage.fullScreen(), c: () => stage.nextChart(), a: () => stage.showAnswer() };
  const act = acts[event.key] || (/^[1-9]$/.test(event.key) && (() => stage.choose(Number(event.key) - 1)));
  if (!act) return;
  event.preventDefault();
  act();
}
