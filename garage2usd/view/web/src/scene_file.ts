/** The scene as the server sends it (garage2usd/view/viewer/wire.py). */

const MAGIC = 0x56553247; // "G2UV"

export interface Surface {
  rgb: [number, number, number];
  emissive: [number, number, number];
  roughness: number;
  metallic: number;
  opacity: number;
  /** What is less opaque is not drawn, and all else is opaque; 0 for no such limit. */
  opacityThreshold: number;
  clearcoat: number;
  colourTexture: number;
  roughnessTexture: number;
  roughnessChannel: number;
  metallicTexture: number;
  metallicChannel: number;
  hasAlpha: boolean;
}

export interface Light {
  kind: string;
  /** Three rows of four that multiply (x, y, z, 1). */
  matrix: number[];
  size: [number, number];
  rgb: [number, number, number];
  candela: number;
}

/** Ranges are of the first element and the number of elements. */
export interface Shape {
  vertices: [number, number];
  opaque: [number, number];
  blended: [number, number];
  /** How many colliders it has. */
  colliders: number;
  doubleSided: boolean;
  /** Of a person: arrays of the four joints of each vertex and their weights, and the joints at rest. */
  skin: { joints: number; weights: number; rest: [number, number, number][]; parents: number[] } | false;
  lights: Light[];
}

export interface Stall {
  id?: string;
  number?: string;
  type?: string;
  use?: string;
  row?: number;
  column?: number;
  entryEdge?: string;
  size?: string;
  accessNode?: number;
  /** Number of its level, from 0. */
  level: number;
  /** (x, z) in metres: mouth left, mouth right, rear right, rear left. */
  corners: [number, number][];
}

interface Header {
  name: string;
  facts: Record<string, string>;
  remarks: string[];
  /** Factor on all light before the view transform AgX, as of `garage2usd render`. */
  exposure: number;
  boundsM: [[number, number, number], [number, number, number]];
  /** Those of a garage of several levels, the top one first; none of a garage of one. */
  levels: { name: string; path: string }[];
  labels: string[];
  squares: string[];
  textures: number;
  surfaces: Surface[];
  palettes: number[][];
  shapes: {
    entries: Shape[];
    positions: number;
    normals: number;
    coordinates: number;
    slots: number;
    indices: number;
  };
  objects: {
    paths: string[];
    ids: number[];
    label: number;
    square: number;
    shape: number;
    palette: number;
    matrix: number;
  };
  lanes: {
    nodes: number;
    kinds: string[];
    levels: number[];
    edges: number;
    forward: boolean[];
    stalls: Stall[];
    /** Those that cars park in. */
    parkingStalls: number;
  } | null;
  tracks: {
    step: number;
    duration: number;
    agents: Agent[];
    times: number;
    poses: number;
    levels: number;
  } | null;
  arrays: { at: number; count: number }[];
}

/** A car or a person of tracks; its samples follow the first one. */
export interface Agent {
  name: string;
  kind: string;
  /** Width, height and length. */
  size: [number, number, number];
  /** Path of the parked car of the stage that it is; empty for others. */
  prim: string;
  first: number;
  count: number;
  /** Numbers of its objects; wheels roll, and those in front also steer. */
  parts: { object: number; steers: boolean; rolls: boolean }[];
  /** Arrays of the poses of a person, and the factor from its figure to its stature. */
  gait: { factor: number; times: number; rotations: number; hips: number } | null;
}

/** Seven numbers a sample: x, y, z, yaw, pitch, steering and the turn of the wheels. */
export interface TrackFile {
  step: number;
  duration: number;
  agents: Agent[];
  times: Float32Array;
  poses: Float32Array;
  levels: Uint32Array;
}

export interface Lanes {
  nodes: Float32Array;
  kinds: string[];
  /** Number of the level of each node; a ramp between levels has that of its foot. */
  levels: number[];
  edges: Uint32Array;
  forward: boolean[];
  stalls: Stall[];
}

