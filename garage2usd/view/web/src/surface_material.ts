/** The one program that draws every surface. */

import * as THREE from "three";
import { colourOf } from "./classes";
import type { LightPlan } from "./light_plan";
import type { SceneFile } from "./scene_file";
import type { Layers } from "./textures";

const ENTRIES_A_ROW = 64;
const TEXELS = 3;

const VERTEX = /* glsl */ `
attribute float slot;
attribute vec4 row0;
attribute vec4 row1;
attribute vec4 row2;
attribute vec4 info;
flat varying vec3 vInfo;
varying vec3 vPlace;
varying vec3 vNormalW;
varying vec2 vCoordinate;

#ifdef SKINNED
attribute vec4 joints;
attribute vec4 weights;
uniform highp sampler2D bones; // three rows for each joint, a line for each person

vec4 boneRow(int row) {
  vec4 blended = vec4(0.0);
  for (int k = 0; k < 4; k++) blended += weights[k] * texelFetch(bones, ivec2(3 * int(joints[k]) + row, int(info.w + 0.5)), 0);
  return blended;
}
#endif

void main() {
  vec4 p = vec4(position, 1.0);
  vec3 facing = normal;
#ifdef SKINNED
  vec4 bone0 = boneRow(0);
  vec4 bone1 = boneRow(1);
  vec4 bone2 = boneRow(2);
  p = vec4(dot(bone0, p), dot(bone1, p), dot(bone2, p), 1.0);
  facing = vec3(dot(bone0.xyz, normal), dot(bone1.xyz, normal), dot(bone2.xyz, normal));
#endif
  vPlace = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
  // cofactors turn normals whatever the scale
  vNormalW = vec3(
    dot(cross(row1.xyz, row2.xyz), facing), dot(cross(row2.xyz, row0.xyz), facing), dot(cross(row0.xyz, row1.xyz), facing));
  vInfo = vec3(info.x + slot, info.yz);
  vCoordinate = uv;
  gl_Position = projectionMatrix * viewMatrix * vec4(vPlace, 1.0);
}`;

/** How far below its floor something still stands in the light of a level. */
const BELOW_M = 0.15;

