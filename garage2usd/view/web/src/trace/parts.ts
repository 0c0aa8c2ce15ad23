/** Parts of a survey: their points, the tools that trace them, and their settings. */

import type { FileState } from "../draw/desk";
import type { Point } from "../draw/sheet";

export type PartName = "stalls" | "runs" | "lanes" | "columns" | "portals" | "solids";
export type Value = Record<string, unknown>;
export type Drawing = { outline?: Point[] } & { [Name in PartName]?: Value[] };
export interface Traced extends FileState { drawing: Drawing; stalls: { name: string; corners: Point[] }[] }
/** A part by its place in the file. */
export interface Chosen { part: PartName | "outline"; at: number }

export interface Tool {
  id: string;
  name: string;
  key: string;
  part?: PartName;
  /** Number of its points; of tools without, the least number, and Enter or a double click ends. */
  points?: number;
  least?: number;
  /** What the next point is. */
  hints: string[];
}

export const TOOLS: Tool[] = [
  { id: "select", name: "Select", key: "V", hints: ["Click a part to change it; drag its points; drag beside the parts to move the plan"] },
  { id: "scale", name: "Scale of picture", key: "S", points: 2, hints: ["Click one end of a length that you know", "Click its other end"] },
  { id: "outline", name: "Outline", key: "O", least: 3, hints: ["Click the corners of the inner faces of the walls; Enter or a double click ends"] },
  { id: "runs", name: "Run of stalls", key: "R", part: "runs", points: 3, hints: ["Click where the line in front of the stalls begins", "Click where it ends", "Click on the side on which the stalls are"] },
  { id: "stalls", name: "One stall", key: "T", part: "stalls", points: 3, hints: ["Click one corner of the side that cars cross", "Click its other corner", "Click at the far side"] },
  { id: "lanes", name: "Lane", key: "L", part: "lanes", least: 2, hints: ["Click along the middle of the lane; Enter or a double click ends"] },
  { id: "entrance", name: "Entrance", key: "E", part: "portals", points: 1, hints: ["Click where cars drive in, on the outline"] },
  { id: "exit", name: "Exit", key: "X", part: "portals", points: 1, hints: ["Click where cars drive out, on the outline"] },
  { id: "both", name: "Entrance and exit", key: "B", part: "portals", points: 1, hints: ["Click where cars drive in and out, on the outline"] },
  { id: "columns", name: "Column", key: "C", part: "columns", points: 1, hints: ["Click the middle of the column"] },
  { id: "solids", name: "Block", key: "K", part: "solids", least: 3, hints: ["Click the corners of stairs, a lift or a room; Enter or a double click ends"] },
];

export interface Field { key: string; name: string; choices?: string[]; isSwitch?: boolean; isWhole?: boolean; placeholder?: string; for?: (value: Value) => boolean }
const isAngled = (value: Value) => value["kind"] === "angled";
const USE: Field[] = [
  { key: "use", name: "Use", choices: ["standard", "ev", "accessible"] },
  { key: "size", name: "Size", choices: ["standard", "compact", "large", "van"] },
];
export const FIELDS: Record<PartName | "outline", Field[]> = {
  outline: [],
  runs: [
    { key: "kind", name: "Stalls", choices: ["perpendicular", "angled", "parallel"] },
    { key: "angle_deg", name: "Angle to the line, degrees", for: isAngled },
    { key: "leans", name: "Cars drive in", choices: ["towards last", "towards first"], for: isAngled },
    { key: "width_m", name: "Stall width, m", placeholder: "share of the line" },
    { key: "length_m", name: "Stall length, m", placeholder: "5" },
    { key: "count", name: "Count", isWhole: true, placeholder: "as many as fit" },
    { key: "side", name: "Side of the line", choices: ["left", "right"] },
    ...USE,
    { key: "number", name: "Number of the first", isWhole: true, placeholder: "the next free" },
  ],
  stalls: [...USE, { key: "number", name: "Number", placeholder: "the next free" }],
  lanes: [{ key: "width_m", name: "Width, m", placeholder: "as there is room" }, { key: "one_way", name: "One way, in the direction of the arrow", isSwitch: true }],
  portals: [{ key: "kind", name: "Cars drive", choices: ["entrance", "exit", "both"] }],
  columns: [{ key: "size_m", name: "Side, m", placeholder: "0.4" }],
  solids: [],
};
/** Values of a new part; those of the last one of its kind that was changed count first. */
export const BEGINNING: Record<PartName, Value> = {
  runs: { width_m: 2.5, length_m: 5 }, stalls: {}, lanes: {}, portals: {}, columns: {}, solids: {},
};

