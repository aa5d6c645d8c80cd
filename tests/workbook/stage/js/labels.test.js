import assert from "node:assert/strict";
import test from "node:test";

import { covers, crosses, inSight, inkOn, placedLabels, within } from "../../../../course/workbook/stage/js/labels.js";
import { random } from "./random.js";

const BOUNDS = [400, 300];
const apart = (a, b) => a[2] <= b[0] || b[2] <= a[0] || a[3] <= b[1] || b[3] <= a[1];
const label = (places, more) => Object.assign({ text: "x", key: "x", width: 40, height: 15, places, anchor: places[0] }, more);
const placed = (labels, more) => placedLabels(labels, Object.assign({ lines: [], bodies: [], bounds: BOUNDS }, more));

test("labels never cover each other nor what is taken, and none is left out where there is room", () => {
  const next = random(4);
  const labels = Array.from({ length: 40 }, (_, k) => label(
    Array.from({ length: 4 }, () => [400 * next(), 300 * next()]), { key: `${k}` }));
  const out = placed(labels, { taken: [[0, 0, 50, 50]] });
  assert.equal(out.length, 40);
  const boxes = [[0, 0, 50, 50], ...out.map((l) => l.box)];
  boxes.forEach((a, i) => boxes.slice(0, i).forEach((b) => assert.ok(apart(a, b))));
  boxes.forEach((b) => assert.ok(b[0] >= 0 && b[1] >= 0 && b[2] <= 400 && b[3] <= 300));
});

test("more labels than the picture holds: those without a place are left out, and cover nothing", () => {
  const labels = Array.from({ length: 300 }, (_, k) => label([[200, 150]], { key: `${k}` }));
  const out = placed(labels);
  assert.ok(out.length > 20 && out.length < 300);
});

test("a label keeps off arrows, wherever they lie", () => {
  const next = random(5);
  for (let round = 0; round < 100; round += 1) {
    const lines = Array.from({ length: 6 }, () => [400 * next(), 300 * next(), 400 * next(), 300 * next(), 3]);
    const [[x, y, a, b]] = lines;
    const [one] = placed([label([[(x + a) / 2, (y + b) / 2]])], { lines });
    for (const line of lines) assert.ok(!crosses(one.box, line), `round ${round}: ${one.box} over ${line}`);
  }
});

test("the first place that is free is taken, whatever else is free too", () => {
  const [one] = placed([label([[100, 100], [200, 100], [300, 100]])], { lines: [[90, 0, 110, 300, 2]] });
  assert.deepEqual([one.x, one.y, one.far], [200, 100, 0]);
});

test("a label goes off a body where it can, to a place farther away where all of its own are bad", () => {
  const body = { points: [[100, 100]], radius: 30 };
  const [off] = placed([label([[100, 100], [200, 100]])], { bodies: [body] });
  assert.equal(off.x, 200);
  const arrow = [200, 0, 200, 300, 2];
  const [far] = placed([label([[100, 100], [200, 100]])], { bodies: [body], lines: [arrow] });
  assert.ok(far.far > 0 && !covers(far.box, body) && !crosses(far.box, arrow));
});

test("on a floor there is room where there is no other", () => {
  const floor = { points: [[0, 50], [400, 50], [400, 300], [0, 300]], radius: 0, fixed: true };
  assert.equal(placed([label([[100, 100], [100, 20]])], { bodies: [floor] })[0].y, 20);
  assert.equal(placed([label([[100, 100], [100, 150]])], { bodies: [floor] })[0].y, 100);
});

test("a body's name is in it where it has room, beside it where not", () => {
  for (const [radius, inside] of [[40, true], [10, false]]) {
    const body = { points: [[100, 100]], radius };
    const [name] = placed([label([[100, 100], [100 + radius + 22, 100]], { inside: body })], { bodies: [body] });
    assert.equal(Boolean(name.inside), inside);
    assert.equal(name.x, inside ? 100 : 132);
  }
});

test("a label stays where it was while two places are as good", () => {
  const memory = new Map();
  const wanted = [label([[100, 100], [100, 200]])];
  assert.equal(placed(wanted, { memory, lines: [[0, 100, 400, 100, 2]] })[0].y, 200);
  assert.equal(placed(wanted, { memory })[0].y, 200);
  assert.equal(placed(wanted)[0].y, 100);
});

test("whether a box lies on a line, covers a body, lies within it", () => {
  const box = [10, 10, 30, 20];
  assert.ok(crosses(box, [0, 0, 40, 30, 0]) && !crosses(box, [0, 0, 40, 0, 0]) && crosses(box, [0, 8, 40, 8, 3]));
  assert.ok(!crosses(box, [0, 15, 9, 15, 0]) && crosses(box, [15, 15, 16, 16, 0]), "it ends before, it lies within");
  const square = { points: [[40, 0], [60, 0], [60, 30], [40, 30]], radius: 0 };
  assert.ok(!covers(box, square) && covers(box, { ...square, radius: 11 }) && covers([35, 5, 45, 10], square));
  assert.ok(!covers(box, { points: [[34, 24]], radius: 5 }) && covers(box, { points: [[34, 24]], radius: 6 }));
  assert.ok(within([45, 5, 55, 20], square) && !within([35, 5, 55, 20], square));
  assert.ok(within([-3, -3, 3, 3], { points: [[0, 0]], radius: 5 }) && !within([-4, -4, 4, 4], { points: [[0, 0]], radius: 5 }));
});

test("a name on a body is light on dark colours and dark on light ones", () => {
  assert.equal(inkOn("#0072b2"), "#ffffff");
  for (const light of ["#7cc7f2", "#f0b429", "#f0f0f0", "#56b4e9"]) assert.equal(inkOn(light), "#111418");
});

test("what is out of the picture has no label in it", () => {
  const anchors = [[10, 10], [-1, 10], [10, 301], [400, 300]];
  assert.deepEqual(inSight(anchors.map((anchor) => ({ anchor })), BOUNDS).map((l) => l.anchor), [anchors[0], anchors[3]]);
});
