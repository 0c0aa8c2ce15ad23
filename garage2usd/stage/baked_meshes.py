"""Meshes that are made ahead: those of the shapes that many garages have, in a file that the package ships."""

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import fields
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import TypeAdapter

from garage2usd.assets import Asset, Collider, Part
from garage2usd.errors import StageError
from garage2usd.objects import Spec

__all__ = ["MESH_FILE", "bake_meshes", "baked_asset", "baked_shapes"]

MESH_FILE = Path(__file__).with_name("meshes.npz")
_ARRAYS = ("points", "face_counts", "face_indices", "normals", "normal_indices", "st", "st_indices")
"""Of a part."""


class _Entry(NamedTuple):
    """An asset in the file.

    Attributes
    ----------
    paints
        As the asset has them.
    parts
        Name, material, collider and piece of each part.
    first
        Number of the first part among those of all assets.
    """

    paints: dict[str, str]
    parts: Sequence[tuple[str, str, str | None, str]]
    first: int


class _Baked(NamedTuple):
    """What the file holds.

    Attributes
    ----------
    entries
        The assets by the keys of their shapes.
    arrays
        Each array of a part, of all parts one after the other.
    borders
        Where in `arrays` each part begins and the last one ends; int64, shape (parts + 1, arrays).
    """

    entries: dict[str, _Entry]
    arrays: list[NDArray[Any]]
    borders: NDArray[np.int64]


def bake_meshes(shapes: Iterable[Spec], path: Path) -> None:
    """Make the meshes of shapes that give no light and write them to a file, in NumPy's format ``.npz``."""
    index: dict[str, _Entry] = {}
    parts: list[Part] = []
    for key, shape in sorted((_key(shape), shape) for shape in shapes):
        asset = shape.asset()
        kept = [(part.name, part.material, part.collider, part.piece) for part in asset.parts]
        index[key] = _Entry(dict(asset.paints), kept, first=len(parts))
        parts += asset.parts
    columns = {name: [getattr(part, name) for part in parts] for name in _ARRAYS}
    np.savez_compressed(
        path,
        index=np.frombuffer(json.dumps(index).encode(), dtype=np.uint8),
        lengths=np.array([[len(array) for array in column] for column in columns.values()], dtype=np.int32).T,
        **{name: np.concatenate(column) for name, column in columns.items()},
    )


def baked_asset(shape: Spec) -> Asset | None:
    """The meshes of a shape as its method `asset` makes them; None where they are not made ahead."""
    baked = _baked()
    entry = baked.entries.get(_key(shape))
    if entry is None:
        return None
    parts = []
    for number, (name, material, collider, piece) in enumerate(entry.parts, entry.first):
        spans = zip(_ARRAYS, baked.arrays, *baked.borders[number : number + 2].tolist(), strict=True)
        arrays: dict[str, Any] = {of: array[start:end] for of, array, start, end in spans}
        touched = None if collider is None else Collider(collider)
        parts.append(Part(name=name, material=material, collider=touched, piece=piece, **arrays))
    return Asset(tuple(parts), paints=entry.paints)


def baked_shapes() -> Iterator[Spec]:
    """The shapes whose meshes are made ahead.

    Raises
    ------
    StageError
        If a class of shapes was renamed or has other measures by now.
    """
    classes = {cls.__name__: cls for cls in _subclasses(Spec)}  # type: ignore[type-abstract]
    for key in _baked().entries:
        name, measures = json.loads(key)
        try:
            shape = TypeAdapter(classes[name]).validate_python(measures)
        except (KeyError, ValueError):
            raise StageError(MESH_FILE, f"there is no such shape any longer: {key}") from None
        yield shape


@lru_cache(maxsize=1)
def _baked() -> _Baked:
    with np.load(MESH_FILE) as file:
        entries = {key: _Entry(*entry) for key, entry in json.loads(file["index"].tobytes()).items()}
        lengths, arrays = file["lengths"], [file[name] for name in _ARRAYS]
    for array in arrays:
        array.flags.writeable = False  # all users of an asset share it
    borders = np.concatenate([np.zeros_like(lengths[:1]), lengths]).cumsum(axis=0, dtype=np.int64)
    return _Baked(entries, arrays, borders)


def _key(shape: Spec) -> str:
    """The class of a shape and its measures as JSON, which gives each number back as it was."""
    return json.dumps([type(shape).__name__, shape], default=_measures)


def _measures(value: Any) -> dict[str, object]:  # noqa: ANN401 - of any dataclass
    return {field.name: getattr(value, field.name) for field in fields(value)}


def _subclasses(cls: type[Spec]) -> Iterator[type[Spec]]:
    for subclass in cls.__subclasses__():
        yield subclass
        yield from _subclasses(subclass)
