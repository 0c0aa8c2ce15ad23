"""Tables beside pictures: ``frames.json`` with poses and visible objects, ``slots.json`` for detectors of stalls."""

import json
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.common.documents import json_text
from garage2usd.common.errors import ConfigError
from garage2usd.common.package import VERSION
from garage2usd.reading.labels import Labels
from garage2usd.render.cameras import View
from garage2usd.render.pictures import (
    Picture,
    VisibleInstance,
    class_colour,
    classes_of,
    read_depth,
    read_ids,
    write_ids,
)
from garage2usd.sensors.formats.coco import CocoImage, coco_keypoints, coco_panoptic, panoptic_segments
from garage2usd.sensors.formats.slot_files import dmpr_ps, slots_document
from garage2usd.sensors.rays.around_view import AroundView
from garage2usd.sensors.rays.birds_eye import FLOOR_CLASSES, Orthographic
from garage2usd.sensors.rays.sight import seen_points
from garage2usd.sensors.slots import SlotFrame, SlotRecord, Slots, read_slots

_CONVENTIONS = {
    "world": "the stage's axes, in metres",
    "camera": "+X right, +Y down, +Z forward (OpenCV)",
    "world_to_camera": "4 x 4, rows first, for column vectors: p_camera = world_to_camera @ p_world",
    "intrinsics": "u = (K @ p_camera)[0] / z, v likewise; pixel (column, row) covers [column, column + 1) and its "
    "middle is column + 0.5",
    "depth": "z of the camera (planar, not along the ray) in metres, 32-bit float, channel Z; infinite where there is "
    "nothing; of fisheyes, whose frames say so, the distance along the ray, which in around views starts at the camera "
    "that serves the pixel",
    "normals": "of the surface without normal maps, in the world's axes, channels X, Y, Z; 0 where there is nothing",
    "instance": "id = red + 256 * green + 65536 * blue; 0 is nothing, or nothing labelled; number plates have "
    "the id of their car",
    "semantic": "grey is the id of the class; 0 is nothing, or nothing labelled",
    "box_px": "left, top, right, bottom of what can be seen; right and bottom are the first that it does not reach",
}
NEEDED = frozenset({Picture.DEPTH, Picture.INSTANCE})
"""Kinds of pictures that slot labels are derived from, rendered even if not requested."""


def write_frames(
    path: Path,
    entries: Sequence[tuple[View, Sequence[VisibleInstance] | None, Sequence[str]]],
    labels: Labels,
    kinds: Collection[Picture],
    *,
    stage: Path,
    about: Mapping[str, object],
) -> Path:
    """Write the table of frames of rendered views.

    Parameters
    ----------
    path
        The file.
    entries
        View, visible objects (None where none were drawn) and hidden classes of each frame.
    labels
        Table of labels of the stage.
    kinds
        The rendered kinds of pictures.
    stage
        Path of the rendered stage.
    about
        Entries about all frames, by key.
    """
    name_of = {number: name for name, number in labels.ids.items()}
    document = {
        "version": VERSION,
        "stage": stage.name,
        "conventions": _CONVENTIONS,
        **about,
        "classes_version": labels.classes_version,
        "classes": [
            {**entry.model_dump(), "colour": list(class_colour(number))}
            for number, entry in sorted(labels.classes.items())
        ],
        "frames": [
            {
                "name": view.name,
                "camera": view.camera,
                "frame": view.frame,
                "files": {kind: f"{kind}/{view.name}{kind.extension}" for kind in kinds},
                **_optics(view),
                "world_to_camera": view.world_to_camera().tolist(),
                "hidden_classes": list(hidden),
                **view.facts,
                **({} if visible is None else _seen(visible, labels, name_of)),
            }
            for view, visible, hidden in entries
        ],
    }
    path.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8", newline="\n")
    return path


def _optics(view: View) -> dict[str, Any]:
    matrix = view.intrinsics()
    return {"depth": "along_ray"} if matrix is None else {"intrinsics": matrix.tolist()}


def _seen(visible: Sequence[VisibleInstance], labels: Labels, name_of: dict[int, str]) -> dict[str, Any]:
    """List the visible objects of a frame, with number plates merged into their cars."""
    found: dict[int, VisibleInstance] = {}
    for each in visible:
        number = labels.instance_of(each.id)
        found[number] = found[number].joined(each) if number in found else replace(each, id=number)
    plates = [
        {
            "id": labels.plates[each.id].car,
            "path": name_of[each.id],
            "text": labels.plates[each.id].text,
            "box_px": list(each.box_px),
            "pixels": each.pixels,
        }
        for each in visible
        if each.id in labels.plates
    ]
    return {
        "instances": [_instance(found[number], labels, name_of) for number in sorted(found)],
        "number_plates": plates,
    }


def _instance(visible: VisibleInstance, labels: Labels, name_of: dict[int, str]) -> dict[str, Any]:
    return {
        "id": visible.id,
        "path": name_of[visible.id],
        "class": labels.classes[labels.class_ids[visible.id]].name,
        "box_px": list(visible.box_px),
        "pixels": visible.pixels,
    }


class SlotFormat(StrEnum):
    """File formats of parking-slot labels."""

    JSON = "json"
    """``slots.json``, written with every other format as well."""
    COCO = "coco"
    """COCO keypoints: ``slots_coco.json``."""
    PANOPTIC = "panoptic"
    """COCO panoptic segments of all visible objects: ``panoptic.json`` and the folder ``panoptic``."""
    DMPR_PS = "dmpr-ps"
    """Marking points of bird's-eye and around views only: the folder ``dmpr_ps``."""


