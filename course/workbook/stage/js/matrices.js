// Matrices and meshes for the view into space. Column-major 4x4, as WebGL reads them.

import { dot } from "./film.js";

export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

export function unit(v) {
  const length = Math.hypot(v[0], v[1], v[2]) || 1;
  return v.map((c) => c / length);
}

export function multiplied(a, b) {
  const out = new Float32Array(16);
  for (let column = 0; column < 4; column += 1) {
    for (let row = 0; row < 4; row += 1) {
      let sum = 0;
      for (let k = 0; k < 4; k += 1) sum += a[4 * k + row] * b[4 * column + k];
      out[4 * column + row] = sum;
    }
  }
  return out;
}

/** Perspective; `angle` from foot to top of the picture [rad]. */
export function perspective(angle, aspect, near, far) {
  const f = 1 / Math.tan(angle / 2);
  return new Float32Array([f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (near + far) / (near - far), -1,
    0, 0, (2 * near * far) / (near - far), 0]);
}

/** From the world to the eye's axes: x right, y up, looking along -z. */
export function lookAt(eye, target, up) {
  const back = unit(eye.map((v, i) => v - target[i]));
  const right = unit(cross(up, back));
  const above = cross(back, right);
  return new Float32Array([right[0], above[0], back[0], 0, right[1], above[1], back[1], 0,
    right[2], above[2], back[2], 0, -dot(right, eye), -dot(above, eye), -dot(back, eye), 1]);
}

/** A body's place in a row of numbers: the axes that its quaternion gives, and its position. */
export function putPlace(out, from, position, [x, y, z, w]) {
  out[from] = 1 - 2 * (y * y + z * z);
  out[from + 1] = 2 * (x * y + w * z);
  out[from + 2] = 2 * (x * z - w * y);
  out[from + 3] = 2 * (x * y - w * z);
  out[from + 4] = 1 - 2 * (x * x + z * z);
  out[from + 5] = 2 * (y * z + w * x);
  out[from + 6] = 2 * (x * z + w * y);
  out[from + 7] = 2 * (y * z - w * x);
  out[from + 8] = 1 - 2 * (x * x + y * y);
  for (let i = 0; i < 3; i += 1) out[from + 9 + i] = position[i];
}

/** Flattens along the light onto a plane z = height: a body's shadow. */
export function shadowOn(height, light) {
  const [a, b] = [-light[0] / light[2], -light[1] / light[2]];
  return new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, a, b, 0, 0, -a * height, -b * height, height, 1]);
}

/** Where a point of the world is on a canvas, and whether it is before the eye. */
export function projected(matrix, p, width, height) {
  const w = matrix[3] * p[0] + matrix[7] * p[1] + matrix[11] * p[2] + matrix[15];
  const x = matrix[0] * p[0] + matrix[4] * p[1] + matrix[8] * p[2] + matrix[12];
  const y = matrix[1] * p[0] + matrix[5] * p[1] + matrix[9] * p[2] + matrix[13];
  return { point: [(0.5 + x / w / 2) * width, (0.5 - y / w / 2) * height], before: w > 0 };
}

/**
 * Corners with normals and colours, three a triangle: faces stay flat, or shade smoothly
 * where the solid is round. Nine numbers a corner: place, normal, colour.
 */
export function corners(vertices, triangles, colors, smooth) {
  const at = (k) => [vertices[3 * k], vertices[3 * k + 1], vertices[3 * k + 2]];
  const count = triangles.length / 3;
  const faces = [];
  const sums = new Float64Array(vertices.length);
  for (let f = 0; f < count; f += 1) {
    const k = [0, 1, 2].map((i) => triangles[3 * f + i]);
    const [a, b, c] = k.map(at);
    const normal = cross(b.map((v, i) => v - a[i]), c.map((v, i) => v - a[i]));
    for (const v of k) for (let i = 0; i < 3; i += 1) sums[3 * v + i] += normal[i];
    faces.push({ k, normal: unit(normal) });
  }
  const out = new Float32Array(27 * count);
  faces.forEach(({ k, normal }, f) => k.forEach((v, i) => {
    const n = smooth ? unit([sums[3 * v], sums[3 * v + 1], sums[3 * v + 2]]) : normal;
    out.set([...at(v), ...n, ...colors[v]], 27 * f + 9 * i);
  }));
  return out;
}

