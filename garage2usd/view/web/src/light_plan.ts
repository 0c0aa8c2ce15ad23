/**
 * The light of each level as one picture of its plan, so that hundreds of tubes cost a surface one look-up.
 *
 * Red is the square root of a quarter of the direct light on the floor (1 is what most of the lit floor has), green how
 * much of the ceiling shines, blue how much of the light reaches the floor past cars and columns, alpha where a ramp leads
 * up from the floor, over which there is no slab but the lamps of the level above.
 */

import * as THREE from "three";
import type { Boxes } from "./boxes";
import { SHADING } from "./classes";
import { isInside } from "./guides";
import type { SceneFile } from "./scene_file";

const MARGIN_M = 4;
const MOST_TEXELS = 1400;
const FINEST_M = 0.1;
const COARSE_M = 1;
const REACH_M = 14;
const SHADE_BLUR_M = 0.35;
const SHADE = 0.62;
const [DARKEST, BRIGHTEST] = [0.1, 10];

export interface LightPlan {
  /** A layer for each level. */
  texture: THREE.Texture;
  /** Least x and z in metres, and one by the metres across and along. */
  frame: THREE.Vector4;
  /** The top one first. */
  levels: LevelLight[];
}

export interface LevelLight {
  /** Height of the lights in metres. */
  height: number;
  /** Height of the floor in metres. */
  floor: number;
  /** Luminance of a white surface in the direct light that is 1 in the picture, as a renderer has it; 0 where nothing shines. */
  unit: number;
}

interface Lamp {
  level: number;
  x: number;
  y: number;
  z: number;
  /** Candela straight ahead. */
  power: number;
  /** Half of its sides across the plan, or half of its diameters: (x, z) of each. */
  sides: [number, number, number, number];
  round: boolean;
  down: number;
}

export function lightPlanOf(scene: SceneFile, boxes: Boxes): LightPlan {
  const [[x0, , z0], [x1, , z1]] = scene.header.boundsM;
  const [left, back] = [x0 - MARGIN_M, z0 - MARGIN_M];
  const [width, depth] = [x1 - x0 + 2 * MARGIN_M, z1 - z0 + 2 * MARGIN_M];
  const texel = Math.max(FINEST_M, Math.max(width, depth) / MOST_TEXELS);
  const [columns, rows] = [Math.ceil(width / texel), Math.ceil(depth / texel)];
  const all = lampsOf(scene);
  const levels: LevelLight[] = [];
  const layers = new Uint8Array(4 * columns * rows * scene.levels);
  for (let level = 0; level < scene.levels; level++) {
    const lamps = all.filter((lamp) => lamp.level === level);
    const ramps = rampsUp(scene, boxes, level);
    const data = layers.subarray(4 * columns * rows * level, 4 * columns * rows * (level + 1));
    const heights = lamps.map((lamp) => lamp.y).sort((a, b) => a - b);
    const floor = floorHeight(scene, boxes, level);
    // in the well of ramps those of the level above shine down to this floor
    const through = all.filter(({ level: own, x, z }) => own === level - 1 && ramps.some((ramp) => isInside(ramp, x, z)));
    const { field, across, along, unit } = directLight(lamps, through, ramps, floor, left, back, width, depth);
    for (let row = 0; row < rows; row++)
      for (let column = 0; column < columns; column++) {
        const light = between(field, across, along, ((column + 0.5) * texel) / COARSE_M, ((row + 0.5) * texel) / COARSE_M);
        data[4 * (row * columns + column)] = Math.min(255, 255 * Math.sqrt(light / 4));
      }
    const transform = [1 / texel, 0, 0, 1 / texel, -left / texel, -back / texel] as const;
    drawn(columns, rows, transform, (context) => drawLamps(context, lamps), data, 1);
    drawn(columns, rows, transform, (context) => drawShade(context, scene, boxes, { level, floor }), data, 2);
    drawn(columns, rows, transform, (context) => ramps.forEach((ramp) => fill(context, ramp)), data, 3);
    blur(data, columns, rows, Math.max(1, Math.round(SHADE_BLUR_M / texel)));
    levels.push({ height: heights.length ? heights[heights.length >> 1] : scene.header.boundsM[1][1], floor, unit });
  }

  const texture = new THREE.DataArrayTexture(layers, columns, rows, scene.levels);
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.magFilter = THREE.LinearFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return {
    texture,
    frame: new THREE.Vector4(left, back, 1 / (columns * texel), 1 / (rows * texel)),
    levels,
  };
}

