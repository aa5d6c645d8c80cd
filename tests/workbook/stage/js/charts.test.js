import assert from "node:assert/strict";
import test from "node:test";

import { decades, limitsOf, placeOn, tenTo } from "../../../../course/workbook/stage/js/charts.js";

const curves = (...values) => values.map((v) => ({ values: { values: Float64Array.from(v) } }));

test("a logarithmic axis runs over whole powers of ten and leaves out what has no logarithm", () => {
  const [low, high] = limitsOf({ logarithmic: true, curves: curves([1, 0, NaN], [3e-5, 0.2, -1]) });
  assert.ok(Math.abs(low / 1e-5 - 1) < 1e-12 && high === 1);
  assert.deepEqual(limitsOf({ logarithmic: true, curves: curves([0, 0]) }), [0.1, 1]);
  assert.ok(Math.abs(placeOn(1e-3, [1e-4, 1e-1], true) - 1 / 3) < 1e-12);
  assert.ok(Number.isNaN(placeOn(0, [1e-4, 1], true)) && Number.isNaN(placeOn(-1, [1e-4, 1], true)));
  assert.equal(placeOn(5, [0, 10]), 0.5);
});

test("its ticks are powers of ten, not too many of them", () => {
  assert.deepEqual(decades(1e-3, 1, 10).map(tenTo), ["10⁻³", "10⁻²", "10⁻¹", "10⁰"]);
  assert.ok(decades(1e-16, 1, 6).length <= 6);
  assert.equal(tenTo(1e12), "10¹²");
});

test("areas begin at 0, curves have a margin", () => {
  assert.equal(limitsOf({ stacked: true, curves: curves([1, 2], [1, 3]) })[0], 0);
  const [low, high] = limitsOf({ curves: curves([1, 2]) });
  assert.ok(low < 1 && high > 2);
});
