"""Simulation of a camera's picture: from linear light through lens and sensor errors to pixel values."""

import io
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from garage2usd.common.randomness import Step, named_generator
from garage2usd.sensors.rays.around_view import AroundView
from garage2usd.sensors.rays.lenses import Lens
from garage2usd.sensors.rig.sensors import CameraEffects

Floats = NDArray[np.float64]
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
_KNEE = 0.5
"""Share of white above which a sensor with headroom compresses light."""
_STRAIGHT = 0.0031308
"""Upper end of the linear segment of the sRGB curve."""
_BISECTIONS = 48
_VEIL = 0.25
"""Share of the light blocked by dirt on the lens that is scattered over its area."""


@dataclass(frozen=True, eq=False)
class Developed:
    """A picture as developed by the camera simulation.

    Attributes
    ----------
    pixels
        uint8, shape (rows, columns, 3).
    facts
        Entry of the table of frames. For each camera of the picture, by name: exposure factor and stops, gain of the
        sensor, electrons per digital number, and factors of red, green and blue.
    """

    pixels: NDArray[np.uint8]
    facts: Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class _Part:
    """The part of a picture that one camera contributes.

    Attributes
    ----------
    name
        Name of the camera.
    shown
        Mask of the camera's pixels; bool, shape (rows, columns).
    outwards
        Angle from the optical axis at each pixel, as a share of half the field of view; shape (n,).
    places
        Position of each pixel in the camera's own picture, relative to the optical axis and in widths of the picture;
        shape (n, 2).
    """

    name: str
    shown: NDArray[np.bool_]
    outwards: Floats
    places: Floats


def develop(
    light: NDArray[np.float32] | Floats, lens: Lens, effects: CameraEffects, *, camera: str, frame: str, seed: int
) -> Developed:
    """Develop linear light into a camera's picture, with exposure, noise, lens errors and compression.

    Parameters
    ----------
    light
        Linear light in Rec. 709 red, green and blue at the pose of mid-exposure; shape (rows, columns, 3).
    lens
        Lens of the camera, which determines the exposed pixels.
    effects
        Imperfections of the camera.
    camera, frame
        Names that seed the random draws: exposure, colour and dirt for each camera, noise for each frame.
    seed
        0 or more.
    """
    parts = _parts(lens, camera)
    own = {part.name: named_generator(seed, Step.CAMERA_EFFECTS, part.name) for part in parts}
    exposed = np.zeros(light.shape)
    through = _with_chromatic_error(np.asarray(light, dtype=np.float64), lens, effects)
    facts: dict[str, Any] = {}
    electrons = np.zeros(light.shape[:2])
    balance = np.ones(light.shape)
    for part in parts:
        random = own[part.name]
        spread_ev = effects.exposure_spread_ev * random.standard_normal()
        red, blue = 1 + effects.white_balance_spread * np.clip(random.standard_normal(2), -1.9, 1.9)
        passed = 1 - effects.vignetting * np.minimum(part.outwards, 1) ** 2
        seen = through[part.shown] * passed[:, None]
        if effects.dirt and len(seen):
            clean = _clean(part.places, effects.dirt, random)[:, None]
            seen = seen * clean + (1 - clean) * _VEIL * seen.mean(axis=0)
        scale = exposure_scale(seen, effects) * 2.0 ** (effects.exposure_ev + spread_ev)
        gain = max(1.0, scale)
        exposed[part.shown] = seen * scale
        electrons[part.shown] = effects.full_well_electrons / gain
        balance[part.shown] = red, 1.0, blue
        facts[part.name] = {
            "exposure": round(float(scale), 6),
            "exposure_ev": round(float(np.log2(scale)), 6),
            "gain": round(gain, 6),
            "white_balance": [round(float(red), 6), 1.0, round(float(blue), 6)],
        }
        if effects.full_well_electrons:
            numbers = 2**effects.bits - 1
            facts[part.name]["electrons_per_number"] = round(effects.full_well_electrons / gain / numbers, 6)
    exposed = _with_glare(exposed, lens, effects)
    if effects.full_well_electrons:
        noise = named_generator(seed, Step.CAMERA_EFFECTS, f"{camera}/{frame}")
        exposed = sensed(exposed, effects, electrons[..., None], noise)
    picture = _toned(exposed * balance, effects)
    seeing = np.logical_or.reduce([part.shown for part in parts])
    pixels = np.where(seeing[..., None], np.rint(picture * 255), 0).astype(np.uint8)
    if effects.jpeg_quality is not None:
        pixels = _compressed(pixels, effects.jpeg_quality)
    return Developed(pixels, {"cameras": facts})