_NEEDS = {SlotFormat.PANOPTIC: Picture.INSTANCE}
"""Kinds of pictures that slot formats need besides depth, which all need."""


def check_slots(formats: Collection[SlotFormat], kinds: Collection[Picture], *, has_ground_view: bool) -> None:
    """Check before rendering that parking-slot labels can be written in the requested formats.

    Raises
    ------
    ConfigError
        If a required kind of picture is not rendered, or there is no bird's-eye or around view for DMPR-PS.
    """
    needed = {Picture.DEPTH, *(_NEEDS[each] for each in formats if each in _NEEDS)}
    missing = sorted(needed.difference(kinds))
    if missing:
        raise ConfigError("pictures", ",".join(kinds), f"{missing[0]} among them, from which slots are told")
    if SlotFormat.DMPR_PS in formats and not has_ground_view:
        raise ConfigError("slots", str(SlotFormat.DMPR_PS), "other formats where there is no bird's-eye or around view")


@dataclass(frozen=True, eq=False)
class SlotLabels:
    """The parking-slot labels of a rendered data set.

    Attributes
    ----------
    stage, labels
        The stage, and its table of labels.
    views
        The frames.
    finished
        Folder of the frames' pictures, with a subfolder for each kind, including those of `NEEDED`; the label files are
        written there.
    vacated
        Names of the slots whose cars are hidden in the pictures.
    taken
        Names of the slots that cars of traffic stand in, by the name of the view; empty without traffic.
    """

    stage: Usd.Stage
    labels: Labels
    views: Sequence[View]
    finished: Path
    vacated: Collection[str] = ()
    taken: Mapping[str, Collection[str]] = field(default_factory=dict)

    def write(self, formats: Collection[SlotFormat]) -> list[Path]:
        """Write ``slots.json`` and further formats of parking-slot labels.

        Returns
        -------
        list of Path
            The written files and folders.

        Raises
        ------
        StageError
            If the stage has no slots.
        """
        slots = self._slots()
        records = {
            view.name: slots.taken(self.taken.get(view.name, ())).seen_in(self._frame(view)) for view in self.views
        }
        name = Path(self.stage.GetRootLayer().realPath).name
        files = [self._write("slots.json", slots_document(slots, records, stage=name, is_changing=bool(self.taken)))]
        if SlotFormat.COCO in formats:
            frames = [(self._image(view), records[view.name]) for view in self.views]
            files.append(self._write("slots_coco.json", coco_keypoints(frames, description=f"Slots of {name}")))
        if SlotFormat.PANOPTIC in formats:
            folder = self.finished / "panoptic"
            folder.mkdir(exist_ok=True)
            document = coco_panoptic(self._panoptic(folder), self.labels, description=f"All that is seen of {name}")
            files += [folder, self._write("panoptic.json", document)]
        if SlotFormat.DMPR_PS in formats:
            files.append(self._write_dmpr_ps(slots, records))
        return files

    def _slots(self) -> Slots:
        found = read_slots(self.stage)
        vacated = {*self.vacated}
        slots = (
            replace(slot, stall=slot.stall.vacated()) if vacated & {slot.stall.name, slot.stall.blocked_by} else slot
            for slot in found.slots
        )
        return replace(found, slots=tuple(slots))

    def _frame(self, view: View) -> SlotFrame:
        lens, to_sensor = view.sensor_lens(), view.world_to_camera()

        def project(points: NDArray[np.float64]) -> NDArray[np.float64]:
            return lens.project(points @ to_sensor[:3, :3].T + to_sensor[:3, 3])

        depth_m = read_depth(self.finished / Picture.DEPTH / f"{view.name}{Picture.DEPTH.extension}")
        seen_m = seen_points(lens, depth_m, np.linalg.inv(to_sensor))
        return SlotFrame(view.name, view.size_px, project, seen_m, self._shows_floor(view))

    def _shows_floor(self, view: View) -> NDArray[np.bool_]:
        """Mask the pixels that show the floor, its paint, or an unlabelled surface."""
        ids = read_ids(self.finished / Picture.INSTANCE / f"{view.name}{Picture.INSTANCE.extension}")
        floor = [number for number, entry in self.labels.classes.items() if entry.name in FLOOR_CLASSES]
        return np.isin(classes_of(ids, self.labels.class_ids), [0, *floor])

    def _image(self, view: View) -> CocoImage:
        return CocoImage(f"{Picture.COLOUR}/{view.name}{Picture.COLOUR.extension}", view.size_px)

    def _panoptic(self, folder: Path) -> Iterator[tuple[CocoImage, str, list[dict[str, Any]]]]:
        """Write the panoptic picture of each frame, and yield its COCO records."""
        for view in self.views:
            name = f"{view.name}{Picture.INSTANCE.extension}"
            segments, infos = panoptic_segments(read_ids(self.finished / Picture.INSTANCE / name), self.labels)
            write_ids(segments, folder / name)
            yield self._image(view), name, infos

    def _write_dmpr_ps(self, slots: Slots, records: Mapping[str, Sequence[SlotRecord]]) -> Path:
        folder = self.finished / "dmpr_ps"
        folder.mkdir(exist_ok=True)
        for view in self.views:
            if isinstance(view.lens, Orthographic | AroundView):
                text = json.dumps(dmpr_ps(records[view.name], slots))
                (folder / f"{view.name}.json").write_text(text + "\n", encoding="utf-8", newline="\n")
        return folder

    def _write(self, name: str, document: Mapping[str, object]) -> Path:
        path = self.finished / name
        path.write_text(json_text(document), encoding="utf-8", newline="\n")
        return path
