/** A sheet in metres that is zoomed and moved, as SVG. */

export type Point = [number, number];
const SVG = "http://www.w3.org/2000/svg";

export const clamp = (value: number, least: number, most: number) => Math.min(Math.max(value, least), most);

export class Sheet {
  /** What is seen: the corner in metres, and metres per pixel. */
  view = { x: 0, z: 0, scale: 0.1 };
  /** True once the user has zoomed or moved the sheet, which then stays as it is when the window changes. */
  isMoved = false;
  /** Pixels of the fingers, or of the mouse, that are down. */
  readonly fingers = new Map<number, Point>();

  constructor(readonly svg: SVGSVGElement, private readonly redraw: () => void) {
    svg.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(clamp(event.deltaY, -200, 200) / 500), this.pixel(event));
    }, { passive: false });
    svg.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  /** Show from (0, 0) to a far corner, with a margin in pixels, and one more before it. */
  fit(width: number, depth: number, margin: number, before: number): boolean {
    const box = this.svg.getBoundingClientRect();
    if (!box.width) return false;
    const scale = Math.max(width / Math.max(box.width - 2 * margin, 50), depth / Math.max(box.height - 2 * margin, 50));
    this.view = { x: (width - box.width * scale - before * scale) / 2, z: (depth - box.height * scale - before * scale) / 2, scale };
    this.isMoved = false;
    this.redraw();
    return true;
  }

  zoom(factor: number, at?: Point): void {
    const box = this.svg.getBoundingClientRect();
    const [px, pz] = at ?? [box.width / 2, box.height / 2];
    const scale = clamp(this.view.scale * factor, 0.002, 2);
    this.view.x += px * (this.view.scale - scale);
    this.view.z += pz * (this.view.scale - scale);
    this.view.scale = scale;
    this.isMoved = true;
    this.redraw();
  }

  reveal([x, z]: Point): void {
    const box = this.svg.getBoundingClientRect();
    this.view.x = x - (box.width / 2) * this.view.scale;
    this.view.z = z - (box.height / 2) * this.view.scale;
    this.isMoved = true;
    this.redraw();
  }

  /** Move the sheet with a finger or the mouse. */
  pan(before: Point, pixel: Point): void {
    this.view.x -= (pixel[0] - before[0]) * this.view.scale;
    this.view.z -= (pixel[1] - before[1]) * this.view.scale;
    this.isMoved = true;
    this.redraw();
  }

  /** Move and zoom with two fingers, of which one moves. */
  pinch(finger: number, before: Point, pixel: Point): void {
    const other = [...this.fingers].find(([id]) => id !== finger)![1];
    const apart = (a: Point) => Math.hypot(a[0] - other[0], a[1] - other[1]);
    this.view.x -= ((pixel[0] - before[0]) * this.view.scale) / 2;
    this.view.z -= ((pixel[1] - before[1]) * this.view.scale) / 2;
    this.zoom(apart(before) / Math.max(apart(pixel), 1), [(pixel[0] + other[0]) / 2, (pixel[1] + other[1]) / 2]);
  }

  pixel(event: MouseEvent): Point {
    const box = this.svg.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  metres([px, pz]: Point): Point {
    return [this.view.x + px * this.view.scale, this.view.z + pz * this.view.scale];
  }

  /** Let the SVG's units be metres. */
  place(): void {
    const box = this.svg.getBoundingClientRect();
    set(this.svg, { viewBox: `${this.view.x} ${this.view.z} ${box.width * this.view.scale} ${box.height * this.view.scale}` });
  }
}

export function element<Name extends keyof SVGElementTagNameMap>(name: Name, attributes: Record<string, string | number>): SVGElementTagNameMap[Name] {
  const made = document.createElementNS(SVG, name);
  set(made, attributes);
  return made;
}

export function set(target: SVGElement, attributes: Record<string, string | number>): void {
  for (const [name, value] of Object.entries(attributes)) target.setAttribute(name, String(value));
}