def exposure_scale(light: Floats, effects: CameraEffects) -> float:
    """Compute the exposure factor that maps the mean of light, shape (n, 3), to grey; 1 if exposure is fixed."""
    most = float(2.0**effects.most_gain_ev)
    if effects.exposure == "fixed":
        return 1.0
    luminance = light @ _LUMINANCE
    low, high = 2.0**-24, most
    if not luminance.size or np.minimum(luminance * high, 1).mean() <= effects.grey:
        return most
    for _ in range(_BISECTIONS):
        middle = (low * high) ** 0.5
        if np.minimum(luminance * middle, 1).mean() < effects.grey:
            low = middle
        else:
            high = middle
    return float((low * high) ** 0.5)


def sensed(
    exposed: Floats, effects: CameraEffects, white_electrons: float | Floats, random: np.random.Generator
) -> Floats:
    """Simulate an image sensor's values of light: Poisson shot noise, read noise and quantization.

    Parameters
    ----------
    exposed
        Light whose white is 1; any shape.
    effects
        Settings of the sensor.
    white_electrons
        Electrons of white, one number or one for each value; 0 for no noise.
    random
        Generator of the noise.

    Returns
    -------
    ndarray
        Multiples of 1 / (2**bits - 1), from 0 to `CameraEffects.headroom`.
    """
    white = np.broadcast_to(np.asarray(white_electrons, dtype=np.float64), exposed.shape)
    caught = random.poisson(np.clip(exposed, 0, 4 * effects.headroom) * white).astype(np.float64)
    caught += effects.read_noise_electrons * random.standard_normal(exposed.shape)
    numbers = 2**effects.bits - 1
    counted = np.rint(np.divide(caught, white, out=np.zeros(exposed.shape), where=white > 0) * numbers) / numbers
    limited: Floats = np.clip(counted, 0, effects.headroom)
    return limited


def _parts(lens: Lens, camera: str) -> list[_Part]:
    middles = lens.middles()
    shape = lens.size_px[::-1]
    rays = lens.rays(middles)
    seen = np.isfinite(rays).all(axis=1)
    if not isinstance(lens, AroundView):
        return [_part(camera, lens, seen.reshape(shape), rays[seen])]
    served = lens.sectors(lens.ground(middles))
    parts = []
    for sector, eye in enumerate(lens.eyes):
        own = seen & (served == sector)
        parts.append(_part(eye.name, eye.lens, own.reshape(shape), rays[own] @ eye.to_view[:3, :3]))
    return parts


def _part(name: str, lens: Lens, shown: NDArray[np.bool_], rays: Floats) -> _Part:
    width, height = lens.size_px
    corners = lens.rays(np.array([[0, 0], [width, 0], [0, height], [width, height]]))
    edge = getattr(lens, "max_angle_rad", None) or np.nanmax(np.arccos(np.clip(corners[:, 2], -1, 1)))
    angle = np.arccos(np.clip(rays[:, 2], -1, 1))
    places = (lens.project(rays) - lens.centre_px) / width
    return _Part(name, shown, angle / edge, places)


