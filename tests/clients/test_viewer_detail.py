"""What the viewer draws coarsely, because it is far, looks as it would in full."""

import base64
from collections import Counter

import numpy as np
import pytest
import scipy.ndimage
from support.browser import find_browser
from support.sample_files import REPOSITORY
from support.viewer_page import viewed

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path"),
]

WIDTH_PX, HEIGHT_PX = 480, 360
DIFFERENCE = 48  # of 255, in one channel
WIDEST_PX = 3  # what is narrower is an edge that moved by less than a pixel, or two of them

# The finest shape of each class that is drawn coarsely somewhere, by an object that has it.
CHOSEN = """() => {
  const { scene, instances } = viewer, finest = {};
  instances.shapes.forEach(({ levels }, shape) => {
    const object = scene.shape.indexOf(shape);
    if (object < 0 || levels.length < 2) return;
    const label = scene.labelOf(object);
    if (levels[0].triangles > (finest[label]?.[1] ?? 0)) finest[label] = [object, levels[0].triangles];
  });
  return Object.entries(finest).map(([label, [object]]) => [label, object]);
}"""

# An object with all that touches it from ever farther away: where it is drawn coarser than before, so and in full.
STEPS = """([object, side, width, height]) => {
  const { scene, instances, boxes, camera, renderer, world } = viewer, gl = renderer.getContext();
  const box = (one) => [0, 1, 2].map((k) => [boxes.world[6 * one + k], boxes.world[6 * one + 3 + k]]);
  const own = box(object), middle = own.map(([low, high]) => (low + high) / 2);
  const touches = (one) => box(one).every(([low, high], k) => low < own[k][1] + 0.01 && high > own[k][0] - 0.01);
  const alone = instances.visible.map((_, one) => (one === object ? 1 : 0));
  const together = instances.visible.map((_, one) => (touches(one) ? 1 : 0));
  const [x, z] = [scene.matrix[12 * object + 2], scene.matrix[12 * object + 10]];
  const turn = Math.atan2(x, z) + side, up = middle[1] > 1.9 ? -0.3 : 0.3;
  renderer.setPixelRatio(1);
  renderer.setSize(width, height, false);
  camera.near = 0.06;
  camera.fov = 60;
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  const pixels = (detail) => {
    instances.update(camera, detail * height, 1);
    renderer.render(world, camera);
    const data = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
    let text = "";
    for (let k = 0; k < data.length; k += 4096) text += String.fromCharCode(...data.subarray(k, k + 4096));
    return btoa(text);
  };
  const reach = Math.hypot(...own.map(([low, high]) => (high - low) / 2)), found = [];
  for (let away = reach + 0.5, last = Infinity; away < 60; away *= 1.05) {
    camera.position.set(
      middle[0] + away * Math.sin(turn), middle[1] + up * away, middle[2] + away * Math.cos(turn));
    camera.lookAt(...middle);
    camera.updateMatrixWorld();
    instances.visible.set(alone);
    instances.update(camera, height, 1);
    const { triangles } = instances.drawn;
    instances.visible.set(together);
    if (triangles < last && last < Infinity) found.push([away, pixels(1), pixels(1e6)]);
    last = triangles;
  }
  return found;
}"""


@pytest.fixture(scope="module")
def page(builds):
    with viewed(builds(REPOSITORY / "samples" / "irregular.toml", "usdz").stage, size=(640, 400)) as page:
        yield page
        assert page.complaints == []


def picture(text):
    return np.frombuffer(base64.b64decode(text), np.uint8).reshape(HEIGHT_PX, WIDTH_PX, 4)[..., :3].astype(int)


@pytest.mark.soak
def test_where_a_level_begins_it_differs_from_the_shape_by_no_spot_that_one_sees(page):
    block = np.ones((WIDEST_PX, WIDEST_PX))
    compared, spots = Counter(), []
    for label, item in page.page.evaluate(CHOSEN):
        for side in (0.6, -0.9):
            for away_m, coarse, full in page.page.evaluate(STEPS, [item, side, WIDTH_PX, HEIGHT_PX]):
                differs = np.abs(picture(coarse) - picture(full)).max(axis=2) > DIFFERENCE
                if scipy.ndimage.binary_erosion(differs, block).any():
                    spots.append((label, item, round(away_m, 1)))
                compared[label] += 1
    assert compared.keys() >= {"car", "duct", "fire_extinguisher", "hydrant_cabinet", "wheel_stop", "zone_plate"}
    assert compared.total() > 60
    # the finest car shows spots of one to five pixels at three of its levels
    assert len(spots) <= 3, spots
