// The film's time: playing at the display's rate, standing, stepping.

import { stepped, written } from "./film.js";

export const FRAME = 1 / 30; // a single step, in seconds of playing

/** A clock over a film's times; `changed(time)` is called whenever the time is another. */
export class Clock {
  constructor(changed, { now = () => performance.now(), next = (f) => requestAnimationFrame(f) } = {}) {
    Object.assign(this, { changed, now, next, time: 0, playing: false, slow: 1, film: null });
  }

  /** Another film. The time stays where it is, if the film has it. */
  load(film) {
    this.film = film;
    this.time = Math.min(this.last, Math.max(this.first, this.time));
  }

  get first() { return this.film.times[0]; }

  get last() { return this.film.times[this.film.times.length - 1]; }

  seek(time) {
    this.time = Math.min(this.last, Math.max(this.first, time));
    this.changed(this.time);
  }

  step(direction) {
    this.pause();
    this.seek(stepped(this.film.times, this.film.events, this.time, direction, FRAME * this.film.speed * this.slow));
  }

  /** Play on; from the beginning where the film has ended. */
  play() {
    if (this.playing || this.last <= this.first) return;
    if (this.time >= this.last) this.time = this.first;
    this.playing = true;
    this.before = this.now();
    this.next(() => this.#tick());
    this.changed(this.time);
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.changed(this.time);
  }

  toggle() { if (this.playing) this.pause(); else this.play(); }

  reset() { this.pause(); this.seek(this.first); }

  #tick() {
    if (!this.playing) return;
    const now = this.now();
    // A page that was away for a while goes on where it was.
    const passed = Math.min(0.1, (now - this.before) / 1000);
    this.before = now;
    const time = this.time + passed * this.film.speed * this.slow;
    if (time >= this.last) { this.playing = false; this.seek(this.last); return; }
    this.seek(time);
    this.next(() => this.#tick());
  }
}

/** Seconds of motion in one of playing, as it is said: "real time", "5 times slower". @param {number} speed @returns {string} */
export function speedInWords(speed) {
  if (Math.abs(speed - 1) < 1e-9) return "real time";
  return speed < 1 ? `${written(1 / speed, 2)} times slower` : `${written(speed, 2)} times faster`;
}
