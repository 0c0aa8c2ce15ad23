"""Parking-slot labels of a rendered data set: ``slots.json`` and the formats derived for detectors."""

import json
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.common.errors import ConfigError
from garage2usd.common.json_text import json_text
from garage2usd.reading.labels import Labels
from garage2usd.render.cameras import View
from garage2usd.render.pictures import Picture, classes_of, read_depth, read_ids, write_ids
from garage2usd.sensors.formats.coco import CocoImage, coco_keypoints, coco_panoptic, panoptic_segments
from garage2usd.sensors.formats.dmpr_ps import dmpr_ps
from garage2usd.sensors.formats.slots_file import slots_document
from garage2usd.sensors.rays.around_view import AroundView
from garage2usd.sensors.rays.birds_eye import FLOOR_CLASSES, Orthographic
from garage2usd.sensors.rays.seen_points import seen_points
from garage2usd.sensors.slots import SlotFrame, SlotRecord, Slots, read_slots

__all__ = ["NEEDED", "SlotFormat", "SlotLabels", "check_slots"]

NEEDED = frozenset({Picture.DEPTH, Picture.INSTANCE})
"""Kinds of pictures that slot labels are derived from, rendered even if not requested."""


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
    """

    stage: Usd.Stage
    labels: Labels
    views: Sequence[View]
    finished: Path
    vacated: Collection[str] = ()

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
        records = {view.name: slots.seen_in(self._frame(view)) for view in self.views}
        name = Path(self.stage.GetRootLayer().realPath).name
        files = [self._write("slots.json", slots_document(slots, records, stage=name))]
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