function floorHeight(scene: SceneFile, boxes: Boxes, level: number): number {
  const heights: number[] = [];
  for (let object = 0; object < scene.count; object++)
    if (scene.labelOf(object) === "floor" && scene.level[object] === level) heights.push(boxes.world[6 * object + 4]);
  heights.sort((a, b) => a - b);
  return heights.length ? heights[heights.length >> 1] : scene.header.boundsM[0][1];
}

function lampsOf(scene: SceneFile): Lamp[] {
  const lamps: Lamp[] = [];
  for (let object = 0; object < scene.count; object++)
    for (const light of scene.shapes[scene.shape[object]].lights) {
      if (light.kind === "DistantLight" || light.kind === "DomeLight" || !(light.candela > 0)) continue;
      const m = scene.matrix.subarray(12 * object, 12 * object + 12);
      const n = light.matrix;
      const place = (x: number, y: number, z: number, w: number) => {
        const [a, b, c] = [0, 4, 8].map((row) => n[row] * x + n[row + 1] * y + n[row + 2] * z + n[row + 3] * w);
        return [0, 4, 8].map((row) => m[row] * a + m[row + 1] * b + m[row + 2] * c + m[row + 3] * w);
      };
      const [x, y, z] = place(0, 0, 0, 1);
      const side = place(light.size[0] / 2, 0, 0, 0);
      const other = place(0, light.size[1] / 2, 0, 0);
      const bright = 0.2126 * light.rgb[0] + 0.7152 * light.rgb[1] + 0.0722 * light.rgb[2];
      const down = light.kind === "RectLight" || light.kind === "DiskLight" ? -place(0, 0, -1, 0)[1] : 0.7;
      const round = light.kind === "DiskLight";
      lamps.push({ level: scene.level[object], x, y, z, power: light.candela * bright, sides: [side[0], side[2], other[0], other[2]], round, down });
    }
  return lamps;
}

/** Outlines of the ramps that lead up from a level to another one. */
function rampsUp(scene: SceneFile, boxes: Boxes, level: number): [number, number][][] {
  const found: [number, number][][] = [];
  for (let object = 0; level > 0 && object < scene.count; object++)
    if (scene.level[object] === level && scene.labelOf(object) === "ramp") found.push(footprint(scene, boxes, object));
  return found;
}

/**
 * Direct light on the floor by the point-by-point method, on a grid of metres, with that through the openings over the
 * ramps; its upper quartile is 1.
 */
function directLight(
  lamps: Lamp[], through: Lamp[], ramps: [number, number][][], floor: number, left: number, back: number, width: number, depth: number,
) {
  const [across, along] = [Math.ceil(width / COARSE_M) + 1, Math.ceil(depth / COARSE_M) + 1];
  const field = new Float32Array(across * along);
  const open = through.length
    ? Array.from(field, (_, k) => ramps.some((ramp) => isInside(ramp, left + (k % across) * COARSE_M, back + Math.floor(k / across) * COARSE_M)))
    : [];
  const add = (lamp: Lamp, everywhere: boolean) => {
    const height = lamp.y - floor;
    if (height < 0.5 || lamp.down <= 0) return;
    const [column, row] = [(lamp.x - left) / COARSE_M, (lamp.z - back) / COARSE_M];
    const reach = REACH_M / COARSE_M;
    for (let j = Math.max(0, Math.ceil(row - reach)); j <= Math.min(along - 1, row + reach); j++)
      for (let i = Math.max(0, Math.ceil(column - reach)); i <= Math.min(across - 1, column + reach); i++) {
        const square = ((i - column) * COARSE_M) ** 2 + ((j - row) * COARSE_M) ** 2 + height * height;
        if (everywhere || open[j * across + i]) field[j * across + i] += (lamp.power * lamp.down * height * height) / (square * square);
      }
  };
  for (const lamp of lamps) add(lamp, true);
  for (const lamp of through) add(lamp, false);
  const bright = field.filter((value) => value > 0).sort();
  const most = bright.length ? bright[Math.floor(0.75 * bright.length)] : 0;
  for (let k = 0; k < field.length; k++) field[k] = most > 0 ? field[k] / most : 0;
  // what others made may be lit in other units, and is still to be seen
  return { field, across, along, unit: most > 0 ? Math.min(BRIGHTEST, Math.max(DARKEST, most / Math.PI)) : 0 };
}

