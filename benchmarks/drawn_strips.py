"""Strips drawn of garages that are made for it: the garages of a recipe, a folder each, which are drawn once."""

import hashlib
import json
import math
import resource
import shutil
import tempfile
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
from drawn_folder import ABOUT_FILE
from strip_labels import LABELS_FILE, write_strip_labels
from strip_poses import Pose, StripPoses
from strip_rig import drawn_rig
from strips import write_strips

import garage2usd
from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.common.progress import silent
from garage2usd.config import GarageConfig
from garage2usd.datasets import Recipe
from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import read_labels
from garage2usd.render.cameras import USD_FROM_OPENCV, View
from garage2usd.render.devices import Device, find_device
from garage2usd.render.drawing import Drawing
from garage2usd.render.pictures import Picture
from garage2usd.render.tables import NEEDED, SlotLabels
from garage2usd.sensors.slots import Visibility

__all__ = ["DrawnGarage", "StripSettings", "draw_strips", "entry_corners"]

_SAME_CORNER_PX = 3.0
"""Corners of neighbouring stalls that are nearer to each other than this are one."""
_MOST_SEED = 2**31 - 1
"""Of Blender's samples."""
_RANDOM = 34
"""Beside the garage's seed, the seed of its car and of where it stands."""


@dataclass(frozen=True)
class StripSettings:
    """How strips are drawn.

    Attributes
    ----------
    pictures
        How many of each garage at most; fewer where there is no room for the car.
    device
        ``rays``, or ``cpu`` for Blender's path tracer.
    samples
        Of each pixel of the colour picture, which is denoised.
    effects
        Whether pictures are as real cameras take them, see `strip_rig`.
    """

    pictures: int = 11
    device: str = "rays"
    samples: int = 3
    effects: bool = False


@dataclass(frozen=True)
class DrawnGarage:
    """A garage whose strips are drawn.

    Attributes
    ----------
    folder
        Of strips, see `strips`.
    pictures
        How many.
    cpu_s
        Processor seconds that they took when they were drawn.
    """

    folder: Path
    pictures: int
    cpu_s: float


def draw_strips(
    recipe: Recipe, garages: int, folder: Path, *, version: str, settings: StripSettings, workers: int
) -> Iterator[DrawnGarage]:
    """Draw strips of the garages of a recipe; what stands in the folder is not drawn again.

    Parameters
    ----------
    recipe
        Where the configurations come from.
    garages
        How many.
    folder
        Gets a folder of strips for each garage. Its name is the digest of what decides it: configuration, settings and
        `version`.
    version
        By which pictures of other versions of garage2usd are told apart; whoever changes the code and wants to see it
        gives another one.
    settings
        How they are drawn.
    workers
        How many garages are drawn at a time, each in a process of its own if there are several.

    Yields
    ------
    DrawnGarage
        In the recipe's order.
    """
    folder.mkdir(parents=True, exist_ok=True)
    draw = partial(_drawn, recipe, folder=folder, version=version, settings=settings)
    if workers == 1:
        yield from map(draw, range(garages))
        return
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        yield from pool.map(draw, range(garages))


def _drawn(recipe: Recipe, number: int, *, folder: Path, version: str, settings: StripSettings) -> DrawnGarage:
    """A garage of the recipe, at the first attempt at which there is one and its car finds room."""
    for attempt in range(recipe.attempts):
        try:
            config, _ = recipe.drawn(recipe.garage_seed(number, attempt))
            key = _key(config, version, settings)
            if not (folder / key / LABELS_FILE).exists():
                _draw(config, folder, key, settings)
        except (ConfigError, GenerationError):
            continue
        about = json.loads((folder / key / ABOUT_FILE).read_text(encoding="utf-8"))
        return DrawnGarage(folder / key, about["pictures"], about["cpu_s"])
    raise GenerationError("strips", recipe.seed, f"garage {number}: none of {recipe.attempts} attempts made one")


