// Loads /stage.usdz with three.js and posts to /result what stands where, every texture, every complaint and,
// with ?pictures, what the stage's own cameras see.

import { photographer, pictures, post } from "./client.js";

// The loader makes a new blob of a texture for every material of every reference, always of the same bytes. One URL
// stands for all of them, so that an image is decoded once, and it is known by the CRC-32 of its file, as the archive
// has it (the test checks that these differ).
const bytesOfBlob = new WeakMap();
const markOfBytes = new WeakMap();
const urlOfMark = new Map();
const markOfUrl = new Map();
const createObjectURL = URL.createObjectURL;
globalThis.Blob = class extends Blob {
  constructor(parts, options) {
    super(parts, options);
    bytesOfBlob.set(this, parts[0]);
  }
};
URL.createObjectURL = (blob) => {
  const bytes = bytesOfBlob.get(blob);
  if (!markOfBytes.has(bytes)) markOfBytes.set(bytes, crc32(bytes));
  const mark = markOfBytes.get(bytes);
  if (!urlOfMark.has(mark)) {
    urlOfMark.set(mark, createObjectURL(blob));
    markOfUrl.set(urlOfMark.get(mark), mark);
  }
  return urlOfMark.get(mark);
};
URL.revokeObjectURL = () => {};

const CRC_OF_BYTE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? 0xedb88320 ^ (crc >>> 1) : crc >>> 1;
  return crc;
});

function crc32(data) {
  let crc = 0xffffffff;
  for (const byte of new Uint8Array(data)) crc = CRC_OF_BYTE[(crc ^ byte) & 255] ^ (crc >>> 8);
  return (crc ^ 0xffffffff) >>> 0;
}

async function main() {
  const THREE = await import("three");
  const { USDLoader } = await import("three/addons/loaders/USDLoader.js");
  THREE.Cache.enabled = true;
  const manager = new THREE.LoadingManager();
  const failed = [];
  manager.onError = (url) => failed.push(url);
  // onLoad of the loader fires before the textures of references arrive; the manager counts those too
  const allLoaded = new Promise((resolve) => (manager.onLoad = resolve));
  const group = await new USDLoader(manager).loadAsync("/stage.usdz");
  await allLoaded;

  const scene = new THREE.Scene();
  scene.add(group);
  scene.updateMatrixWorld(true);
  const result = { revision: THREE.REVISION, ...describe(THREE, group), failed, pictures: {} };
  if (pictures !== null) result.pictures = render(THREE, scene, group);
  return result;
}

function describe(THREE, group) {
  const objects = [];
  const lights = [];
  const textures = {};
  group.traverse((item) => {
    const path = pathOf(item);
    const place = new THREE.Vector3().setFromMatrixPosition(item.matrixWorld).toArray();
    objects.push({ path, place, mesh: item.isMesh === true, surface: item.isMesh ? surfaceOf(item.material) : undefined });
    if (item.isLight) {
      const down = new THREE.Vector3(0, 0, -1).transformDirection(item.matrixWorld).toArray();
      const rgb = item.color.toArray();
      lights.push({ type: item.type, path, place, down, width: item.width, height: item.height, rgb, intensity: item.intensity });
    }
    for (const texture of texturesOf(item)) {
      const mark = markOf(texture);
      textures[mark] ??= { uses: 0, ...pictureOf(texture.image) };
      textures[mark].uses += 1;
    }
  });
  return { objects, lights, textures };
}

// What a material shows: factors, and the marks of its maps.
function surfaceOf(material) {
  const maps = Object.fromEntries(Object.entries(material).filter(([, value]) => value?.isTexture).map(([name, map]) => [name, markOf(map)]));
  const { roughness, metalness, opacity } = material;
  return { color: material.color.toArray(), emissive: material.emissive.toArray(), roughness, metalness, opacity, maps };
}

// The CRC-32 of the file that a texture shows; -1 while it shows none.
function markOf(texture) {
  return markOfUrl.get(texture.image?.src) ?? -1;
}

// Size of an image, and red, green and blue in the middle of its upper and of its lower half.
function pictureOf(image) {
  const [width, height] = [image?.naturalWidth ?? 0, image?.naturalHeight ?? 0];
  if (!width || !height) return { width, height, halves: [] };
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  const texel = (share) => [...context.getImageData(width >> 1, Math.floor(share * height), 1, 1).data.slice(0, 3)];
  return { width, height, halves: [texel(0.25), texel(0.75)] };
}

function pathOf(item) {
  return item.parent?.parent ? `${pathOf(item.parent)}/${item.name}` : "";
}

function texturesOf(item) {
  return item.isMesh ? [item.material].flat().flatMap((material) => Object.values(material).filter((v) => v?.isTexture)) : [];
}

// A picture to compare coarsely needs the same light everywhere, not the garage's many area lights, which a software
// renderer takes minutes for.
function render(THREE, scene, group) {
  const sources = new Map();
  group.traverse((item) => {
    if (item.isLight) item.visible = false;
    for (const texture of texturesOf(item)) {
      // each texture has an image element of its own, of one file for many: the file is what goes to the renderer once
      const { src } = texture.image;
      if (!sources.has(src)) sources.set(src, texture.source);
      texture.source = sources.get(src);
    }
  });
  const photograph = photographer(THREE, scene);
  const taken = {};
  for (const name of ["Inside", "Above"]) {
    const camera = group.getObjectByName(name);
    group.traverse((item) => {
      if (/^(Ceiling|Tube|Duct)/.test(item.name)) item.visible = name !== "Above";
    });
    taken[name] = photograph(camera);
  }
  return taken;
}

await post(main);
