/** Bounds of shapes and of objects. */

import type { SceneFile } from "./scene_file";

/** Bounds of every object in the world, and of every shape in its own space: x, y, z of the least and greatest corner. */
export class Boxes {
  readonly local: Float32Array;
  readonly world: Float32Array;

  constructor(scene: SceneFile) {
    this.local = new Float32Array(6 * scene.shapes.length);
    scene.shapes.forEach((shape, number) => {
      const box = this.local.subarray(6 * number, 6 * number + 6);
      const [first, count] = shape.vertices;
      if (count === 0) return;
      box.set([Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity]);
      for (let i = 3 * first; i < 3 * (first + count); i += 3)
        for (let axis = 0; axis < 3; axis++) {
          const value = scene.positions[i + axis];
          if (value < box[axis]) box[axis] = value;
          if (value > box[axis + 3]) box[axis + 3] = value;
        }
    });
    this.world = new Float32Array(6 * scene.count);
    for (let object = 0; object < scene.count; object++) {
      const box = 6 * scene.shape[object];
      for (let axis = 0; axis < 3; axis++) {
        const row = 12 * object + 4 * axis;
        let middle = scene.matrix[row + 3];
        let reach = 0;
        for (let k = 0; k < 3; k++) {
          const [least, most] = [this.local[box + k], this.local[box + 3 + k]];
          middle += (scene.matrix[row + k] * (least + most)) / 2;
          reach += (Math.abs(scene.matrix[row + k]) * (most - least)) / 2;
        }
        this.world[6 * object + axis] = middle - reach;
        this.world[6 * object + 3 + axis] = middle + reach;
      }
    }
  }

  centre(object: number): [number, number, number] {
    const box = this.world.subarray(6 * object, 6 * object + 6);
    return [(box[0] + box[3]) / 2, (box[1] + box[4]) / 2, (box[2] + box[5]) / 2];
  }
}

/** Objects near each other, so that many can be passed over at once. */
export interface Chunk {
  objects: Uint32Array;
  box: Float32Array;
}

/** Objects by the squares of a grid, `size` metres wide, that their middles are in. */
export function chunksOf(boxes: Boxes, count: number, size: number): Chunk[] {
  const members = new Map<string, number[]>();
  for (let object = 0; object < count; object++) {
    const [x, , z] = boxes.centre(object);
    const key = `${Math.floor(x / size)} ${Math.floor(z / size)}`;
    const list = members.get(key);
    if (list) list.push(object);
    else members.set(key, [object]);
  }
  return [...members.values()].map((list) => {
    const box = new Float32Array([Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity]);
    for (const object of list)
      for (let axis = 0; axis < 3; axis++) {
        box[axis] = Math.min(box[axis], boxes.world[6 * object + axis]);
        box[axis + 3] = Math.max(box[axis + 3], boxes.world[6 * object + 3 + axis]);
      }
    return { objects: Uint32Array.from(list), box };
  });
}
