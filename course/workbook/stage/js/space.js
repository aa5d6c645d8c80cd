// A view into space, by WebGL2: bodies, their shadows on a ground, arrows; labels, trails and
// measured lines are painted above them. Browsers keep about 16 WebGL contexts alive: all
// pictures of a page are drawn by one, out of sight, and copied onto canvases of their own.

import { between, momentAt, turnedBetween, written } from "./film.js";
import { drawLabels } from "./look.js";
import { arrowCorners, corners, frameAlong, indexed, lookAt, multiplied, perspective, projected, putPlace, shadowOn, unit }
  from "./matrices.js";

const ANGLE = (32 * Math.PI) / 180; // from foot to top of the picture
const LIGHT = unit([-0.45, 0.62, -1]); // the way it shines
const ROOM = 1.06; // around what is seen
const INSTANCE = 15; // numbers: three axes, a place, a colour
const STILL = Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);

const VERTEX = `#version 300 es
  layout(location=0) in vec3 place; layout(location=1) in vec3 normal; layout(location=2) in vec3 color;
  layout(location=3) in vec3 first; layout(location=4) in vec3 second; layout(location=5) in vec3 third;
  layout(location=6) in vec3 start; layout(location=7) in vec3 tint;
  uniform mat4 eye, flatten; out vec3 n, c;
  void main() {
    n = normalize(first) * normal.x + normalize(second) * normal.y + normalize(third) * normal.z; c = color * tint;
    gl_Position = eye * flatten * vec4(start + first * place.x + second * place.y + third * place.z, 1.0); }`;
const FRAGMENT = `#version 300 es
  precision mediump float; in vec3 n, c; uniform vec3 light; uniform vec4 flat_color; out vec4 painted;
  void main() {
    float lit = 0.76 + 0.28 * max(-0.8, dot(normalize(n), -light));
    painted = flat_color.a > 0.0 ? flat_color : vec4(c * lit, 1.0); }`;

/** The colour of a palette as three numbers from 0 to 1. */
export function rgb(hex) {
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
}

/** A camera that looks at the middle of the window from a preset's side, as near as shows all of it. */
export function cameraOf(view, preset) {
  const [direction, up] = view.cameras[preset];
  const d = unit(direction);
  const flat = up[2] === 0;
  const camera = { yaw: flat ? -Math.PI / 2 : Math.atan2(d[1], d[0]), pitch: flat ? Math.PI / 2 - 1e-3 : Math.asin(d[2]),
    reach: 0.5 * Math.hypot(...view.high.map((v, i) => v - view.low[i])) || 1 };
  const seen = lookAt(d, [0, 0, 0], flat ? up : [0, 0, 1]);
  let distance = 0;
  for (let k = 0; k < 8; k += 1) {
    const p = view.low.map((v, i) => ((k >> i) & 1 ? view.high[i] : v));
    const [x, y, z] = [0, 1, 2].map((row) => seen[row] * p[0] + seen[4 + row] * p[1] + seen[8 + row] * p[2]);
    distance = Math.max(distance, z + (ROOM * Math.max(Math.abs(x) / 1.2, Math.abs(y))) / Math.tan(ANGLE / 2));
  }
  return Object.assign(camera, { distance: distance || 1 });
}

/** From the world to the screen, for a camera and a picture's shape. */
export function eyeOf(camera, aspect) {
  const { yaw, pitch, distance, reach } = camera;
  const away = distance * Math.max(1, 1.2 / aspect);
  const eye = [Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch)]
    .map((v) => away * v);
  const near = Math.max(0.02 * away, away - 4 * reach);
  return multiplied(perspective(ANGLE, aspect, near, away + 4 * reach), lookAt(eye, [0, 0, 0], [0, 0, 1]));
}

/**
 * How a hand moves in space: where points are on the canvas, and the way from `start` along
 * the knobs' directions (one or two) whose end is nearest to a point of the canvas.
 */
export function spaceFrame(camera, width, height) {
  const eye = eyeOf(camera, width / height);
  const screen = (p) => projected(eye, p, width, height).point;
  const dragged = (start, directions, [x, y]) => {
    const moved = [0, 0, 0];
    for (let turn = 0; turn < 6; turn += 1) { // Newton's way: the perspective is not linear
      const at = start.map((v, i) => v + moved[i]);
      const here = screen(at);
      const small = 1e-4 * camera.reach;
      const slopes = directions.map((d) => screen(at.map((v, i) => v + small * d[i])).map((v, i) => (v - here[i]) / small));
      const left = [x - here[0], y - here[1]];
      leastSquares(slopes, left).forEach((s, k) => directions[k].forEach((d, i) => { moved[i] += s * d; }));
    }
    return moved;
  };
  return { screen, dragged };
}

