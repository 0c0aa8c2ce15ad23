"""nuScenes tables under construction, and nuScenes' categories of semantic classes."""

import hashlib
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from garage2usd.common.documents import shipped_toml
from garage2usd.objects import CLASSES
from garage2usd.reading.labels import Labels

Record = dict[str, Any]
_NOISE, _DRIVEABLE, _MANMADE, _OTHER = "noise", "flat.driveable_surface", "static.manmade", "static.other"
_TABLES = shipped_toml("garage2usd.sensors.formats", "nuscenes")
CATEGORIES = tuple(_TABLES["categories"])
"""Categories of nuScenes-lidarseg; the index in the list is the value in its files."""
BOXED: dict[str, str] = _TABLES["boxed"]
"""Semantic classes of objects with nuScenes boxes, and their categories."""
_PARTS = {"number_plate": "vehicle.car"}
"""Semantic classes of parts of boxed objects, and the categories of those objects."""
FLAT = frozenset(entry.label for entry in CLASSES if entry.cityscapes in {"road", "parking"})
"""Semantic classes of the ground and its paint."""
STANDING = frozenset({"wall", "column", "obstacle", "vehicle_door"})
"""Semantic classes of fixed objects that stand on the ground."""
_KNOWN = frozenset(entry.label for entry in CLASSES)


class Tables:
    """Records of nuScenes tables, by table name in `records`."""

    def __init__(self) -> None:
        names = "attribute calibrated_sensor category ego_pose instance lidarseg log map sample sample_annotation"
        names += " sample_data scene sensor visibility"
        self.records: dict[str, list[Record]] = {name: [] for name in names.split()}

    def add(self, table: str, key: str, **fields: object) -> str:
        """Add a record to a nuScenes table and return its token, made from table and key."""
        self.records[table].append({"token": token_of(table, key), **fields})
        return token_of(table, key)


def token_of(table: str, key: object) -> str:
    """Return the token of a nuScenes record, given its table and key."""
    return hashlib.md5(f"{table} {key}".encode(), usedforsecurity=False).hexdigest()


def place_fields(matrix: NDArray[np.float64]) -> Record:
    """Return a rigid transform, shape (4, 4), as nuScenes' translation and rotation fields."""
    x, y, z, w = Rotation.from_matrix(matrix[:3, :3]).as_quat(canonical=True).tolist()
    return {"translation": matrix[:3, 3].tolist(), "rotation": [w, x, y, z]}


def categories_of_classes(labels: Labels) -> NDArray[np.uint8]:
    """Return the nuScenes-lidarseg category index of each semantic class, indexed by class id."""
    table = np.full(256, CATEGORIES.index(_NOISE), dtype=np.uint8)
    for number, entry in labels.classes.items():
        name = (BOXED | _PARTS).get(entry.name) or (_DRIVEABLE if entry.name in FLAT else _MANMADE)
        table[number] = CATEGORIES.index(name if entry.name in _KNOWN else _OTHER)
    return table
