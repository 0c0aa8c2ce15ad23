// Loads /stage.glb with three.js and posts to /result what stands where, what it says of itself, every complaint and,
// with ?pictures, a view from inside.

import { photographer, pictures, post } from "./client.js";

async function main() {
  const THREE = await import("three");
  const { GLTFLoader } = await import("three/addons/loaders/GLTFLoader.js");
  const { scene } = await new GLTFLoader().loadAsync("/stage.glb");
  scene.updateMatrixWorld(true);
  const objects = [];
  const geometries = new Set();
  const textures = new Set();
  scene.traverse((item) => {
    if (item.isMesh) {
      geometries.add(item.geometry);
      for (const value of Object.values(item.material)) if (value?.isTexture) textures.add(value.image);
    }
    // the loader keeps a node's name, which a name in three.js cannot be, among what the node says of itself
    const name = item.userData.name ?? item.name;
    if (!item.userData.class && !item.userData.stall) return;
    const box = new THREE.Box3().setFromObject(item, true);
    objects.push({ name, place: item.getWorldPosition(new THREE.Vector3()).toArray(), said: item.userData,
      low: box.min.toArray(), high: box.max.toArray() });
  });
  const result = { revision: THREE.REVISION, objects, geometries: geometries.size, textures: textures.size, facts: scene.userData };
  if (pictures !== null) result.pictures = { Inside: render(THREE, scene) };
  return result;
}

// From a place, looking at another, with a vertical angle of view, as the address says.
function render(THREE, model) {
  const scene = new THREE.Scene();
  scene.add(model);
  const [place, target, degrees] = JSON.parse(pictures);
  const camera = new THREE.PerspectiveCamera(degrees, 16 / 9, 0.1, 500);
  camera.position.set(...place);
  camera.lookAt(...target);
  return photographer(THREE, scene)(camera);
}

await post(main);
