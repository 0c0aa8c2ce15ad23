/** All textures as the layers of one, so that everything is drawn with one program and no rebinding. */

import * as THREE from "three";
import type { SceneFile, Surface } from "./scene_file";

const SIDE_PX = 512;

export interface Layers {
  texture: THREE.DataArrayTexture;
  /** Layer of each surface; -1 for none. */
  layerOf: number[];
  /** How metallic each surface is, on average. */
  metallicOf: number[];
}

/** Colour in red, green and blue; in alpha the opacity where the surface has one there, else the roughness. */
export async function layersOf(scene: SceneFile): Promise<Layers> {
  const pictures = await Promise.all(Array.from({ length: scene.header.textures }, (_, number) => pixelsOf(number)));
  const keys = new Map<string, Surface>();
  const keyOf = (surface: Surface) => [surface.colourTexture, surface.roughnessTexture, surface.roughnessChannel, surface.hasAlpha].join(" ");
  const layerOf = scene.header.surfaces.map((surface) => {
    if (surface.colourTexture < 0 && surface.roughnessTexture < 0) return -1;
    const key = keyOf(surface);
    if (!keys.has(key)) keys.set(key, surface);
    return [...keys.keys()].indexOf(key);
  });
  const metallicOf = scene.header.surfaces.map((surface) => {
    const picture = surface.metallicTexture < 0 ? null : pictures[surface.metallicTexture];
    return picture ? mean(picture, surface.metallicChannel) : surface.metallicTexture < 0 ? surface.metallic : 0;
  });
  const size = 4 * SIDE_PX * SIDE_PX;
  const data = new Uint8Array(size * Math.max(1, keys.size)).fill(255);
  [...keys.values()].forEach((surface, layer) => {
    const target = data.subarray(size * layer, size * (layer + 1));
    const colour = surface.colourTexture < 0 ? null : pictures[surface.colourTexture];
    const roughness = surface.hasAlpha || surface.roughnessTexture < 0 ? null : pictures[surface.roughnessTexture];
    if (colour) target.set(colour);
    if (!surface.hasAlpha)
      for (let k = 0; k < size; k += 4) target[k + 3] = roughness ? roughness[k + surface.roughnessChannel] : 255;
  });
  const texture = new THREE.DataArrayTexture(data, SIDE_PX, SIDE_PX, Math.max(1, keys.size));
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.format = THREE.RGBAFormat;
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.magFilter = THREE.LinearFilter;
  texture.anisotropy = 1;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return { texture, layerOf, metallicOf };
}

/** A texture's pixels at the size of all, its first row at the bottom; null where it cannot be had. */
async function pixelsOf(number: number): Promise<Uint8ClampedArray | null> {
  const answer = await fetch(`textures/${number}`);
  if (!answer.ok) return null;
  try {
    const image = await createImageBitmap(await answer.blob(), { colorSpaceConversion: "none" });
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = SIDE_PX;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    if (!context) return null;
    context.imageSmoothingQuality = "high";
    context.setTransform(1, 0, 0, -1, 0, SIDE_PX);
    context.drawImage(image, 0, 0, SIDE_PX, SIDE_PX);
    image.close();
    return context.getImageData(0, 0, SIDE_PX, SIDE_PX).data;
  } catch {
    return null;
  }
}

function mean(pixels: Uint8ClampedArray, channel: number): number {
  let sum = 0;
  for (let k = channel; k < pixels.length; k += 4) sum += pixels[k];
  return (4 * sum) / pixels.length / 255;
}
