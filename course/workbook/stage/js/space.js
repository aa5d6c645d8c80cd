// A view into space, by WebGL2: bodies, their shadows on a ground, arrows. Labels, trails and
// measured lines are painted on a canvas above it.

import { between, momentAt, turnedBetween, written } from "./film.js";
import { drawLabels } from "./look.js";
import { arrowCorners, corners, frameAlong, lookAt, multiplied, perspective, placed, projected, shadowOn, unit }
  from "./matrices.js";

const ANGLE = (32 * Math.PI) / 180; // from foot to top of the picture
const LIGHT = unit([-0.45, 0.62, -1]); // the way it shines

const BODY = {
  vertex: `#version 300 es
    layout(location=0) in vec3 place; layout(location=1) in vec3 normal; layout(location=2) in vec3 color;
    uniform mat4 world, eye; out vec3 n, c;
    void main() { n = mat3(world) * normal; c = color; gl_Position = eye * world * vec4(place, 1.0); }`,
  fragment: `#version 300 es
    precision mediump float; in vec3 n, c; uniform vec3 light; uniform vec4 flat_color; out vec4 painted;
    void main() {
      float lit = 0.62 + 0.42 * max(-0.5, dot(normalize(n), -light));
      painted = flat_color.a > 0.0 ? flat_color : vec4(c * lit, 1.0); }`,
};
const ARROW = {
  vertex: `#version 300 es
    layout(location=0) in vec3 place; layout(location=1) in vec3 normal;
    layout(location=3) in vec3 first; layout(location=4) in vec3 second; layout(location=5) in vec3 third;
    layout(location=6) in vec3 start; layout(location=7) in vec3 color;
    uniform mat4 eye; out vec3 n, c;
    void main() {
      n = normalize(first) * normal.x + normalize(second) * normal.y + normalize(third) * normal.z; c = color;
      gl_Position = eye * vec4(start + first * place.x + second * place.y + third * place.z, 1.0); }`,
  fragment: BODY.fragment,
};

/** The colour of a palette as three numbers from 0 to 1. */
export function rgb(hex) {
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
}

function program(gl, { vertex, fragment }) {
  const made = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  return made;
}

/** A camera that looks at the middle of everything; turned by the hand, set by presets. */
export function cameraOf(view, preset) {
  const [direction, up] = view.cameras[preset].map((v) => v.slice());
  const reach = 0.5 * Math.hypot(...view.high.map((v, i) => v - view.low[i])) || 1;
  const flat = up[2] === 0;
  const d = unit(direction);
  return { yaw: flat ? -Math.PI / 2 : Math.atan2(d[1], d[0]), pitch: flat ? Math.PI / 2 - 1e-3 : Math.asin(d[2]),
    distance: (1.02 * reach) / Math.sin(ANGLE / 2), reach };
}

/** From the world to the screen, for a camera and a picture's shape. */
export function eyeOf(camera, aspect) {
  const { yaw, pitch, distance, reach } = camera;
  const away = aspect < 1 ? distance / aspect : distance;
  const eye = [Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch)]
    .map((v) => away * v);
  const near = Math.max(0.02 * away, away - 4 * reach);
  return multiplied(perspective(ANGLE, aspect, near, away + 4 * reach), lookAt(eye, [0, 0, 0], [0, 0, 1]));
}

/** The grid of a ground plane as wide as everything, as `corners` has it, two a line. */
function groundLines(view, color) {
  const half = 0.75 * Math.hypot(...view.high.map((v, i) => v - view.low[i])) || 1;
  const z = view.ground - 2e-3 * half;
  const out = [];
  for (let k = -5; k <= 5; k += 1) {
    const at = (k / 5) * half;
    for (const [x, y] of [[at, -half], [at, half], [-half, at], [half, at]]) out.push(x, y, z, 0, 0, 1, ...color);
  }
  return new Float32Array(out);
}

/** The drawing of one pane in space; `draw` paints a time, `release` gives the context back. */
export class SpaceView {
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    if (!this.gl) throw new Error("this browser draws no WebGL2");
    this.body = program(this.gl, BODY);
    this.arrow = program(this.gl, ARROW);
    this.arrowMeshes = [0, 1].map((head) => this.#mesh(arrowCorners(10, head), [3, 3]));
    for (const mesh of this.arrowMeshes) this.#instances(mesh);
  }

  /** New bodies, or the old ones in other colours. */
  load(view, pane, theme) {
    for (const mesh of this.meshes || []) this.gl.deleteBuffer(mesh.buffer);
    this.meshes = pane.solids.map((solid) => {
      const colors = solid.colors.map((k) => rgb(solid.fixed ? theme.fixed : theme.palette[solid.names[k]]));
      return this.#mesh(corners(solid.vertices.values, solid.triangles.values, colors, solid.smooth), [3, 3, 3]);
    });
    if (this.ground) this.gl.deleteBuffer(this.ground.buffer);
    this.ground = view.ground === null ? null : this.#mesh(groundLines(view, rgb(theme.grid)), [3, 3, 3]);
    this.loaded = [pane, theme];
  }

