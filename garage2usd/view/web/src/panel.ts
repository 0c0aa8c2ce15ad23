/** The panels: layers, classes, the selected object. */

import type { Boxes } from "./boxes";
import { NODE_COLOURS, USE_COLOURS, colourOf, spoken } from "./classes";
import type { SceneFile, Stall } from "./scene_file";

export function element<K extends HTMLElement>(id: string): K {
  const found = document.getElementById(id);
  if (!found) throw new Error(`The page has no ${id}.`);
  return found as K;
}

function made<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  className = "",
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  node.className = className;
  node.append(...children);
  return node;
}

/** Whether a stall is parallel to its lane, angled or perpendicular, by its corners. */
function kindOf(stall: Stall): string {
  const [left, right, rear] = stall.corners;
  const mouth = [right[0] - left[0], right[1] - left[1]];
  const side = [rear[0] - right[0], rear[1] - right[1]];
  const [width, length] = [Math.hypot(mouth[0], mouth[1]), Math.hypot(side[0], side[1])];
  const cosine = (mouth[0] * side[0] + mouth[1] * side[1]) / (width * length || 1);
  if (Math.abs(cosine) > 0.02) {
    const angle = (Math.acos(Math.min(1, Math.abs(cosine))) * 180) / Math.PI;
    return `angled, ${angle.toFixed(0)}°`;
  }
  return width > length ? "parallel" : "perpendicular";
}

function chip(colour: string): HTMLElement {
  const node = made("i", "chip");
  node.style.backgroundColor = colour;
  return node;
}

export interface LayerRow {
  id: string;
  name: string;
  hint: string;
  key: string;
  on: boolean;
  /** What else stands under the name. */
  legend?: [string, string][];
  change: (on: boolean) => void;
}

/** A row with a switch for each layer; gives what sets one from elsewhere. */
export function showLayers(rows: LayerRow[]): (id: string, on?: boolean) => void {
  const boxes = new Map<string, HTMLInputElement>();
  for (const row of rows) {
    const box = made("input");
    box.type = "checkbox";
    box.checked = row.on;
    box.id = `layer-${row.id}`;
    box.addEventListener("change", () => row.change(box.checked));
    boxes.set(row.id, box);
    const label = made("label", "layer", box, made("span", "knob"), made("span", "name", row.name), made("kbd", "", row.key));
    label.title = row.hint;
    element("layer-list").append(label);
    if (row.legend) element("layer-list").append(legendOf(row.legend));
  }
  return (id, on) => {
    const box = boxes.get(id);
    if (!box) return;
    box.checked = on ?? !box.checked;
    box.dispatchEvent(new Event("change"));
  };
}

function legendOf(entries: [string, string][]): HTMLElement {
  return made("div", "legend", ...entries.map(([name, colour]) => made("span", "", chip(colour), name)));
}

export const laneLegend = (kinds: string[]): [string, string][] =>
  Object.entries(NODE_COLOURS)
    .filter(([kind]) => kinds.includes(kind))
    .map(([kind, colour]) => [kind === "t_junction" ? "T junction" : spoken(kind), colour]);

export const useLegend = (uses: string[]): [string, string][] =>
  Object.entries(USE_COLOURS)
    .filter(([use]) => uses.includes(use))
    .map(([use, colour]) => [spoken(use), colour]);

/** A row for each class, the most frequent first; gives what sets one from elsewhere. */
export function showClasses(scene: SceneFile, change: (label: string, on: boolean) => void): void {
  const counts = scene.counts();
  element("object-count").textContent = `${scene.count.toLocaleString("en")} objects`;
  scene.header.labels.forEach((label, number) => {
    const box = made("input");
    box.type = "checkbox";
    box.checked = true;
    box.addEventListener("change", () => change(label, box.checked));
    const count = made("span", "count", counts[number].toLocaleString("en"));
    const row = made("label", "class", box, chip(colourOf(label)), made("span", "name", spoken(label)), count);
    row.dataset["label"] = label;
    row.dataset["count"] = String(counts[number]);
    element("class-list").append(row);
  });
}

