"""nuScenes tables under construction."""

import hashlib
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

__all__ = ["Record", "Tables", "place_fields", "token_of"]

Record = dict[str, Any]


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
