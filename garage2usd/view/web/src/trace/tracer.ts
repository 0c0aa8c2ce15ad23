/** The sheet with the picture and the parts traced over it, and the hand that traces. */

import type { Finding } from "../draw/desk";
import { element, type Point, set, Sheet } from "../draw/sheet";
import { type Chosen, type Drawing, keysOf, lengthOf, type PartName, pointsOf, TOOLS, type Tool, type Traced, type Value } from "./parts";

const SNAP_PX = 9;
const STRAIGHT_DEG = 3;
const CLICK_PX = 5;
const LAYERS = ["picture", "outlines", "stalls", "lanes", "columns", "portals", "pending", "handles", "findings", "cross", "scale"];

interface Listener {
  traced(tool: Tool, points: Point[]): void;
  chosen(chosen: Chosen | null): void;
  moved(chosen: Chosen, keys: Value | Point[], stroke: string): void;
  /** The next point that a tool waits for, or the place of the cross. */
  waits(): void;
}

export class Tracer {
  tool: Tool = TOOLS[0]!;
  pending: Point[] = [];
  chosen: Chosen | null = null;
  findings: Finding[] = [];
  /** Where a key puts a point. */
  cross: Point = [5, 5];
  /** Address and size in pixels of the picture, and metres of a pixel. */
  picture: { url: string; width: number; height: number; scale: number; share: number } | null = null;
  /** The length in the picture whose metres are asked for. */
  stretch: Point[] = [];
  readonly sheet: Sheet;
  private drawing: Drawing = {};
  private stalls: Traced["stalls"] = [];
  private hover: Point | null = null;
  private pressed: { id: number; pixel: Point; handle: number | null; target: Chosen | null; isDragged: boolean; stroke: string } | null = null;
  private strokes = 0;
  private fitted = false;
  private readonly layers = new Map<string, SVGGElement>();

  constructor(readonly svg: SVGSVGElement, private readonly listener: Listener) {
    for (const name of LAYERS) {
      const layer = element("g", { class: name });
      this.layers.set(name, layer);
      svg.append(layer);
    }
    this.sheet = new Sheet(svg, () => this.draw());
    svg.addEventListener("pointerdown", (event) => this.press(event));
    svg.addEventListener("pointermove", (event) => this.drag(event));
    svg.addEventListener("pointerup", (event) => this.release(event));
    svg.addEventListener("pointercancel", (event) => this.release(event));
    svg.addEventListener("dblclick", () => this.finish());
    new ResizeObserver(() => (this.sheet.isMoved && this.fitted ? this.draw() : this.fit())).observe(svg);
  }

  get isPainting(): boolean {
    return this.pressed?.isDragged ?? false;
  }

  show({ drawing, stalls }: Traced): void {
    [this.drawing, this.stalls] = [drawing, stalls];
    if (this.chosen && !this.valueOf(this.chosen)) this.choose(null);
    if (this.fitted) this.draw();
    else this.fit();
  }

  valueOf({ part, at }: Chosen): Value | Point[] | undefined {
    return part === "outline" ? this.drawing.outline : this.drawing[part]?.[at];
  }

  /** All parts in the order of the list. */
  get parts(): Chosen[] {
    const names: PartName[] = ["runs", "stalls", "lanes", "portals", "columns", "solids"];
    const own: Chosen[] = names.flatMap((part) => (this.drawing[part] ?? []).map((_, at) => ({ part, at })));
    return this.drawing.outline ? [{ part: "outline", at: 0 }, ...own] : own;
  }

  fit(): void {
    const points = [...this.parts.flatMap((each) => pointsOf(each.part, this.valueOf(each)!)), ...this.stalls.flatMap(({ corners }) => corners)];
    const { width = 1200, height = 800, scale = 0.05 } = this.picture ?? {};
    const far = (axis: 0 | 1, least: number) => Math.max(...points.map((point) => point[axis]), points.length && !this.picture ? 1 : least);
    this.fitted = this.sheet.fit(far(0, width * scale), far(1, height * scale), 40, 0) || this.fitted;
  }

