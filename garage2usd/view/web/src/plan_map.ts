/** The plan from above, with where one is and what one sees. */

import type { Boxes } from "./boxes";
import { USE_COLOURS } from "./classes";
import { footprint } from "./light_plan";
import type { SceneFile } from "./scene_file";

const SMALL_PX = 268;
const LARGE_PX = 640;
const PAPER = "#12161d";
/** What is drawn in turn. */
const PAINT: [string, string][] = [
  ["ramp", "#394049"],
  ["floor", "#2b323c"],
  ["speed_bump", "#8a7a2a"],
  ["wall", "#c9d1db"],
  ["vehicle_door", "#d98a4b"],
  ["obstacle", "#6d7683"],
  ["column", "#eef2f7"],
  ["car", "#e6e9ee"],
  ["van", "#e6e9ee"],
  ["truck", "#e6e9ee"],
];

export interface Eye {
  x: number;
  z: number;
  /** Direction of view, seen from above. */
  dx: number;
  dz: number;
  /** Half of the angle of view across, in radians; 0 for an eye high above. */
  half: number;
}

export class PlanMap {
  private readonly context: CanvasRenderingContext2D;
  private readonly base = document.createElement("canvas");
  private scale = 1;
  private side = SMALL_PX;
  private last = "";
  private level = 0;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly scene: SceneFile,
    private readonly boxes: Boxes,
    go: (x: number, z: number) => void,
  ) {
    const context = canvas.getContext("2d");
    if (!context) throw new Error("The browser draws no pictures.");
    this.context = context;
    this.resize(SMALL_PX);
    canvas.addEventListener("click", (event) => {
      const [[left, , back]] = this.frame;
      go(left + event.offsetX / this.scale, back + event.offsetY / this.scale);
    });
  }

  showLevel(level: number): void {
    if (level === this.level) return;
    this.level = level;
    this.resize(this.side);
  }

  toggleSize(): void {
    this.resize(this.side === SMALL_PX ? LARGE_PX : SMALL_PX);
  }

  /** The stage without the ramps, which lead far away, but for their beginnings. */
  private get frame(): [[number, number, number], [number, number, number]] {
    const [least, most] = this.scene.header.boundsM;
    let box: [number, number, number, number] | null = null;
    for (let object = 0; object < this.scene.count; object++) {
      const label = this.scene.labelOf(object);
      if (label !== "floor" && label !== "wall") continue;
      const [x0, , z0, x1, , z1] = this.boxes.world.subarray(6 * object, 6 * object + 6);
      box = box
        ? [Math.min(box[0], x0), Math.min(box[1], z0), Math.max(box[2], x1), Math.max(box[3], z1)]
        : [x0, z0, x1, z1];
    }
    if (!box) return [least, most];
    const margin = 0.03 * Math.max(box[2] - box[0], box[3] - box[1]) + 2;
    return [
      [box[0] - margin, least[1], box[1] - margin],
      [box[2] + margin, most[1], box[3] + margin],
    ];
  }

  private resize(side: number): void {
    this.side = side;
    const [[x0, , z0], [x1, , z1]] = this.frame;
    const room = Math.min(side, window.innerWidth * 0.6);
    this.scale = Math.min(room / (x1 - x0), Math.min(side, window.innerHeight * 0.62) / (z1 - z0));
    const [width, height] = [(x1 - x0) * this.scale, (z1 - z0) * this.scale];
    const dense = Math.max(1, Math.min(2, window.devicePixelRatio));
    for (const canvas of [this.canvas, this.base]) {
      canvas.width = Math.round(width * dense);
      canvas.height = Math.round(height * dense);
    }
    this.canvas.style.width = `${width}px`;
    this.canvas.style.height = `${height}px`;
    const context = this.base.getContext("2d");
    if (!context) return;
    context.setTransform(this.scale * dense, 0, 0, this.scale * dense, -x0 * this.scale * dense, -z0 * this.scale * dense);
    this.context.setTransform(context.getTransform());
    this.drawBase(context, x0, z0, x1, z1);
    this.last = "";
  }

  private drawBase(context: CanvasRenderingContext2D, x0: number, z0: number, x1: number, z1: number): void {
    context.fillStyle = PAPER;
    context.fillRect(x0, z0, x1 - x0, z1 - z0);
    const stalls = () => {
      for (const stall of this.scene.lanes?.stalls ?? []) {
        if (stall.level !== this.level) continue;
        context.fillStyle = `${USE_COLOURS[stall.use ?? ""] ?? "#9aa5b1"}66`;
        this.polygon(context, stall.corners);
        context.strokeStyle = PAPER;
        context.lineWidth = 0.25;
        context.stroke();
      }
    };
    for (const [label, colour] of PAINT) {
      if (label === "wall") stalls();
      const number = this.scene.header.labels.indexOf(label);
      context.fillStyle = colour;
      for (let object = 0; number >= 0 && object < this.scene.count; object++)
        if (this.scene.label[object] === number && this.isDrawn(object)) this.polygon(context, footprint(this.scene, this.boxes, object));
    }
    const lanes = this.scene.lanes;
    for (const [kind, colour] of [["entrance", "#34d399"], ["exit", "#f87171"]])
      lanes?.kinds.forEach((found, node) => {
        if (found !== kind || lanes.levels[node] !== this.level) return;
        context.fillStyle = colour;
        context.beginPath();
        context.arc(lanes.nodes[3 * node], lanes.nodes[3 * node + 2], 8 / Math.max(this.scale, 1), 0, 7);
        context.fill();
      });
    if (!this.scene.header.labels.includes("floor"))
      for (let object = 0; object < this.scene.count; object++) {
        context.fillStyle = "#9aa5b133";
        this.polygon(context, footprint(this.scene, this.boxes, object));
      }
  }

  /** Whether an object is on the level; a ramp is drawn on the level at its head, too. */
  private isDrawn(object: number): boolean {
    const below = this.scene.level[object] - this.level;
    return below === 0 || (below === 1 && this.scene.labelOf(object) === "ramp");
  }

  private polygon(context: CanvasRenderingContext2D, corners: [number, number][]): void {
    context.beginPath();
    corners.forEach(([x, z], k) => (k ? context.lineTo(x, z) : context.moveTo(x, z)));
    context.closePath();
    context.fill();
  }

  draw(eye: Eye, selected: [number, number][] | null): void {
    const key = [eye.x, eye.z, eye.dx, eye.dz, eye.half].map((value) => value.toFixed(2)).join() + (selected?.join() ?? "");
    if (key === this.last) return;
    this.last = key;
    const { context } = this;
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.base, 0, 0);
    context.restore();
    const metre = 1 / this.scale;
    if (selected) {
      context.fillStyle = "#ffb020";
      this.polygon(context, selected);
      context.strokeStyle = "#ffb020";
      context.lineWidth = 3 * metre;
      context.stroke();
    }
    const angle = Math.atan2(eye.dz, eye.dx);
    const reach = 46 * metre;
    const glow = context.createRadialGradient(eye.x, eye.z, 0, eye.x, eye.z, reach);
    glow.addColorStop(0, "#58c4ffcc");
    glow.addColorStop(1, "#58c4ff00");
    context.fillStyle = glow;
    context.beginPath();
    context.moveTo(eye.x, eye.z);
    context.arc(eye.x, eye.z, reach, angle - eye.half, angle + eye.half);
    context.fill();
    context.fillStyle = "#58c4ff";
    context.strokeStyle = "#ffffff";
    context.lineWidth = 1.6 * metre;
    context.beginPath();
    context.arc(eye.x, eye.z, 5 * metre, 0, 7);
    context.fill();
    context.stroke();
  }
}
