"""Names in CARLA: the folder of each semantic class, and the names of meshes and maps that CARLA's importer reads."""

import re
import unicodedata

from garage2usd.objects import PIECE_LABELS, stall_number
from garage2usd.reading.labels import CITYSCAPES

ROAD_LINE, OTHER = "RoadLine", "Other"
_PAINT = PIECE_LABELS | {stall_number.KIND.label}
_FOLDERS = {
    "road": "Road",
    "parking": "Road",
    "sidewalk": "SideWalk",
    "terrain": "Terrain",
    "building": "Building",
    "wall": "Wall",
    "fence": "Fence",
    "guard rail": "GuardRail",
    "bridge": "Bridge",
    "pole": "Pole",
    "traffic sign": "TrafficSign",
    "traffic light": "TrafficLight",
    "vegetation": "Vegetation",
    "sky": "Sky",
    "ground": "Ground",
    "person": "Pedestrian",
    "rider": "Rider",
    "car": "Car",
    "truck": "Truck",
    "bus": "Bus",
    "motorcycle": "Motorcycle",
    "bicycle": "Bicycle",
    "static": "Static",
    "dynamic": "Dynamic",
}
"""Folder whose name gives meshes their class in `ATagger::GetLabelByFolderName`, by Cityscapes class."""
BY_NAME = {"Road": "Road_Road", ROAD_LINE: "Road_Marking", "SideWalk": "Road_Sidewalk", "Terrain": "Terrain"}
"""Part of a mesh's name by which `UMoveAssetsCommandlet` moves the mesh to a folder; it moves others to Terrain."""
_BEGINNINGS = {**BY_NAME, "TrafficSign": "TrafficPlate", "TrafficLight": "TrafficLamp"}
_REFUSED = re.compile(r"li(?=ght)|si(?=gn)|ro(?=ad)|te(?=rrain)|ti(?=le)", re.IGNORECASE)
"""Where words are parted by which CARLA leaves a mesh out (light, sign), classes it (road, terrain) or finds a tile."""


def folder_of(label: str) -> str:
    """Return the folder of CARLA for a semantic class of the stage; `OTHER` for an unknown one."""
    return ROAD_LINE if label in _PAINT else _FOLDERS.get(CITYSCAPES.get(label, ""), OTHER)


def mesh_name(folder: str, number: int) -> str:
    """Return the name of the mesh of an object with an instance id, for example ``Road_Marking_00012``."""
    return f"{_BEGINNINGS.get(folder, folder)}_{number:05d}"


def plain_name(name: str) -> str:
    """Return a name of ASCII letters, digits and single underscores that CARLA's importer takes as a mere name.

    Examples
    --------
    >>> plain_name("my garage.v2"), plain_name("Signs")
    ('my_garage_v2', 'Si_gns')
    """
    ascii_name = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
    words = "_".join(re.findall(r"[A-Za-z0-9]+", ascii_name)) or "garage"
    return _REFUSED.sub(r"\g<0>_", words)
