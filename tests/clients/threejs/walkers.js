// Loads /stage.glb with three.js, plays its animation, and posts to /result the points of shoes 24 times a second.

import { post } from "./client.js";

async function main() {
  const THREE = await import("three");
  const { GLTFLoader } = await import("three/addons/loaders/GLTFLoader.js");
  const { scene, animations } = await new GLTFLoader().loadAsync("/stage.glb");
  const mixer = new THREE.AnimationMixer(scene);
  mixer.clipAction(animations[0]).play();
  const shoes = [];
  scene.traverse((item) => item.isSkinnedMesh && item.name.endsWith("Shoes") && shoes.push(item));
  const points = [];
  const point = new THREE.Vector3();
  const first = Math.min(...animations[0].tracks.map(({ times }) => times[0]));
  for (let time = first; time < animations[0].duration; time += 1 / 24) {
    mixer.setTime(time);
    scene.updateMatrixWorld(true);
    for (const mesh of shoes) {
      const own = [];
      for (let k = 0; k < mesh.geometry.getAttribute("position").count; k++)
        own.push(mesh.getVertexPosition(k, point).applyMatrix4(mesh.matrixWorld).toArray());
      points.push(own);
    }
  }
  return { points };
}

await post(main);
