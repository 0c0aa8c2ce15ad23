"""Rendering of views by Blender, frame by frame; finished frames are kept and never rendered again."""
# Over 300 lines: what is drawn of a view, and in which order, is decided in one place.

import json
import shutil
import time
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.assets.light import EXPOSURE_EV, VIEW_TRANSFORM
from garage2usd.common.limits import lift
from garage2usd.common.progress import Announce, Progress, time_in_words, unheard
from garage2usd.common.system import cores
from garage2usd.reading.labels import Labels
from garage2usd.render import agx
from garage2usd.render.blender_process import run_blender
from garage2usd.render.cameras import View
from garage2usd.render.devices import CPU, ComputeDevice, drawing_s
from garage2usd.render.drawn_prims import (
    SHAPE_PROPERTY,
    DrawnPrims,
    Overhead,
    find_overhead,
    read_drawn_prims,
    write_shapes,
)
from garage2usd.render.pictures import (
    INDEX_LIMIT,
    Picture,
    Surfaces,
    VisibleInstance,
    read_depth,
    read_ids,
    read_light,
    read_surfaces,
    visible_instances,
    write_colour,
    write_picture,
    write_pixels,
)
from garage2usd.sensors.developing import develop
from garage2usd.sensors.motion_blur import exposed_in_motion
from garage2usd.sensors.rays.birds_eye import Orthographic

_BLENDER_FROM = {
    UsdGeom.Tokens.y: np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
    UsdGeom.Tokens.z: np.eye(3),
}
"""Rotation from a stage's axes, by its up axis, to Blender's."""
_TILE_PX = 256
"""Side of the tiles of a colour picture; Blender tells its progress after each."""
_SEEN = "seen"
_EFFECTS = "effects"
_LIGHT = "light"
MOTION_NEEDS = Picture.DEPTH, Picture.INSTANCE
"""Kinds of pictures needed to develop the colour of views that show motion."""