  choose(chosen: Chosen | null): void {
    this.chosen = chosen;
    this.listener.chosen(chosen);
    this.draw();
  }

  take(tool: Tool): void {
    this.tool = tool;
    this.pending = this.stretch = [];
    this.listener.waits();
    this.draw();
  }

  /** Put the next point of the tool. */
  put(point: Point): void {
    if (this.tool.id === "select") return;
    this.pending.push(point);
    if (this.tool.points === this.pending.length) this.end();
    else this.listener.waits();
    this.draw();
  }

  /** End a line or an outline of as many points as were put. */
  finish(): void {
    if (this.tool.least && this.pending.length >= this.tool.least) this.end();
  }

  back(): void {
    this.pending.pop();
    this.listener.waits();
    this.draw();
  }

  private end(): void {
    // a double click ends with two points at one place
    const points = this.pending.filter(([x, z], k) => !k || Math.hypot(x - this.pending[k - 1]![0], z - this.pending[k - 1]![1]) > 0.01);
    this.pending = [];
    if (points.length >= (this.tool.least ?? this.tool.points!)) this.listener.traced(this.tool, points);
    this.listener.waits();
    this.draw();
  }

  /** Move the cross, or while parts are selected the chosen one. */
  step(right: number, down: number): void {
    const chosen = this.chosen;
    if (this.tool.id === "select" && chosen) {
      this.moved(chosen, pointsOf(chosen.part, this.valueOf(chosen)!).map(([x, z]) => [x + right, z + down]), `k${this.strokes}`);
      return;
    }
    this.cross = [Math.round((this.cross[0] + right) * 100) / 100, Math.round((this.cross[1] + down) * 100) / 100];
    this.hover = this.cross;
    this.listener.waits();
    this.draw();
  }

  private moved(chosen: Chosen, points: Point[], stroke: string): void {
    const value = this.valueOf(chosen)!;
    this.listener.moved(chosen, chosen.part === "outline" ? points : keysOf(chosen.part, value as Value, points), stroke);
  }

  /** Near another point, or in line with the last one, a point is put exactly there. */
  private snapped(point: Point, event: PointerEvent): Point {
    if (event.altKey || this.tool.id === "scale") return point;
    const near = SNAP_PX * this.sheet.view.scale;
    const others = this.parts.flatMap((each) => (this.isDragging(each) ? [] : pointsOf(each.part, this.valueOf(each)!)));
    const found = [...others, ...this.pending].find(([x, z]) => Math.hypot(x - point[0], z - point[1]) < near);
    const last = this.pending[this.pending.length - 1];
    if (found || !last) return found ?? point;
    const turn = (Math.atan2(point[1] - last[1], point[0] - last[0]) * 180) / Math.PI;
    const off = Math.abs(turn - 90 * Math.round(turn / 90));
    if (off > STRAIGHT_DEG) return point;
    return Math.round(turn / 90) % 2 ? [last[0], point[1]] : [point[0], last[1]];
  }

  private isDragging({ part, at }: Chosen): boolean {
    return this.pressed?.handle != null && this.chosen?.part === part && this.chosen.at === at;
  }

  private press(event: PointerEvent): void {
    this.svg.focus({ preventScroll: true });
    this.svg.setPointerCapture(event.pointerId);
    const pixel = this.sheet.pixel(event);
    this.sheet.fingers.set(event.pointerId, pixel);
    if (this.sheet.fingers.size > 1) {
      this.pressed = null;
      return;
    }
    const data = (event.target as SVGElement).closest<SVGElement>("[data-part]")?.dataset;
    const target = data ? { part: data["part"] as Chosen["part"], at: Number(data["at"]) } : null;
    const handle = this.tool.id === "select" && data?.["handle"] ? Number(data["handle"]) : null;
    this.pressed = { id: event.button === 0 ? event.pointerId : -1, pixel, handle, target, isDragged: false, stroke: `h${this.strokes++}` };
  }

