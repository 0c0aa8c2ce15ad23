/** What a ray meets first: for clicks, and for feet and shoulders of the walker. */

import type { Boxes, Chunk } from "./boxes";
import type { SceneFile } from "./scene_file";

export interface Hit {
  object: number;
  distance: number;
  point: [number, number, number];
  /** Of unit length, towards the ray's origin. */
  normal: [number, number, number];
}

type Vector = readonly [number, number, number];

export class Rays {
  constructor(
    private readonly scene: SceneFile,
    private readonly boxes: Boxes,
    private readonly chunks: Chunk[],
  ) {}

  /** The nearest triangle within `reach` metres along a unit direction, of the objects that `seen` lets pass. */
  cast(origin: Vector, direction: Vector, reach: number, seen: (object: number) => boolean): Hit | null {
    const inverse: Vector = [1 / direction[0], 1 / direction[1], 1 / direction[2]];
    const candidates: [number, number][] = [];
    for (const chunk of this.chunks) {
      if (entry(chunk.box, 0, origin, inverse, reach) === Infinity) continue;
      for (const object of chunk.objects) {
        const near = entry(this.boxes.world, 6 * object, origin, inverse, reach);
        if (near !== Infinity && seen(object)) candidates.push([near, object]);
      }
    }
    candidates.sort((one, other) => one[0] - other[0]);
    let best: Hit | null = null;
    for (const [near, object] of candidates) {
      if (best && near > best.distance) break;
      best = this.castAt(object, origin, direction, best ? best.distance : reach) ?? best;
    }
    return best;
  }

  private castAt(object: number, origin: Vector, direction: Vector, reach: number): Hit | null {
    const { matrix, positions, indices, shapes, shape } = this.scene;
    const m = matrix.subarray(12 * object, 12 * object + 12);
    const [o, d] = [unmoved(m, origin, 1), unmoved(m, direction, 0)];
    if (!o || !d) return null;
    const { vertices, opaque, blended } = shapes[shape[object]];
    let nearest = reach;
    let found = -1;
    for (const [first, count] of [opaque, blended])
      for (let i = first; i < first + count; i += 3) {
        const t = meet(positions, vertices[0], indices, i, o, d);
        if (t < nearest) [nearest, found] = [t, i];
      }
    if (found < 0) return null;
    const normal = turned(m, face(positions, vertices[0], indices, found));
    const facing = normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2] > 0 ? -1 : 1;
    return {
      object,
      distance: nearest,
      point: [0, 1, 2].map((k) => origin[k] + nearest * direction[k]) as Hit["point"],
      normal: normal.map((value) => facing * value) as Hit["normal"],
    };
  }
}

/** Where a ray enters a box, in metres; Infinity where it does not within reach. */
function entry(boxes: Float32Array, at: number, origin: Vector, inverse: Vector, reach: number): number {
  let near = 0;
  let far = reach;
  for (let axis = 0; axis < 3; axis++) {
    const least = boxes[at + axis] - 1e-4;
    const most = boxes[at + axis + 3] + 1e-4;
    if (!Number.isFinite(inverse[axis])) {
      if (origin[axis] < least || origin[axis] > most) return Infinity;
      continue;
    }
    const one = (least - origin[axis]) * inverse[axis];
    const other = (most - origin[axis]) * inverse[axis];
    near = Math.max(near, Math.min(one, other));
    far = Math.min(far, Math.max(one, other));
  }
  return near <= far ? near : Infinity;
}

/** A point (w = 1) or direction (w = 0) in the object's space; null where its matrix has no inverse. */
function unmoved(m: Float32Array, p: Vector, w: 0 | 1): Vector | null {
  const [x, y, z] = [p[0] - w * m[3], p[1] - w * m[7], p[2] - w * m[11]];
  const [c0, c1, c2] = [
    [m[5] * m[10] - m[6] * m[9], m[2] * m[9] - m[1] * m[10], m[1] * m[6] - m[2] * m[5]],
    [m[6] * m[8] - m[4] * m[10], m[0] * m[10] - m[2] * m[8], m[2] * m[4] - m[0] * m[6]],
    [m[4] * m[9] - m[5] * m[8], m[1] * m[8] - m[0] * m[9], m[0] * m[5] - m[1] * m[4]],
  ];
  const determinant = m[0] * c0[0] + m[1] * c1[0] + m[2] * c2[0];
  if (Math.abs(determinant) < 1e-12) return null;
  return [c0, c1, c2].map((c) => (c[0] * x + c[1] * y + c[2] * z) / determinant) as unknown as Vector;
}

/** Distance to a triangle by Möller and Trumbore, from either side; Infinity for none. */
function meet(p: Float32Array, base: number, indices: Uint32Array, i: number, o: Vector, d: Vector): number {
  const a = 3 * (base + indices[i]);
  const b = 3 * (base + indices[i + 1]);
  const c = 3 * (base + indices[i + 2]);
  const [e1x, e1y, e1z] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
  const [e2x, e2y, e2z] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
  const [hx, hy, hz] = [d[1] * e2z - d[2] * e2y, d[2] * e2x - d[0] * e2z, d[0] * e2y - d[1] * e2x];
  const determinant = e1x * hx + e1y * hy + e1z * hz;
  if (Math.abs(determinant) < 1e-12) return Infinity;
  const [sx, sy, sz] = [o[0] - p[a], o[1] - p[a + 1], o[2] - p[a + 2]];
  const u = (sx * hx + sy * hy + sz * hz) / determinant;
  if (u < -1e-6 || u > 1 + 1e-6) return Infinity;
  const [qx, qy, qz] = [sy * e1z - sz * e1y, sz * e1x - sx * e1z, sx * e1y - sy * e1x];
  const v = (d[0] * qx + d[1] * qy + d[2] * qz) / determinant;
  if (v < -1e-6 || u + v > 1 + 1e-6) return Infinity;
  const t = (e2x * qx + e2y * qy + e2z * qz) / determinant;
  return t > 1e-5 ? t : Infinity;
}

function face(p: Float32Array, base: number, indices: Uint32Array, i: number): Vector {
  const [a, b, c] = [0, 1, 2].map((k) => 3 * (base + indices[i + k]));
  const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
  const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
  return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
}

/** A normal in the world, by the matrix' cofactors, of unit length. */
function turned(m: Float32Array, n: Vector): [number, number, number] {
  const rows = [
    [m[5] * m[10] - m[6] * m[9], m[6] * m[8] - m[4] * m[10], m[4] * m[9] - m[5] * m[8]],
    [m[2] * m[9] - m[1] * m[10], m[0] * m[10] - m[2] * m[8], m[1] * m[8] - m[0] * m[9]],
    [m[1] * m[6] - m[2] * m[5], m[2] * m[4] - m[0] * m[6], m[0] * m[5] - m[1] * m[4]],
  ];
  const [x, y, z] = rows.map((row) => row[0] * n[0] + row[1] * n[1] + row[2] * n[2]);
  const length = Math.hypot(x, y, z) || 1;
  return [x / length, y / length, z / length];
}
