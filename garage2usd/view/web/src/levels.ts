/** Coarser levels of a shape: ever fewer of its triangles, each with how far it strays from the shape. */

import { MeshoptSimplifier } from "meshoptimizer/simplifier";

/**
 * How far the coarser levels may stray, as a share of the shape's radius, and how many times that a turn of the normal by
 * one counts: a wrong shade is seen as long as the shape is more than some pixels across.
 */
const COARSER = [
  { share: 1 / 500, normal: 4 },
  { share: 1 / 150, normal: 4 },
  { share: 1 / 50, normal: 4 },
  { share: 1 / 15, normal: 2 },
  { share: 1 / 5, normal: 2 },
];
/** The same of a shift of the texture by its whole width. */
const TEXTURE = 4;
/**
 * A surface thinner than this share of the radius lies before another one, as a screen on a post, and would sink into it: it
 * strays by a third of its thickness at most, until the level strays by so many times its thickness.
 */
const [THIN, SUNK] = [1 / 50, 10];
const FEWEST_TRIANGLES = 40;
/** A level is kept where it has at most this share of the one before. */
const WORTH = 0.75;

export interface Level {
  indices: Uint32Array;
  /** How far what is drawn lies from the shape, as meshoptimizer measures it, in the shape's units. */
  stray: number;
}

/** The corners of a shape: three numbers a position, four bytes a normal, two numbers a texture coordinate. */
export interface Corners {
  positions: Float32Array;
  normals: Int8Array;
  coordinates: Float32Array;
  /** Which surface each corner has. */
  slots: Uint8Array;
}

export const ready = MeshoptSimplifier.ready;

/** The shape itself, then its coarser levels; none where that is not worth it. */
export function levelsOf(indices: Uint32Array, corners: Corners, radius: number): Level[] {
  const levels = [{ indices, stray: 0 }];
  if (indices.length / 3 < FEWEST_TRIANGLES) return levels;
  const looks = looksOf(corners);
  // one surface at a time, so that none takes the colour of another
  const parts = bySlot(indices, corners.slots);
  const thick = parts.map((part) => thickness(part, corners.positions));
  for (const { share, normal } of COARSER) {
    const stray = share * radius;
    const found = parts.map((part, k) => {
      const isThin = thick[k] < THIN * radius && stray < SUNK * thick[k];
      return simplified(part, corners.positions, looks, isThin ? Math.min(stray, thick[k] / 3) : stray, normal);
    });
    const coarser = Uint32Array.from(found.flatMap((level) => [...level.indices]));
    if (coarser.length === 0) break;
    if (coarser.length > WORTH * levels[levels.length - 1].indices.length) continue;
    levels.push({ indices: coarser, stray: Math.max(...found.map((level) => level.stray)) });
  }
  return levels;
}

function simplified(indices: Uint32Array, positions: Float32Array, looks: Float32Array, stray: number, normal: number): Level {
  const weights = [normal, normal, normal, TEXTURE, TEXTURE].map((weight) => weight * stray);
  const [found, error] = MeshoptSimplifier.simplifyWithAttributes(
    indices, positions, 3, looks, weights.length, weights, null, 0, stray, ["ErrorAbsolute", "Permissive", "Prune"],
  );
  return { indices: found, stray: error };
}

/** The least side of the box around some triangles. */
function thickness(indices: Uint32Array, positions: Float32Array): number {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (const corner of indices)
    for (let axis = 0; axis < 3; axis++) {
      low[axis] = Math.min(low[axis], positions[3 * corner + axis]);
      high[axis] = Math.max(high[axis], positions[3 * corner + axis]);
    }
  return Math.min(...high.map((value, axis) => value - low[axis]));
}

/** Five numbers a corner: its normal and its texture coordinate. */
function looksOf({ normals, coordinates }: Corners): Float32Array {
  const count = coordinates.length / 2;
  const looks = new Float32Array(5 * count);
  for (let k = 0; k < count; k++) {
    for (let axis = 0; axis < 3; axis++) looks[5 * k + axis] = normals[4 * k + axis] / 127;
    looks.set(coordinates.subarray(2 * k, 2 * k + 2), 5 * k + 3);
  }
  return looks;
}

/** The triangles of each surface. */
function bySlot(indices: Uint32Array, slots: Uint8Array): Uint32Array[] {
  const groups = new Map<number, number[]>();
  for (let k = 0; k < indices.length; k += 3) {
    const slot = slots[indices[k]];
    const group = groups.get(slot) ?? [];
    if (!group.length) groups.set(slot, group);
    group.push(indices[k], indices[k + 1], indices[k + 2]);
  }
  return [...groups.values()].map((group) => Uint32Array.from(group));
}
