"""The tables of nuScenes as they are filled."""

import hashlib
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

__all__ = ["Record", "Tables", "place_fields", "token_of"]

Record = dict[str, Any]


class Tables:
    """Records by the names of their tables, as `records`."""

    def __init__(self) -> None:
        names = "attribute calibrated_sensor category ego_pose instance lidarseg log map sample sample_annotation"
        names += " sample_data scene sensor visibility"
        self.records: dict[str, list[Record]] = {name: [] for name in names.split()}

    def add(self, table: str, key: str, **fields: object) -> str:
        """Add a record; its token is made of the table and the key."""
        self.records[table].append({"token": token_of(table, key), **fields})
        return token_of(table, key)


def token_of(table: str, key: object) -> str:
    """The token of the record of a table that was added by a key."""
    return hashlib.md5(f"{table} {key}".encode(), usedforsecurity=False).hexdigest()


def place_fields(matrix: NDArray[np.float64]) -> Record:
    """A rigid move, shape (4, 4), as nuScenes writes it."""
    x, y, z, w = Rotation.from_matrix(matrix[:3, :3]).as_quat(canonical=True).tolist()
    return {"translation": matrix[:3, 3].tolist(), "rotation": [w, x, y, z]}
