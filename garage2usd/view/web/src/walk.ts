/** Walking: eyes over the floor, feet on it, and no way through walls, columns and cars. */

import * as THREE from "three";
import { OVERHEAD } from "./classes";
import type { Rays } from "./rays";
import type { SceneFile } from "./scene_file";

export const EYE_M = 1.65;
const SPEED_M_S = 3.2;
const RUN = 2.4;
const BODY_M = 0.32;
/** Heights at which a body meets obstacles: below a bumper, at a bonnet and at a shoulder. */
const HEIGHTS_M = [0.3, 0.75, 1.35];
const STEP_M = 0.35;
const LONGEST_STEP_M = 0.25;
const FLATTEST = 0.6;
/** Height of edges in a floor, such as those of grooves in a ramp, on which a foot stands however steep they are. */
const EDGE_M = 0.05;
const SENSITIVITY = 0.0023;
const TURN_RAD_S = 1.8;

const KEYS: Record<string, "ahead" | "back" | "left" | "right" | "run" | "turnLeft" | "turnRight"> = {
  KeyW: "ahead",
  ArrowUp: "ahead",
  KeyS: "back",
  ArrowDown: "back",
  KeyA: "left",
  KeyD: "right",
  ArrowLeft: "turnLeft",
  ArrowRight: "turnRight",
  ShiftLeft: "run",
  ShiftRight: "run",
};

export class Walker {
  active = false;
  yaw = 0;
  pitch = 0;
  /** Between the feet, in metres. */
  readonly feet = new THREE.Vector3();
  private readonly pressed = new Set<string>();

  constructor(
    private readonly scene: SceneFile,
    private readonly rays: Rays,
  ) {}

  /** Whether a key is one to walk with. */
  key(code: string, down: boolean): boolean {
    const meaning = KEYS[code];
    if (!meaning) return false;
    if (down) this.pressed.add(meaning);
    else this.pressed.delete(meaning);
    return true;
  }

  release(): void {
    this.pressed.clear();
  }

  look(dx: number, dy: number): void {
    this.yaw -= dx * SENSITIVITY;
    this.pitch = Math.max(-1.45, Math.min(1.45, this.pitch - dy * SENSITIVITY));
  }

  /** Stand at a place, or as near to it as there is floor; whether there is any. */
  standAt(x: number, z: number, above: number): boolean {
    for (let ring = 0; ring < 14; ring++)
      for (let k = 0; k < (ring ? 12 : 1); k++) {
        const angle = (k * 2 * Math.PI) / 12;
        const [px, pz] = [x + 0.6 * ring * Math.cos(angle), z + 0.6 * ring * Math.sin(angle)];
        const ground = this.ground(px, pz, above + 0.5, 6);
        if (ground === null || this.isCramped(px, ground, pz)) continue;
        this.feet.set(px, ground, pz);
        return true;
      }
    return false;
  }

  /** Move for some seconds; whether anything changed. */
  advance(seconds: number): boolean {
    const on = (name: string) => (this.pressed.has(name) ? 1 : 0);
    const turn = on("turnLeft") - on("turnRight");
    this.yaw += turn * TURN_RAD_S * seconds;
    const [ahead, right] = [on("ahead") - on("back"), on("right") - on("left")];
    if (!ahead && !right) return turn !== 0;
    const speed = (SPEED_M_S * (on("run") ? RUN : 1)) / Math.hypot(ahead, right);
    const [sin, cos] = [Math.sin(this.yaw), Math.cos(this.yaw)];
    const way = new THREE.Vector2(right * cos - ahead * sin, -right * sin - ahead * cos).multiplyScalar(speed * seconds);
    const steps = Math.max(1, Math.ceil(way.length() / LONGEST_STEP_M));
    way.divideScalar(steps);
    for (let k = 0; k < steps; k++) this.step(way.clone());
    return true;
  }

  place(camera: THREE.PerspectiveCamera): void {
    camera.position.set(this.feet.x, this.feet.y + EYE_M, this.feet.z);
    camera.rotation.set(this.pitch, this.yaw, 0, "YXZ");
  }

  /** One short step, along what stands in the way. */
  private step(way: THREE.Vector2): void {
    for (let slide = 0; slide < 3; slide++) {
      const wall = this.wallAhead(way);
      if (!wall) break;
      const against = way.dot(wall);
      if (against >= 0) break;
      way.addScaledVector(wall, -against);
    }
    if (way.length() < 1e-5 || this.wallAhead(way)) return;
    const [x, z] = [this.feet.x + way.x, this.feet.z + way.y];
    const ground = this.ground(x, z, this.feet.y + STEP_M, 2 * STEP_M);
    if (ground !== null) this.feet.set(x, ground, z);
  }

  /** Direction (x, z), of unit length, away from what a step would run into. */
  private wallAhead(way: THREE.Vector2): THREE.Vector2 | null {
    const length = way.length();
    if (length < 1e-6) return null;
    const [dx, dz] = [way.x / length, way.y / length];
    let nearest: { distance: number; normal: THREE.Vector2 } | null = null;
    for (const height of HEIGHTS_M)
      for (const side of [-0.8, 0, 0.8]) {
        const origin = [this.feet.x - side * BODY_M * dz, this.feet.y + height, this.feet.z + side * BODY_M * dx] as const;
        const hit = this.rays.cast(origin, [dx, 0, dz], BODY_M + length, this.solid);
        if (!hit || Math.abs(hit.normal[1]) > FLATTEST || (nearest && hit.distance >= nearest.distance)) continue;
        nearest = { distance: hit.distance, normal: new THREE.Vector2(hit.normal[0], hit.normal[2]).normalize() };
      }
    return nearest && nearest.normal;
  }

  private isCramped(x: number, ground: number, z: number): boolean {
    for (let k = 0; k < 8; k++) {
      const angle = (k * Math.PI) / 4;
      for (const height of HEIGHTS_M)
        if (this.rays.cast([x, ground + height, z], [Math.cos(angle), 0, Math.sin(angle)], BODY_M + 0.1, this.solid)) return true;
    }
    // beneath a car or inside a wall the way up is short
    const up = this.rays.cast([x, ground + 0.02, z], [0, 1, 0], EYE_M, this.solid);
    return up !== null;
  }

  /** Height of the floor beneath a place; null where there is none. */
  private ground(x: number, z: number, from: number, reach: number): number | null {
    const hit = this.rays.cast([x, from, z], [0, -1, 0], reach, this.solid);
    if (!hit) return null;
    const isEdge = Math.abs(hit.point[1] - this.feet.y) < EDGE_M;
    return hit.normal[1] > FLATTEST || isEdge ? hit.point[1] : null;
  }

  private readonly solid = (object: number): boolean => {
    const label = this.scene.labelOf(object);
    return !OVERHEAD.has(label) && label !== "sky";
  };
}