@dataclass(frozen=True, eq=False)
class Drawing:
    """A render job: the views of a stage, the kinds of pictures and the quality.

    Attributes
    ----------
    stage, labels
        The stage, and its table of labels.
    views
        The views to render, with unique names.
    hidden
        Ids of the objects hidden from each view.
    kinds
        The kinds of pictures.
    samples, seed
        Samples per pixel and seed of the colour picture.
    finished
        Folder of finished frames, with a subfolder for each kind of picture.
    moving
        Ids of the objects of the vehicle that carries sensors.
    moved
        For each view the rigid transform of each object that moves from view to view, by its id, from its pose in the
        stage, in the stage's axes and metres; shape (4, 4). Empty if nothing moves.
    unseen
        Ids of the objects that each view looks through, though light does not; empty if there are none.
    device
        Device that renders colour; all other pictures are rendered by the processor, by rays like colour or by Blender.
    is_draft
        True for a faster colour picture, hardly visible in small pictures: fewer light bounces, uniform sampling of
        lights and quick denoising.
    """

    stage: Usd.Stage
    labels: Labels
    views: Sequence[View]
    hidden: Sequence[Sequence[int]]
    kinds: Collection[Picture]
    samples: int
    seed: int
    finished: Path
    moving: frozenset[int] = frozenset()
    moved: Sequence[Mapping[int, NDArray[np.float64]]] = ()
    device: ComputeDevice = CPU
    is_draft: bool = False
    unseen: Sequence[Sequence[int]] = ()

    def draw(self, work: Path, progress: Progress, announce: Announce = unheard) -> list[list[VisibleInstance] | None]:
        """Render the unfinished frames.

        Parameters
        ----------
        work
            Folder for Blender's input and output.
        progress
            Called with the number of finished samples, finished frames included.
        announce
            Called with a description of the job, and with the time per picture once one is finished.

        Returns
        -------
        list
            Visible objects of each view; None if only colour is rendered.

        Raises
        ------
        RenderError
            If Blender fails. Finished frames are kept.
        """
        missing = sorted(set(MOTION_NEEDS) - set(self.kinds))
        if missing and self._has_colour and any(view.shows_motion for view in self.views):
            raise TypeError(f"motion is drawn with {missing}")
        for folder in (*self.kinds, _SEEN, _EFFECTS, _LIGHT):
            (self.finished / folder).mkdir(parents=True, exist_ok=True)
        if self.device.is_by_rays:
            self._draw_by_rays(progress, announce)
        else:
            self._draw_by_blender(work, progress, announce)
        return [self._read_seen(view) if self._has_data else None for view in self.views]

    def _frames(self) -> list[tuple[View, Sequence[int], Sequence[int], Mapping[int, NDArray[np.float64]]]]:
        """Return each view with what is hidden from it, what it looks through, and what moves."""
        count = len(self.views)
        moved, unseen = self.moved or [{}] * count, self.unseen or [()] * count
        return list(zip(self.views, self.hidden, unseen, moved, strict=True))

    def _draw_by_blender(self, work: Path, progress: Progress, announce: Announce) -> None:
        """Render the unfinished frames with Cycles."""
        digits = 1 + int(max(self.labels.ids.values(), default=0) >= INDEX_LIMIT)
        jobs = [
            {**self._frame_job(view, hide, work, digits), "unseen": list(through), "moved": _listed(places)}
            for view, hide, through, places in self._frames()
        ]
        order = self._order()
        total = len(self.views) * (self.samples * self._has_colour + self._has_data)
        left = sum(self.samples * bool(job["colour"]) + bool(job["data"]) for job in jobs)
        if left:
            announce(self._described(jobs))
            progress("scene", 0, 1)
            scene = read_drawn_prims(self.stage, self.labels.ids)
            progress("render", total - left, total)
            tempo = _Tempo(self.samples if any(job["colour"] for job in jobs) else 1, jobs, announce)
            waiting = _Waiting(self, [(self.views[number], jobs[number]) for number in order])
            lift()

            def done(samples: int) -> None:
                waiting.take()
                tempo.take(samples)
                progress("render", total - left + samples, total)

            run_blender(self._job(scene, [jobs[number] for number in order], work), work, done, self.device.blender)
            waiting.take()
        for view in self.views:
            self._develop_kept(view)

    def _draw_by_rays(self, progress: Progress, announce: Announce) -> None:
        """Render the unfinished frames without Blender."""
        from garage2usd.render.ray_pictures import RayPictures  # noqa: PLC0415 - Blender does not need its extra

        count = len(self.views)
        missing = [frame for frame in self._frames() if any(self._lacks(frame[0]))]
        finished = f", {count - len(missing)} of them finished before" if len(missing) < count else ""
        announce(f"{count} views{finished}: {self.samples} rays a pixel on {self.device.words}")
        if missing:
            progress("scene", 0, 1)
            pictures = RayPictures(self.stage, self.labels, self.samples, self.seed)
        for number, (view, hide, through, places) in enumerate(missing, count - len(missing)):
            progress("render", number, count)
            light, surfaces = pictures.taken(view, hide, through, places)
            if self._has_data:
                self._keep_surfaces(view, surfaces)
            if self._has_colour and view.effects is None:
                with _whole(self._path(view, Picture.COLOUR)) as part:
                    write_pixels(agx.developed(light), part)
            elif self._has_colour and view.shows_motion:
                self._develop_in_motion(view, light, surfaces.depth_m, surfaces.instance)
            elif self._has_colour:
                self._develop(view, light)
        progress("render", count, count)

    def _lacks(self, view: View) -> tuple[bool, bool]:
        """Return whether the colour of a view is still to be rendered, and whether its other pictures are."""
        has_colour = self._path(view, Picture.COLOUR).exists() or self._light_path(view).exists()
        return self._has_colour and not has_colour, self._has_data and not self._seen_path(view).exists()

    def take_colour(self, view: View, drawn: Path) -> None:
        """Store a rendered colour picture, or the picture that the view's camera develops from the light."""
        if view.shows_motion:  # motion blur needs the depth, which Blender draws last
            with _whole(self._light_path(view)) as part:
                shutil.copyfile(drawn, part)
            return
        if view.effects is not None:
            self._develop(view, read_light(drawn))
            return
        with _whole(self._path(view, Picture.COLOUR)) as part:
            starts_m = view.starts_m()
            write_colour(drawn, part, seeing=None if starts_m is None else np.isfinite(starts_m).all(axis=-1))

    def take_data(self, view: View, drawn: Sequence[Path]) -> None:
        """Store Blender's depth, normals and ids as pictures; the list of visible objects marks completion."""
        # of a pinhole of a rig Blender measures depth along the ray, as its lens is a shader
        self._keep_surfaces(view, read_surfaces(drawn, self._axes.T, view.starts_m()).along_axis(view.lens))
        self._develop_kept(view)

    def _keep_surfaces(self, view: View, surfaces: Surfaces) -> None:
        """Write the pictures other than colour, and the list of visible objects."""
        for kind in self.kinds:
            if kind is not Picture.COLOUR:
                with _whole(self._path(view, kind)) as part:
                    write_picture(kind, part, surfaces, self.labels)
        seen = [asdict(each) for each in visible_instances(surfaces.instance)]
        with _whole(self._seen_path(view)) as part:
            part.write_text(json.dumps(seen), encoding="utf-8", newline="\n")

    def _develop_kept(self, view: View) -> None:
        """Develop stored light once its depth and instances are available."""
        light = self._light_path(view)
        if not light.exists() or not self._seen_path(view).exists():
            return
        depth_m, instance = read_depth(self._path(view, Picture.DEPTH)), read_ids(self._path(view, Picture.INSTANCE))
        self._develop_in_motion(view, read_light(light), depth_m, instance)
        light.unlink()

    def _develop_in_motion(
        self, view: View, light: NDArray[np.float32], depth_m: NDArray[np.float32], instance: NDArray[np.int32]
    ) -> None:
        if view.twist is None or view.effects is None:
            raise TypeError(view.name)
        is_vehicle = np.isin(instance, sorted(self.moving))
        moves = ~is_vehicle if view.is_carried else is_vehicle
        self._develop(view, exposed_in_motion(light, depth_m, moves, view.sensor_lens(), view.twist, view.effects))

    def facts(self, view: View) -> dict[str, object]:
        """Return a finished view's entry in the table of frames: its own facts, and those of its camera's exposure."""
        if view.effects is None or not self._has_colour:
            return dict(view.facts)
        did = json.loads((self.finished / _EFFECTS / f"{view.name}.json").read_text(encoding="utf-8"))
        motion = {"motion": view.twist.facts} if view.twist is not None and view.shows_motion else {}
        return {**view.facts, "effects": {**view.effects.model_dump(mode="json"), **did, **motion}}

    def _develop(self, view: View, light: NDArray[np.float32] | NDArray[np.float64]) -> None:
        """Develop light by the view's camera; the picture is written last, as a mark of completion."""
        if view.effects is None:
            raise TypeError(view.name)
        taken = develop(light, view.sensor_lens(), view.effects, camera=view.camera, frame=view.name, seed=self.seed)
        with _whole(self.finished / _EFFECTS / f"{view.name}.json") as part:
            part.write_text(json.dumps(taken.facts), encoding="utf-8", newline="\n")
        with _whole(self._path(view, Picture.COLOUR)) as part:
            write_pixels(taken.pixels, part)

    def _order(self) -> list[int]:
        """Order the views for rendering by lens, since changing the lens is slow."""
        groups: dict[str, list[int]] = {}
        unseen = self.unseen or [()] * len(self.views)
        for number, (view, hide, through) in enumerate(zip(self.views, self.hidden, unseen, strict=True)):
            key = json.dumps([view.lens_job(), view.size_px, list(hide), list(through)])
            groups.setdefault(key, []).append(number)
        return [number for group in groups.values() for number in group]

    @property
    def _has_colour(self) -> bool:
        return Picture.COLOUR in self.kinds

    @property
    def _has_data(self) -> bool:
        return bool(set(self.kinds) - {Picture.COLOUR})

    @property
    def _axes(self) -> NDArray[np.float64]:
        return _BLENDER_FROM[UsdGeom.GetStageUpAxis(self.stage)]

    def _path(self, view: View, kind: Picture) -> Path:
        return self.finished / kind / f"{view.name}{kind.extension}"

    def _seen_path(self, view: View) -> Path:
        return self.finished / _SEEN / f"{view.name}.json"

    def _light_path(self, view: View) -> Path:
        return self.finished / _LIGHT / f"{view.name}.exr"

    def _read_seen(self, view: View) -> list[VisibleInstance]:
        entries = json.loads(self._seen_path(view).read_text(encoding="utf-8"))
        return [VisibleInstance(**{**entry, "box_px": tuple(entry["box_px"])}) for entry in entries]

    def _frame_job(self, view: View, hidden: Sequence[int], work: Path, digits: int) -> dict[str, Any]:
        """Return a frame's job for Blender, without finished pictures."""
        draws_colour, draws_data = self._lacks(view)
        return {
            "colour": str(work / f"{view.name}.{'png' if view.effects is None else 'light.exr'}")
            if draws_colour
            else None,
            "is_light": view.effects is not None,
            "data": [str(work / f"{view.name}_{digit}.exr") for digit in range(digits)] if draws_data else [],
            "lens": view.lens_job(),
            "size_px": view.size_px,
            "camera_to_world": view.camera_to_world.tolist(),
            "hidden": list(hidden),
            "from_above": isinstance(view.lens, Orthographic),
        }

    def _job(self, scene: DrawnPrims, jobs: Sequence[Mapping[str, Any]], work: Path) -> dict[str, Any]:
        write_shapes(self.stage, scene, work / "shapes.usda")
        overhead = self._overhead(scene)
        np.savez(
            work / "places.npz",
            shape=scene.shape,
            instance=scene.instance,
            to_world=scene.to_world,
            hangs=overhead.hangs,
            cut_m=overhead.cut_m,
        )
        to_blender = np.eye(4)
        to_blender[:3, :3] = self._axes
        return {
            "shapes": str(work / "shapes.usda"),
            "places": str(work / "places.npz"),
            "mask": [str(prim) for prim in (*scene.shapes, *scene.materials, *scene.domes)],
            "property": SHAPE_PROPERTY,
            "to_blender": to_blender.tolist(),
            "samples": self.samples,
            "tile_px": _TILE_PX,
            "view_transform": VIEW_TRANSFORM,
            "exposure_ev": EXPOSURE_EV,
            "seed": self.seed,
            "is_draft": self.is_draft,
            "device": self.device.kind,
            "moving": sorted({number for places in self.moved for number in places}),
            "frames": jobs,
        }

    def _overhead(self, scene: DrawnPrims) -> Overhead:
        """Find the overhead objects to hide from bird's-eye views, if there are such views."""
        if any(isinstance(view.lens, Orthographic) for view in self.views):
            return find_overhead(self.stage, scene, self.labels.ids)
        return Overhead(np.zeros(len(scene.shape), dtype=bool), np.full(len(scene.shape), np.nan))

    def _described(self, jobs: Sequence[Mapping[str, Any]]) -> str:
        """Describe the render job in words."""
        sizes = Counter(f"{width} x {height}" for width, height in (view.size_px for view in self.views))
        told = [f"{count} of {size}" for size, count in sizes.items()]
        there = sum(not job["colour"] and not job["data"] for job in jobs)
        finished = f", {there} of them finished before" if there else ""
        count = "1 sample" if self.samples == 1 else f"{self.samples} samples"
        kinds = ", ".join(
            f"colour with {count} on {self.device.words}" if kind is Picture.COLOUR else str(kind)
            for kind in self.kinds
        )
        views = "1 view" if len(self.views) == 1 else f"{len(self.views)} views"
        words = f"{views}, {' and '.join(told)} pixels{finished}: {kinds}"
        if self.device.kind != CPU.kind and self._has_colour:
            return words  # GPUs differ too much for an estimate
        seconds = drawing_s(
            [job["size_px"] for job in jobs if job["colour"]],
            [job["size_px"] for job in jobs if job["data"]],
            samples=self.samples,
            cores=cores(),
        )
        return f"{words}; about {time_in_words(seconds)}"


