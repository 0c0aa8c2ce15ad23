"""Poses, numbers and names in SDF."""

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable

import numpy as np
from scipy.spatial.transform import Rotation

from garage2usd.maps.xml_text import child, number_text
from garage2usd.scenes.prims import Matrix

_DIGITS = 6
_NOT_OF_NAMES = re.compile(r"[^\w\[\]-]+")


def add_pose(element: ET.Element, place: Matrix) -> None:
    """Add a rotation and a move, for column vectors with shape (4, 4), to an element; nothing for the identity."""
    move = numbers_text(place[:3, 3])
    turn = Rotation.from_matrix(place[:3, :3]).as_quat(canonical=True)
    if np.allclose(turn, (0, 0, 0, 1), atol=1e-9):
        if place[:3, 3].any():
            add_text(element, "pose", f"{move} 0 0 0")
        return
    add_text(element, "pose", f"{move} {' '.join(number_text(value) for value in turn)}", rotation_format="quat_xyzw")


def add_text(parent: ET.Element, tag: str, value: str | float, **attributes: str) -> None:
    """Add a child element with a text or number."""
    child(parent, tag, **attributes).text = value if isinstance(value, str) else number_text(value)


def numbers_text(values: Iterable[float]) -> str:
    """Format numbers to six decimals."""
    return " ".join(number_text(round(float(value), _DIGITS)) for value in values)


def sdf_name(path: str) -> str:
    """Return the path of a prim as a name in SDF, where slashes and double colons have a meaning of their own."""
    return _NOT_OF_NAMES.sub(".", path).strip(".")
