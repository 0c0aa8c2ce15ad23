/** The plan as SVG, in metres: squares, stalls, findings, rulers, and the hand that paints on it. */

import type { Axis, Finding, Level, Sketch, Square } from "./desk";
import { clamp, element, set, Sheet } from "./sheet";

export type Shape = "squares" | "rectangle" | "flood" | "run" | "move";
export const NAMES: Record<string, string> = { "#": "outside or obstacle", ".": "free", "=": "lane", E: "entrance", X: "exit" };
const RULER_PX = 34;
const HANDLE_PX = 7;
const SEND_MS = 120;
const USES = ["standard", "ev", "accessible", "access_aisle", "turning", "unreachable", "motorcycle"];

interface Listener {
  painted(shape: "squares" | "rectangle" | "flood", at: Square[], stroke: string): void;
  ran(first: Square, last: Square, point: [number, number]): void;
  sized(axis: Axis, metres: number[], stroke: string): void;
  moved(): void;
  found(finding: number): void;
}

const edgesOf = (sides: number[]) => sides.reduce((edges, side) => [...edges, edges[edges.length - 1]! + side], [0]);
const round = (value: number) => Math.round(value * 1000) / 1000;

export class Board {
  shape: Shape = "squares";
  symbol = "=";
  symmetry = "none";
  cursor: Square = [0, 0];
  /** The other corner of the selection. */
  anchor: Square = [0, 0];
  private sketch: Sketch = { state: "open", levels: [], rows_m: [1], cols_m: [1], findings: [] };
  private rows: string[] = ["."];
  private level = 0;
  private xs: number[] = [0, 1];
  private zs: number[] = [0, 1];
  private fitted = false;
  private stroke: { id: string; sent: number; squares: Square[]; all: Square[]; start: Square; point: [number, number] } | null = null;
  private sizing: { axis: Axis; line: number; start: number; side: number; sides: number[]; id: string } | null = null;
  private panned: number | null = null;
  private strokes = 0;
  private readonly picture = element("image", { preserveAspectRatio: "none" });
  private readonly layers = new Map<string, SVGGElement>();
  private readonly sheet: Sheet;

  constructor(readonly svg: SVGSVGElement, private readonly listener: Listener) {
    for (const name of ["squares", "picture", "stalls", "ways", "grid", "symmetry", "selection", "findings", "rulers"]) {
      const layer = element("g", { class: name });
      this.layers.set(name, layer);
      svg.append(layer);
    }
    this.layers.get("picture")!.append(this.picture);
    svg.addEventListener("pointerdown", (event) => this.press(event));
    svg.addEventListener("pointermove", (event) => this.drag(event));
    svg.addEventListener("pointerup", (event) => this.release(event));
    svg.addEventListener("pointercancel", (event) => this.release(event));
    this.sheet = new Sheet(svg, () => this.draw());
    new ResizeObserver(() => this.sketch.levels.length && (this.sheet.isMoved ? this.draw() : this.fit())).observe(svg);
  }

  private get view(): Sheet["view"] {
    return this.sheet.view;
  }

  get isPainting(): boolean {
    return this.stroke !== null || this.sizing !== null;
  }

  show(sketch: Sketch, level: number): void {
    const isOther = sketch.rows_m.length !== this.sketch.rows_m.length || sketch.cols_m.length !== this.sketch.cols_m.length;
    this.sketch = sketch;
    this.level = clamp(level, 0, sketch.levels.length - 1);
    this.rows = [...this.current.rows];
    // squares of a stroke that the server has not answered yet
    if (this.stroke && this.shape === "squares") this.paint(this.stroke.all);
    if (!this.sizing) this.takeSides(sketch.rows_m, sketch.cols_m);
    this.cursor = this.inside(this.cursor);
    this.anchor = this.inside(this.anchor);
    if (isOther || !this.fitted) this.fit();
    else this.draw();
  }

  get current(): Level {
    return this.sketch.levels[this.level]!;
  }

  symbolAt([row, col]: Square): string {
    return this.rows[row]?.[col] ?? "#";
  }

