"""What a garage of a data set in operation costs, part by part: traffic, sensors and writing."""

import os
import resource
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any
from unittest import mock

import garage2usd.recordings
from garage2usd.datasets import drives, load_recipe, scene
from garage2usd.datasets.plans import planned
from garage2usd.datasets.shards import make_shard, shards_of
from garage2usd.recordings.sweeps import Sweeps
from garage2usd.render.drawing import Drawing

__all__ = ["living"]

RECIPE = "samples/recipes/living.toml"
GARAGES = 2
PARTS: dict[str, tuple[Any, str]] = {
    "traffic: the run, tracks, prediction tasks, figures": (scene, "operate"),
    "sensors: pictures by few rays": (Drawing, "draw"),
    "sensors: sweeps of the LiDAR": (Sweeps, "write"),
    "sensors: poses, models of agents": (scene, "record_drives"),
    "writing: tables of nuScenes with shares in sight": (garage2usd.recordings, "write_sequence"),
    "writing: packing": (drives, "_pack"),
}
REST = "plan, stage, proofs, difficulty, maps"


class _Clock:
    """Core-seconds of parts, without those of parts within them."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = defaultdict(float)
        self._within = [REST]
        self._last = _core_s()

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        """Count the time of a part."""
        self._note()
        self._within.append(name)
        try:
            yield
        finally:
            self._note()
            self._within.pop()

    def _note(self) -> None:
        now = _core_s()
        self.seconds[self._within[-1]] += now - self._last
        self._last = now

    def timed(self, name: str, function: Any) -> Any:  # noqa: ANN401 - of any kind
        """Wrap a function whose time is that of a part."""

        def called(*arguments: Any, **options: Any) -> Any:  # noqa: ANN401
            with self.part(name):
                return function(*arguments, **options)

        return called


def _core_s() -> float:
    """Return the processor time of this process and of its children, in seconds."""
    uses = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(use.ru_utime + use.ru_stime for use in uses)


def living() -> str:
    """Core-seconds of a garage of the recipe, by part."""
    recipe = load_recipe(Path(__file__).parents[1] / RECIPE)
    loads, clock = [os.getloadavg()[0]], _Clock()
    with tempfile.TemporaryDirectory() as name, ExitStack() as stack:
        for part, (home, function) in PARTS.items():
            stack.enter_context(mock.patch.object(home, function, clock.timed(part, getattr(home, function))))
        made = planned(recipe, [(number, 0) for number in range(GARAGES)])
        rows = []
        for shard in shards_of(recipe, made):
            rows += make_shard(recipe, Path(name), shard)
            loads.append(os.getloadavg()[0])
            print(f"{shard.name}: {dict(clock.seconds)}", file=sys.stderr, flush=True)
        with clock.part(REST):
            pass
        bytes_ = sum(file.bytes for row in rows for file in row.files)
    every_s, drive = sum(clock.seconds.values()), recipe.make.drives
    assert drive is not None
    poses = round(drive.longest_s / drive.every_s)
    about = (
        f"Core-seconds of a garage of `{RECIPE}`, of {GARAGES} garages: traffic of "
        f"{recipe.garage['traffic']['minutes']:g} minutes and a car in it that records {poses} poses or less with "
        f"`lidar_32`, pictures of {round(1600 * drive.scale)} x {round(900 * drive.scale)} with {drive.samples} "
        f"samples. A garage takes {bytes_ / GARAGES / 1e6:.1f} MB. The machine's load average was "
        f"{min(loads):.1f} to {max(loads):.1f} meanwhile."
    )
    return "\n".join(
        [
            "## Garages in operation",
            "",
            about,
            "",
            "| part | core-seconds a garage | share |",
            "|---|---|---|",
            *(
                f"| {part} | {clock.seconds[part] / GARAGES:.1f} | {clock.seconds[part] / every_s:.0%} |"
                for part in (*PARTS, REST)
            ),
            f"| all | {every_s / GARAGES:.1f} | |",
        ]
    )
