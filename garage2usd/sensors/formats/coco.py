"""Parking slots as COCO keypoints, and pictures as COCO panoptic segments.

Lin et al., *Microsoft COCO: Common Objects in Context* (2014); Kirillov et al., *Panoptic Segmentation* (2019); the
data formats of cocodataset.org.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.common.package import VERSION
from garage2usd.garage import Stall, StallUse
from garage2usd.reading.labels import Labels
from garage2usd.sensors.slots import CORNERS, PLACES_PX, SlotRecord, Visibility

STUFF = frozenset(
    {
        "beam",
        "cable_tray",
        "ceiling",
        "crossing",
        "duct",
        "floor",
        "floor_stain",
        "hatching",
        "lane_line",
        "obstacle",
        "parking_stall",
        "ramp",
        "sky",
        "stall_line",
        "wall",
    }
)
"""Semantic classes with one panoptic segment a picture; objects of all other classes have one segment each."""

_LEAST_AREA_PX = 16.0
_SLOT, _KEPT_FREE, _MOTORCYCLE_SLOT = 1, 2, 3
_CATEGORIES = [
    {
        "id": number,
        "name": name,
        "supercategory": "slot",
        "keypoints": list(CORNERS),
        "skeleton": [[1, 2], [2, 3], [3, 4], [4, 1]],
    }
    for number, name in ((_SLOT, "parking_slot"), (_KEPT_FREE, "kept_free"), (_MOTORCYCLE_SLOT, "motorcycle_slot"))
]


@dataclass(frozen=True)
class CocoImage:
    """A picture of a COCO data set.

    Attributes
    ----------
    file_name
        Name of the file within the data set.
    size_px
        Width and height.
    """

    file_name: str
    size_px: tuple[int, int]

    def entry(self, number: int) -> dict[str, Any]:
        """Return the picture's record in the COCO list of images."""
        width, height = self.size_px
        return {"id": number, "file_name": self.file_name, "width": width, "height": height}


def coco_keypoints(frames: Iterable[tuple[CocoImage, Iterable[SlotRecord]]], *, description: str) -> dict[str, Any]:
    """Return parking slots as COCO objects with four keypoints.

    Parameters
    ----------
    frames
        Pictures, each with its visible slots.
    description
        Description of the data set.

    Notes
    -----
    Slots of the category ``parking_slot`` take cars; those of ``kept_free`` are hatched or otherwise kept free.
    Those of ``motorcycle_slot`` are for motorcycles; the category is listed only where there are any.
    `segmentation`, `bbox` and `area` cover the whole ground of the slot within the picture, hidden or not. Coordinates
    count from the picture's left and upper edge, so that the middle of the first pixel is (0.5, 0.5). The extension
    `attributes` holds name, number, use, type, angle, occupancy, and the number of pixels that show the slot's ground.
    Slots with fewer than 16 square pixels of ground in the picture are omitted, since COCO's masks of such slivers may
    be empty.
    """
    images: list[dict[str, Any]] = []
    annotations: list[dict[str, Any]] = []
    for number, (image, records) in enumerate(frames, 1):
        images.append(image.entry(number))
        grounds = [(each, shapely.MultiPolygon(list(map(shapely.Polygon, each.outline_px)))) for each in records]
        found = [(record, ground) for record, ground in grounds if ground.area >= _LEAST_AREA_PX]
        for record, ground in found:
            annotations.append({"id": len(annotations) + 1, "image_id": number, **_annotation(record, ground)})
    listed = {_SLOT, _KEPT_FREE, *(annotation["category_id"] for annotation in annotations)}
    return {
        "info": _info(description),
        "licenses": [],
        "images": images,
        "annotations": annotations,
        "categories": [category for category in _CATEGORIES if category["id"] in listed],
    }


