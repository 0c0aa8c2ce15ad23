import numpy as np
import pytest

from garage2usd.config import GarageConfig
from garage2usd.layout.ceiling.lighting import MAINTENANCE, direct_lux
from garage2usd.layout.placement import Placement
from garage2usd.objects.lamp import LampSpec
from garage2usd.pipeline import generate

SPEC = LampSpec(1.5, 0.12, luminance_nit=1000.0)


def tube(x, z, yaw=0.0, height=3.2):
    return Placement("Tube", SPEC, (x, height, z), yaw, (0, 0))


def integrated(point, place):
    """The same by summing over 3000 pieces of the rectangle, each with its cosines."""
    x, y, z = place.position_m
    along = (np.arange(150) + 0.5) / 150 * SPEC.length_m - SPEC.length_m / 2
    across = (np.arange(20) + 0.5) / 20 * SPEC.width_m - SPEC.width_m / 2
    u, v = np.meshgrid(along, across)
    px = x + u * np.cos(place.yaw_rad) + v * np.sin(place.yaw_rad)
    pz = z - u * np.sin(place.yaw_rad) + v * np.cos(place.yaw_rad)
    height = y - 0.115
    distance = np.sqrt((px - point[0]) ** 2 + (pz - point[1]) ** 2 + height**2)
    piece = SPEC.length_m * SPEC.width_m / u.size
    return MAINTENANCE * (piece * (height / distance) ** 2 / distance**2).sum()


@pytest.mark.parametrize("yaw", [0.0, np.pi / 2, 0.4])
def test_direct_light_against_a_fine_integral(yaw):
    rng = np.random.default_rng(0)
    points = rng.uniform(-8, 8, (40, 2))
    lights = [tube(0, 0, yaw), tube(3, -2, yaw + 1)]
    expected = [sum(integrated(point, light) for light in lights) for point in points]
    assert direct_lux(points, lights) == pytest.approx(np.array(expected), rel=0.02)


def test_the_floor_gets_what_was_asked_for():
    light = generate(GarageConfig(plan={"episodes": 200})).layout.illuminance
    assert light.lanes.mean == pytest.approx(50, abs=0.1)
    assert light.stalls.mean >= 30
    assert light.lanes.minimum < light.lanes.mean < light.lanes.maximum
    brighter = generate(
        GarageConfig(plan={"episodes": 200}, fittings={"lane_lux": 100, "stall_lux": 150})
    ).layout.illuminance
    assert brighter.stalls.mean == pytest.approx(150, abs=0.2)
    assert brighter.lanes.mean >= 100
    assert brighter.flux_lm / light.flux_lm == pytest.approx(brighter.luminance_nit / light.luminance_nit)
    assert light.flux_lm == pytest.approx(np.pi * light.luminance_nit * 1.5 * 0.12)


def test_no_tubes_no_light():
    layout = generate(GarageConfig(plan={"episodes": 100}, fittings={"tubes_per_cell": 0})).layout
    assert layout.of_kind("light") == ()
    assert (layout.illuminance.luminance_nit, layout.illuminance.lanes.maximum) == (0, 0)
