import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Boxes, chunksOf } from "./boxes";
import { CARS, OVERHEAD } from "./classes";
import { Colliders, Frame, isInside, laneGraphOf, middleOf, stallPlanOf } from "./guides";
import { Instances } from "./instances";
import { footprint, lightPlanOf } from "./light_plan";
import { element, laneLegend, showClasses, showLayers, showLevels, showObject, showRemarks, useLegend } from "./panel";
import { type Eye, PlanMap } from "./plan_map";
import { Quality, isSoftware } from "./quality";
import { type Hit, Rays } from "./rays";
import { SceneFile, type Stall } from "./scene_file";
import { SurfaceMaterials } from "./surface_material";
import { layersOf } from "./textures";
import { Traffic } from "./traffic";
import { EYE_M, Walker } from "./walk";
import "./style.css";

const CHUNK_M = 24;
const WALK_FOV = 68;
const ORBIT_FOV = 45;
const CLICK_PX = 4;
const SKY = "#161b22";
const HINTS = {
  orbit: "Drag: orbit · Right drag: move · Wheel: nearer · Click: what is it · Double click: walk there",
  walk: "W A S D: walk · Shift: run · Mouse or drag: look · Click: what is it · Esc: free the mouse · 1: orbit",
};

/** One rides along with an agent in pictures of a film. */
type Mode = "orbit" | "walk" | "ride";

class Viewer {
  readonly renderer: THREE.WebGLRenderer;
  readonly camera = new THREE.PerspectiveCamera(ORBIT_FOV, 1, 0.1, 2000);
  readonly world = new THREE.Scene();
  readonly boxes: Boxes;
  readonly rays: Rays;
  readonly walker: Walker;
  readonly orbit: OrbitControls;
  readonly quality: Quality;
  readonly map: PlanMap;
  readonly colliders: Colliders;
  readonly frame = new Frame();
  readonly hiddenLabels = new Set<string>();
  readonly traffic: Traffic | null;
  mode: Mode = "orbit";
  /** The highest level that is shown; while one walks, the one that one is on. */
  level = 0;
  selected = -1;
  ready = false;
  firstFrameMs = 0;
  /** Milliseconds that the latest pictures took to draw, while moving. */
  readonly frameTimes: number[] = [];
  private filming = false;
  private filmScale = 1;
  private dirty = true;
  private cut: boolean | null = null;
  private last = performance.now();
  private fence: WebGLSync | null = null;
  private submitted = 0;
  private measured = false;
  private pressedAt: [number, number] | null = null;
  private lookedAt: [number, number] | null = null;
  private readonly cars: number[] = [];
  private setLayer: (id: string, on?: boolean) => void = () => undefined;
  private lanes: THREE.Object3D | null = null;
  private stalls: THREE.Object3D | null = null;

  private constructor(
    readonly scene: SceneFile,
    private readonly instances: Instances,
    private readonly materials: SurfaceMaterials,
    /** Heights of the floors, the top one first. */
    private readonly floors: number[],
    parts: { boxes: Boxes; rays: Rays; renderer: THREE.WebGLRenderer },
  ) {
    ({ boxes: this.boxes, rays: this.rays, renderer: this.renderer } = parts);
    this.quality = new Quality(isSoftware());
    this.world.background = new THREE.Color(SKY);
    this.walker = new Walker(scene, this.rays);
    this.colliders = new Colliders(scene);
    this.orbit = new OrbitControls(this.camera, this.renderer.domElement);
    this.orbit.enableDamping = false;
    this.orbit.maxPolarAngle = 0.495 * Math.PI;
    this.orbit.zoomToCursor = true;
    this.orbit.addEventListener("change", () => this.touch());
    this.world.add(instances.group, this.colliders.group, this.frame.lines);
    this.traffic = scene.tracks && new Traffic(scene, scene.tracks, instances, materials.bones, () => this.touch());
    if (this.traffic) {
      this.world.add(this.traffic.group);
      this.traffic.listen();
    }
    if (scene.lanes) {
      this.lanes = laneGraphOf(scene.lanes, scene.levels);
      this.stalls = stallPlanOf(scene.lanes, floors);
      for (const guide of [this.lanes, this.stalls]) guide.visible = false;
      this.world.add(this.lanes, this.stalls);
    }
    for (let object = 0; object < scene.count; object++) if (CARS.includes(scene.labelOf(object))) this.cars.push(object);
    this.map = new PlanMap(element("plan"), scene, this.boxes, (x, z) => this.goTo(x, z));
    this.showPanels();
    this.listen();
    this.resize();
    this.overview();
  }