export class SceneFile {
  readonly header: Header;
  private readonly start: number;
  readonly shapes: Shape[];
  readonly positions: Float32Array;
  readonly normals: Int8Array;
  readonly coordinates: Float32Array;
  readonly slots: Uint8Array;
  readonly indices: Uint32Array;
  readonly paths: string[];
  readonly ids: number[];
  readonly label: Uint32Array;
  readonly square: Uint32Array;
  readonly shape: Uint32Array;
  readonly palette: Uint32Array;
  /** Number of the level of each object; 0 in a garage of one level. */
  readonly level: Uint8Array;
  /** Twelve numbers an object: three rows that multiply (x, y, z, 1). */
  readonly matrix: Float32Array;
  readonly lanes: Lanes | null;
  readonly tracks: TrackFile | null;
  /** Parked cars of the stage that are agents, and their number plates. */
  readonly replaced = new Set<number>();

  constructor(private readonly data: ArrayBuffer) {
    const head = new DataView(data);
    if (head.getUint32(0, true) !== MAGIC) throw new Error("This is no scene of garage2usd.");
    const size = head.getUint32(4, true);
    this.header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 8, size))) as Header;
    const { arrays, shapes, objects, lanes } = this.header;
    const at = (number: number) => 8 + size + arrays[number].at;
    this.start = 8 + size;
    const floats = (number: number) => this.floats(number);
    const words = (number: number) => new Uint32Array(data, at(number), arrays[number].count);
    this.shapes = shapes.entries;
    this.positions = floats(shapes.positions);
    this.normals = new Int8Array(data, at(shapes.normals), arrays[shapes.normals].count);
    this.coordinates = floats(shapes.coordinates);
    this.slots = new Uint8Array(data, at(shapes.slots), arrays[shapes.slots].count);
    this.indices = words(shapes.indices);
    this.paths = objects.paths;
    this.ids = objects.ids;
    this.label = words(objects.label);
    this.square = words(objects.square);
    this.shape = words(objects.shape);
    this.palette = words(objects.palette);
    this.matrix = floats(objects.matrix);
    const roots = this.header.levels.map(({ path }) => `${path}/`);
    this.level = Uint8Array.from(this.paths, (path) => Math.max(0, roots.findIndex((root) => path.startsWith(root))));
    this.lanes = lanes && { ...lanes, nodes: floats(lanes.nodes), edges: words(lanes.edges) };
    const { tracks } = this.header;
    this.tracks = tracks && { ...tracks, times: floats(tracks.times), poses: floats(tracks.poses), levels: words(tracks.levels) };
    const numberOf = new Map(this.paths.map((path, object) => [path, object]));
    for (const { prim } of tracks?.agents ?? [])
      for (const path of [prim, prim.replace(/\/Car_(\d+)$/, "/NumberPlate_$1")]) {
        const object = numberOf.get(path);
        if (object !== undefined) this.replaced.add(object);
      }
  }

  floats(number: number): Float32Array {
    const { at, count } = this.header.arrays[number];
    return new Float32Array(this.data, this.start + at, count);
  }

  bytes(number: number): Uint8Array {
    const { at, count } = this.header.arrays[number];
    return new Uint8Array(this.data, this.start + at, count);
  }

  /** How many levels there are, at least one. */
  get levels(): number {
    return Math.max(1, this.header.levels.length);
  }

  /** How many objects the stage has; those of agents follow them. */
  get count(): number {
    return this.paths.length;
  }

  labelOf(object: number): string {
    return this.header.labels[this.label[object]];
  }

  /** How many objects each class has, in the order of `header.labels`. */
  counts(): number[] {
    const counts = this.header.labels.map(() => 0);
    for (let object = 0; object < this.count; object++) if (!this.replaced.has(object)) counts[this.label[object]] += 1;
    for (const { parts } of this.tracks?.agents ?? []) counts[this.label[parts[0].object]] += 1;
    return counts;
  }
}