/** The one or two factors of plane vectors whose sum is nearest to another. */
function leastSquares(slopes, left) {
  const inner = (a, b) => a[0] * b[0] + a[1] * b[1];
  const [a, b] = slopes;
  if (!b) return [inner(a, left) / (inner(a, a) || 1)];
  // Seen from its edge a plane is a line: what lies across it cannot be taken from the picture.
  const least = 1e-3 * (inner(a, a) + inner(b, b)) || 1;
  const [aa, ab, bb] = [inner(a, a) + least, inner(a, b), inner(b, b) + least];
  const [p, q] = [inner(a, left), inner(b, left)];
  const size = aa * bb - ab * ab;
  return [(bb * p - ab * q) / size, (aa * q - ab * p) / size];
}

/** The lines of a ground plane at round distances, as wide as everything; nine numbers an end. */
function groundLines(view, color) {
  const half = 0.75 * Math.hypot(...view.high.map((v, i) => v - view.low[i])) || 1;
  const z = view.ground - 2e-3 * half;
  const power = 10 ** Math.floor(Math.log10(half / 4));
  const step = power * [5, 2, 1].find((s) => s * power <= half / 4);
  const out = [];
  const line = (a, b) => out.push(...a, z, 0, 0, 1, ...color, ...b, z, 0, 0, 1, ...color);
  [0, 1].forEach((axis) => {
    const middle = view.middle[axis];
    for (let k = Math.ceil((middle - half) / step); k * step <= middle + half; k += 1) {
      const at = k * step - middle;
      if (axis) line([-half, at], [half, at]); else line([at, -half], [at, half]);
    }
  });
  return new Float32Array(out);
}

