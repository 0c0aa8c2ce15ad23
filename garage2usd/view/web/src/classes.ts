/** What the viewer knows of semantic classes: colours, layers, and what hangs overhead. */

/** Colours of the classes of garage2usd: the building in greys and browns, traffic in strong hues. */
const COLOURS: Record<string, string> = {
  floor: "#6f7884",
  parking_stall: "#3d8bd9",
  ceiling: "#b9bec7",
  wall: "#a08c76",
  vehicle_door: "#c46a2b",
  obstacle: "#7a6a5e",
  column: "#e0b23c",
  light: "#fff3b8",
  beam: "#8d93a0",
  duct: "#7fb7c9",
  cable_tray: "#5f8f7a",
  speed_bump: "#f0d038",
  wheel_stop: "#4a4f8f",
  traffic_sign: "#e0483e",
  traffic_cone: "#ff7a1a",
  car: "#d63384",
  ramp: "#94a35a",
  sky: "#a8d8ff",
  barrier: "#ff9f9f",
  stall_number: "#bfe3ff",
  zone_plate: "#8f5fd0",
  charger: "#2fbf71",
  sprinkler: "#b3202c",
  exit_sign: "#00c9a7",
  lane_sign: "#2f6fd6",
  fire_shutter: "#a86b5a",
  mirror: "#e6e9ee",
  floor_stain: "#4b3f38",
  drain: "#2f6f86",
  stall_line: "#ffffff",
  lane_line: "#ffe45c",
  lane_arrow: "#7dffb2",
  crossing: "#ffb3f0",
  hatching: "#ff9d5c",
  stall_symbol: "#86e0ff",
  number_plate: "#f7f3c4",
  waste_bin: "#3f8f4f",
  cardboard_box: "#c69a5b",
  pallet: "#d8b483",
  bicycle: "#00b4ff",
  motorbike: "#0a6fd6",
  shopping_trolley: "#9aa7ff",
  pram: "#ff9ad5",
  bag: "#7c4dff",
  person: "#ff2e2e",
  van: "#ffd23f",
  truck: "#a86c00",
  hydrant_cabinet: "#d81b1b",
  fire_extinguisher: "#ff5e5e",
};

/** Colour of a class, as CSS has it; one that is not known gets a hue of its own by its name. */
export function colourOf(label: string): string {
  if (label in COLOURS) return COLOURS[label];
  let hash = 2166136261;
  for (const letter of label) hash = Math.imul(hash ^ letter.charCodeAt(0), 16777619) >>> 0;
  return hslToHex(hash % 360, 0.5, 0.45 + ((hash >>> 9) % 100) / 500);
}

function hslToHex(hue: number, saturation: number, lightness: number): string {
  const channel = (n: number) => {
    const k = (n + hue / 30) % 12;
    const value = lightness - saturation * Math.min(lightness, 1 - lightness) * Math.max(-1, Math.min(k - 3, 9 - k, 1));
    return Math.round(255 * value)
      .toString(16)
      .padStart(2, "0");
  };
  return `#${channel(0)}${channel(8)}${channel(4)}`;
}

/** What is cut away where one looks at the garage from above. */
export const OVERHEAD = new Set([
  "ceiling",
  "beam",
  "duct",
  "cable_tray",
  "sprinkler",
  "exit_sign",
  "lane_sign",
  "fire_shutter",
  "light",
]);

/** People and things that stand about. */
const STANDING = ["person", "bicycle", "motorbike", "shopping_trolley", "pram", "waste_bin", "cardboard_box", "pallet", "bag"];

/** Parked vehicles. */
export const CARS = ["car", "van", "truck"];

/** Objects that shade the floor around them. */
export const SHADING = new Set([...CARS, "column", "wall", "obstacle", "charger", "traffic_cone", "barrier", "vehicle_door", ...STANDING]);

export const USE_COLOURS: Record<string, string> = {
  standard: "#4aa3ff",
  ev: "#37d67a",
  accessible: "#7a7bff",
  access_aisle: "#b9a4ff",
  turning: "#ffc53d",
};

export const NODE_COLOURS: Record<string, string> = {
  entrance: "#34d399",
  exit: "#f87171",
  crossroads: "#fbbf24",
  t_junction: "#fb923c",
  straight: "#e2e8f0",
};

/** "stall_number" as one says it. */
export function spoken(label: string): string {
  return label.replaceAll("_", " ");
}