class _Tempo:
    """Announcer of the time per picture, as soon as the first one is rendered."""

    def __init__(self, samples: int, jobs: Sequence[Mapping[str, Any]], announce: Announce) -> None:
        self._samples, self._announce = samples, announce
        self._pictures = sum(bool(job["colour"]) for job in jobs) or sum(bool(job["data"]) for job in jobs)
        self._begun_s: float | None = None
        self._is_said = False

    def take(self, samples: int) -> None:
        """Record the number of finished samples; the first call marks the scene as read."""
        now_s = time.monotonic()
        if self._begun_s is None:
            self._begun_s = now_s
        elif not self._is_said and samples >= self._samples:
            self._is_said = True
            took_s, more = now_s - self._begun_s, self._pictures - 1
            left = f", {more} more about {time_in_words(more * took_s)}" if more else ""
            self._announce(f"a picture takes {time_in_words(took_s)}{left}")


class _Waiting:
    """Pictures that Blender has yet to finish; each is stored as soon as it is complete."""

    def __init__(self, drawing: Drawing, pairs: Sequence[tuple[View, Mapping[str, Any]]]) -> None:
        self._drawing = drawing
        self._colour = [(view, Path(job["colour"])) for view, job in pairs if job["colour"]]
        self._data = [(view, [Path(name) for name in job["data"]]) for view, job in pairs if job["data"]]

    def take(self) -> None:
        """Store the pictures that are complete; Blender renders frames in order, colour first."""
        while self._colour and self._colour[0][1].exists():
            view, drawn = self._colour.pop(0)
            self._drawing.take_colour(view, drawn)
            drawn.unlink()
        while self._data and self._data[0][1][-1].exists():
            view, files = self._data.pop(0)
            self._drawing.take_data(view, files)
            for file in files:
                file.unlink()


def _listed(places: Mapping[int, NDArray[np.float64]]) -> list[tuple[int, list[list[float]]]]:
    return [(number, place.tolist()) for number, place in places.items()]


@contextmanager
def _whole(path: Path) -> Iterator[Path]:
    """Yield a temporary path, which is renamed to the file's path once complete."""
    part = path.with_name(f".part-{path.name}")
    yield part
    part.replace(path)
