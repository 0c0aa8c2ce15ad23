"""Rigs of cars with around views, whose pictures are strips of the ground to both sides, as series cars have them."""

import numpy as np
from strips import SIDES, SIZE_PX

from garage2usd.config.vehicles import DRIVEN_BODIES
from garage2usd.sensors.rig.rig import Rig, rig_from_mapping

__all__ = ["drawn_rig"]

_CAR_PX = 100.0, 160.0
"""How long cars are in photographs of such systems: of one car at one scale in each garage."""
_CAR_SHOWN_PX = 4.0, 14.0
"""How much of the car's width is at the picture's edge."""
_CAR_BELOW_PX = -10.0, 28.0
"""How far the middle of the car is below the middle of the picture."""
_FISHEYE = {
    "kind": "kannala_brandt",
    "recorded": False,
    "size_px": [1280, 960],
    "focal_px": [330.0, 330.0],
    "coefficients": [0.05, -0.01, 0.002, -0.0004],
    "field_of_view_deg": 190.0,
}


def drawn_rig(random: np.random.Generator, *, effects: bool) -> Rig:
    """A car, its four fisheyes and its strips, called `strips.SIDES`, with places and scale at random.

    With effects its cameras expose by themselves, too dark or too bright by some stops, and have noise, casts, dark
    corners and compressed pictures, each garage's others.
    """
    body = DRIVEN_BODIES[int(random.integers(len(DRIVEN_BODIES)))]
    metres_per_px = body.length_m / random.uniform(*_CAR_PX)
    out_m = body.width_m / 2 + (SIZE_PX[0] / 2 - random.uniform(*_CAR_SHOWN_PX)) * metres_per_px
    ahead_m = body.ahead_m - body.length_m / 2 + random.uniform(*_CAR_BELOW_PX) * metres_per_px
    tail_m = body.ahead_m - body.length_m
    mirror_m, mirror_up_m = body.ahead_m - random.uniform(1.5, 1.9), random.uniform(0.95, 1.15)
    fisheyes = [
        ("front", [body.ahead_m, 0.0, random.uniform(0.5, 0.75)], 0.0, 20.0),
        ("rear", [tail_m, 0.0, random.uniform(0.75, 1.0)], 180.0, 30.0),
        ("left", [mirror_m, body.overall_width_m / 2, mirror_up_m], 90.0, 40.0),
        ("right", [mirror_m, -body.overall_width_m / 2, mirror_up_m], -90.0, 40.0),
    ]
    cameras = [
        {**_FISHEYE, "name": f"{name}_fisheye", "position_m": place, "yaw_deg": yaw, "pitch_deg": pitch}
        for name, place, yaw, pitch in fisheyes
    ]
    taken = {"effects": _effects(random)} if effects else {}
    views = [
        {
            "kind": "around_view",
            "name": side,
            "position_m": [ahead_m, sign * out_m, 0.0],
            "size_px": list(SIZE_PX),
            "metres_per_px": metres_per_px,
            "cameras": {each: f"{each}_fisheye" for each in ("front", "rear", "left", "right")},
            **taken,
        }
        for side, sign in zip(SIDES, (1.0, -1.0), strict=True)
    ]
    return rig_from_mapping({"name": "strips", "car": body.name, "sensors": [*views, *cameras]})


def _effects(random: np.random.Generator) -> dict[str, object]:
    """What the cameras of a car do to light."""
    return {
        "exposure_ev": float(random.normal(0.2, 0.6)),
        "exposure_spread_ev": 0.25,
        "white_balance_spread": 0.05,
        "full_well_electrons": 3000.0,
        "read_noise_electrons": 8.0,
        "vignetting": float(random.uniform(0.0, 0.5)),
        "headroom": float(random.uniform(1.0, 4.0)),
        "bloom": float(random.uniform(0.0, 0.5)),
        "jpeg_quality": int(random.integers(60, 96)),
    }