function rendererOf(gl) {
  const told = gl.getExtension("WEBGL_debug_renderer_info");
  return String(gl.getParameter(told ? told.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}

/** The page's one WebGL context, and what all pictures draw with. */
class Drawing {
  constructor() {
    this.#open(true);
    // Where the processor draws, smoothing every frame halves their number: there only what stands is smooth.
    this.slow = Boolean(this.gl) && /swiftshader|llvmpipe|software/i.test(rendererOf(this.gl));
    if (this.slow) {
      const lose = this.gl.getExtension("WEBGL_lose_context");
      if (lose) lose.loseContext();
      this.#open(false);
    }
    this.views = new Set();
    this.age = 0; // how often the context was lost
    if (!this.gl) return;
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.age += 1;
      this.#begin();
      for (const view of this.views) view.again();
    });
    this.#begin();
  }

  #open(antialias) {
    this.canvas = document.createElement("canvas");
    this.gl = this.canvas.getContext("webgl2", { antialias });
  }

  #begin() {
    const { gl } = this;
    this.program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error(gl.getProgramInfoLog(this.program));
    }
    this.uniform = Object.fromEntries(["eye", "flatten", "light", "flat_color"].map((n) => [n, gl.getUniformLocation(this.program, n)]));
    gl.vertexAttrib3f(2, 1, 1, 1); // what has no colours of its own is white, and tinted
    this.arrows = [0, 1].map((head) => this.mesh(arrowCorners(10, head), [3, 3]));
  }

  /** Corners: `sizes` numbers for each attribute from location 0 on; and room for instances. */
  mesh(values, sizes) {
    const { gl } = this;
    const array = gl.createVertexArray();
    const [buffer, order, instances] = [0, 1, 2].map(() => gl.createBuffer());
    const stride = sizes.reduce((a, b) => a + b, 0);
    const once = indexed(values, stride);
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, once.values, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, order);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, once.index, gl.STATIC_DRAW);
    sizes.reduce((from, size, location) => {
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, size, gl.FLOAT, false, 4 * stride, 4 * from);
      return from + size;
    }, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, instances);
    for (let k = 0; k < 5; k += 1) {
      gl.enableVertexAttribArray(3 + k);
      gl.vertexAttribPointer(3 + k, 3, gl.FLOAT, false, 4 * INSTANCE, 12 * k);
      gl.vertexAttribDivisor(3 + k, 1);
    }
    return { array, buffers: [buffer, order, instances], instances, count: once.index.length };
  }

  /** Draws a mesh once for each 15 numbers; none: for those it was drawn with before. */
  draw(mesh, values, color, lines = false) {
    const { gl, uniform } = this;
    gl.bindVertexArray(mesh.array);
    if (values) {
      gl.bindBuffer(gl.ARRAY_BUFFER, mesh.instances);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
      mesh.drawn = values.length / INSTANCE;
    }
    gl.uniform4fv(uniform.flat_color, color || [0, 0, 0, 0]);
    gl.drawElementsInstanced(lines ? gl.LINES : gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0, mesh.drawn);
  }

  /** A clean sheet of so many pixels in the lower left corner. */
  begin(width, height, eye, paper) {
    const { gl, canvas, uniform } = this;
    // All of it is copied, however much was asked for: where that is slow it is as large as the picture.
    if (this.slow ? canvas.width !== width : canvas.width < width) canvas.width = width;
    if (this.slow ? canvas.height !== height : canvas.height < height) canvas.height = height;
    gl.viewport(0, 0, width, height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(0, 0, width, height);
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(...paper, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(this.program);
    gl.uniform3fv(uniform.light, LIGHT);
    gl.uniformMatrix4fv(uniform.eye, false, eye);
    gl.uniformMatrix4fv(uniform.flatten, false, STILL);
  }

  drop(meshes) {
    for (const { array, buffers } of meshes) {
      this.gl.deleteVertexArray(array);
      for (const buffer of buffers) this.gl.deleteBuffer(buffer);
    }
  }
}

/** The same for every stage of a page, each of which may be a module of its own. */
function sharedDrawing() {
  const name = Symbol.for("course.stage.drawing");
  globalThis[name] = globalThis[name] || new Drawing();
  return globalThis[name];
}

/** The drawing of one pane in space; `again` is called when it must be drawn anew. */
export class SpaceView {
  constructor(again) {
    Object.assign(this, { again, drawing: sharedDrawing(), meshes: [], loaded: [] });
    this.drawing.views.add(this);
  }

  /** New bodies, or the old ones in other colours. */
  #load(view, pane, theme) {
    const { drawing } = this;
    const now = [pane, theme, drawing.age];
    if (now.every((v, k) => v === this.loaded[k])) return;
    if (this.loaded[2] === drawing.age) drawing.drop(this.meshes);
    this.bodies = pane.meshes.map((m) => {
      const colors = m.colors.map((k) => rgb(m.fixed ? theme.fixed : theme.palette[m.names[k]]));
      const bodies = pane.solids.map((_, k) => k).filter((k) => pane.solids[k].mesh === pane.meshes.indexOf(m));
      const mesh = drawing.mesh(corners(m.vertices.values, m.triangles.values, colors, m.smooth), [3, 3, 3]);
      return { mesh, bodies, fixed: m.fixed, values: new Float32Array(INSTANCE * bodies.length).fill(1) };
    });
    this.ground = view.ground === null ? null : drawing.mesh(groundLines(view, rgb(theme.grid)), [3, 3, 3]);
    this.meshes = [...this.bodies.map((b) => b.mesh), ...(this.ground ? [this.ground] : [])];
    this.loaded = now;
  }

  /** Paints a time onto a canvas; returns the matrix from the world to the screen. */
  draw(context, film, pane, time, { theme, hidden, camera, width, height, hurried }) {
    const { drawing } = this;
    const { gl } = drawing;
    const eye = eyeOf(camera, width / height);
    const dense = drawing.slow && !hurried ? 2 : 1;
    const [w, h] = [context.canvas.width, context.canvas.height].map((v) => dense * v);
    if (!gl || gl.isContextLost()) { sheet(context, theme, width, height, gl ? "" : "This browser draws no WebGL2."); return eye; }
    this.#load(film.view, pane, theme);
    const moment = momentAt(film.times, time);
    drawing.begin(w, h, eye, rgb(theme.paper));
    for (const { mesh, bodies, values } of this.bodies) {
      bodies.forEach((k, i) => putPlace(values, INSTANCE * i,
        between(pane.position, moment, 3 * k, 3), turnedBetween(pane.orientation, moment, 4 * k)));
      drawing.draw(mesh, values);
    }
    this.#arrows(pane, moment, theme, hidden, camera);
    if (this.ground) this.#floor(film.view, theme, camera);
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(drawing.canvas, 0, drawing.canvas.height - h, w, h, 0, 0, context.canvas.width, context.canvas.height);
    context.restore();
    return eye;
  }

  #floor({ ground }, theme, camera) {
    const { drawing } = this;
    const { gl, uniform } = drawing;
    drawing.draw(this.ground, Float32Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1), [...rgb(theme.grid), 1], true);
    gl.uniformMatrix4fv(uniform.flatten, false, shadowOn(ground - 0.001 * camera.reach, LIGHT));
    const shadow = rgb(theme.paper).map((v) => (theme.dark ? 0.45 * v : 0.82 * v));
    for (const { mesh, fixed } of this.bodies) if (!fixed) drawing.draw(mesh, null, [...shadow, 1]);
  }

  #arrows(pane, moment, theme, hidden, camera) {
    const thick = 0.012 * camera.reach;
    const [shafts, heads] = [[], []];
    for (const arrows of pane.arrows) {
      if (hidden.has(arrows.name)) continue;
      arrows.colors.forEach((color, k) => {
        const start = between(arrows.at, moment, 3 * k, 3);
        const vector = between(arrows.vector, moment, 3 * k, 3).map((v) => arrows.scale * v);
        const length = Math.hypot(...vector);
        if (length < 1e-4 * camera.reach) return;
        const head = Math.min(5 * thick, 0.6 * length);
        const radius = Math.min(thick, 0.2 * length);
        const [first, second, along] = frameAlong(vector);
        const neck = start.map((v, i) => v + (length - head) * along[i]);
        const paint = rgb(theme.palette[color]);
        const wide = (v, r) => v.map((c) => r * c);
        shafts.push(...wide(first, radius), ...wide(second, radius), ...wide(along, length - head), ...start, ...paint);
        heads.push(...wide(first, radius), ...wide(second, radius), ...wide(along, head), ...neck, ...paint);
      });
    }
    if (!shafts.length) return;
    [shafts, heads].forEach((values, which) => this.drawing.draw(this.drawing.arrows[which], new Float32Array(values)));
  }

  release() {
    const { drawing } = this;
    drawing.views.delete(this);
    if (drawing.gl && this.loaded[2] === drawing.age) drawing.drop(this.meshes);
    Object.assign(this, { meshes: [], loaded: [] });
  }
}