  /** First and last square of the selection, from above and left. */
  get selection(): [Square, Square] {
    const [a, b] = [this.cursor, this.anchor];
    return [[Math.min(a[0], b[0]), Math.min(a[1], b[1])], [Math.max(a[0], b[0]), Math.max(a[1], b[1])]];
  }

  get sides(): { rows: number[]; cols: number[] } {
    return { rows: this.sketch.rows_m, cols: this.sketch.cols_m };
  }

  showPicture(url: string, width: number, height: number, x: number, z: number, share: number): void {
    set(this.picture, { href: url, x, y: z, width, height, opacity: share });
  }

  fit(): void {
    if (this.sheet.fit(this.xs[this.xs.length - 1]!, this.zs[this.zs.length - 1]!, RULER_PX + 24, RULER_PX)) this.fitted = true;
  }

  zoom(factor: number): void {
    this.sheet.zoom(factor);
  }

  reveal(place: [number, number]): void {
    this.sheet.reveal(place);
  }

  /** Move the cursor by a step; with `selects` the other corner of the selection stays. */
  step(down: number, right: number, selects: boolean): void {
    this.cursor = this.inside([this.cursor[0] + down, this.cursor[1] + right]);
    if (!selects) this.anchor = this.cursor;
    this.drawSelection();
    this.listener.moved();
  }

  paintSelection(): void {
    const id = `k${this.strokes++}`;
    if (this.shape === "flood") this.listener.painted("flood", [this.cursor], id);
    else this.listener.painted("rectangle", [this.cursor, this.anchor], id);
  }

  /** Direction from a square to the lane that a place in it is next to. */
  edgeToLane([row, col]: Square, point?: [number, number]): string | null {
    const [x, z] = point ?? [(this.xs[col]! + this.xs[col + 1]!) / 2, (this.zs[row]! + this.zs[row + 1]!) / 2];
    const found = ([["up", -1, 0, z - this.zs[row]!], ["down", 1, 0, this.zs[row + 1]! - z], ["left", 0, -1, x - this.xs[col]!],
      ["right", 0, 1, this.xs[col + 1]! - x]] as [string, number, number, number][])
      .filter(([, down, right]) => this.symbolAt([row + down, col + right]) === "=")
      .sort((a, b) => a[3] - b[3]);
    return found[0]?.[0] ?? null;
  }

  private takeSides(rows: number[], cols: number[]): void {
    [this.zs, this.xs] = [edgesOf(rows), edgesOf(cols)];
  }

  private inside([row, col]: Square): Square {
    return [clamp(row, 0, this.rows.length - 1), clamp(col, 0, this.rows[0]!.length - 1)];
  }

  private squareAt([x, z]: [number, number]): Square | null {
    const col = this.xs.findIndex((edge) => x < edge) - 1;
    const row = this.zs.findIndex((edge) => z < edge) - 1;
    return row < 0 || col < 0 ? null : [row, col];
  }

  private press(event: PointerEvent): void {
    this.svg.focus({ preventScroll: true });
    this.svg.setPointerCapture(event.pointerId);
    const pixel = this.sheet.pixel(event);
    this.sheet.fingers.set(event.pointerId, pixel);
    if (this.sheet.fingers.size > 1) {
      this.stroke = null; // a second finger moves the plan
      this.draw();
      return;
    }
    const handle = this.handleAt(pixel);
    if (handle) {
      const sides = [...(handle.axis === "rows" ? this.sketch.rows_m : this.sketch.cols_m)];
      this.sizing = { ...handle, start: pixel[handle.axis === "rows" ? 1 : 0], side: sides[handle.line]!, sides, id: `s${this.strokes++}` };
      return;
    }
    const marker = (event.target as Element).closest("[data-finding]");
    if (marker) {
      this.listener.found(Number(marker.getAttribute("data-finding")));
      return;
    }
    if (event.button !== 0 || this.shape === "move") {
      this.panned = event.pointerId;
      return;
    }
    const point = this.sheet.metres(pixel);
    const square = this.squareAt(point);
    if (!square) return;
    this.cursor = this.anchor = square;
    this.stroke = { id: `p${this.strokes++}`, sent: performance.now(), squares: [], all: [], start: square, point };
    this.extend(square);
    this.listener.moved();
  }

