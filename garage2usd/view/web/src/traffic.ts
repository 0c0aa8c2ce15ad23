/** Cars and people of tracks over time, and the time line that plays them. */

import * as THREE from "three";
import type { Instances } from "./instances";
import { element } from "./panel";
import type { Agent, SceneFile } from "./scene_file";

/** Numbers of a sample: x, y, z, yaw, pitch, steering and the turn of the wheels. */
const POSE = 7;
/** How far a shadow reaches beyond a body, how dark it is, and its height above the floor. */
const [SHADOW_M, SHADOW, LIFT_M] = [0.35, 0.6, 0.012];
/** Eyes of a driver by the height of a car, from the middle by its width, and those of a person by stature. */
const [DRIVER_HEIGHT, DRIVER_ASIDE, EYE_HEIGHT] = [0.81, 0.2, 0.935];

/** Samples around a time: the one before and the one after, and the share of the latter. */
type Between = [number, number, number];

function between(times: ArrayLike<number>, first: number, last: number, time: number): Between {
  let [low, high] = [first, last];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time + 1e-4) low = middle;
    else high = middle - 1;
  }
  const next = Math.min(low + 1, last);
  return [low, next, next > low ? Math.min(1, Math.max(0, (time - times[low]) / (times[next] - times[low]))) : 0];
}

interface Person {
  number: number;
  times: Float32Array;
  rotations: Float32Array;
  hips: Float32Array;
}

export class Traffic {
  readonly group = new THREE.Group();
  /** Seconds since the tracks began. */
  time = 0;
  playing = false;
  speed = 1;
  /** Agent whose own body is not drawn, as one looks out of it; -1 for none. */
  rider = -1;
  private readonly people = new Map<Agent, Person>();
  private readonly shadows: THREE.InstancedMesh;
  private readonly matrix = new THREE.Matrix4();
  private readonly part = new THREE.Matrix4();
  private readonly turn = new THREE.Quaternion();
  private readonly angles = new THREE.Euler(0, 0, 0, "YXZ");

  constructor(
    private readonly scene: SceneFile,
    private readonly tracks: NonNullable<SceneFile["tracks"]>,
    private readonly instances: Instances,
    private readonly bones: THREE.DataTexture,
    private readonly changed: () => void,
  ) {
    for (const agent of tracks.agents)
      if (agent.gait) {
        const [times, rotations, hips] = [agent.gait.times, agent.gait.rotations, agent.gait.hips].map((array) => scene.floats(array));
        this.people.set(agent, { number: this.people.size, times, rotations, hips });
      }
    const material = new THREE.MeshBasicMaterial({
      color: 0, map: shadowTexture(), transparent: true, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1,
    });
    this.shadows = new THREE.InstancedMesh(new THREE.PlaneGeometry(1, 1).rotateX(-Math.PI / 2), material, Math.max(1, tracks.agents.length));
    this.shadows.frustumCulled = false;
    this.shadows.renderOrder = 1e5;
    this.group.add(this.shadows);
    this.show();
  }

