// What can be taken hold of in a picture: handles that move knobs, and the camera of a view into space.

import { draggedValue, learnedGain } from "./asking.js";
import { spaceFrame } from "./camera.js";
import { between, momentAt } from "./film.js";
import { arrowTip, flatFrame } from "./flat.js";

const REACH = 26; // pixels from a handle within which it is taken
const MOST_TRIES = 5; // films until what is held has come to where the pointer stands

/** How the world lies on a picture of this size. */
function frameOf(view, camera, { width, height }) {
  return view.kind === "flat" ? flatFrame(view, width, height) : spaceFrame(camera, width, height);
}

/** The hands of a stage: one of them may hold something, `held`, or turn the camera. */
export class Hands {
  /** @param {object} stage whose film, clock, values and pictures are used, and which is asked for other films */
  constructor(stage) {
    Object.assign(this, { stage, held: null, turning: null });
  }

  /**
   * The handles of a picture, where they are on its canvas now.
   * @param {object} picture of the stage @param {{width: number, height: number}} size of its canvas [pixels]
   * @returns {{hand: object, frame: object, place: number[], at: number[], scale: number}[]} place in the world [m]
   */
  seen(picture, size) {
    const { film, clock, exhibit, questions } = this.stage;
    const pane = film.panes[picture.k];
    const moment = momentAt(film.times, clock.time);
    const { view } = film;
    const frame = frameOf(view, picture.camera, size);
    return (exhibit.hands || [])
      .filter((h) => questions && (h.until === null || clock.time <= h.until))
      .map((hand) => {
        const arrows = hand.body === null && pane.arrows.find((a) => a.name === hand.arrows);
        const place = arrows ? arrowTip(arrows, hand.index, view, moment) : between(pane.position, moment, 3 * hand.body, 3);
        // Each film counts from a middle of its own: what is compared between films is in the world.
        return { hand, frame, place: place.map((v, i) => v + view.middle[i]), at: frame.screen(place), scale: arrows ? arrows.scale : 1 };
      });
  }

  /** Paints them. @param {object} picture @param {object} size with its context @param {object} options theme, font */
  paint(picture, size, { theme, font }) {
    const { context } = size;
    const handles = this.seen(picture, size);
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

  /** The handle of a picture nearest to a point of its canvas, if one is near. */
  #nearest(picture, { offsetX, offsetY }) {
    const { clientWidth: width, clientHeight: height } = picture.canvas;
    return this.seen(picture, { width, height })
      .map((h) => Object.assign(h, { far: Math.hypot(h.at[0] - offsetX, h.at[1] - offsetY) }))
      .filter((h) => h.far < REACH).sort((a, b) => a.far - b.far)[0];
  }

  /** Listens to the pointer on a picture. @param {object} picture */
  listen(picture) {
    const { canvas } = picture;
    // A finger on a flat picture scrolls the page, unless it takes hold of something.
    canvas.addEventListener("touchstart", (event) => {
      const { left, top } = canvas.getBoundingClientRect();
      const [{ clientX, clientY }] = event.touches;
      if (this.#nearest(picture, { offsetX: clientX - left, offsetY: clientY - top })) event.preventDefault();
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => this.#take(picture, event));
    canvas.addEventListener("pointermove", (event) => {
      if (this.held) this.#drag(event);
      else if (this.turning && picture.camera) this.#turn(event);
      else canvas.style.cursor = this.#nearest(picture, event) ? "grab" : picture.camera ? "move" : "default";
    });
    for (const name of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(name, () => { this.held = null; this.turning = null; this.stage.paintSoon(); });
    }
    canvas.addEventListener("wheel", (event) => {
      if (!picture.camera || document.activeElement !== this.stage.root) return; // else the page scrolls
      event.preventDefault();
      for (const p of this.stage.pictures) p.camera.distance *= Math.exp(0.001 * event.deltaY);
      this.stage.paintSoon();
    }, { passive: false });
  }

  #take(picture, event) {
    const { stage } = this;
    const found = this.#nearest(picture, event);
    if (found) {
      stage.clock.pause();
      stage.told = true;
      const { hand, place, at } = found;
      hand.gains = hand.gains || hand.knobs.map(() => 1);
      this.held = { hand, picture, place, off: [event.offsetX - at[0], event.offsetY - at[1]], point: at,
        scale: found.scale, values: Object.assign({}, stage.values) };
    } else if (picture.camera) this.turning = { x: event.offsetX, y: event.offsetY };
    else return;
    event.preventDefault();
    stage.root.focus({ preventScroll: true });
    picture.canvas.setPointerCapture(event.pointerId);
    stage.paintSoon();
  }

  #drag(event) {
    const { off } = this.held;
    this.held.point = [event.offsetX - off[0], event.offsetY - off[1]];
    this.held.tries = 0;
    this.#pull();
    this.stage.ask();
    this.stage.paintSoon();
  }

  /** Knobs for which what is held comes to lie under the pointer; whether they are others than before. */
  #pull() {
    const { hand, picture, place, point, scale, values } = this.held;
    const { stage } = this;
    const { clientWidth: width, clientHeight: height } = picture.canvas;
    const { view } = stage.film;
    const frame = frameOf(view, picture.camera, { width, height });
    const moved = frame.dragged(place.map((v, i) => v - view.middle[i]), hand.knobs.map((k) => k.direction), point);
    const before = Object.assign({}, stage.values);
    hand.knobs.forEach(({ knob: name, direction }, k) => {
      const { knob } = stage.sliders[name];
      stage.setKnobs({ [name]: draggedValue(knob, values[name], moved, direction, scale, hand.gains[k]) });
    });
    return hand.knobs.some(({ knob: name }) => stage.values[name] !== before[name]);
  }

  /** A film came while something may be held: how well it followed, and a question more where it did not. @param {object} values of the film */
  follow(values) {
    const { held, stage } = this;
    if (!held) return;
    const { clientWidth: width, clientHeight: height } = held.picture.canvas;
    const now = this.seen(held.picture, { width, height }).find((h) => h.hand === held.hand);
    if (!now) return;
    const moved = now.place.map((v, i) => v - held.place[i]);
    held.hand.knobs.forEach(({ knob: name, direction }, k) => {
      const { knob } = stage.sliders[name];
      held.hand.gains[k] = learnedGain(held.hand.gains[k], values[name] - held.values[name], moved, direction, held.scale, knob.step);
    });
    Object.assign(held, { place: now.place, scale: now.scale, values });
    held.tries += 1;
    if (this.#pull() && held.tries < MOST_TRIES) stage.ask();
  }

  /** All panes are seen from the same side. */
  #turn(event) {
    const [dx, dy] = [event.offsetX - this.turning.x, event.offsetY - this.turning.y];
    this.turning = { x: event.offsetX, y: event.offsetY };
    for (const { camera } of this.stage.pictures) {
      camera.yaw -= 0.008 * dx;
      camera.pitch = Math.min(1.56, Math.max(-1.56, camera.pitch + 0.008 * dy));
    }
    this.stage.paintSoon();
  }
}