  draw(film, pane, time, { theme, hidden, camera }) {
    if (!this.loaded || this.loaded[0] !== pane || this.loaded[1] !== theme) this.load(film.view, pane, theme);
    const { gl, canvas } = this;
    const moment = momentAt(film.times, time);
    const eye = eyeOf(camera, canvas.width / canvas.height);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...rgb(theme.paper), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(this.body);
    const uniform = (name) => gl.getUniformLocation(this.body, name);
    gl.uniform3fv(uniform("light"), LIGHT);
    gl.uniformMatrix4fv(uniform("eye"), false, eye);
    const places = pane.solids.map((_, k) => placed(
      between(pane.position, moment, 3 * k, 3), turnedBetween(pane.orientation, moment, 4 * k)));
    this.#bodies(uniform, places, null);
    const { ground } = film.view;
    if (ground !== null) {
      const shadow = rgb(theme.paper).map((v) => (theme.dark ? 0.45 * v : 0.82 * v));
      const flatten = shadowOn(ground - 0.001 * camera.reach, LIGHT);
      const fallen = pane.solids.map((s, k) => (s.fixed ? null : multiplied(flatten, places[k])));
      this.#bodies(uniform, fallen, [...shadow, 1]);
      gl.uniform4fv(uniform("flat_color"), [...rgb(theme.grid), 1]);
      gl.uniformMatrix4fv(uniform("world"), false, placed([0, 0, 0], [0, 0, 0, 1]));
      gl.bindVertexArray(this.ground.array);
      gl.drawArrays(gl.LINES, 0, this.ground.count);
    }
    this.#arrows(pane, moment, eye, theme, hidden, camera);
    return eye;
  }

  #bodies(uniform, places, color) {
    const { gl } = this;
    gl.uniform4fv(uniform("flat_color"), color || [0, 0, 0, 0]);
    this.meshes.forEach((mesh, k) => {
      if (!places[k]) return;
      gl.uniformMatrix4fv(uniform("world"), false, places[k]);
      gl.bindVertexArray(mesh.array);
      gl.drawArrays(gl.TRIANGLES, 0, mesh.count);
    });
  }

  #arrows(pane, moment, eye, theme, hidden, camera) {
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
    const { gl } = this;
    gl.useProgram(this.arrow);
    gl.uniformMatrix4fv(gl.getUniformLocation(this.arrow, "eye"), false, eye);
    gl.uniform3fv(gl.getUniformLocation(this.arrow, "light"), LIGHT);
    gl.uniform4fv(gl.getUniformLocation(this.arrow, "flat_color"), [0, 0, 0, 0]);
    [shafts, heads].forEach((values, which) => {
      const mesh = this.arrowMeshes[which];
      gl.bindVertexArray(mesh.array);
      gl.bindBuffer(gl.ARRAY_BUFFER, mesh.instances);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(values), gl.DYNAMIC_DRAW);
      gl.drawArraysInstanced(gl.TRIANGLES, 0, mesh.count, values.length / 15);
    });
  }

  /** Corners in a buffer of their own: `sizes` numbers for each attribute from location 0 on. */
  #mesh(values, sizes) {
    const { gl } = this;
    const [array, buffer] = [gl.createVertexArray(), gl.createBuffer()];
    const stride = sizes.reduce((a, b) => a + b, 0);
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    sizes.reduce((from, size, location) => {
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, size, gl.FLOAT, false, 4 * stride, 4 * from);
      return from + size;
    }, 0);
    return { array, buffer, count: values.length / stride };
  }

  /** Fifteen numbers an arrow: three axes, start, colour. */
  #instances(mesh) {
    const { gl } = this;
    mesh.instances = gl.createBuffer();
    gl.bindVertexArray(mesh.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.instances);
    for (let k = 0; k < 5; k += 1) {
      gl.enableVertexAttribArray(3 + k);
      gl.vertexAttribPointer(3 + k, 3, gl.FLOAT, false, 60, 12 * k);
      gl.vertexAttribDivisor(3 + k, 1);
    }
  }

  release() {
    const lose = this.gl.getExtension("WEBGL_lose_context");
    if (lose) lose.loseContext();
  }
}

/** What lies above the bodies on a flat canvas: ground lines, trails, measured lines, labels. */
export function drawAbove(context, film, pane, time, eye, options) {
  const { width, height, theme, font, hidden, trails } = options;
  const moment = momentAt(film.times, time);
  const at = (p) => projected(eye, p, width, height);
  context.clearRect(0, 0, width, height);
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
    .map(({ solid, k }) => ({ text: solid.label, color: theme.ink, places: [at(between(pane.position, moment, 3 * k, 3)).point] }));
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
      const said = a.unit ? `${a.name} ${written(Math.hypot(...vector))} ${a.unit}` : a.name;
      labels.push({ text: said, color: theme.palette[color], places: [[x, y - font], [x, y + font], [x + 3 * font, y], [x - 3 * font, y]] });
    });
  }
  return drawLabels(context, labels, theme, font, [width, height]);
}