const FRAGMENT = /* glsl */ `
uniform mediump sampler2DArray layers;
uniform highp sampler2D palette;
uniform highp sampler2D labels;
uniform mediump sampler2DArray plan;
uniform vec4 frame;
uniform vec3 levels[LEVELS]; // of each level: lights, floor, luminance of white where the plan is 1
uniform float byLabel;
uniform float selected;
uniform float gloss;
flat varying vec3 vInfo; // entry of the palette, label, object
varying vec3 vPlace;
varying vec3 vNormalW;
varying vec2 vCoordinate;

float lightOf(float stored) { return 4.0 * stored * stored; }

/** Direct and bounced light of a level. */
vec2 lightAt(vec2 at, float level, float direct, float unit) {
  if (unit <= 0.0) return vec2(0.9);
  float bounce = max(lightOf(textureLod(plan, vec3(at, level), 5.0).r), 0.2);
  return unit * vec2(max(lightOf(direct), 0.2 * bounce), bounce);
}

void main() {
  vec3 normal = normalize(vNormalW) * (gl_FrontFacing ? 1.0 : -1.0);
  vec3 view = normalize(cameraPosition - vPlace);
  // rounded, as some renderers interpolate even what is flat where they clip
  int entry = int(vInfo.x + 0.5);
  ivec2 first = ivec2(${TEXELS} * (entry % ${ENTRIES_A_ROW}), entry / ${ENTRIES_A_ROW});
  vec4 tint = texelFetch(palette, first, 0);
  vec4 finish = texelFetch(palette, first + ivec2(1, 0), 0);
  vec3 colour = tint.rgb;
  float roughness = finish.x;
  float opacity = finish.z;
  if (tint.a > -0.5) {
    int code = int(tint.a + 0.5);
    vec4 texel = texture(layers, vec3(vCoordinate, float(code >> 1)));
    colour *= texel.rgb;
    if ((code & 1) == 1) opacity *= texel.a; else roughness *= texel.a;
  }
  vec4 glow = texelFetch(palette, first + ivec2(2, 0), 0);
  if (glow.a > 0.0) {
    if (opacity < glow.a) discard;
    opacity = 1.0;
  }
  vec3 shown;
  if (byLabel > 0.5) {
    shown = texelFetch(labels, ivec2(int(vInfo.y + 0.5), 0), 0).rgb * (0.72 + 0.2 * normal.y + 0.08 * normal.x);
  } else {
    float level = 0.0;
    vec3 heights = levels[0];
    for (int k = 1; k < LEVELS; k++)
      if (vPlace.y < levels[k - 1].y - ${BELOW_M}) {
        level = float(k);
        heights = levels[k];
      }
    vec2 at = (vPlace.xz + 0.6 * normal.xz - frame.xy) * frame.zw;
    vec4 here = texture(plan, vec3(at, level));
    vec2 light = lightAt(at, level, here.r, heights.z);
    float above = vPlace.y - heights.y;
    // in the well of a ramp the light of the level above passes into that of the level below
    if (level > 0.5) {
      vec3 upper = levels[int(level) - 1];
      float share = here.a * (1.0 - smoothstep(0.0, 1.0, (upper.y - vPlace.y) / (upper.y - heights.y)));
      light = mix(light, lightAt(at, level - 1.0, textureLod(plan, vec3(at, level - 1.0), 0.0).r, upper.z), share);
    }
    if (level < float(LEVELS) - 1.5) above = mix(above, 2.0, textureLod(plan, vec3(at, level + 1.0), 0.0).a);
    float direct = light.x;
    float bounce = light.y;
    float shade = mix(here.b, 1.0, smoothstep(0.0, 0.7, above));
    float low = mix(0.62, 1.0, smoothstep(-0.2, 1.4, above));
    // shares of a path tracer's light on floors, walls and cars of the same place
    float side = (0.26 * direct + 0.27 * bounce) * low * mix(shade, 1.0, 0.4);
    float top = 0.82 * direct * shade + 0.06 * bounce;
    float under = 0.24 * bounce + 0.01;
    float lit = normal.y > 0.0 ? mix(side, top, normal.y) : mix(side, under, -normal.y);
    lit *= 1.0 + 0.07 * normal.x;

    // what it mirrors: the tubes and the ceiling between them, or the floor
    vec3 away = reflect(-view, normal);
    float rise = away.y;
    float mirrored = 0.24 * bounce;
    float clear = mirrored;
    if (gloss > 0.0 && rise > 0.02 && heights.x > vPlace.y) {
      float far = min((heights.x - vPlace.y) / rise, 80.0);
      vec2 there = (vPlace.xz + away.xz * far - frame.xy) * frame.zw;
      float spread = log2(1.0 + roughness * roughness * far * 24.0);
      float ceiling = 0.24 * bounce;
      mirrored = ceiling + 9.0 * textureLod(plan, vec3(there, level), spread).g;
      clear = finish.w > 0.0 ? ceiling + 9.0 * textureLod(plan, vec3(there, level), 0.0).g : mirrored;
    }
    float metallic = finish.y;
    float grazing = pow(1.0 - max(dot(normal, view), 0.0), 5.0);
    vec3 base = mix(vec3(0.04), colour, metallic);
    vec3 fresnel = base + (max(vec3(1.0 - roughness), base) - base) * grazing;
    float coat = finish.w * (0.04 + 0.96 * grazing) * gloss;
    shown = colour * (1.0 - metallic) * lit + fresnel * mirrored * shade * gloss + coat * clear + glow.rgb;
    shown = AgXToneMapping(shown);
  }
  if (abs(vInfo.z - selected) < 0.5) shown = mix(shown, vec3(1.0, 0.62, 0.08), 0.45);
  gl_FragColor = vec4(shown, opacity);
  #include <colorspace_fragment>
}`;