  private drag(event: PointerEvent): void {
    const pixel = this.sheet.pixel(event);
    const before = this.sheet.fingers.get(event.pointerId);
    if (!before) {
      this.svg.style.cursor = { rows: "row-resize", cols: "col-resize", "": "" }[this.handleAt(pixel)?.axis ?? ""];
      return;
    }
    if (this.sheet.fingers.size > 1) {
      this.sheet.pinch(event.pointerId, before, pixel);
    } else if (this.sizing) this.size(pixel);
    else if (this.panned === event.pointerId) {
      this.sheet.pan(before, pixel);
    } else if (this.stroke) {
      for (const place of between(this.sheet.metres(before), this.sheet.metres(pixel), this.view.scale * 4)) {
        const square = this.squareAt(place);
        if (square) this.extend(square);
      }
    }
    this.sheet.fingers.set(event.pointerId, pixel);
  }

  private release(event: PointerEvent): void {
    this.sheet.fingers.delete(event.pointerId);
    if (this.panned === event.pointerId) this.panned = null;
    if (this.sizing) {
      const { axis, sides, id } = this.sizing;
      this.sizing = null;
      this.listener.sized(axis, sides, id);
    }
    const stroke = this.stroke;
    this.stroke = null;
    if (!stroke) return;
    if (this.shape === "squares") this.sendSquares(stroke);
    else if (this.shape === "flood") this.listener.painted("flood", [stroke.start], stroke.id);
    else if (this.shape === "rectangle") this.listener.painted("rectangle", [this.anchor, this.cursor], stroke.id);
    else if (this.shape === "run") this.listener.ran(...this.selection, stroke.point);
    this.listener.moved();
  }

  /** Take a square into the stroke; a pencil's are painted at once, before the server answers. */
  private extend(square: Square): void {
    const stroke = this.stroke!;
    this.cursor = square;
    if (this.shape === "squares") {
      this.anchor = square;
      if (!stroke.all.some(([row, col]) => row === square[0] && col === square[1])) {
        stroke.all.push(square);
        stroke.squares.push(square);
        this.paint([square]);
        this.drawSquares();
      }
      if (performance.now() - stroke.sent > SEND_MS) this.sendSquares(stroke);
    } else if (this.shape === "run") {
      const [row, col] = stroke.start;
      // a run lies along one line
      this.cursor = Math.abs(square[0] - row) > Math.abs(square[1] - col) ? [square[0], col] : [row, square[1]];
    }
    this.drawSelection();
  }

  private paint(squares: Square[]): void {
    for (const [row, col] of squares.flatMap((square) => this.images(square)))
      this.rows[row] = this.rows[row]!.slice(0, col) + this.symbol + this.rows[row]!.slice(col + 1);
  }

  private sendSquares(stroke: { id: string; sent: number; squares: Square[] }): void {
    if (!stroke.squares.length) return;
    this.listener.painted("squares", stroke.squares, stroke.id);
    stroke.squares = [];
    stroke.sent = performance.now();
  }

  private images([row, col]: Square): Square[] {
    const [up, left] = [this.rows.length - 1 - row, this.rows[0]!.length - 1 - col];
    const all: Record<string, Square[]> = { "left-right": [[row, left]], "up-down": [[up, col]], both: [[row, left], [up, col], [up, left]], turned: [[up, left]] };
    return [[row, col], ...(all[this.symmetry] ?? [])];
  }

  /** The border on a ruler that a pixel is near. */
  private handleAt([px, pz]: [number, number]): { axis: Axis; line: number } | null {
    const near = (edges: number[], corner: number, pixel: number) =>
      edges.findIndex((edge, number) => number > 0 && Math.abs((edge - corner) / this.view.scale - pixel) < HANDLE_PX) - 1;
    const top = Math.max((this.zs[0]! - this.view.z) / this.view.scale, RULER_PX);
    const left = Math.max((this.xs[0]! - this.view.x) / this.view.scale, RULER_PX);
    if (pz < top && pz > top - RULER_PX) {
      const line = near(this.xs, this.view.x, px);
      if (line >= 0) return { axis: "cols", line };
    } else if (px < left && px > left - RULER_PX) {
      const line = near(this.zs, this.view.z, pz);
      if (line >= 0) return { axis: "rows", line };
    }
    return null;
  }