function between(field: Float32Array, across: number, along: number, x: number, z: number): number {
  const [i, j] = [Math.min(across - 2, Math.floor(x)), Math.min(along - 2, Math.floor(z))];
  const [u, v] = [x - i, z - j];
  const at = j * across + i;
  return (
    (1 - v) * ((1 - u) * field[at] + u * field[at + 1]) + v * ((1 - u) * field[at + across] + u * field[at + across + 1])
  );
}

/** Draw in metres and take what became white as one channel of the data. */
function drawn(
  columns: number,
  rows: number,
  transform: readonly [number, number, number, number, number, number],
  draw: (context: CanvasRenderingContext2D) => void,
  data: Uint8Array,
  channel: number,
): void {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [columns, rows];
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) throw new Error("The browser draws no pictures.");
  context.fillStyle = "black";
  context.fillRect(0, 0, columns, rows);
  context.setTransform(...transform);
  context.fillStyle = "white";
  draw(context);
  const pixels = context.getImageData(0, 0, columns, rows).data;
  for (let k = 0; k < pixels.length; k += 4) data[k + channel] = pixels[k];
}

function drawLamps(context: CanvasRenderingContext2D, lamps: Lamp[]): void {
  for (const { x, z, sides, round } of lamps) {
    const [ax, az, bx, bz] = sides;
    context.beginPath();
    if (round) {
      context.save();
      context.transform(ax, az, bx, bz, x, z);
      context.arc(0, 0, 1, 0, 2 * Math.PI);
      context.restore();
      context.fill();
      continue;
    }
    context.moveTo(x - ax - bx, z - az - bz);
    context.lineTo(x + ax - bx, z + az - bz);
    context.lineTo(x + ax + bx, z + az + bz);
    context.lineTo(x - ax + bx, z - az + bz);
    context.fill();
  }
}

function drawShade(
  context: CanvasRenderingContext2D,
  scene: SceneFile,
  boxes: Boxes,
  { level, floor }: { level: number; floor: number },
): void {
  for (let object = 0; object < scene.count; object++) {
    if (scene.replaced.has(object) || scene.level[object] !== level || !SHADING.has(scene.labelOf(object)) || boxes.world[6 * object + 1] > floor + 0.6) continue;
    fill(context, footprint(scene, boxes, object));
  }
}

function fill(context: CanvasRenderingContext2D, corners: [number, number][]): void {
  context.beginPath();
  corners.forEach(([x, z], k) => (k ? context.lineTo(x, z) : context.moveTo(x, z)));
  context.fill();
}

/** Corners (x, z) of the box of an object, seen from above. */
export function footprint(scene: SceneFile, boxes: Boxes, object: number): [number, number][] {
  const m = scene.matrix.subarray(12 * object, 12 * object + 12);
  const box = boxes.local.subarray(6 * scene.shape[object], 6 * scene.shape[object] + 6);
  const y = (box[1] + box[4]) / 2;
  return [
    [box[0], box[2]],
    [box[3], box[2]],
    [box[3], box[5]],
    [box[0], box[5]],
  ].map(([x, z]) => [m[0] * x + m[1] * y + m[2] * z + m[3], m[8] * x + m[9] * y + m[10] * z + m[11]]);
}

/** Make the shade of things soft, and turn it into the light that is left. */
function blur(data: Uint8Array, columns: number, rows: number, radius: number): void {
  const line = new Float32Array(Math.max(columns, rows) + 1);
  const along = (first: number, step: number, count: number) => {
    for (let k = 0; k < count; k++) line[k + 1] = line[k] + data[first + k * step];
    for (let k = 0; k < count; k++) {
      const [low, high] = [Math.max(0, k - radius), Math.min(count, k + radius + 1)];
      data[first + k * step] = (line[high] - line[low]) / (high - low);
    }
  };
  for (let pass = 0; pass < 2; pass++) {
    for (let row = 0; row < rows; row++) along(4 * row * columns + 2, 4, columns);
    for (let column = 0; column < columns; column++) along(4 * column + 2, 4 * columns, rows);
  }
  for (let k = 2; k < data.length; k += 4) data[k] = 255 - SHADE * data[k];
}
