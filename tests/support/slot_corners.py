"""Corners of slots as ``slots.json`` has them, judged by the pictures of classes beside it."""

import json
import math

import numpy as np
from PIL import Image

FLOOR = {
    "crossing",
    "drain",
    "floor",
    "floor_stain",
    "hatching",
    "lane_arrow",
    "lane_line",
    "parking_stall",
    "stall_line",
    "stall_number",
    "stall_symbol",
}


def judge_corners(folder, table):
    """Assert that a corner counts as seen exactly where its pixel shows the floor or its paint; returns how many do."""
    names = {entry["id"]: entry["name"] for entry in table["classes"]}
    pictures = {frame["name"]: folder / frame["files"]["semantic"] for frame in table["frames"]}
    counts = {1: 0, 2: 0}
    for frame in json.loads((folder / "slots.json").read_text())["frames"]:
        classes = np.asarray(Image.open(pictures[frame["name"]]))
        for slot in frame["slots"]:
            for place, visibility in zip(slot["corners_px"], slot["visibility"], strict=True):
                if visibility:
                    column, row = map(math.floor, place)
                    shown = names.get(int(classes[row, column]), "")
                    assert (visibility == 2) == (shown in FLOOR), (frame["name"], slot["name"], shown)
                    counts[visibility] += 1
    return counts