  static async open(): Promise<Viewer> {
    const asked = fetch("scene.bin");
    // smooth edges cost a renderer in software more than all else
    const antialias = !isSoftware();
    // the context is made while the server may still be building the scene
    const renderer = new THREE.WebGLRenderer({ canvas: element<HTMLCanvasElement>("view"), antialias });
    const answer = await asked;
    if (!answer.ok) throw new Error("The stage could not be read; the command line says why.");
    performance.mark("scene");
    const scene = new SceneFile(await answer.arrayBuffer());
    const textures = layersOf(scene);
    const boxes = new Boxes(scene);
    const chunks = chunksOf(boxes, scene.count, CHUNK_M);
    // as garage2usd render has it; the shader of surfaces takes this curve from three.js
    renderer.toneMapping = THREE.AgXToneMapping;
    renderer.toneMappingExposure = scene.header.exposure;
    const light = lightPlanOf(scene, boxes);
    const materials = new SurfaceMaterials(scene, await textures, light);
    const instances = await Instances.create(scene, boxes, chunks, materials);
    const floors = light.levels.map(({ floor }) => floor);
    return new Viewer(scene, instances, materials, floors, { boxes, rays: new Rays(scene, boxes, chunks), renderer });
  }

  /** Draw until the page goes. */
  run(): void {
    this.draw();
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits until it is drawn
    this.ready = true;
    this.firstFrameMs = performance.now();
    document.documentElement.dataset["ready"] = "yes";
    element("curtain").hidden = true;
    const tick = (now: number) => {
      this.tick(now);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  private tick(now: number): void {
    if (this.filming) return;
    const elapsed = (now - this.last) / 1000;
    const seconds = Math.min(0.1, elapsed);
    this.last = now;
    if (this.mode === "walk" && this.walker.advance(seconds)) this.touch();
    if (this.traffic?.advance(elapsed)) this.touch();
    if (this.isBusy(now)) return;
    if (this.quality.rests(now)) {
      this.dirty = true;
      this.sharpen();
    }
    if (!this.dirty) return;
    const { quality } = this;
    if (quality.moving) this.renderer.setPixelRatio(window.devicePixelRatio / quality.coarse);
    this.draw();
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.submitted = now;
    this.measured = quality.moving;
    gl.flush();
  }

  /** Whether the latest picture is still being drawn; another one begun now would only come later. */
  private isBusy(now: number): boolean {
    if (!this.fence) return false;
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    if (gl.clientWaitSync(this.fence, 0, 0) === gl.TIMEOUT_EXPIRED) return true;
    gl.deleteSync(this.fence);
    this.fence = null;
    if (this.measured) {
      this.quality.took(now - this.submitted);
      this.frameTimes.push(now - this.submitted);
      if (this.frameTimes.length > 120) this.frameTimes.shift();
    }
    return false;
  }

  /** Note that the picture is to be drawn anew. */
  touch(): void {
    this.quality.move(performance.now());
    this.dirty = true;
  }

  private sharpen(): void {
    this.renderer.setPixelRatio(window.devicePixelRatio);
  }

  /**
   * Show nothing but the picture, `scale` times as fine as it is given out, for `still`: from above a level, or from the
   * eyes of an agent.
   */
  film(camera: string, level: number, scale: number): void {
    this.filming = true;
    document.documentElement.dataset["film"] = "yes";
    this.filmScale = scale;
    this.resize();
    const rider = this.scene.tracks?.agents.findIndex(({ name }) => name === camera) ?? -1;
    if (this.traffic) this.traffic.rider = rider;
    if (rider >= 0) this.setMode("ride");
    else {
      this.setLevel(level);
      this.overview();
    }
    this.quality.settle();
    this.renderer.setPixelRatio(scale);
  }

  /** The picture at a time, as the address of a PNG. */
  still(time: number): string {
    this.traffic?.seek(time);
    this.quality.settle();
    this.draw();
    const { domElement: drawn } = this.renderer;
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [drawn.width / this.filmScale, drawn.height / this.filmScale];
    const context = canvas.getContext("2d");
    if (!context) throw new Error("The browser gives no canvas.");
    context.imageSmoothingQuality = "high";
    context.drawImage(drawn, 0, 0, canvas.width, canvas.height);
    return canvas.toDataURL("image/png");
  }

  private ride(): void {
    const { traffic, camera } = this;
    if (!traffic) return;
    const { place, yaw, pitch } = traffic.eyesOf(traffic.rider, this.scene.header.facts["drivesOn"] === "left");
    camera.position.copy(place);
    camera.rotation.set(pitch, yaw, 0, "YXZ");
  }

  private draw(): void {
    this.dirty = false;
    const { camera } = this;
    if (this.mode === "walk") this.walker.place(camera);
    if (this.mode === "ride") this.ride();
    camera.near = this.mode !== "orbit" ? 0.06 : Math.max(0.1, 0.02 * this.orbit.getDistance());
    camera.far = 60 + 3 * this.reach;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    if (this.mode === "walk") this.setLevel(this.levelAt(this.walker.feet.y));
    if (this.mode === "ride") this.setLevel(this.levelAt(camera.position.y - 1));
    this.cutAway(camera.position.y > this.ceilingHeights[this.level]);
    const ratio = this.renderer.getPixelRatio();
    this.traffic?.place(this.mode === "orbit" ? this.level : 0);
    this.instances.update(camera, element("view").clientHeight * ratio, this.quality.moving ? this.quality.coarse : 1);
    this.renderer.render(this.world, camera);
    this.map.draw(this.eye(), this.selected < 0 ? null : footprint(this.scene, this.boxes, this.selected));
    this.showFigures();
  }

  private showFigures(): void {
    const { objects, triangles, calls } = this.instances.drawn;
    element("figures").textContent = `${objects.toLocaleString("en")} objects · ${(triangles / 1000).toFixed(0)}k triangles · ${calls} calls`;
    const { x, z } = this.camera.position;
    const level = this.scene.header.levels.length ? `${this.scene.header.levels[this.level].name} · ` : "";
    element("place").textContent = this.mode === "walk" ? `${level}${x.toFixed(1)}, ${z.toFixed(1)} m` : "";
  }

  private get reach(): number {
    const [[x0, , z0], [x1, , z1]] = this.scene.header.boundsM;
    return Math.hypot(x1 - x0, z1 - z0);
  }

  /** Height of each level above which one looks at it from above. */
  private get ceilingHeights(): number[] {
    const heights = this.floors.map(() => Infinity);
    for (let object = 0; object < this.scene.count; object++)
      if (this.scene.labelOf(object) === "ceiling") {
        const level = this.scene.level[object];
        heights[level] = Math.min(heights[level], this.boxes.world[6 * object + 1]);
      }
    Object.defineProperty(this, "ceilingHeights", { value: heights });
    return heights;
  }

  private get floor(): number {
    return this.floors[this.level];
  }

  /** The level that a height is on; the upper half of a ramp is on the level at its head. */
  private levelAt(y: number): number {
    const heights = this.floors.map((floor, k) => (k + 1 < this.floors.length ? (floor + this.floors[k + 1]) / 2 : -Infinity));
    return heights.findIndex((height) => y >= height);
  }

  /** Show a level and those below it; one that walks goes there. */
  chooseLevel(level: number): void {
    if (level === this.level || level < 0 || level >= this.scene.levels) return;
    const rise = this.floors[level] - this.floor;
    if (this.mode === "walk") {
      this.walkIn(level);
      return;
    }
    this.setLevel(level);
    this.orbit.target.y += rise;
    this.camera.position.y += rise;
    this.orbit.update();
  }

  private setLevel(level: number): void {
    if (level !== this.level) {
      this.level = level;
      this.map.showLevel(level);
      this.applyLayers();
    }
    this.scene.header.levels.forEach(({ name }, k) => (element(`level-${name}`).ariaPressed = String(k === this.level)));
  }

  /** From above, what hangs overhead is not shown. */
  private cutAway(cut: boolean): void {
    if (cut === this.cut) return;
    this.cut = cut;
    this.applyLayers();
  }

  applyLayers(): void {
    const labels = this.scene.header.labels.map((label) => !this.hiddenLabels.has(label));
    const { visible } = this.instances;
    const top = this.mode === "orbit" ? this.level : 0;
    for (let object = 0; object < visible.length; object++) {
      const level = this.scene.level[object] ?? top;
      const isCut = object < this.scene.count && level === this.level && this.cut === true && OVERHEAD.has(this.scene.labelOf(object));
      visible[object] = level >= top && !isCut && labels[this.scene.label[object]] ? 1 : 0;
    }
    for (const object of this.scene.replaced) visible[object] = 0;
    for (const guide of [this.lanes, this.stalls]) guide?.children.forEach((child, level) => (child.visible = level >= top));
    if (this.colliders.group.visible) this.colliders.show(visible);
    this.touch();
  }

  // -- panels

  private showPanels(): void {
    const { scene } = this;
    const { header } = scene;
    document.title = `${header.name} - garage2usd`;
    element("stage-name").textContent = header.name;
    const stalls = header.lanes?.parkingStalls ?? 0;
    const told = [stalls ? `${stalls.toLocaleString("en")} stalls` : "", header.facts["seed"] ? `seed ${header.facts["seed"]}` : ""];
    element("stage-facts").textContent = told.filter(Boolean).join(" · ");
    const classes = (id: string, on: boolean, labels: Iterable<string>) => {
      for (const label of labels) {
        const row = document.querySelector<HTMLInputElement>(`.class[data-label="${CSS.escape(label)}"] input`);
        if (row && row.checked !== on) row.checked = on;
        if (on) this.hiddenLabels.delete(label);
        else this.hiddenLabels.add(label);
      }
      void id;
      this.applyLayers();
    };
    const has = (labels: Iterable<string>) => [...labels].some((label) => header.labels.includes(label));
    const rows = [];
    if (has(OVERHEAD))
      rows.push({
        id: "ceiling", name: "Ceiling and services", key: "C", on: true,
        hint: "Slab, beams, lights, ducts, trays, pipes and signs; cut away when seen from above",
        change: (on: boolean) => classes("ceiling", on, OVERHEAD),
      });
    if (has(CARS))
      rows.push({ id: "cars", name: "Cars", key: "V", on: true, hint: "Parked cars", change: (on: boolean) => classes("cars", on, [...CARS, "number_plate"]) });
    const { lanes, stalls: plan } = this;
    if (lanes && plan && scene.lanes) {
      rows.push({
        id: "lanes", name: "Lane graph", key: "G", on: false, hint: "Nodes and edges; arrows say which way one may drive",
        legend: laneLegend(scene.lanes.kinds),
        change: (on: boolean) => { lanes.visible = on; this.touch(); },
      });
      rows.push({
        id: "stalls", name: "Stalls by use", key: "U", on: false, hint: "The outline of each stall in the colour of its use",
        legend: useLegend(scene.lanes.stalls.map((stall) => stall.use ?? "")),
        change: (on: boolean) => { plan.visible = on; this.touch(); },
      });
    }
    if (this.colliders.count)
      rows.push({
        id: "colliders", name: "Colliders", key: "K", on: false, hint: "What a physics engine makes of the objects that are shown",
        change: (on: boolean) => {
          this.colliders.group.visible = on;
          if (on) void this.colliders.load().then(() => this.applyLayers());
          this.touch();
        },
      });
    this.setLayer = showLayers(rows);
    showLevels(scene, (level) => this.chooseLevel(level));
    this.setLevel(this.level);
    showClasses(scene, (label, on) => {
      if (on) this.hiddenLabels.delete(label);
      else this.hiddenLabels.add(label);
      this.applyLayers();
    });
    showRemarks(header.remarks);
  }

  setLook(byLabel: boolean): void {
    this.materials.uniforms.byLabel.value = byLabel ? 1 : 0;
    element("look-surface").ariaPressed = String(!byLabel);
    element("look-labels").ariaPressed = String(byLabel);
    this.touch();
  }

  // -- where one is

  private eye(): Eye {
    const ahead = this.camera.getWorldDirection(new THREE.Vector3());
    const length = Math.hypot(ahead.x, ahead.z) || 1;
    const half = Math.atan(Math.tan((this.camera.fov * Math.PI) / 360) * this.camera.aspect);
    const { x, z } = this.mode === "walk" ? this.camera.position : this.orbit.target;
    return { x, z, dx: ahead.x / length, dz: ahead.z / length, half: this.mode === "walk" ? half : 0.4 };
  }

  overview(): void {
    this.setMode("orbit");
    const [x0, z0, x1, z1] = this.inside();
    const corners = [[x0, z0], [x1, z0], [x1, z1], [x0, z1]].map(([x, z]) => new THREE.Vector3(x, this.floor, z));
    this.orbit.target.set((x0 + x1) / 2, this.floor, (z0 + z1) / 2);
    const away = new THREE.Vector3(0.1, 1, 0.62).normalize();
    // a film has the long side across
    if (this.filming) away.set(x1 - x0 < z1 - z0 ? 0.5 : 0, 1, x1 - x0 < z1 - z0 ? 0 : 0.5).normalize();
    // as near as all corners stay clear of the panels
    const free = this.freeView();
    for (let distance = 10; distance < 1e4; distance *= 1.04) {
      this.camera.position.copy(this.orbit.target).addScaledVector(away, distance);
      this.orbit.update();
      this.camera.updateMatrixWorld();
      this.camera.updateProjectionMatrix();
      const seen = corners.map((corner) => corner.clone().project(this.camera));
      const [xs, ys] = [seen.map(({ x }) => x), seen.map(({ y }) => y)];
      const wide = Math.max(...xs) - Math.min(...xs) < free.right - free.left;
      if (!wide || Math.max(...ys) - Math.min(...ys) > free.top - free.bottom || seen.some(({ z }) => z > 1)) continue;
      this.shift((free.left + free.right - Math.max(...xs) - Math.min(...xs)) / 2, (free.bottom + free.top - Math.max(...ys) - Math.min(...ys)) / 2);
      break;
    }
    this.touch();
  }

  /** What no panel covers, from -1 to 1 as a camera has it. */
  private freeView(): { left: number; right: number; bottom: number; top: number } {
    if (this.filming) return { left: -0.97, right: 0.97, bottom: -0.97, top: 0.92 };
    const [width, height] = [window.innerWidth, window.innerHeight];
    const [bar, layers, map] = ["bar", "layers", "map"].map((id) => element(id).getBoundingClientRect());
    return {
      left: (2 * layers.right) / width - 1 + 0.03,
      right: (2 * (width > 1000 ? map.left : width)) / width - 1 - 0.03,
      bottom: -0.9,
      top: 1 - (2 * bar.bottom) / height - 0.03,
    };
  }

  /** Move the camera along the floor, so that what is in the middle is seen elsewhere. */
  private shift(x: number, y: number): void {
    const across = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    const far = this.orbit.getDistance() * Math.tan((this.camera.fov * Math.PI) / 360);
    const along = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1).setY(0).normalize();
    const slope = Math.max(0.2, this.camera.getWorldDirection(new THREE.Vector3()).y * -1);
    const move = across.multiplyScalar(-x * far * this.camera.aspect).addScaledVector(along, (-y * far) / slope);
    this.orbit.target.add(move);
    this.camera.position.add(move);
    this.orbit.update();
  }

  /** The floor's extent: least x and z, greatest x and z. */
  private inside(): [number, number, number, number] {
    const [[x0, , z0], [x1, , z1]] = this.scene.header.boundsM;
    let box: [number, number, number, number] | null = null;
    for (let object = 0; object < this.scene.count; object++) {
      if (this.scene.labelOf(object) !== "floor") continue;
      const w = this.boxes.world.subarray(6 * object, 6 * object + 6);
      box = box ? [Math.min(box[0], w[0]), Math.min(box[1], w[2]), Math.max(box[2], w[3]), Math.max(box[3], w[5])] : [w[0], w[2], w[3], w[5]];
    }
    return box ?? [x0, z0, x1, z1];
  }

  setMode(mode: Mode): void {
    this.mode = mode;
    this.walker.active = mode === "walk";
    this.walker.release();
    this.orbit.enabled = mode === "orbit";
    this.camera.fov = mode === "orbit" ? ORBIT_FOV : WALK_FOV;
    element("mode-orbit").ariaPressed = String(mode === "orbit");
    element("mode-walk").ariaPressed = String(mode === "walk");
    element("hints").textContent = mode === "ride" ? "" : HINTS[mode];
    document.documentElement.dataset["mode"] = mode;
    if (mode === "orbit" && document.pointerLockElement) document.exitPointerLock();
    this.applyLayers();
  }

  /** Walk from a place on a level on, looking along a direction. */
  walkAt(x: number, z: number, yaw?: number, level = this.level): boolean {
    if (!this.walker.standAt(x, z, this.floors[level] + 1)) return false;
    if (yaw !== undefined) this.walker.yaw = yaw;
    this.walker.pitch = 0;
    this.setMode("walk");
    return true;
  }

  /** Walk in at an entrance of a level, on one of its lanes, or in the middle where there is none. */
  walkIn(level = this.level): void {
    const lanes = this.scene.lanes;
    const entrance = lanes ? lanes.kinds.findIndex((kind, node) => kind === "entrance" && lanes.levels[node] === level) : -1;
    if (lanes)
      for (let edge = 0; edge < lanes.forward.length; edge++) {
        const [from, to] = [lanes.edges[2 * edge], lanes.edges[2 * edge + 1]];
        if (entrance >= 0 ? from !== entrance && to !== entrance : !this.isFlat(from, to, level)) continue;
        const next = from === entrance ? to : from;
        const first = from === next ? to : from;
        const [x0, z0] = [lanes.nodes[3 * first], lanes.nodes[3 * first + 2]];
        const [x1, z1] = [lanes.nodes[3 * next], lanes.nodes[3 * next + 2]];
        if (this.walkAt(x0 + 0.5 * (x1 - x0), z0 + 0.5 * (z1 - z0), Math.atan2(x0 - x1, z0 - z1), level)) return;
      }
    const [x0, z0, x1, z1] = this.inside();
    if (!this.walkAt((x0 + x1) / 2, (z0 + z1) / 2, undefined, level)) element("hints").textContent = "There is no floor to walk on.";
  }

  /** Whether a lane lies on the floor of a level. */
  private isFlat(from: number, to: number, level: number): boolean {
    const lanes = this.scene.lanes;
    return lanes !== null && [from, to].every((node) => lanes.levels[node] === level && Math.abs(lanes.nodes[3 * node + 1] - this.floors[level]) < 0.2);
  }

  private goTo(x: number, z: number): void {
    if (this.mode === "walk") {
      this.walkAt(x, z);
      return;
    }
    const shift = new THREE.Vector3(x, this.floor, z).sub(this.orbit.target);
    this.orbit.target.add(shift);
    this.camera.position.add(shift);
    this.orbit.update();
    this.touch();
  }

  // -- what is selected

  select(object: number): void {
    this.selected = object;
    this.materials.uniforms.selected.value = object;
    this.frame.lines.visible = false;
    element("inspector").hidden = object < 0;
    if (object >= 0) {
      const [x, , z] = this.boxes.centre(object);
      const stall = this.stallAt(x, z, this.boxes.world[6 * object + 1], this.scene.level[object]);
      const parked = stall !== null && this.cars.some((car) => this.isIn(stall, car));
      showObject(this.scene, this.boxes, object, stall, parked);
      this.frame.around(this.scene, this.boxes.local, object);
    }
    this.touch();
  }

  /** Whether the middle of an object is in a stall. */
  private isIn(stall: Stall, object: number): boolean {
    const [x, , z] = this.boxes.centre(object);
    return stall.level === this.scene.level[object] && isInside(stall.corners, x, z);
  }

  /** The stall that something low stands in. */
  private stallAt(x: number, z: number, low: number, level: number): Stall | null {
    if (low > this.floors[level] + 1) return null;
    return this.scene.lanes?.stalls.find((stall) => stall.level === level && isInside(stall.corners, x, z)) ?? null;
  }

  /** The object seen at a place on the canvas, in CSS pixels, stains only on request; -1 for none. */
  pick(x: number, y: number, stains = false): number {
    return this.hitAt(x, y, stains)?.object ?? -1;
  }

  private hitAt(x: number, y: number, stains: boolean): Hit | null {
    const canvas = element("view");
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2((2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight), this.camera);
    const { origin, direction } = caster.ray;
    const { scene, instances } = this;
    const seen = (object: number) =>
      instances.visible[object] > 0 && (stains || scene.shapes[scene.shape[object]].opaque[1] > 0);
    return this.rays.cast(origin.toArray(), direction.toArray(), this.camera.far, seen);
  }

  /** Show and select the stall with a number, or the object with an id or a path. */
  find(query: string): boolean {
    const word = query.trim().toLowerCase();
    if (!word) return false;
    const level = this.scene.header.levels[this.level]?.name.toLowerCase();
    const words = [word, `${level}/${word}`];
    const stall = this.scene.lanes?.stalls.find((one) => [one.number, one.id].some((name) => words.includes(name?.toLowerCase() ?? "")));
    let object = stall ? this.scene.paths.findIndex((_, k) => this.scene.labelOf(k) === "parking_stall" && this.isIn(stall, k)) : -1;
    if (object < 0 && /^\d+$/.test(word)) object = this.scene.ids.indexOf(Number(word));
    if (object < 0) object = this.scene.paths.findIndex((path) => path.toLowerCase() === word);
    if (object < 0) object = this.scene.paths.findIndex((path) => path.toLowerCase().endsWith(word));
    if (object < 0) return false;
    this.select(object);
    if (this.mode === "orbit") this.chooseLevel(this.scene.level[object]);
    this.approach(object);
    return true;
  }

  private approach(object: number): void {
    const [x, y, z] = this.boxes.centre(object);
    const stall = this.scene.lanes?.stalls.find((one) => this.isIn(one, object));
    if (this.mode === "walk") {
      const mouth = stall ? middleOf(stall.corners.slice(0, 2)) : [x, z + 3];
      const way = [mouth[0] - x, mouth[1] - z];
      const length = Math.hypot(way[0], way[1]) || 1;
      const [px, pz] = [mouth[0] + (2 * way[0]) / length, mouth[1] + (2 * way[1]) / length];
      if (this.walkAt(px, pz, undefined, this.scene.level[object])) {
        this.walker.yaw = Math.atan2(this.walker.feet.x - x, this.walker.feet.z - z);
        this.walker.pitch = Math.atan2(y - this.walker.feet.y - EYE_M, length + 2);
      }
      return;
    }
    const away = this.camera.position.clone().sub(this.orbit.target).normalize().multiplyScalar(18);
    this.orbit.target.set(x, y, z);
    this.camera.position.set(x, y, z).add(away);
    this.orbit.update();
    this.touch();
  }

  // -- mouse and keys

  private listen(): void {
    const canvas = element<HTMLCanvasElement>("view");
    canvas.addEventListener("pointerdown", (event) => {
      canvas.focus();
      this.pressedAt = [event.clientX, event.clientY];
      this.lookedAt = this.mode === "walk" && !document.pointerLockElement ? [event.clientX, event.clientY] : null;
    });
    window.addEventListener("pointermove", (event) => {
      if (this.mode !== "walk") return;
      if (document.pointerLockElement === canvas) this.walker.look(event.movementX, event.movementY);
      else if (this.lookedAt) {
        this.walker.look(event.clientX - this.lookedAt[0], event.clientY - this.lookedAt[1]);
        this.lookedAt = [event.clientX, event.clientY];
      } else return;
      this.touch();
    });
    window.addEventListener("pointerup", (event) => {
      this.lookedAt = null;
      const from = this.pressedAt;
      this.pressedAt = null;
      if (!from || event.button !== 0 || Math.hypot(event.clientX - from[0], event.clientY - from[1]) > CLICK_PX) return;
      const locked = document.pointerLockElement === canvas;
      const [x, y] = locked ? [canvas.clientWidth / 2, canvas.clientHeight / 2] : [event.clientX, event.clientY];
      this.select(this.pick(x, y, event.shiftKey));
    });
    canvas.addEventListener("dblclick", (event) => {
      if (this.mode !== "orbit") return;
      const hit = this.hitAt(event.clientX, event.clientY, false);
      if (!hit) return;
      const ahead = this.camera.getWorldDirection(new THREE.Vector3());
      this.walkAt(hit.point[0], hit.point[2], Math.atan2(-ahead.x, -ahead.z), this.scene.level[hit.object]);
    });
    document.addEventListener("pointerlockchange", () => {
      element("crosshair").hidden = document.pointerLockElement !== canvas;
    });
    window.addEventListener("keydown", (event) => this.keyDown(event));
    window.addEventListener("keyup", (event) => this.walker.key(event.code, false));
    window.addEventListener("blur", () => this.walker.release());
    window.addEventListener("resize", () => this.resize());
    element("mode-orbit").addEventListener("click", () => this.overview());
    element("mode-walk").addEventListener("click", () => this.enterWalk());
    element("look-surface").addEventListener("click", () => this.setLook(false));
    element("look-labels").addEventListener("click", () => this.setLook(true));
    element("close").addEventListener("click", () => this.select(-1));
    element("map-size").addEventListener("click", () => {
      this.map.toggleSize();
      this.touch();
    });
    element("search").addEventListener("submit", (event) => {
      event.preventDefault();
      const query = element<HTMLInputElement>("query");
      query.classList.toggle("missed", !this.find(query.value));
    });
  }

  private enterWalk(): void {
    if (this.mode !== "walk") this.walkIn();
    // not every browser gives it; then one looks by dragging
    const asked: unknown = element("view").requestPointerLock();
    if (asked instanceof Promise) asked.catch(() => undefined);
  }

  private keyDown(event: KeyboardEvent): void {
    if (event.target instanceof HTMLInputElement && event.target.type !== "checkbox") return;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (this.mode === "walk" && this.walker.key(event.code, true)) {
      event.preventDefault();
      return;
    }
    const actions: Record<string, () => void> = {
      Digit1: () => this.overview(),
      Digit2: () => this.enterWalk(),
      Digit3: () => this.setLook(false),
      Digit4: () => this.setLook(true),
      KeyC: () => this.setLayer("ceiling"),
      KeyV: () => this.setLayer("cars"),
      KeyG: () => this.setLayer("lanes"),
      KeyU: () => this.setLayer("stalls"),
      KeyK: () => this.setLayer("colliders"),
      KeyT: () => this.traffic?.setPlaying(!this.traffic.playing),
      PageUp: () => this.chooseLevel(this.level - 1),
      PageDown: () => this.chooseLevel(this.level + 1),
      KeyF: () => this.selected >= 0 && this.approach(this.selected),
      Escape: () => this.select(-1),
    };
    actions[event.code]?.();
  }

  private resize(): void {
    const [width, height] = [window.innerWidth, window.innerHeight];
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.touch();
  }
}

declare global {
  interface Window {
    /** For tests, and for whoever likes the console. */
    viewer?: Viewer;
  }
}

try {
  const viewer = await Viewer.open();
  window.viewer = viewer;
  viewer.run();
} catch (error) {
  console.error(error);
  element("note").textContent = error instanceof Error ? error.message : String(error);
  element("curtain").classList.add("failed");
}
