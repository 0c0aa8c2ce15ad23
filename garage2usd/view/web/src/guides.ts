/** What lies over the garage: the lane graph, the stalls by their use, and what a physics engine collides with. */

import * as THREE from "three";
import { NODE_COLOURS, USE_COLOURS } from "./classes";
import type { Lanes, SceneFile } from "./scene_file";

const LIFT_M = 0.06;
const LANE_WIDTH_M = 0.36;
const NODE_RADIUS_M = 0.75;
const NODE_SIDES = 20;
const ARROW_M = 1.4;
const ARROW_LIFT_M = LIFT_M + 0.004;
const LANE_COLOUR = "#ffd84d";
const STALL_INSET_M = 0.12;

type Corner = [number, number, number];

/** Triangles on the floor, each corner with a colour. */
class Flat {
  private readonly places: number[] = [];
  private readonly colours: number[] = [];

  /** Corners are (x, y, z). */
  triangle(corners: Corner[], colour: THREE.Color): void {
    for (const corner of corners) {
      this.places.push(...corner);
      this.colours.push(colour.r, colour.g, colour.b);
    }
  }

  quad([a, b, c, d]: Corner[], colour: THREE.Color): void {
    this.triangle([a, b, c], colour);
    this.triangle([a, c, d], colour);
  }

  mesh(opacity: number): THREE.Mesh {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(this.places, 3));
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(this.colours, 3));
    const material = new THREE.MeshBasicMaterial({
      vertexColors: true,
      side: THREE.DoubleSide,
      transparent: opacity < 1,
      opacity,
      depthWrite: false,
      polygonOffset: true,
      polygonOffsetFactor: -2,
      polygonOffsetUnits: -8,
      toneMapped: false,
    });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.renderOrder = 2e6;
    return mesh;
  }
}

/** Of each level, the lanes and the ramps that lead up from it. */
export function laneGraphOf(lanes: Lanes, levels: number): THREE.Object3D {
  return grouped(levels, (level) => lanesOf(lanes, level));
}

function lanesOf(lanes: Lanes, level: number): THREE.Mesh {
  const flat = new Flat();
  const colour = new THREE.Color(LANE_COLOUR);
  lanes.forward.forEach((forward, edge) => {
    const ends = [lanes.edges[2 * edge], lanes.edges[2 * edge + 1]];
    if (Math.max(...ends.map((end) => lanes.levels[end])) !== level) return;
    const [from, to] = ends.map((end) => 3 * end);
    const n = lanes.nodes;
    const length = Math.hypot(n[to] - n[from], n[to + 2] - n[from + 2]) || 1;
    const [dx, dz] = [(n[to] - n[from]) / length, (n[to + 2] - n[from + 2]) / length];
    const at = (along: number, across: number, lift = LIFT_M): Corner => [
      n[from] + along * dx - across * dz,
      n[from + 1] + (along / length) * (n[to + 1] - n[from + 1]) + lift,
      n[from + 2] + along * dz + across * dx,
    ];
    const half = LANE_WIDTH_M / 2;
    flat.quad([at(0, -half), at(0, half), at(length, half), at(length, -half)], colour);
    const middle = length / 2;
    const arrow = (sign: number, centre: number) => {
      const [tip, base] = [centre + sign * ARROW_M * 0.6, centre - sign * ARROW_M * 0.4];
      flat.triangle([at(tip, 0, ARROW_LIFT_M), at(base, -0.65, ARROW_LIFT_M), at(base, 0.65, ARROW_LIFT_M)], colour);
    };
    if (forward) arrow(1, middle);
    else {
      arrow(1, middle + 0.9);
      arrow(-1, middle - 0.9);
    }
  });
  lanes.kinds.forEach((kind, node) => {
    if (lanes.levels[node] !== level) return;
    const [x, y, z] = lanes.nodes.subarray(3 * node, 3 * node + 3);
    const shade = new THREE.Color(NODE_COLOURS[kind] ?? "#ffffff");
    const radius = kind === "entrance" || kind === "exit" ? 1.6 * NODE_RADIUS_M : NODE_RADIUS_M;
    for (let k = 0; k < NODE_SIDES; k++) {
      const [a, b] = [k, k + 1].map((step) => (step * 2 * Math.PI) / NODE_SIDES);
      const high = y + LIFT_M + 0.008;
      const rim = (angle: number): Corner => [x + radius * Math.cos(angle), high, z + radius * Math.sin(angle)];
      flat.triangle([[x, high, z], rim(a), rim(b)], shade);
    }
  });
  return flat.mesh(1);
}

export function stallPlanOf(lanes: Lanes, floors: number[]): THREE.Object3D {
  return grouped(floors.length, (level) => stallsOf(lanes, level, floors[level]));
}

function stallsOf(lanes: Lanes, level: number, floor: number): THREE.Mesh {
  const flat = new Flat();
  for (const stall of lanes.stalls) {
    if (stall.level !== level) continue;
    const colour = new THREE.Color(USE_COLOURS[stall.use ?? ""] ?? "#9aa5b1");
    const [cx, cz] = middleOf(stall.corners);
    const inset = stall.corners.map(([x, z]): Corner => {
      const length = Math.hypot(x - cx, z - cz);
      const share = (length - STALL_INSET_M * Math.SQRT2) / length;
      return [cx + share * (x - cx), floor + 0.03, cz + share * (z - cz)];
    });
    flat.quad(inset, colour);
  }
  return flat.mesh(0.55);
}