/** A button for each level of a garage of several levels. */
export function showLevels(scene: SceneFile, choose: (level: number) => void): void {
  element("levels").hidden = scene.header.levels.length === 0;
  scene.header.levels.forEach(({ name }, level) => {
    const button = made("button", "", name);
    button.id = `level-${name}`;
    button.title = "Page Up and Page Down; levels above are hidden";
    button.addEventListener("click", () => choose(level));
    element("levels").append(button);
  });
}

export function showRemarks(remarks: string[]): void {
  element("remarks").hidden = remarks.length === 0;
  element("remarks").replaceChildren(...remarks.map((remark) => made("p", "", remark)));
}

/** A row of the inspector: a name and what stands beside it. */
type Fact = [string, string | HTMLElement];

function facts(rows: Fact[]): HTMLElement {
  const list = made("dl");
  for (const [name, value] of rows) {
    const cell = made("dd", "", value);
    cell.dataset["fact"] = name;
    list.append(made("dt", "", name), cell);
  }
  return list;
}

export function showObject(scene: SceneFile, boxes: Boxes, object: number, stall: Stall | null, parked: boolean): void {
  const label = scene.labelOf(object);
  const path = scene.paths[object];
  const world = boxes.world.subarray(6 * object, 6 * object + 6);
  const size = [0, 1, 2].map((k) => (world[k + 3] - world[k]).toFixed(2)).join(" × ");
  const square = scene.header.squares[scene.square[object]];
  const copy = made("button", "copy", "Copy path");
  copy.addEventListener("click", () => {
    void navigator.clipboard.writeText(path).then(() => (copy.textContent = "Copied"));
  });
  const head = made("h2", "", chip(colourOf(label)), spoken(label));
  const rows: Fact[] = [
    ["Class", label],
    ["Instance id", scene.ids[object] ? String(scene.ids[object]) : "no label table"],
    ["Prim", made("span", "path", ...breakable(path))],
  ];
  const sections: HTMLElement[] = [copy, head, facts(rows)];
  if (stall) {
    const use = made("span", "", chip(USE_COLOURS[stall.use ?? ""] ?? "#9aa5b1"), spoken(stall.use ?? "-"));
    const [left, right, rear] = stall.corners;
    const [width, length] = [distance(left, right), distance(right, rear)];
    sections.push(
      made("h3", "", label === "parking_stall" ? "Stall" : "Stands in stall"),
      facts([
        ["Number", made("b", "number", stall.number || "-")],
        ["Stall id", stall.id ?? "-"],
        ["Use", use],
        ["Type", spoken(stall.type ?? "-")],
        ["Kind", `${kindOf(stall)}${stall.size && stall.size !== "standard" ? `, ${stall.size}` : ""}`],
        ["Mouth and side", `${width.toFixed(2)} × ${length.toFixed(2)} m`],
        ["Entry edge", stall.entryEdge ?? "-"],
        ["Lane node", String(stall.accessNode ?? "-")],
        ["Car", parked ? "parked" : "none"],
      ]),
    );
  }
  const place: Fact[] = [
    ["Size", `${size} m`],
    ["Middle", `${boxes.centre(object).map((value) => value.toFixed(2)).join(", ")} m`],
  ];
  const level = scene.header.levels[scene.level[object]];
  if (level) place.push(["Level", level.name]);
  if (square) place.push(["Square", spoken(square)]);
  sections.push(made("h3", "", "Place"), facts(place));
  element("inspected").replaceChildren(...sections);
  element("inspector").hidden = false;
}

/** A path that may break after each slash. */
function breakable(path: string): (Node | string)[] {
  return path.split("/").flatMap((part, k) => (k ? ["/", document.createElement("wbr"), part] : [part]));
}

function distance([x0, z0]: [number, number], [x1, z1]: [number, number]): number {
  return Math.hypot(x1 - x0, z1 - z0);
}