  private size(pixel: [number, number]): void {
    const sizing = this.sizing!;
    const isRows = sizing.axis === "rows";
    const moved = (pixel[isRows ? 1 : 0] - sizing.start) * this.view.scale;
    sizing.sides[sizing.line] = clamp(Math.round((sizing.side + moved) * 10) / 10, 1, 50);
    if (isRows) this.takeSides(sizing.sides, this.sketch.cols_m);
    else this.takeSides(this.sketch.rows_m, sizing.sides);
    this.draw();
  }

  draw(): void {
    this.sheet.place();
    this.drawSquares();
    const level = this.current;
    const paths = new Map<string, string>();
    for (const stall of level.stalls) {
      const use = USES.includes(stall.use) ? stall.use : "standard";
      paths.set(use, (paths.get(use) ?? "") + `M${stall.corners.map((corner) => corner.join(",")).join("L")}Z`);
    }
    this.fill("stalls", ...[...paths].map(([use, d]) => element("path", { d, class: `stall ${use}` })));
    this.fill("ways", ...level.ways.map(([x0, z0, x1, z1]) => element("path", { d: arrow(x0, z0, x1, z1), class: "way" })));
    const [width, depth] = [this.xs[this.xs.length - 1]!, this.zs[this.zs.length - 1]!];
    const lines = [...this.xs.map((x) => `M${x} 0V${depth}`), ...this.zs.map((z) => `M0 ${z}H${width}`)].join("");
    this.fill("grid", element("path", { d: lines }));
    this.drawSymmetry(width, depth);
    this.drawFindings();
    this.drawSelection();
    this.drawRulers();
  }

  /** Squares of one kind side by side are one rectangle, so that a large site has few elements. */
  private drawSquares(): void {
    const outside = outsideOf(this.rows);
    const found: SVGElement[] = [];
    this.rows.forEach((line, row) => {
      for (let start = 0, col = 1; col <= line.length; col++) {
        const kind = (each: number) => line[each]! + (line[each] === "#" && outside.has(`${row},${each}`) ? "o" : "");
        if (col < line.length && kind(col) === kind(start)) continue;
        const [x, z] = [this.xs[start]!, this.zs[row]!];
        const name = { "#": "obstacle", "#o": "outside", ".": "free", "=": "lane", E: "entrance", X: "exit" }[kind(start)]!;
        found.push(element("rect", { x, y: z, width: round(this.xs[col]! - x), height: round(this.zs[row + 1]! - z), class: name }));
        if ("EX".includes(line[start]!))
          for (let each = start; each < col; each++) {
            const text = element("text", { x: (this.xs[each]! + this.xs[each + 1]!) / 2, y: (z + this.zs[row + 1]!) / 2, class: "letter", "font-size": 0.3 * Math.min(this.xs[each + 1]! - this.xs[each]!, this.zs[row + 1]! - z) });
            text.textContent = line[start] === "E" ? "IN" : "OUT";
            found.push(text);
          }
        start = col;
      }
    });
    this.fill("squares", ...found);
  }

  private drawSymmetry(width: number, depth: number): void {
    const lines = { "left-right": `M${width / 2} 0V${depth}`, "up-down": `M0 ${depth / 2}H${width}`, both: `M${width / 2} 0V${depth}M0 ${depth / 2}H${width}` };
    const d = lines[this.symmetry as keyof typeof lines];
    this.fill("symmetry", ...(d ? [element("path", { d })] : []));
  }

  drawSelection(): void {
    const [[row, col], [last, end]] = this.selection;
    const frame = { x: this.xs[col]!, y: this.zs[row]!, width: this.xs[end + 1]! - this.xs[col]!, height: this.zs[last + 1]! - this.zs[row]! };
    this.fill("selection", element("rect", { ...frame, class: "frame under" }), element("rect", { ...frame, class: "frame" }));
  }

