// What the pages share. Every complaint counts from when this is loaded, so three.js itself is imported later, in `main`.

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

// Posts to /result what `main` gives, and every complaint.
export async function post(main) {
  let result = {};
  try {
    result = await main();
  } catch (error) {
    complaints.push(String(error.stack ?? error));
  }
  await fetch("/result", { method: "POST", body: JSON.stringify({ ...result, complaints }) });
}

// What the address says of pictures; null where none are asked for.
export const pictures = new URLSearchParams(location.search).get("pictures");

// A function that gives what a camera sees, as the URL of a PNG; light comes from everywhere.
export function photographer(THREE, scene) {
  scene.background = new THREE.Color(0x203040);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x808080, 2));
  const renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
  renderer.setSize(640, 360);
  return (camera) => {
    renderer.render(scene, camera);
    return renderer.domElement.toDataURL("image/png");
  };
}