def _clean(places: Floats, smudges: int, random: np.random.Generator) -> Floats:
    """Compute the share of light that dirt on the lens transmits at points, shape (n, 2), in widths of the picture."""
    clean = np.ones(len(places))
    for _ in range(smudges):
        middle = random.uniform(-0.5, 0.5, 2) * (1.0, 0.75)
        radius, stretch, turn = random.uniform(0.01, 0.09), random.uniform(0.5, 1.0), random.uniform(0, np.pi)
        dense = random.uniform(0.15, 0.85)
        across, down = (places - middle).T
        along = across * np.cos(turn) + down * np.sin(turn)
        aside = (down * np.cos(turn) - across * np.sin(turn)) / stretch
        clean *= 1 - dense * np.exp(-(((along**2 + aside**2) / radius**2) ** 2))
    return clean


def _with_chromatic_error(light: Floats, lens: Lens, effects: CameraEffects) -> Floats:
    """Apply lateral chromatic aberration: red is magnified and blue reduced about the optical axis."""
    if not effects.chromatic_error:
        return light
    from scipy.ndimage import map_coordinates  # noqa: PLC0415 - slow to import, and not always needed

    rows, columns = np.indices(light.shape[:2]) + 0.5
    across, down = lens.centre_px
    changed = light.copy()
    for channel, larger in ((0, 1 + effects.chromatic_error), (2, 1 - effects.chromatic_error)):
        places = [(rows - down) / larger + down - 0.5, (columns - across) / larger + across - 0.5]
        changed[..., channel] = map_coordinates(light[..., channel], places, order=1, mode="nearest")
    return changed


def _with_glare(exposed: Floats, lens: Lens, effects: CameraEffects) -> Floats:
    """Apply bloom and flare: light beyond white spreads around its source and is mirrored about the optical axis."""
    beyond = np.maximum(exposed - 1, 0)
    if not (effects.bloom or effects.flare) or not beyond.any():
        return exposed
    from scipy.ndimage import gaussian_filter, map_coordinates  # noqa: PLC0415

    width_px = effects.bloom_width * lens.size_px[0]
    glaring = exposed - beyond * effects.bloom
    for share, wider in ((0.7, 1.0), (0.3, 4.0)):  # a narrow core and a wide halo, as scattered by glass and dust
        glaring += (
            effects.bloom * share * gaussian_filter(beyond, (width_px * wider, width_px * wider, 0), mode="constant")
        )
    if effects.flare:
        rows, columns = np.indices(exposed.shape[:2]) + 0.5
        across, down = lens.centre_px
        for channel in range(3):
            size = -0.6 - 0.05 * channel  # a ghost is smaller, and its colours part
            places = [(rows - down) / size + down - 0.5, (columns - across) / size + across - 0.5]
            ghost = map_coordinates(beyond[..., channel], places, order=1, mode="constant")
            glaring[..., channel] += effects.flare * gaussian_filter(ghost, width_px / 2, mode="constant")
    return glaring


def _toned(linear: Floats, effects: CameraEffects) -> Floats:
    """Apply the camera's tone curve to linear light whose white is 1; values from 0 to 1."""
    value = np.clip(linear, 0, effects.headroom)
    if effects.headroom > 1:
        ratio = (effects.headroom - _KNEE) / (1 - _KNEE)
        bend = 2 * (ratio - 1)
        for _ in range(_BISECTIONS):  # solve bend = ratio * log(1 + bend), so that the curve is smooth at the knee
            bend = ratio * np.log1p(bend)
        share = np.clip((value - _KNEE) / (effects.headroom - _KNEE), 0, 1)
        value = np.where(value > _KNEE, _KNEE + (1 - _KNEE) * np.log1p(bend * share) / np.log1p(bend), value)
    if effects.tone == "linear":
        return value
    return np.where(value <= _STRAIGHT, 12.92 * value, 1.055 * np.maximum(value, 1e-9) ** (1 / 2.4) - 0.055)


def _compressed(pixels: NDArray[np.uint8], quality: int) -> NDArray[np.uint8]:
    """Compress a picture as JPEG and decode it again."""
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "JPEG", quality=quality)
    with Image.open(file) as image:
        return np.asarray(image)
