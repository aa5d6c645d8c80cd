import assert from "node:assert/strict";
import test from "node:test";

import {
  arrowCorners, copied, corners, frameAlong, indexed, lookAt, multiplied, perspective, projected, putPlace, shadowOn,
} from "../../../../course/workbook/stage/js/matrices.js";
import { turned } from "../../../../course/workbook/stage/js/film.js";

const applied = (m, p) => [0, 1, 2, 3].map((r) => m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r] * (p[3] ?? 1));
const close = (a, b, tolerance = 1e-5) => a.forEach((v, i) => assert.ok(Math.abs(v - b[i]) <= tolerance, `${a} is not ${b}`));

test("what is looked at is in the middle of the picture, what is above it higher", () => {
  const eye = multiplied(perspective(0.6, 1.5, 0.1, 100), lookAt([5, -6, 3], [0, 0, 0], [0, 0, 1]));
  close(projected(eye, [0, 0, 0], 600, 400).point, [300, 200], 1e-3);
  assert.ok(projected(eye, [0, 0, 1], 600, 400).point[1] < 200);
  assert.equal(projected(eye, [50, -60, 30], 600, 400).before, false);
});

test("a body's place turns and moves it", () => {
  const quaternion = [0.1, -0.5, 0.7, 0.5];
  const row = new Float32Array(13);
  putPlace(row, 1, [1, 2, 3], quaternion);
  [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((axis, k) => close(Array.from(row.slice(1 + 3 * k, 4 + 3 * k)), turned(quaternion, axis)));
  close(Array.from(row.slice(10)), [1, 2, 3]);
});

test("a shadow lies on the ground, along the light", () => {
  const light = [0.3, -0.2, -1];
  const shadow = shadowOn(-2, light);
  const p = [0.7, 0.4, 1.5];
  const fallen = applied(shadow, p);
  const far = (-2 - p[2]) / light[2];
  close(fallen.slice(0, 3), p.map((v, i) => v + far * light[i]));
});

test("faces of a box keep their normals, a ball's normals point outward", () => {
  const vertices = [0, 0, 0, 1, 0, 0, 0, 1, 0];
  const out = corners(vertices, [0, 1, 2], [[1, 0, 0], [1, 0, 0], [1, 0, 0]], false);
  close(Array.from(out.slice(3, 6)), [0, 0, 1]);
  assert.equal(out.length, 27);
});

test("an arrow's mesh runs from 0 to 1 along z", () => {
  for (const head of [0, 1]) {
    const mesh = arrowCorners(8, head);
    const heights = Array.from({ length: mesh.length / 6 }, (_, k) => mesh[6 * k + 2]);
    assert.equal(Math.min(...heights), 0);
    assert.equal(Math.max(...heights), 1);
  }
});

test("the frame along a direction is right-handed and orthonormal", () => {
  for (const d of [[1, 0, 0], [0, 1, 0], [0, 0, -1], [1, 2, 3]]) {
    const [a, b, c] = frameAlong(d);
    const cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    close(cross, c, 1e-12);
  }
});

test("equal corners are kept once, and triangles stay what they were", () => {
  const values = Float32Array.from([0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 1]);
  const { values: kept, index } = indexed(values, 2);
  assert.deepEqual(Array.from(kept), [0, 0, 1, 0, 0, 1, 1, 1]);
  assert.deepEqual(Array.from(index).flatMap((k) => Array.from(kept.slice(2 * k, 2 * k + 2))), Array.from(values));
});

test("copies written out are where their axes and places put them, with normals of length 1", () => {
  const random = (() => { let k = 7; return () => { k = (k * 16807) % 2147483647; return k / 2147483647 - 0.5; }; })();
  const values = Float32Array.from({ length: 9 * 5 }, () => random());
  for (let k = 0; k < 5; k += 1) {
    const n = Math.hypot(values[9 * k + 3], values[9 * k + 4], values[9 * k + 5]);
    for (let i = 3; i < 6; i += 1) values[9 * k + i] /= n;
  }
  const quaternion = [0.1, -0.5, 0.7, 0.5];
  const copies = new Float32Array(30).fill(0.5);
  putPlace(copies, 15, [1, 2, 3], quaternion);
  for (let i = 0; i < 9; i += 1) copies[15 + i] *= 3; // three times as large
  const out = new Float32Array(9 * 5 * 2);
  copied(values, 9, copies, out);
  for (let k = 0; k < 5; k += 1) {
    const [place, normal, color] = [0, 3, 6].map((i) => Array.from(values.slice(9 * k + i, 9 * k + i + 3)));
    const found = out.subarray(9 * (5 + k), 9 * (6 + k));
    close(Array.from(found.slice(0, 3)), turned(quaternion, place).map((v, i) => 3 * v + [1, 2, 3][i]));
    close(Array.from(found.slice(3, 6)), turned(quaternion, normal));
    close(Array.from(found.slice(6)), color.map((v) => 0.5 * v));
  }
  const plain = new Float32Array(9);
  copied(Float32Array.of(0, 0, 1, 0, 0, 1), 6, copies.subarray(15), plain);
  close(Array.from(plain.slice(6)), [0.5, 0.5, 0.5]);
});
