import assert from "node:assert/strict";
import test from "node:test";

import { draggedValue, learnedGain, rounded, slid, unslid } from "../../../../course/workbook/stage/js/asking.js";
import { Clock } from "../../../../course/workbook/stage/js/clock.js";
import {
  between, hull, momentAt, slerp, stepped, ticks, turned, turnedBetween, unpack, written,
} from "../../../../course/workbook/stage/js/film.js";
import { random } from "./random.js";

const close = (a, b, tolerance = 1e-12) => a.forEach((v, i) => assert.ok(Math.abs(v - b[i]) <= tolerance, `${a} is not ${b}`));

test("numbers come out of base64 as they went in", () => {
  const values = new Float64Array([1.5, -2, 1e8 + 1]);
  const bytes = Buffer.from(values.buffer).toString("base64");
  const track = unpack({ kind: "f8", shape: [3, 1], still: false, bytes });
  assert.deepEqual(Array.from(track.values), Array.from(values));
  assert.equal(track.stride, 1);
});

test("the moment at a time, and after a jump the later one", () => {
  const times = new Float64Array([0, 1, 1, 3]);
  assert.deepEqual(momentAt(times, -1), { index: 0, part: 0 });
  assert.deepEqual(momentAt(times, 0.25), { index: 0, part: 0.25 });
  assert.deepEqual(momentAt(times, 1), { index: 2, part: 0 });
  assert.deepEqual(momentAt(times, 2), { index: 2, part: 0.5 });
  assert.deepEqual(momentAt(times, 9), { index: 3, part: 0 });
});

test("a jump is not smeared over the moments beside it", () => {
  const track = { values: Float64Array.of(5, 5, -2, -2), stride: 1, still: false };
  const times = new Float64Array([0, 1, 1, 3]);
  const at = (t) => between(track, momentAt(times, t), 0, 1)[0];
  assert.equal(at(0.999999), 5);
  assert.equal(at(1), -2);
});

test("what stands still is sent once", () => {
  const track = { values: Float64Array.of(7, 8), stride: 2, still: true };
  assert.deepEqual(between(track, { index: 3, part: 0.5 }, 1, 1), [8]);
});

test("half way between two turns is half the angle, by the shorter way", () => {
  const about = (angle) => [0, 0, Math.sin(angle / 2), Math.cos(angle / 2)];
  const half = slerp(about(0), about(1), 0.5);
  close(half, about(0.5));
  close(slerp(about(0), about(1).map((v) => -v), 0.5), about(0.5));
  close(slerp(about(0.3), about(0.3), 0.7), about(0.3));
  const values = Float64Array.from([...about(0), ...about(2)]);
  close(turnedBetween({ values, stride: 4, still: false }, { index: 0, part: 0.25 }, 0), about(0.5));
});

test("turning keeps lengths and angles, and agrees with the rotation matrix about z", () => {
  const next = random(1);
  for (let k = 0; k < 200; k += 1) {
    const raw = [next() - 0.5, next() - 0.5, next() - 0.5, next() - 0.5];
    const size = Math.hypot(...raw);
    const q = raw.map((v) => v / size);
    const [a, b] = [[next(), next(), next()], [next(), next(), next()]];
    const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    assert.ok(Math.abs(dot(turned(q, a), turned(q, b)) - dot(a, b)) < 1e-12);
  }
  close(turned([0, 0, Math.SQRT1_2, Math.SQRT1_2], [1, 0, 0]), [0, 1, 0]);
});

test("a hull holds every point and turns one way", () => {
  const next = random(2);
  for (let k = 0; k < 100; k += 1) {
    const points = Array.from({ length: 3 + Math.floor(20 * next()) }, () => [next(), next()]);
    const around = hull(points);
    around.forEach((a, i) => {
      const b = around[(i + 1) % around.length];
      for (const p of points) {
        assert.ok((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) >= -1e-12);
      }
    });
  }
  assert.deepEqual(hull([[1, 2]]), [[1, 2]]);
  assert.equal(hull([[0, 0], [1, 1], [2, 2], [3, 3]]).length, 2);
  assert.equal(hull([[1, 1], [1, 1], [1, 1]]).length, 1);
});