/** Corners that are the same in all their numbers once, and which of them each triangle has. */
export function indexed(values, stride) {
  const [kept, known] = [[], new Map()];
  const index = Uint32Array.from({ length: values.length / stride }, (_, k) => {
    const corner = values.subarray(k * stride, (k + 1) * stride);
    const key = corner.join();
    if (!known.has(key)) { known.set(key, known.size); kept.push(...corner); }
    return known.get(key);
  });
  return { values: new Float32Array(kept), index };
}

/**
 * Corners of copies of a mesh, one after the other: place, normal, colour, as `corners` has them.
 * @param {Float32Array} values of one mesh, six numbers a corner, or nine with colours @param {number} stride six or nine
 * @param {Float32Array} copies fifteen numbers each: three axes, a place, a colour
 * @param {Float32Array} out nine numbers a corner of a copy
 */
export function copied(values, stride, copies, out) {
  let to = 0;
  for (let from = 0; from < copies.length; from += 15) {
    const [a, b, c, d, e, f, g, h, i, x, y, z, red, green, blue] = copies.subarray(from, from + 15);
    const [p, q, r] = [1 / (Math.hypot(a, b, c) || 1), 1 / (Math.hypot(d, e, f) || 1), 1 / (Math.hypot(g, h, i) || 1)];
    for (let k = 0; k < values.length; k += stride, to += 9) {
      const [u, v, w] = [values[k], values[k + 1], values[k + 2]];
      const [l, m, n] = [p * values[k + 3], q * values[k + 4], r * values[k + 5]];
      out[to] = x + a * u + d * v + g * w;
      out[to + 1] = y + b * u + e * v + h * w;
      out[to + 2] = z + c * u + f * v + i * w;
      out[to + 3] = a * l + d * m + g * n;
      out[to + 4] = b * l + e * m + h * n;
      out[to + 5] = c * l + f * m + i * n;
      out[to + 6] = stride > 6 ? red * values[k + 6] : red;
      out[to + 7] = stride > 6 ? green * values[k + 7] : green;
      out[to + 8] = stride > 6 ? blue * values[k + 8] : blue;
    }
  }
}

/** An arrow of length 1 along z, as `corners` has it; its shaft has radius 1, to be thinned. */
export function arrowCorners(sides = 10, head = 1) {
  const ring = (radius, z) => Array.from({ length: sides }, (_, k) => {
    const turn = (2 * Math.PI * k) / sides;
    return [radius * Math.cos(turn), radius * Math.sin(turn), z];
  });
  const rings = head ? [ring(2.4, 0), [[0, 0, 1]]] : [ring(1, 0), ring(1, 1)];
  const out = [];
  const push = (a, b, c) => {
    const n = unit(cross(b.map((v, i) => v - a[i]), c.map((v, i) => v - a[i])));
    for (const p of [a, b, c]) out.push(...p, ...n);
  };
  for (let k = 0; k < sides; k += 1) {
    const after = (k + 1) % sides;
    const [low, high] = rings;
    if (head) push(low[k], low[after], high[0]);
    else { push(low[k], low[after], high[after]); push(low[k], high[after], high[k]); }
    push([0, 0, 0], low[after], low[k]);
  }
  return new Float32Array(out);
}

/** A rotation that takes z to a direction, as three columns. */
export function frameAlong(direction) {
  const along = unit(direction);
  const aside = Math.abs(along[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0];
  const second = unit(cross(along, aside));
  return [cross(second, along), second, along];
}