def _key(config: GarageConfig, version: str, settings: StripSettings) -> str:
    """Digest of all that decides the strips of a garage; settings that are as they are by default do not count."""
    document = {"config": config.model_dump(mode="json", exclude_defaults=True), "version": version, **asdict(settings)}
    return hashlib.sha256(json.dumps(document, sort_keys=True).encode()).hexdigest()[:20]


def _draw(config: GarageConfig, folder: Path, key: str, settings: StripSettings) -> None:
    """Build a garage and draw its strips; the folder appears whole or not at all."""
    begun_s = _cpu_s()
    with tempfile.TemporaryDirectory(prefix=".part-", dir=folder) as name:
        work = Path(name)  # the garages' own folder of assets is ../../assets from a stage
        stage_folder = work / "stage"
        stage_folder.mkdir()
        built = garage2usd.build(config, stage_folder / "garage.usdc")
        stage, path = open_stage(built.stage), built.stage
        random = np.random.default_rng([config.seed, _RANDOM])
        poses = StripPoses(stage, path, drawn_rig(random, effects=settings.effects), random).drawn(settings.pictures)
        views = [_view(pose, number) for number, pose in enumerate(poses)]
        if not views:
            raise GenerationError("strips", config.seed, "no room for the car before its stalls")
        labels = read_labels(stage, path)
        finished, blender = work / "finished", work / "blender"
        blender.mkdir()
        kinds = tuple(kind for kind in Picture if kind is Picture.COLOUR or kind in NEEDED)
        seed = config.seed & _MOST_SEED
        drawing = Drawing(
            *(stage, labels, views, [[]] * len(views), kinds, settings.samples, seed, finished),
            device=find_device(Device(settings.device), has_rays=True),
            is_draft=True,
        )
        drawing.draw(blender, silent)
        SlotLabels(stage, labels, views, finished).write(())
        strips = work / "strips"
        corners = entry_corners(json.loads((finished / "slots.json").read_text(encoding="utf-8")))
        named, places = {}, {}
        for view in views:
            place = Path(f"{key[:8]}_{view.camera}") / f"{view.name}{Picture.COLOUR.extension}"
            (strips / place).parent.mkdir(parents=True, exist_ok=True)
            (finished / Picture.COLOUR / place.name).rename(strips / place)
            named[str(place)], places[view.name] = corners[view.name], place
        write_strips(strips, named)
        write_strip_labels(strips, places, finished, labels)
        about = {
            "seed": config.seed,
            "pictures": len(views),
            "cpu_s": round(_cpu_s() - begun_s, 1),
            "views": {
                str(name): {
                    "metres_per_px": pose.camera.metres_per_px,
                    "position_m": pose.camera.position_m,
                    "vehicle_to_world": pose.vehicle_to_world.tolist(),
                }
                for name, pose in zip(named, poses, strict=True)
            },
        }
        (strips / ABOUT_FILE).write_text(json.dumps(about) + "\n", encoding="utf-8")
        shutil.rmtree(folder / key, ignore_errors=True)  # of a drawing that was broken off
        strips.rename(folder / key)


def _view(pose: Pose, number: int) -> View:
    lens = pose.camera.lens
    name = f"{number:04}"
    matrix = pose.camera_to_world @ USD_FROM_OPENCV
    return View(name, pose.camera.name, None, lens, lens.size_px, matrix, effects=pose.camera.effects)


def entry_corners(slots: dict[str, Any]) -> dict[str, list[tuple[float, float, bool]]]:
    """The entry corners in each picture by its name, from a file of slots; those that stalls share are there once."""
    found = {}
    for frame in slots["frames"]:
        corners: list[tuple[float, float, bool]] = []
        for slot in frame["slots"]:
            for place, visibility in list(zip(slot["corners_px"], slot["visibility"], strict=True))[:2]:
                if visibility != Visibility.NOT_IN_PICTURE and all(
                    math.dist(place, other[:2]) > _SAME_CORNER_PX for other in corners
                ):
                    corners.append((*place, visibility == Visibility.OCCLUDED))
        found[frame["name"]] = corners
    return found


def _cpu_s() -> float:
    """Seconds of this process and of those that it waited for."""
    used = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(each.ru_utime + each.ru_stime for each in used)