test("single steps stop at every jump and event", () => {
  const times = new Float64Array([0, 1, 1, 3]);
  assert.equal(stepped(times, [], 0.99, 1, 0.1), 1);
  assert.equal(stepped(times, [], 1, 1, 0.1), 1.1);
  assert.equal(stepped(times, [], 1.05, -1, 0.1), 1);
  assert.equal(stepped(times, [2.5], 2.45, 1, 0.1), 2.5);
  assert.equal(stepped(times, [], 2.99, 1, 0.1), 3);
  assert.equal(stepped(times, [], 0.05, -1, 0.1), 0);
});

test("ticks are round, within the ends, and about as many as asked for", () => {
  close(ticks(-4.3, 4.3, 4), [-4, -2, 0, 2, 4]);
  close(ticks(0, 2.6, 5), [0, 0.5, 1, 1.5, 2, 2.5]);
  const next = random(3);
  for (let k = 0; k < 500; k += 1) {
    const low = (next() - 0.5) * 10 ** (8 * next() - 4);
    const high = low + next() * 10 ** (8 * next() - 4) + 1e-9;
    const made = ticks(low, high, 5);
    assert.ok(made.length >= 1 && made.length <= 8, `${low} ${high}: ${made}`);
    made.forEach((v) => assert.ok(v >= low - 1e-6 * (high - low) && v <= high + 1e-6 * (high - low)));
  }
});

test("numbers are written for reading", () => {
  assert.equal(written(-0.0004, 3), "−4e−4");
  assert.equal(written(-0), "0");
  assert.equal(written(2.8000001), "2.8");
  assert.equal(written(Infinity), "∞");
  assert.equal(written(NaN), "–");
  assert.equal(written(123456, 6), "1.23456e5");
});

test("a hand moves a knob along its direction, within its ends, on its steps", () => {
  const knob = { low: -4, high: 4, step: 0.1, log: false };
  assert.equal(draggedValue(knob, 1, [0.3, 5, 0], [1, 0, 0], 0.3), 2);
  assert.equal(draggedValue(knob, 1, [9, 0, 0], [1, 0, 0], 0.3), 4);
  assert.equal(draggedValue(knob, 1, [0.3, 5, 0], [1, 0, 0], 0.3, 2), 3);
  assert.equal(rounded(knob, 0.3499), 0.3);
});

test("a slider's place and its value are inverse, over powers of ten too", () => {
  const knob = { low: 0.01, high: 100, step: 0.01, log: true };
  for (const value of [0.01, 0.1, 1, 10, 100]) assert.equal(unslid(knob, slid(knob, value)), value);
  const even = { low: -4, high: 4, step: 0.1, log: false };
  for (let k = 0; k <= 80; k += 1) {
    const value = Number((-4 + 0.1 * k).toFixed(1));
    assert.equal(unslid(even, slid(even, value)), value);
  }
});

test("the clock plays at its speed, ends at the end, and plays again from the start", () => {
  let [now, tick] = [0, null];
  const seen = [];
  const clock = new Clock((t) => seen.push(t), { now: () => now, next: (f) => { tick = f; } });
  clock.load({ times: new Float64Array([0, 1]), events: [], speed: 0.5 });
  clock.play();
  for (let k = 0; k < 10; k += 1) { now += 50; tick(); }
  assert.ok(Math.abs(clock.time - 0.25) < 1e-12);
  clock.slow = 0.1;
  now += 50; tick();
  assert.ok(Math.abs(clock.time - 0.2525) < 1e-12);
  clock.slow = 1;
  now += 60000; tick(); // the page was away
  assert.ok(clock.time < 0.31);
  for (let k = 0; k < 40; k += 1) { now += 50; if (clock.playing) tick(); }
  assert.equal(clock.time, 1);
  assert.equal(clock.playing, false);
  clock.play();
  assert.equal(clock.time, 0);
});

test("what moves less than its arrow grows is learned from a film", () => {
  const x = [1, 0, 0];
  assert.equal(learnedGain(1, 1, [0.15, 7, 0], x, 0.3, 0.1), 2); // half as far as the direction says
  assert.equal(learnedGain(1.5, 0.05, [0.15, 0, 0], x, 0.3, 0.1), 1.5); // too little to tell
  assert.equal(learnedGain(1.5, 1, [-0.15, 0, 0], x, 0.3, 0.1), 1.5); // it runs away
  assert.equal(learnedGain(1, 1, [1e-6, 0, 0], x, 0.3, 0.1), 8);
});