  private drag(event: PointerEvent): void {
    const pixel = this.sheet.pixel(event);
    const before = this.sheet.fingers.get(event.pointerId);
    const point = this.snapped(this.sheet.metres(pixel), event);
    if (!before) {
      this.hover = point;
      if (this.pending.length) this.draw();
      return;
    }
    this.sheet.fingers.set(event.pointerId, pixel);
    if (this.sheet.fingers.size > 1) return this.sheet.pinch(event.pointerId, before, pixel);
    const { pressed, chosen } = this;
    if (!pressed) return;
    if (!pressed.isDragged && Math.hypot(pixel[0] - pressed.pixel[0], pixel[1] - pressed.pixel[1]) < CLICK_PX) return;
    pressed.isDragged = true;
    if (pressed.handle !== null && chosen) {
      const points = [...pointsOf(chosen.part, this.valueOf(chosen)!)];
      points[pressed.handle] = point;
      this.moved(chosen, points, pressed.stroke);
    } else if (pressed.id < 0 || this.tool.id === "select") this.sheet.pan(before, pixel);
  }

  private release(event: PointerEvent): void {
    this.sheet.fingers.delete(event.pointerId);
    const { pressed } = this;
    this.pressed = null;
    if (!pressed || pressed.id < 0 || event.type === "pointercancel") return;
    if (this.tool.id !== "select") this.put(this.snapped(this.sheet.metres(this.sheet.pixel(event)), event));
    else if (!pressed.isDragged) this.choose(pressed.target);
  }

  draw(): void {
    this.sheet.place();
    const { scale } = this.sheet.view;
    const picture = this.picture;
    this.fill("picture", ...(picture ? [element("image", {
      href: picture.url, x: 0, y: 0, width: picture.width * picture.scale, height: picture.height * picture.scale, opacity: picture.share, preserveAspectRatio: "none",
    })] : []));
    const outlines: SVGElement[] = [];
    if (this.drawing.outline) outlines.push(this.mark({ part: "outline", at: 0 }, element("path", { d: closed(this.drawing.outline), class: "outline" })));
    this.drawing.solids?.forEach((solid, at) => outlines.push(this.mark({ part: "solids", at }, element("path", { d: closed(solid["corners"] as Point[]), class: "solid" }))));
    this.fill("outlines", ...outlines);
    const stalls: SVGElement[] = [];
    for (const part of ["stalls", "runs"] as const)
      this.drawing[part]?.forEach((value, at) => {
        const name = (value["id"] as string | undefined) || `${part}.${at}`;
        const own = this.stalls.filter((stall) => (part === "runs" ? stall.name.startsWith(`${name}.`) : stall.name === name));
        stalls.push(this.mark({ part, at }, element("path", { d: own.map(({ corners }) => closed(corners)).join(""), class: "stall" })));
        stalls.push(element("path", { d: own.map(({ corners: [a, b] }) => `M${a}L${b}`).join(""), class: "mouth" }));
      });
    this.fill("stalls", ...stalls);
    this.fill("lanes", ...(this.drawing.lanes ?? []).map((lane, at) => {
      const points = lane["points"] as Point[];
      const group = element("g", {});
      group.append(element("path", { d: open(points), class: "lane", "stroke-width": (lane["width_m"] as number | undefined) ?? 5 }));
      group.append(element("path", { d: open(points) + (lane["one_way"] ? arrow(points, 14 * scale) : ""), class: "way" }));
      return this.mark({ part: "lanes", at }, group);
    }));
    this.fill("columns", ...(this.drawing.columns ?? []).map((column, at) => {
      const [[x, z], side] = [column["at"] as Point, (column["size_m"] as number | undefined) ?? 0.4];
      return this.mark({ part: "columns", at }, element("rect", { x: x - side / 2, y: z - side / 2, width: side, height: side, class: "column" }));
    }));
    this.fill("portals", ...(this.drawing.portals ?? []).map((portal, at) => {
      const [[x, z], kind] = [portal["at"] as Point, (portal["kind"] as string | undefined) ?? "both"];
      const group = element("g", { class: `portal ${kind}` });
      const text = element("text", { x, y: z, "font-size": 9 * scale });
      text.textContent = { entrance: "IN", exit: "OUT", both: "IN+OUT" }[kind] ?? kind;
      group.append(element("circle", { cx: x, cy: z, r: 17 * scale }), text);
      return this.mark({ part: "portals", at }, group);
    }));
    this.drawPending(scale);
    this.fill("handles", ...(this.chosen ? pointsOf(this.chosen.part, this.valueOf(this.chosen)!) : []).map(([x, z], handle) =>
      this.mark(this.chosen!, element("circle", { cx: x, cy: z, r: 6 * scale, class: "handle", "data-handle": handle })),
    ));
    this.fill("findings", ...this.findings.flatMap(({ at, severity, message }, number) => {
      if (!at) return [];
      const group = element("g", { class: `finding ${severity}` });
      const [title, text] = [element("title", {}), element("text", { x: at[0], y: at[1], "font-size": 11 * scale })];
      [title.textContent, text.textContent] = [message, String(number + 1)];
      group.append(title, element("circle", { cx: at[0], cy: at[1], r: 10 * scale }), text);
      return [group];
    }));
    const [x, z] = this.cross;
    this.fill("cross", element("path", { d: `M${x - 9 * scale} ${z}h${18 * scale}M${x} ${z - 9 * scale}v${18 * scale}` }));
    this.drawScale(scale);
  }