  /** Place the agents of a level and those below it as they are at the time; others are not drawn. */
  place(top: number): void {
    const { agents, times, levels } = this.tracks;
    const { instances } = this;
    instances.moving = [];
    this.shadows.count = 0;
    agents.forEach((agent, number) => {
      const [first, last] = [agent.first, agent.first + agent.count - 1];
      const time = agent.prim ? Math.max(this.time, times[first]) : this.time;
      if (time < times[first] - 1e-4 || time > times[last] + 1e-4) return;
      const at = between(times, first, last, time);
      if (levels[at[0]] < top) return;
      const pose = this.poseOf(at);
      this.matrix.compose(new THREE.Vector3(pose[0], pose[1], pose[2]), this.turn.setFromEuler(this.angles.set(pose[4], pose[3], 0)), ONE);
      const person = this.people.get(agent);
      if (person) this.bend(agent, person, time);
      for (const { object, steers, rolls } of agent.parts) {
        if (!instances.visible[object] || number === this.rider) continue;
        const m = this.scene.matrix.subarray(12 * object, 12 * object + 12);
        this.part.set(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], 0, 0, 0, 1).premultiply(this.matrix);
        // a wheel that steers turns about the vertical, and then about its own axle
        if (rolls) this.part.multiply(new THREE.Matrix4().makeRotationFromEuler(this.angles.set(-pose[6], steers ? pose[5] : 0, 0)));
        if (person) this.part.multiply(TO_FRONT).scale(new THREE.Vector3().setScalar(agent.gait?.factor ?? 1));
        instances.move(object, this.part, person?.number);
        instances.moving.push(object);
      }
      this.shade(agent, number !== this.rider && instances.visible[agent.parts[0].object] > 0);
    });
    this.shadows.instanceMatrix.needsUpdate = true;
  }

  /** A dark place on the floor under an agent. */
  private shade(agent: Agent, visible: boolean): void {
    if (!visible) return;
    const [width, , length] = agent.size;
    this.part.copy(this.matrix).multiply(new THREE.Matrix4().makeTranslation(0, LIFT_M, 0));
    this.part.scale(new THREE.Vector3(width + 2 * SHADOW_M, 1, length + 2 * SHADOW_M));
    this.shadows.setMatrixAt(this.shadows.count++, this.part);
  }

  private poseOf([at, next, share]: Between): number[] {
    const { poses } = this.tracks;
    return Array.from({ length: POSE }, (_, column) => poses[POSE * at + column] * (1 - share) + poses[POSE * next + column] * share);
  }

  /** Bend the joints of a person as they are at a time. */
  private bend(agent: Agent, person: Person, time: number): void {
    const skin = this.scene.shapes[this.scene.shape[agent.parts[0].object]].skin;
    if (!skin) return;
    const { rest, parents } = skin;
    const [at, next, share] = between(person.times, 0, person.times.length - 1, time);
    const factor = agent.gait?.factor ?? 1;
    const turns: THREE.Quaternion[] = [];
    const places: THREE.Vector3[] = [];
    const bones = this.bones.image.data as Float32Array;
    const width = this.bones.image.width;
    rest.forEach(([x, y, z], joint) => {
      const from = 4 * (rest.length * at + joint);
      const to = 4 * (rest.length * next + joint);
      const own = new THREE.Quaternion(...[0, 1, 2, 3].map((k) => person.rotations[from + k] * (1 - share) + person.rotations[to + k] * share)).normalize();
      const up = parents[joint];
      if (up < 0) {
        turns.push(own);
        places.push(new THREE.Vector3(...[0, 1, 2].map((k) => (person.hips[3 * at + k] * (1 - share) + person.hips[3 * next + k] * share) / factor)));
      } else {
        turns.push(turns[up].clone().multiply(own));
        const [a, b, c] = rest[up];
        places.push(new THREE.Vector3(x - a, y - b, z - c).applyQuaternion(turns[up]).add(places[up]));
      }
      const { elements: e } = new THREE.Matrix4().compose(places[joint], turns[joint], ONE).multiply(new THREE.Matrix4().makeTranslation(-x, -y, -z));
      for (let row = 0; row < 3; row++)
        for (let k = 0; k < 4; k++) bones[4 * (width * person.number + 3 * joint + row) + k] = e[4 * k + row];
    });
    this.bones.needsUpdate = true;
  }

  /** Where the eyes of an agent are at the time, and its heading and pitch; its first or last place while it is not there. */
  eyesOf(number: number, onLeft: boolean): { place: THREE.Vector3; yaw: number; pitch: number } {
    const agent = this.tracks.agents[number];
    const [x, y, z, yaw, pitch] = this.poseOf(between(this.tracks.times, agent.first, agent.first + agent.count - 1, this.time));
    const [width, height] = agent.size;
    const aside = DRIVER_ASIDE * width * (onLeft ? 1 : -1);
    const place = agent.gait ? new THREE.Vector3(0, EYE_HEIGHT * height, 0) : new THREE.Vector3(aside, DRIVER_HEIGHT * height, 0);
    return { place: place.applyEuler(this.angles.set(pitch, yaw, 0)).add(new THREE.Vector3(x, y, z)), yaw, pitch };
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

const ONE = new THREE.Vector3(1, 1, 1);
/** Figures look to +Z, agents to -Z. */
const TO_FRONT = new THREE.Matrix4().makeRotationY(Math.PI);

/** The soft edge of a shadow. */
function shadowTexture(): THREE.DataTexture {
  const size = 32;
  const data = new Uint8Array(4 * size * size);
  const soft = (k: number) => Math.min(1, Math.min(k + 0.5, size - k - 0.5) / (size / 6));
  for (let row = 0; row < size; row++)
    for (let column = 0; column < size; column++) data[4 * (size * row + column) + 3] = 255 * SHADOW * soft(row) * soft(column);
  const texture = new THREE.DataTexture(data, size, size);
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

const clock = (seconds: number) => `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, "0")}`;