function sheet(context, theme, width, height, words) {
  context.fillStyle = theme.paper;
  context.fillRect(0, 0, width, height);
  context.fillStyle = theme.ink;
  context.fillText(words, 12, 24);
}

/** What lies above the bodies: trails, measured lines, labels; returns the labels' boxes. */
export function drawAbove(context, film, pane, time, eye, options) {
  const { width, height, theme, font, hidden, trails } = options;
  const moment = momentAt(film.times, time);
  const at = (p) => projected(eye, p, width, height);
  const line = (points, color, wide, alpha = 1) => {
    context.strokeStyle = color;
    context.lineWidth = wide;
    context.globalAlpha = alpha;
    context.beginPath();
    points.forEach((p, k) => {
      const { point, before } = at(p);
      if (k && before) context.lineTo(...point); else context.moveTo(...point);
    });
    context.stroke();
    context.globalAlpha = 1;
  };
  if (trails) {
    for (const body of pane.trails) {
      const step = Math.max(1, Math.floor(moment.index / 1500));
      const points = [];
      for (let k = 0; k <= moment.index; k += step) points.push(between(pane.position, { index: k, part: 0 }, 3 * body, 3));
      points.push(between(pane.position, moment, 3 * body, 3));
      line(points, theme.palette[pane.solids[body].parts[0].color], 1.5, 0.6);
    }
  }
  const labels = pane.solids.map((solid, k) => ({ solid, k })).filter(({ solid }) => solid.label)
    .map(({ solid, k }) => {
      const [x, y] = at(between(pane.position, moment, 3 * k, 3)).point;
      return { text: solid.label, color: theme.ink, places: [[x, y + 1.1 * font], [x, y - 1.1 * font], [x + font, y], [x - font, y]] };
    });
  for (const s of pane.segments) {
    if (hidden.has(s.name)) continue;
    for (let k = 0; k < s.start.stride / 3; k += 1) {
      const ends = [s.start, s.end].map((track) => between(track, moment, 3 * k, 3));
      line(ends, theme.palette[s.color], 2.2);
      if (!s.value) continue;
      const [a, b] = ends.map((p) => at(p).point);
      const [x, y] = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
      labels.push({ text: `${s.name} ${written(between(s.value, moment, k, 1)[0])} ${s.unit}`, color: theme.palette[s.color],
        places: [[x + 3 * font, y], [x - 3 * font, y], [x, y - font], [x, y + font]] });
    }
  }
  for (const a of pane.arrows) {
    if (hidden.has(a.name) || !a.numbers) continue;
    a.colors.forEach((color, k) => {
      const vector = between(a.vector, moment, 3 * k, 3);
      const tip = between(a.at, moment, 3 * k, 3).map((v, i) => v + a.scale * vector[i]);
      if (Math.hypot(...vector) * a.scale < 1e-6) return;
      const { point: [x, y] } = at(tip);
      const said = a.unit ? `${written(Math.hypot(...vector))} ${a.unit}` : a.name;
      labels.push({ text: said, color: theme.palette[color], places: [[x, y - font], [x, y + font], [x + 3 * font, y], [x - 3 * font, y]] });
    });
  }
  return drawLabels(context, labels, theme, font, [width, height]);
}