  private drawFindings(): void {
    const name = this.current.name;
    const radius = 10 * this.view.scale;
    const marks = this.sketch.findings.flatMap((finding, number) => {
      if (!finding.at || !isOn(finding, name)) return [];
      const [x, z] = finding.at;
      const group = element("g", { "data-finding": number, class: `finding ${finding.severity}` });
      const title = element("title", {});
      title.textContent = finding.message;
      const text = element("text", { x, y: z, "font-size": radius * 1.15 });
      text.textContent = String(number + 1);
      group.append(title, element("circle", { cx: x, cy: z, r: radius }), text);
      return [group];
    });
    this.fill("findings", ...marks);
  }

  private drawRulers(): void {
    const { x, z, scale } = this.view;
    const [top, left] = [Math.max(z, this.zs[0]! - RULER_PX * scale), Math.max(x, this.xs[0]! - RULER_PX * scale)];
    const size = RULER_PX * scale;
    const font = 11 * scale;
    const found: SVGElement[] = [
      element("rect", { x: left, y: top, width: this.xs[this.xs.length - 1]! - left, height: size, class: "ruler" }),
      element("rect", { x: left, y: top, width: size, height: this.zs[this.zs.length - 1]! - top, class: "ruler" }),
    ];
    const label = (at: number, side: number, isRow: boolean) => {
      const [cx, cz] = isRow ? [left + size / 2, at] : [at, top + size / 2];
      const isNarrow = side / scale < (isRow ? 12 : 26);
      if (isNarrow) return;
      const text = element("text", { x: cx, y: cz, "font-size": font });
      text.textContent = side.toFixed(1);
      found.push(text);
    };
    this.xs.slice(1).forEach((edge, col) => {
      label((edge + this.xs[col]!) / 2, edge - this.xs[col]!, false);
      found.push(element("path", { d: `M${edge} ${top}V${top + size}`, class: "handle" }));
    });
    this.zs.slice(1).forEach((edge, row) => {
      label((edge + this.zs[row]!) / 2, edge - this.zs[row]!, true);
      found.push(element("path", { d: `M${left} ${edge}H${left + size}`, class: "handle" }));
    });
    this.fill("rulers", ...found);
  }

  private fill(layer: string, ...elements: SVGElement[]): void {
    this.layers.get(layer)!.replaceChildren(...elements);
  }
}

/** True if a finding is on a level; places of several levels begin with the level's name or hold it in their path. */
export function isOn(finding: Finding, level: string): boolean {
  return !level || !/\bU\d\b/.test(finding.place) || finding.place.split("/").includes(level);
}

/** Squares outside: those that hang together with the border. */
function outsideOf(rows: string[]): Set<string> {
  const found = new Set<string>();
  const waiting: Square[] = rows.flatMap((line, row) =>
    [...line].flatMap((_, col): Square[] => (row % (rows.length - 1) && col % (line.length - 1) ? [] : [[row, col]])),
  );
  while (waiting.length) {
    const [row, col] = waiting.pop()!;
    if (rows[row]?.[col] !== "#" || found.has(`${row},${col}`)) continue;
    found.add(`${row},${col}`);
    waiting.push([row - 1, col], [row + 1, col], [row, col - 1], [row, col + 1]);
  }
  return found;
}

function* between([x0, z0]: [number, number], [x1, z1]: [number, number], step: number): Generator<[number, number]> {
  const count = Math.max(1, Math.ceil(Math.hypot(x1 - x0, z1 - z0) / step));
  for (let each = 1; each <= count; each++) yield [x0 + ((x1 - x0) * each) / count, z0 + ((z1 - z0) * each) / count];
}

function arrow(x0: number, z0: number, x1: number, z1: number): string {
  const length = Math.hypot(x1 - x0, z1 - z0) || 1;
  const [dx, dz] = [(x1 - x0) / length, (z1 - z0) / length];
  const [x, z] = [(x0 + x1) / 2, (z0 + z1) / 2];
  const head = (side: number) => `${x + dx - side * dz - dx * 1.2} ${z + dz + side * dx - dz * 1.2}`;
  return `M${x - 1.4 * dx} ${z - 1.4 * dz}L${x + dx} ${z + dz}M${head(0.8)}L${x + dx} ${z + dz}L${head(-0.8)}`;
}
