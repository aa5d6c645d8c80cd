import assert from "node:assert/strict";
import test from "node:test";

import { projected } from "../../../../course/workbook/stage/js/matrices.js";
import { cameraOf, eyeOf, spaceFrame } from "../../../../course/workbook/stage/js/camera.js";

const cameras = {
  corner: [[0.62, -0.72, 0.42], [0, 0, 1]], front: [[0, -1, 0], [0, 0, 1]],
  side: [[1, 0, 0], [0, 0, 1]], top: [[0, 0, 1], [0, 1, 0]],
};
const view = (high) => ({ cameras, low: high.map((v) => -v), high, middle: [0, 0, 0] });
const close = (a, b, tolerance) => a.forEach((v, i) => assert.ok(Math.abs(v - b[i]) <= tolerance, `${a} is not ${b}`));

test("every preset shows the whole window, and not much more where it is wide", () => {
  for (const preset of Object.keys(cameras)) {
    for (const high of [[1, 1, 1], [4, 1, 0.5], [0.2, 0.2, 3]]) {
      for (const [width, height] of [[600, 440], [500, 500], [300, 600]]) {
        const eye = eyeOf(cameraOf(view(high), preset), width / height);
        let most = 0;
        for (let k = 0; k < 8; k += 1) {
          const { point, before } = projected(eye, high.map((v, i) => ((k >> i) & 1 ? v : -v)), width, height);
          assert.ok(before && point[0] > 0 && point[0] < width && point[1] > 0 && point[1] < height, `${preset} ${high}`);
          most = Math.max(most, Math.abs(point[0] / width - 0.5), Math.abs(point[1] / height - 0.5));
        }
        assert.ok(width < 1.3 * height || most > 0.3, `${preset} ${high} ${width}: ${most}`);
      }
    }
  }
});

test("what is held follows the hand in the plane of two knobs, and along the line of one", () => {
  const frame = spaceFrame(cameraOf(view([1, 1, 1]), "corner"), 600, 440);
  const start = [0.2, -0.3, 0.1];
  const plane = [[1, 0, 0], [0, 1, 0]];
  const wanted = [0.5, 0.4, 0];
  const to = frame.screen(start.map((v, i) => v + wanted[i]));
  close(frame.dragged(start, plane, to), wanted, 1e-3);
  const up = frame.dragged(start, [[0, 0, 1]], frame.screen([0.2, -0.3, 0.6]));
  close(up, [0, 0, 0.5], 1e-3);
  const beside = frame.dragged(start, [[0, 0, 1]], frame.screen([0.2, -0.3, 0.6]).map((v, i) => v + (i ? 0 : 40)));
  assert.ok(Math.abs(beside[2] - 0.5) < 0.05 && beside[0] === 0);
});

test("a plane seen from its edge is held without a jump", () => {
  const frame = spaceFrame(cameraOf(view([1, 1, 1]), "front"), 600, 440);
  const at = frame.screen([0, 0, 0]);
  const moved = frame.dragged([0, 0, 0], [[1, 0, 0], [0, 1, 0]], [at[0] + 10, at[1] + 10]);
  assert.ok(Math.hypot(...moved) < 0.2 && moved[0] > 0, `${moved}`);
});