const centimetres = (value: number) => Math.round(value * 100) / 100;
export const rounded = ([x, z]: Point): Point => [centimetres(x), centimetres(z)];
const POINTS: Record<PartName, string[]> = { stalls: ["corners"], runs: ["first", "last"], lanes: ["points"], columns: ["at"], portals: ["at"], solids: ["corners"] };

/** The points by which a part is given. */
export function pointsOf(part: PartName | "outline", value: Value | Point[]): Point[] {
  if (part === "outline") return value as Point[];
  const given = value as Value;
  const keys = part === "stalls" && !given["corners"] ? ["centre"] : POINTS[part];
  return keys.flatMap((key) => (Array.isArray((given[key] as unknown[])[0]) ? (given[key] as Point[]) : [given[key] as Point]));
}

/** The keys of a part with other points. */
export function keysOf(part: PartName, value: Value, points: Point[]): Value {
  const places = points.map(rounded);
  if (part === "runs") return { first: places[0], last: places[1] };
  if (part === "stalls" && !value["corners"]) return { centre: places[0] };
  const [key] = POINTS[part] as [string];
  return { [key]: key === "at" ? places[0] : places };
}

/** A new part from the points of its tool. */
export function traced(tool: Tool, points: Point[]): Value {
  const [a, b, c] = points as [Point, Point, Point];
  if (tool.id === "runs") return { ...keysOf("runs", {}, [a, b]), side: across(a, b, c) > 0 ? "left" : "right" };
  if (tool.id === "stalls") {
    const [length, deep] = [Math.hypot(b[0] - a[0], b[1] - a[1]) || 1, across(a, b, c)];
    const into: Point = [((b[1] - a[1]) / length) * deep, (-(b[0] - a[0]) / length) * deep];
    return { corners: [a, b, [b[0] + into[0], b[1] + into[1]], [a[0] + into[0], a[1] + into[1]]].map((point) => rounded(point as Point)), mouth: 0 };
  }
  return { ...keysOf(tool.part!, { corners: true }, points), ...(tool.part === "portals" ? { kind: tool.id } : {}) };
}

/** How far a point lies to the left of a line, for somebody who looks along it. */
function across(a: Point, b: Point, point: Point): number {
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
  return ((point[0] - a[0]) * (b[1] - a[1]) - (point[1] - a[1]) * (b[0] - a[0])) / length;
}

export function lengthOf(points: Point[]): number {
  return points.slice(1).reduce((sum, point, k) => sum + Math.hypot(point[0] - points[k]![0], point[1] - points[k]![1]), 0);
}

const NAMES: Record<PartName | "outline", string> = { outline: "Outline", stalls: "Stall", runs: "Run", lanes: "Lane", columns: "Column", portals: "Portal", solids: "Block" };

export function nameOf({ part, at }: Chosen, value: Value | Point[], stalls: Traced["stalls"]): string {
  const name = part === "outline" ? NAMES[part] : `${NAMES[part]} ${at + 1}`;
  const given = value as Value;
  if (part === "outline") return `${name}, ${(value as Point[]).length} corners`;
  if (part === "runs") {
    const own = `${(given["id"] as string | undefined) ?? `runs.${at}`}.`;
    return `${name}: ${stalls.filter((stall) => stall.name.startsWith(own)).length} stalls`;
  }
  if (part === "lanes") return `${name}: ${lengthOf(given["points"] as Point[]).toFixed(1)} m${given["one_way"] ? ", one way" : ""}`;
  if (part === "portals") return `${name}: ${(given["kind"] as string | undefined) ?? "both"}`;
  return name;
}
