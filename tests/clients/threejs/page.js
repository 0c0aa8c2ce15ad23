// Loads /stage.usdz with three.js and posts to /result what stands where, every texture, every complaint and,
// with ?pictures, what the stage's own cameras see.

import { photographer, pictures, post } from "./client.js";

// The loader makes a new blob of a texture for every material of every reference. Blobs of one size are one file here
// (the test checks that sizes tell the files apart), so that an image is decoded once and known by its file's size.
const urlOfSize = new Map();
const sizeOfUrl = new Map();
const createObjectURL = URL.createObjectURL;
URL.createObjectURL = (blob) => {
  if (!urlOfSize.has(blob.size)) {
    urlOfSize.set(blob.size, createObjectURL(blob));
    sizeOfUrl.set(urlOfSize.get(blob.size), blob.size);
  }
  return urlOfSize.get(blob.size);
};
URL.revokeObjectURL = () => {};

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
    objects.push({ path, place, mesh: item.isMesh === true });
    if (item.isLight) {
      const down = new THREE.Vector3(0, 0, -1).transformDirection(item.matrixWorld).toArray();
      lights.push({ type: item.type, path, place, down, width: item.width, height: item.height });
    }
    for (const texture of texturesOf(item)) {
      const bytes = sizeOfUrl.get(texture.image?.src) ?? -1;
      textures[bytes] ??= { uses: 0, width: texture.image?.naturalWidth ?? 0, height: texture.image?.naturalHeight ?? 0 };
      textures[bytes].uses += 1;
    }
  });
  return { objects, lights, textures };
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