def coco_panoptic(
    pictures: Iterable[tuple[CocoImage, str, list[dict[str, Any]]]], labels: Labels, *, description: str
) -> dict[str, Any]:
    """Return the panoptic segments of pictures in COCO's format.

    Parameters
    ----------
    pictures
        Pictures, each with the name of its PNG of segments and its segments from `panoptic_segments`.
    labels
        Table of labels, whose classes are the categories, `STUFF` and things.
    description
        Description of the data set.
    """
    images, annotations = [], []
    for number, (image, file_name, segments) in enumerate(pictures, 1):
        images.append(image.entry(number))
        annotations.append({"image_id": number, "file_name": file_name, "segments_info": segments})
    categories = [
        {
            "id": number,
            "name": entry.name,
            "supercategory": entry.cityscapes or entry.name,
            "isthing": int(entry.name not in STUFF),
        }
        for number, entry in sorted(labels.classes.items())
    ]
    return {
        "info": _info(description),
        "licenses": [],
        "images": images,
        "annotations": annotations,
        "categories": categories,
    }


def panoptic_segments(instance: NDArray[np.int32], labels: Labels) -> tuple[NDArray[np.int32], list[dict[str, Any]]]:
    """Compute the panoptic segments of a picture of instances.

    Parameters
    ----------
    instance
        Id of the object that each pixel shows, 0 for none; shape (rows, columns).
    labels
        Table of labels of the stage.

    Returns
    -------
    tuple
        Segment id of each pixel, 0 where nothing is labelled, and COCO's records of the segments ordered by id. A
        thing's segment has the id of its object; a segment of `STUFF` has the least id of its objects in the picture.
    """
    ids, which = np.unique(instance, return_inverse=True)
    first_of: dict[int, int] = {}
    segment_of = np.zeros(len(ids), dtype=np.int32)
    for place, number in enumerate(ids.tolist()):
        class_id = labels.class_ids.get(number)
        if class_id is not None:
            is_stuff = labels.classes[class_id].name in STUFF
            segment_of[place] = first_of.setdefault(class_id, number) if is_stuff else number
    segments: NDArray[np.int32] = segment_of[which].reshape(instance.shape)
    rows, columns = np.nonzero(segments)
    numbers, owner, areas = np.unique(segments[rows, columns], return_inverse=True, return_counts=True)
    low, high = np.full((len(numbers), 2), max(instance.shape)), np.zeros((len(numbers), 2), dtype=np.int64)
    places = np.stack([columns, rows], axis=1)
    np.minimum.at(low, owner, places)
    np.maximum.at(high, owner, places + 1)
    infos = [
        {
            "id": number,
            "category_id": labels.class_ids[number],
            "area": area,
            "bbox": [left, top, right - left, bottom - top],
            "iscrowd": 0,
        }
        for number, area, (left, top), (right, bottom) in zip(
            numbers.tolist(), areas.tolist(), low.tolist(), high.tolist(), strict=True
        )
    ]
    return segments, infos


def _info(description: str) -> dict[str, str]:
    return {"description": description, "version": VERSION}


def _category_of(stall: Stall) -> int:
    if stall.use is StallUse.MOTORCYCLE:
        return _MOTORCYCLE_SLOT
    return _SLOT if stall.takes_cars else _KEPT_FREE


def _annotation(record: SlotRecord, ground: shapely.MultiPolygon) -> dict[str, Any]:
    slot = record.slot
    left, top, right, bottom = ground.bounds
    keypoints: list[float] = []
    for (column, row), visibility in zip(record.corners_px.tolist(), record.visibility, strict=True):
        is_there = visibility != Visibility.NOT_IN_PICTURE
        keypoints += [round(column, PLACES_PX), round(row, PLACES_PX), visibility] if is_there else [0, 0, 0]
    return {
        "category_id": _category_of(slot.stall),
        "iscrowd": 0,
        "segmentation": [np.round(part, PLACES_PX).ravel().tolist() for part in record.outline_px],
        "bbox": [round(value, PLACES_PX) for value in (left, top, right - left, bottom - top)],
        "area": round(ground.area, PLACES_PX),
        "keypoints": keypoints,
        "num_keypoints": sum(visibility != Visibility.NOT_IN_PICTURE for visibility in record.visibility),
        "attributes": {
            **slot.facts,
            "seen_px": record.seen_px,
        },
    }
