/** All objects, drawn as instances of their shapes: what cannot be seen is left out, what is far is drawn coarsely. */

import * as THREE from "three";
import type { Boxes, Chunk } from "./boxes";
import { levelsOf, ready } from "./levels";
import type { SceneFile } from "./scene_file";
import type { SurfaceMaterials } from "./surface_material";

const STRIDE = 16;
/** A shape is drawn at its coarsest level that strays by at most so many pixels. */
const STRAY_PX = 0.5;
const [SHEET_M, SHEET_RADIUS_M] = [0.05, 1.5];
/** What is smaller is not drawn. */
const LEAST_PX = 1.5;

/** Instances of one shape at one level. */
class Batch {
  readonly mesh: THREE.Mesh;
  readonly list: Uint32Array;
  private shown: Uint32Array;
  private shownCount = -1;
  count = 0;
  /** Whether one of the listed objects may have moved. */
  moved = false;
  private readonly buffer: THREE.InstancedInterleavedBuffer;

  constructor(
    source: THREE.BufferGeometry,
    index: THREE.BufferAttribute,
    material: THREE.Material,
    readonly triangles: number,
    capacity: number,
  ) {
    const geometry = new THREE.InstancedBufferGeometry();
    for (const [name, attribute] of Object.entries(source.attributes)) geometry.setAttribute(name, attribute);
    geometry.setIndex(index);
    this.buffer = new THREE.InstancedInterleavedBuffer(new Float32Array(STRIDE * capacity), STRIDE, 1);
    this.buffer.setUsage(THREE.DynamicDrawUsage);
    ["row0", "row1", "row2", "info"].forEach((name, k) =>
      geometry.setAttribute(name, new THREE.InterleavedBufferAttribute(this.buffer, 4, 4 * k)),
    );
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.matrixAutoUpdate = false;
    this.list = new Uint32Array(capacity);
    this.shown = new Uint32Array(capacity);
  }

  /** Put the listed objects before the graphics card, unless they are what it has. */
  commit(instances: Float32Array): void {
    const { count, list } = this;
    this.mesh.visible = count > 0;
    (this.mesh.geometry as THREE.InstancedBufferGeometry).instanceCount = count;
    let same = count === this.shownCount && !this.moved;
    for (let k = 0; same && k < count; k++) same = list[k] === this.shown[k];
    if (same || count === 0) return;
    const data = this.buffer.array as Float32Array;
    for (let k = 0; k < count; k++) {
      const from = STRIDE * list[k];
      for (let i = 0; i < STRIDE; i++) data[STRIDE * k + i] = instances[from + i];
    }
    this.shown.set(list.subarray(0, count));
    this.shownCount = count;
    this.buffer.clearUpdateRanges();
    this.buffer.addUpdateRange(0, STRIDE * count);
    this.buffer.needsUpdate = true;
  }
}

interface ShapeBatches {
  levels: Batch[];
  /** How far each level strays, in the shape's units. */
  strays: number[];
  blended: Batch | null;
  radius: number;
}

export interface Drawn {
  objects: number;
  triangles: number;
  calls: number;
}

export class Instances {
  readonly group = new THREE.Group();
  /** Objects of agents that are there. */
  moving: number[] = [];
  readonly drawn: Drawn = { objects: 0, triangles: 0, calls: 0 };
  /** Whether each object is in a layer that is on. */
  readonly visible: Uint8Array;
  private readonly instances: Float32Array;
  /** How many metres a unit of each object's shape is at most. */
  private readonly scales: Float32Array;
  private readonly shapes: ShapeBatches[] = [];
  private readonly frustum = new THREE.Frustum();
  private readonly projection = new THREE.Matrix4();
  private readonly box = new THREE.Box3();
  private readonly sphere = new THREE.Sphere();

