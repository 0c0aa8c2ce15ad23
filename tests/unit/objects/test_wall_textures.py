"""Textures lie on all faces of walls and ramps as sheets laid on them: not mirrored, sheared or stretched."""

from itertools import pairwise

import numpy as np
import pytest
from support.object_specs import SPECS

from garage2usd.assets.materials import MATERIALS

WALLS = [name for name, spec in SPECS.items() if spec.kind.name in {"wall", "portal", "ramp"}]
CHEVRONS = "hazard"
"""Stripes that are mirrored on purpose, so that those of both kerbs point along the ramp."""


def sheets(part):
    """Of each face, a right-handed frame on it as seen from outside times the metres of texture a metre of it."""
    look = MATERIALS[part.material]
    repeats_m = np.array([look.repeat_m, look.repeat_up_m or look.repeat_m])
    ends = np.cumsum(part.face_counts)[:-1]
    for points, st in zip(np.split(part.face_indices, ends), np.split(part.st_indices, ends), strict=True):
        corners, texture_m = part.points[points].astype(float), part.st[st] * repeats_m
        normal = sum(np.cross(a - corners[0], b - corners[0]) for a, b in pairwise(corners))
        along = corners[np.argmax(np.linalg.norm(corners - corners[0], axis=1))] - corners[0]
        across = np.cross(normal, along)
        frame = np.stack([along / np.linalg.norm(along), across / np.linalg.norm(across)])
        flat = np.column_stack([(corners - corners[0]) @ frame.T, np.ones(len(corners))])
        found = np.linalg.lstsq(flat, texture_m, rcond=None)[0]
        yield found[:2].T, np.abs(flat @ found - texture_m).max()


@pytest.mark.parametrize("name", WALLS)
def test_textures_of_walls_and_ramps_are_neither_mirrored_nor_sheared(name):
    spec = SPECS[name]
    for part in spec.asset().parts:
        # the band is as high as a repeat of its texture
        high = spec.dado_m / 1.1 if part.material == "wall_band" else 1.0
        for laid, bent_m in sheets(part) if len(part.st) else ():
            assert bent_m < 0.02, part.name
            assert part.material == CHEVRONS or np.linalg.det(laid) > 0, part.name
            densities = np.linalg.svd(laid * [[1.0], [high]], compute_uv=False)
            assert 0.8 < densities[1] <= densities[0] < 1.25, part.name
