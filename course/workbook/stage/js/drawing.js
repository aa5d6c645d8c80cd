// WebGL2 for all pictures in space. Browsers keep about 16 contexts alive: all pictures of a page
// are drawn by one, out of sight, and copied onto canvases of their own.

import { arrowCorners, copied, indexed, unit } from "./matrices.js";

export const LIGHT = unit([-0.45, 0.62, -1]); // the way it shines
export const INSTANCE = 15; // numbers: three axes, a place, a colour
const ONCE = Float32Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1);
const FEW = 200; // corners of a mesh whose copies a processor writes out sooner than it begins each of them anew
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

function rendererOf(gl) {
  const told = gl.getExtension("WEBGL_debug_renderer_info");
  return String(gl.getParameter(told ? told.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}

// A strip along the third axis, as wide as the first on both sides.
const RIBBON = Float32Array.of(-1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, -1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, -1, 0, 1, 0, 1, 0);

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
    this.ribbon = this.mesh(RIBBON, [3, 3]);
  }

  /** Corners: `sizes` numbers for each attribute from location 0 on; and room for instances. */
  mesh(values, sizes) {
    return this.#mesh(indexed(values, sizes.reduce((a, b) => a + b, 0)), sizes);
  }

  #mesh(once, sizes) {
    const { gl } = this;
    const array = gl.createVertexArray();
    const [buffer, order, instances] = [0, 1, 2].map(() => gl.createBuffer());
    const stride = sizes.reduce((a, b) => a + b, 0);
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
    return { array, buffers: [buffer, order, instances], instances, count: once.index.length, once, stride };
  }

  /** One mesh of all copies of another, with room for some more. */
  #copy(mesh, copies) {
    const { gl } = this;
    const { once: { values, index }, stride } = mesh;
    const [corners, count] = [values.length / stride, copies.length / INSTANCE];
    if (!mesh.all || mesh.all.room < count) {
      if (mesh.all) this.drop([mesh.all]);
      const room = 2 ** Math.ceil(Math.log2(count));
      const order = Uint32Array.from({ length: index.length * room },
        (_, k) => index[k % index.length] + corners * Math.floor(k / index.length));
      mesh.all = { ...this.#mesh({ values: new Float32Array(9 * corners * room), index: order }, [3, 3, 3]), room };
      gl.bindBuffer(gl.ARRAY_BUFFER, mesh.all.instances);
      gl.bufferData(gl.ARRAY_BUFFER, ONCE, gl.STATIC_DRAW);
      mesh.all.drawn = 1;
    }
    const { all } = mesh;
    all.count = index.length * count;
    copied(values, stride, copies, all.once.values);
    gl.bindBuffer(gl.ARRAY_BUFFER, all.buffers[0]);
    gl.bufferData(gl.ARRAY_BUFFER, all.once.values.subarray(0, 9 * corners * count), gl.DYNAMIC_DRAW);
  }

  /** Draws a mesh once for each 15 numbers; none: for those it was drawn with before. */
  draw(mesh, values, color, lines = false) {
    const { gl, uniform } = this;
    if (values) mesh.spread = this.slow && values.length > INSTANCE && mesh.once.values.length < FEW * mesh.stride;
    if (mesh.spread) {
      if (values) this.#copy(mesh, values);
      this.draw(mesh.all, null, color);
      return;
    }
    gl.bindVertexArray(mesh.array);
    if (values) {
      gl.bindBuffer(gl.ARRAY_BUFFER, mesh.instances);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
      mesh.drawn = values.length / INSTANCE;
    }
    gl.uniform4fv(uniform.flat_color, color || [0, 0, 0, 0]);
    gl.drawElementsInstanced(lines ? gl.LINES : gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0, mesh.drawn);
  }

  /** What is drawn here is seen only where something is before it, faintly. @param {number} part of its colour @param {() => void} act */
  through(part, act) {
    const { gl } = this;
    gl.depthFunc(gl.GREATER);
    gl.depthMask(false);
    gl.enable(gl.BLEND);
    gl.blendColor(0, 0, 0, part);
    gl.blendFunc(gl.CONSTANT_ALPHA, gl.ONE_MINUS_CONSTANT_ALPHA);
    act();
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    gl.depthFunc(gl.LESS);
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
    for (const { array, buffers, all } of meshes) {
      if (all) this.drop([all]);
      this.gl.deleteVertexArray(array);
      for (const buffer of buffers) this.gl.deleteBuffer(buffer);
    }
  }
}

/** The same for every stage of a page, each of which may be a module of its own. @returns {Drawing} */
export function sharedDrawing() {
  const name = Symbol.for("course.stage.drawing");
  globalThis[name] = globalThis[name] || new Drawing();
  return globalThis[name];
}