  private constructor(
    private readonly scene: SceneFile,
    private readonly boxes: Boxes,
    private readonly chunks: Chunk[],
    materials: SurfaceMaterials,
  ) {
    const total = scene.shape.length;
    this.visible = new Uint8Array(total).fill(1);
    this.instances = new Float32Array(STRIDE * total);
    this.scales = new Float32Array(total);
    const members = new Uint32Array(scene.shapes.length);
    for (let object = 0; object < total; object++) {
      members[scene.shape[object]] += 1;
      const matrix = scene.matrix.subarray(12 * object, 12 * object + 12);
      this.scales[object] = Math.max(...[0, 1, 2].map((axis) => Math.hypot(matrix[axis], matrix[axis + 4], matrix[axis + 8])));
      this.instances.set(matrix, STRIDE * object);
      this.instances.set([materials.paletteStart[scene.palette[object]], scene.label[object], object, 0], STRIDE * object + 12);
    }
    scene.shapes.forEach((_, number) => this.shapes.push(this.batchesOf(number, members[number], materials)));
    for (const { levels, blended } of this.shapes) for (const batch of [...levels, blended]) if (batch) this.group.add(batch.mesh);
  }

  static async create(scene: SceneFile, boxes: Boxes, chunks: Chunk[], materials: SurfaceMaterials): Promise<Instances> {
    await ready;
    return new Instances(scene, boxes, chunks, materials);
  }

