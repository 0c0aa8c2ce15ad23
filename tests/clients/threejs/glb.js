// Loads /stage.glb with three.js and posts to /result what stands where, what it says of itself, every complaint and,
// with ?pictures, a view from inside.

const complaints = [];
for (const level of ["error", "warn"]) {
  const original = console[level];
  console[level] = (...words) => {
    complaints.push(words.map(String).join(" "));
    original(...words);
  };
}
addEventListener("error", (event) => complaints.push(event.message));
addEventListener("unhandledrejection", (event) => complaints.push(String(event.reason)));

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
  if (new URLSearchParams(location.search).has("pictures")) result.pictures = { Inside: render(THREE, scene) };
  return result;
}

// From a place, looking at another, with a vertical angle of view, as the address says; light from everywhere.
function render(THREE, model) {
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0x203040);
  scene.add(model, new THREE.HemisphereLight(0xffffff, 0x808080, 2));
  const [place, target, degrees] = JSON.parse(new URLSearchParams(location.search).get("pictures"));
  const camera = new THREE.PerspectiveCamera(degrees, 16 / 9, 0.1, 500);
  camera.position.set(...place);
  camera.lookAt(...target);
  const renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
  renderer.setSize(640, 360);
  renderer.render(scene, camera);
  return renderer.domElement.toDataURL("image/png");
}

let result;
try {
  result = await main();
} catch (error) {
  complaints.push(String(error.stack ?? error));
  result = {};
}
await fetch("/result", { method: "POST", body: JSON.stringify({ ...result, complaints }) });