export type Uniforms = Record<"byLabel" | "selected" | "gloss", { value: number }>;

export class SurfaceMaterials {
  readonly opaque: THREE.ShaderMaterial;
  readonly opaqueTwoSided: THREE.ShaderMaterial;
  readonly blended: THREE.ShaderMaterial;
  readonly skinned: THREE.ShaderMaterial;
  /** Poses of people: three rows for each joint, a line for each person. */
  readonly bones: THREE.DataTexture;
  /** First entry of each palette. */
  readonly paletteStart: number[] = [];
  readonly uniforms: Uniforms;

  constructor(scene: SceneFile, layers: Layers, light: LightPlan) {
    const people = scene.tracks?.agents.filter(({ gait }) => gait).length ?? 0;
    const texels = 3 * Math.max(1, ...scene.shapes.map(({ skin }) => (skin ? skin.rest.length : 0)));
    const rows = Math.max(1, people);
    this.bones = new THREE.DataTexture(new Float32Array(4 * texels * rows), texels, rows, THREE.RGBAFormat, THREE.FloatType);
    const uniforms = {
      bones: { value: this.bones },
      palette: { value: this.paletteTexture(scene, layers) },
      labels: { value: labelTexture(scene) },
      layers: { value: layers.texture },
      plan: { value: light.texture },
      frame: { value: light.frame },
      levels: { value: light.levels.map(({ height, floor, unit }) => new THREE.Vector3(height, floor, unit)) },
      byLabel: { value: 0 },
      selected: { value: -1 },
      gloss: { value: 1 },
    };
    this.uniforms = uniforms;
    const defines = { LEVELS: light.levels.length };
    const common = { vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, defines };
    this.opaque = new THREE.ShaderMaterial(common);
    this.opaqueTwoSided = new THREE.ShaderMaterial({ ...common, side: THREE.DoubleSide });
    this.skinned = new THREE.ShaderMaterial({ ...common, defines: { ...defines, SKINNED: "" } });
    this.blended = new THREE.ShaderMaterial({
      ...common,
      side: THREE.DoubleSide,
      transparent: true,
      depthWrite: false,
      polygonOffset: true,
      polygonOffsetFactor: -1,
      polygonOffsetUnits: -2,
    });
  }

  private paletteTexture(scene: SceneFile, layers: Layers): THREE.DataTexture {
    const { palettes, surfaces } = scene.header;
    let entries = 0;
    for (const palette of palettes) {
      this.paletteStart.push(entries);
      entries += palette.length;
    }
    const rows = Math.max(1, Math.ceil(entries / ENTRIES_A_ROW));
    const data = new Float32Array(4 * TEXELS * ENTRIES_A_ROW * rows);
    palettes.flat().forEach((number, entry) => {
      const surface = surfaces[number];
      const layer = layers.layerOf[number];
      data.set(
        [
          ...surface.rgb,
          layer < 0 ? -1 : 2 * layer + (surface.hasAlpha ? 1 : 0),
          surface.roughness,
          layers.metallicOf[number],
          surface.opacity,
          surface.clearcoat,
          ...surface.emissive,
          surface.opacityThreshold,
        ],
        4 * TEXELS * entry,
      );
    });
    const texture = new THREE.DataTexture(data, TEXELS * ENTRIES_A_ROW, rows, THREE.RGBAFormat, THREE.FloatType);
    texture.needsUpdate = true;
    return texture;
  }
}

function labelTexture(scene: SceneFile): THREE.DataTexture {
  const data = new Float32Array(
    scene.header.labels.flatMap((label) => [...new THREE.Color(colourOf(label)).toArray(), 1]),
  );
  const texture = new THREE.DataTexture(data, scene.header.labels.length, 1, THREE.RGBAFormat, THREE.FloatType);
  texture.needsUpdate = true;
  return texture;
}