/** A group with a child for each level. */
function grouped(levels: number, of: (level: number) => THREE.Mesh): THREE.Group {
  const group = new THREE.Group();
  for (let level = 0; level < levels; level++) group.add(of(level));
  return group;
}

export function middleOf(corners: [number, number][]): [number, number] {
  return [0, 1].map((k) => corners.reduce((sum, corner) => sum + corner[k], 0) / corners.length) as [number, number];
}

export function isInside(corners: [number, number][], x: number, z: number): boolean {
  let inside = false;
  corners.forEach(([x1, z1], k) => {
    const [x0, z0] = corners[(k + corners.length - 1) % corners.length];
    if (z1 > z !== z0 > z && x < ((x0 - x1) * (z - z1)) / (z0 - z1) + x1) inside = !inside;
  });
  return inside;
}

const LINE_VERTEX = /* glsl */ `
attribute vec4 row0;
attribute vec4 row1;
attribute vec4 row2;
void main() {
  vec4 p = vec4(position, 1.0);
  gl_Position = projectionMatrix * viewMatrix * vec4(dot(row0, p), dot(row1, p), dot(row2, p), 1.0);
  gl_Position.z -= 0.0002 * gl_Position.w;
}`;

const LINE_FRAGMENT = /* glsl */ `
void main() {
  gl_FragColor = vec4(0.16, 1.0, 0.42, 1.0);
  #include <colorspace_fragment>
}`;

/** Colliders of the objects whose layers are on. */
export class Colliders {
  readonly group = new THREE.Group();
  readonly count: number;
  private readonly material = new THREE.ShaderMaterial({ vertexShader: LINE_VERTEX, fragmentShader: LINE_FRAGMENT });
  private readonly members: number[][];
  /** Ends of lines, by shape. */
  private readonly points: Float32Array[] = [];

  constructor(private readonly scene: SceneFile) {
    this.members = scene.shapes.map(() => []);
    for (let object = 0; object < scene.count; object++) this.members[scene.shape[object]].push(object);
    this.count = scene.shapes.reduce((sum, shape, k) => sum + (shape.colliders ? this.members[k].length : 0), 0);
    this.group.visible = false;
  }

  /** Ask the server for the lines, once. */
  async load(): Promise<void> {
    if (this.points.length) return;
    const data = await (await fetch("colliders.bin")).arrayBuffer();
    const counts = new Uint32Array(data, 0, this.scene.shapes.length);
    let at = counts.byteLength;
    for (const count of counts) {
      this.points.push(new Float32Array(data, at, 3 * count));
      at += 12 * count;
    }
  }

  /** Draw those of the visible objects. */
  show(visible: Uint8Array): void {
    for (const child of this.group.children as THREE.LineSegments[]) child.geometry.dispose();
    this.group.clear();
    this.points.forEach((points, number) => {
      const shown = this.members[number].filter((object) => visible[object]);
      if (!points.length || !shown.length) return;
      const geometry = new THREE.InstancedBufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
      const rows = new Float32Array(12 * shown.length);
      shown.forEach((object, k) => rows.set(this.scene.matrix.subarray(12 * object, 12 * object + 12), 12 * k));
      const buffer = new THREE.InstancedInterleavedBuffer(rows, 12, 1);
      [0, 1, 2].forEach((k) => geometry.setAttribute(`row${k}`, new THREE.InterleavedBufferAttribute(buffer, 4, 4 * k)));
      geometry.instanceCount = shown.length;
      const lines = new THREE.LineSegments(geometry, this.material);
      lines.frustumCulled = false;
      this.group.add(lines);
    });
  }
}

/** The box of the selected object. */
export class Frame {
  readonly lines: THREE.LineSegments;

  constructor() {
    const geometry = new THREE.EdgesGeometry(new THREE.BoxGeometry(1, 1, 1));
    this.lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: "#ffb020", toneMapped: false }));
    this.lines.matrixAutoUpdate = false;
    this.lines.frustumCulled = false;
    this.lines.visible = false;
  }

  around(scene: SceneFile, local: Float32Array, object: number): void {
    const box = local.subarray(6 * scene.shape[object], 6 * scene.shape[object] + 6);
    const m = scene.matrix.subarray(12 * object, 12 * object + 12);
    const size = [0, 1, 2].map((k) => box[k + 3] - box[k] + 0.04);
    const middle = [0, 1, 2].map((k) => (box[k] + box[k + 3]) / 2);
    this.lines.matrix
      .set(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], 0, 0, 0, 1)
      .multiply(new THREE.Matrix4().makeTranslation(middle[0], middle[1], middle[2]))
      .multiply(new THREE.Matrix4().makeScale(size[0], size[1], size[2]));
    this.lines.matrixWorldNeedsUpdate = true;
    this.lines.visible = true;
  }
}
