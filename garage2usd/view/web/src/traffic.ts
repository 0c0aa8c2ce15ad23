/** Cars and people of tracks over time, as plain bodies in their sizes and colours, and the time line that plays them. */

import * as THREE from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { element } from "./panel";
import type { SceneFile } from "./scene_file";

const PERSON_RGB = [0.95, 0.45, 0.1];
const POSE = 5;
/** Boxes of a car and a person of 1 m in length, width and height: middle, size, and share of the colour. */
const BODIES: Record<"car" | "person", number[][]> = {
  car: [
    [0, 0.36, 0, 1, 0.44, 1, 1],
    [0, 0.78, 0.06, 0.84, 0.44, 0.52, 0.45],
    [0, 0.38, -0.5, 0.7, 0.08, 0.01, 3],
    [-0.38, 0.12, -0.3, 0.2, 0.24, 0.16, 0.12],
    [0.38, 0.12, -0.3, 0.2, 0.24, 0.16, 0.12],
    [-0.38, 0.12, 0.3, 0.2, 0.24, 0.16, 0.12],
    [0.38, 0.12, 0.3, 0.2, 0.24, 0.16, 0.12],
  ],
  person: [
    [-0.18, 0.24, 0, 0.28, 0.48, 0.35, 0.4],
    [0.18, 0.24, 0, 0.28, 0.48, 0.35, 0.4],
    [0, 0.66, 0, 0.9, 0.36, 0.5, 1],
    [0, 0.93, 0, 0.34, 0.14, 0.4, 1.3],
  ],
};

/** A body whose faces are shaded by their direction, as nothing lights it. */
function bodyOf(kind: "car" | "person"): THREE.BufferGeometry {
  const boxes = BODIES[kind].map(([x, y, z, width, height, length, share]) => {
    const box = new THREE.BoxGeometry(width, height, length).translate(x, y, z);
    const normal = box.getAttribute("normal");
    const shades = Array.from({ length: normal.count }, (_, k) => share * (0.72 + 0.28 * normal.getY(k) + 0.08 * normal.getX(k)));
    box.setAttribute("color", new THREE.Float32BufferAttribute(shades.flatMap((shade) => [shade, shade, shade]), 3));
    return box;
  });
  return mergeGeometries(boxes);
}

export class Traffic {
  readonly group = new THREE.Group();
  /** Seconds since the tracks began. */
  time = 0;
  playing = false;
  speed = 1;
  /** Objects of the stage that are agents, and their number plates. */
  readonly replaced: number[] = [];
  private readonly meshes: { mesh: THREE.InstancedMesh; agents: number[] }[] = [];
  private readonly matrix = new THREE.Matrix4();
  private readonly turn = new THREE.Quaternion();
  private readonly angles = new THREE.Euler(0, 0, 0, "YXZ");

  constructor(
    scene: SceneFile,
    private readonly tracks: NonNullable<SceneFile["tracks"]>,
    private readonly changed: () => void,
  ) {
    for (const kind of ["car", "person"] as const) {
      const agents = tracks.agents.map((_, k) => k).filter((k) => (tracks.agents[k].kind === "person") === (kind === "person"));
      const material = new THREE.MeshBasicMaterial({ vertexColors: true, toneMapped: false });
      const mesh = new THREE.InstancedMesh(bodyOf(kind), material, Math.max(1, agents.length));
      mesh.frustumCulled = false;
      mesh.count = agents.length;
      const colour = new THREE.Color();
      agents.forEach((agent, k) => mesh.setColorAt(k, colour.fromArray(tracks.agents[agent].rgb ?? PERSON_RGB)));
      this.meshes.push({ mesh, agents });
      this.group.add(mesh);
    }
    const objects = new Map(scene.paths.map((path, object) => [path, object]));
    for (const { prim } of tracks.agents) {
      const names = [prim, prim.replace(/\/Car_(\d+)$/, "/NumberPlate_$1")];
      for (const object of new Set(names.map((name) => objects.get(name)))) if (object !== undefined) this.replaced.push(object);
    }
    this.show();
  }

  /** Place the agents of a level and those below it as they are at the time; the others are shrunk to nothing. */
  place(top: number): void {
    const { agents, times, poses, levels } = this.tracks;
    const place = new THREE.Vector3();
    const size = new THREE.Vector3();
    for (const { mesh, agents: own } of this.meshes) {
      own.forEach((number, k) => {
        const agent = agents[number];
        const [first, last] = [agent.first, agent.first + agent.count - 1];
        const time = agent.prim ? Math.max(this.time, times[first]) : this.time;
        const at = this.before(first, last, time);
        const shown = time >= times[first] - 1e-4 && time <= times[last] + 1e-4 && levels[at] >= top;
        const next = Math.min(at + 1, last);
        const share = next > at ? Math.min(1, Math.max(0, (time - times[at]) / (times[next] - times[at]))) : 0;
        const value = (column: number) => poses[POSE * at + column] * (1 - share) + poses[POSE * next + column] * share;
        place.set(value(0), value(1), value(2));
        this.angles.set(value(4), value(3), 0);
        size.fromArray(shown ? agent.size : [0, 0, 0]);
        mesh.setMatrixAt(k, this.matrix.compose(place, this.turn.setFromEuler(this.angles), size));
      });
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  /** The last sample of an agent at or before a time. */
  private before(first: number, last: number, time: number): number {
    let [low, high] = [first, last];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.tracks.times[middle] <= time + 1e-4) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** Go on by seconds of the clock; whether anything changed. */
  advance(seconds: number): boolean {
    if (!this.playing) return false;
    this.time = Math.min(this.tracks.duration, this.time + seconds * this.speed);
    if (this.time >= this.tracks.duration) this.setPlaying(false);
    this.show();
    return true;
  }

  seek(time: number): void {
    this.time = Math.min(this.tracks.duration, Math.max(0, time));
    this.show();
    this.changed();
  }

  setPlaying(playing: boolean): void {
    if (playing && this.time >= this.tracks.duration) this.time = 0;
    this.playing = playing;
    this.show();
    this.changed();
  }

  /** Show the time line and listen to it. */
  listen(): void {
    element("timeline").hidden = false;
    const slider = element<HTMLInputElement>("time");
    slider.max = String(this.tracks.duration);
    slider.step = String(this.tracks.step);
    slider.addEventListener("input", () => this.seek(Number(slider.value)));
    element("play").addEventListener("click", () => this.setPlaying(!this.playing));
    const speed = element<HTMLSelectElement>("speed");
    speed.addEventListener("change", () => (this.speed = Number(speed.value)));
  }

  private show(): void {
    element<HTMLInputElement>("time").value = String(this.time);
    element("clock").textContent = `${clock(this.time)} / ${clock(this.tracks.duration)}`;
    element("play").textContent = this.playing ? "❚❚" : "▶";
    element("play").ariaLabel = this.playing ? "Pause" : "Play";
  }
}

const clock = (seconds: number) => `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, "0")}`;