  private batchesOf(number: number, members: number, materials: SurfaceMaterials): ShapeBatches {
    const { scene } = this;
    const { vertices, opaque, blended, doubleSided, skin } = scene.shapes[number];
    const [first, count] = vertices;
    const geometry = new THREE.BufferGeometry();
    const positions = scene.positions.subarray(3 * first, 3 * (first + count));
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(scene.normals.subarray(4 * first, 4 * (first + count)), 4, true));
    geometry.setAttribute("uv", new THREE.BufferAttribute(scene.coordinates.subarray(2 * first, 2 * (first + count)), 2));
    geometry.setAttribute("slot", new THREE.BufferAttribute(scene.slots.subarray(first, first + count), 1));
    if (skin) {
      geometry.setAttribute("joints", new THREE.BufferAttribute(scene.bytes(skin.joints), 4));
      geometry.setAttribute("weights", new THREE.BufferAttribute(scene.bytes(skin.weights), 4, true));
    }
    const box = this.boxes.local.subarray(6 * number, 6 * number + 6);
    const radius = Math.hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]) / 2;
    const material = skin ? materials.skinned : doubleSided ? materials.opaqueTwoSided : materials.opaque;
    const levels: Batch[] = [];
    const strays: number[] = [];
    if (opaque[1]) {
      const full = scene.indices.subarray(opaque[0], opaque[0] + opaque[1]);
      // a floor has few triangles, and each is seen from afar
      const isSheet = radius > SHEET_RADIUS_M && Math.min(box[3] - box[0], box[4] - box[1], box[5] - box[2]) < SHEET_M;
      const corners = {
        positions,
        normals: scene.normals.subarray(4 * first, 4 * (first + count)),
        coordinates: scene.coordinates.subarray(2 * first, 2 * (first + count)),
        slots: scene.slots.subarray(first, first + count),
      };
      for (const { indices, stray } of isSheet ? [{ indices: full, stray: 0 }] : levelsOf(full, corners, radius)) {
        strays.push(stray);
        const index = new THREE.BufferAttribute(narrow(indices, count), 1);
        const batch = new Batch(geometry, index, material, indices.length / 3, members);
        // the large and the far last: what stands before it hides it
        batch.mesh.renderOrder = radius;
        levels.push(batch);
      }
    }
    let glass: Batch | null = null;
    if (blended[1]) {
      const indices = scene.indices.subarray(blended[0], blended[0] + blended[1]);
      const index = new THREE.BufferAttribute(narrow(indices, count), 1);
      glass = new Batch(geometry, index, materials.blended, indices.length / 3, members);
      glass.mesh.renderOrder = 1e6;
    }
    return { levels, strays, blended: glass, radius };
  }

  /** Put an object of an agent somewhere; `person` is the number of its skin's pose. */
  move(object: number, matrix: THREE.Matrix4, person = 0): void {
    const e = matrix.elements;
    for (let row = 0; row < 3; row++) for (let k = 0; k < 4; k++) this.instances[STRIDE * object + 4 * row + k] = e[4 * k + row];
    this.instances[STRIDE * object + 15] = person;
  }

  /** Choose what is drawn, and how finely; `coarse` from 1 on makes it coarser. */
  update(camera: THREE.PerspectiveCamera, heightPx: number, coarse: number): void {
    const { scene, boxes, box, frustum } = this;
    this.projection.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    frustum.setFromProjectionMatrix(this.projection);
    const least = coarse > 1 ? 2 * LEAST_PX : LEAST_PX;
    const pixels = heightPx / (2 * Math.tan((camera.fov * Math.PI) / 360));
    const { x, y, z } = camera.position;
    const all = this.shapes.flatMap(({ levels, blended }) => (blended ? [...levels, blended] : levels));
    for (const batch of all) {
      batch.count = 0;
      batch.moved = false;
    }
    const list = (object: number, distance: number, reach: number, moved: boolean) => {
      if ((pixels * reach) / distance < least) return;
      const { levels, strays, blended } = this.shapes[scene.shape[object]];
      const most = (STRAY_PX * coarse * distance) / (pixels * this.scales[object]);
      let level = levels.length - 1;
      while (level > 0 && strays[level] > most) level -= 1;
      for (const batch of [levels[level], blended]) {
        if (!batch) continue;
        batch.list[batch.count++] = object;
        batch.moved ||= moved;
      }
    };
    for (const chunk of this.chunks) {
      box.min.fromArray(chunk.box, 0);
      box.max.fromArray(chunk.box, 3);
      if (!frustum.intersectsBox(box)) continue;
      for (const object of chunk.objects) {
        if (!this.visible[object]) continue;
        const at = 6 * object;
        box.min.fromArray(boxes.world, at);
        box.max.fromArray(boxes.world, at + 3);
        if (!frustum.intersectsBox(box)) continue;
        const w = boxes.world;
        const dx = Math.max(w[at] - x, 0, x - w[at + 3]);
        const dy = Math.max(w[at + 1] - y, 0, y - w[at + 4]);
        const dz = Math.max(w[at + 2] - z, 0, z - w[at + 5]);
        const reach = Math.hypot(w[at + 3] - w[at], w[at + 4] - w[at + 1], w[at + 5] - w[at + 2]);
        list(object, Math.max(0.05, Math.hypot(dx, dy, dz)), reach, false);
      }
    }
    for (const object of this.moving) {
      const { radius } = this.shapes[scene.shape[object]];
      const at = STRIDE * object;
      this.sphere.center.set(this.instances[at + 3], this.instances[at + 7], this.instances[at + 11]);
      // origins of cars and people lie within their bodies' spheres
      this.sphere.radius = 2 * radius;
      if (!frustum.intersectsSphere(this.sphere)) continue;
      list(object, Math.max(0.05, this.sphere.center.distanceTo(camera.position) - radius), 2 * radius, true);
    }
    const { drawn } = this;
    drawn.objects = drawn.triangles = drawn.calls = 0;
    for (const { levels, blended } of this.shapes)
      for (const batch of [...levels, blended]) {
        if (!batch) continue;
        batch.commit(this.instances);
        drawn.objects += batch === blended && levels.length ? 0 : batch.count;
        drawn.triangles += batch.count * batch.triangles;
        drawn.calls += batch.count ? 1 : 0;
      }
  }
}

function narrow(indices: Uint32Array, vertices: number): Uint16Array | Uint32Array {
  return vertices <= 0xffff ? Uint16Array.from(indices) : Uint32Array.from(indices);
}