  private drawPending(scale: number): void {
    const fixed = this.pending.length ? this.pending : this.stretch;
    const points = this.hover && this.pending.length ? [...this.pending, this.hover] : fixed;
    const dots = fixed.map(([x, z]) => element("circle", { cx: x, cy: z, r: 4 * scale }));
    const text = element("text", { "font-size": 12 * scale });
    const [a, b] = points.slice(-2) as [Point, Point | undefined];
    if (b && this.tool.id !== "scale") {
      set(text, { x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2 - 12 * scale });
      text.textContent = `${lengthOf([a, b]).toFixed(2)} m`;
    }
    this.fill("pending", element("path", { d: points.length > 1 ? open(points) : "" }), ...dots, text);
  }

  private drawScale(scale: number): void {
    const box = this.svg.getBoundingClientRect();
    const metres = [1, 2, 5, 10, 20, 50, 100, 200].find((each) => each / scale > 60) ?? 500;
    const [x, z] = this.sheet.metres([16, box.height - 16]);
    const text = element("text", { x: x + metres / 2, y: z - 10 * scale, "font-size": 11 * scale });
    text.textContent = `${metres} m`;
    this.fill("scale", element("path", { d: `M${x} ${z - 4 * scale}v${4 * scale}h${metres}v${-4 * scale}` }), text);
  }

  private mark<Kind extends SVGElement>(chosen: Chosen, drawn: Kind): Kind {
    set(drawn, { "data-part": chosen.part, "data-at": chosen.at });
    if (this.chosen?.part === chosen.part && this.chosen.at === chosen.at) drawn.classList.add("chosen");
    return drawn;
  }

  private fill(layer: string, ...elements: SVGElement[]): void {
    this.layers.get(layer)!.replaceChildren(...elements);
  }
}

const open = (points: Point[]) => `M${points.join("L")}`;
const closed = (points: Point[]) => `M${points.join("L")}Z`;

/** An arrow head in the middle of a line. */
function arrow(points: Point[], size: number): string {
  const k = (points.length - 1) >> 1;
  const [a, b] = [points[k]!, points[k + 1]!];
  const turn = Math.atan2(b[1] - a[1], b[0] - a[0]);
  const [x, z] = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  const tail = (side: number) => `${x - size * Math.cos(turn + side)} ${z - size * Math.sin(turn + side)}`;
  return `M${tail(0.5)}L${x} ${z}L${tail(-0.5)}`;
}
