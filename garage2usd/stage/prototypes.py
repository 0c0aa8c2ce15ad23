"""Prototypes of a layout, one asset for each distinct shape, and the meshes of common shapes that are made ahead."""

import hashlib
import json
import zlib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from functools import lru_cache
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, TypeAdapter

from garage2usd.assets import Asset, Collider, Part, pascal_case
from garage2usd.assets.mesh import Pose
from garage2usd.common.errors import StageError
from garage2usd.common.progress import Progress, counted, silent
from garage2usd.layout import Layout
from garage2usd.objects import Spec
from garage2usd.objects.car import CarSpec
from garage2usd.objects.kind import Look

MESH_FILE = Path(__file__).with_name("meshes.npz")
_STEPS = {
    "points": 100_000,
    "face_counts": 1,
    "face_indices": 1,
    "normals": 10_000,
    "normal_indices": 1,
    "st": 100_000,
    "st_indices": 1,
}
"""Arrays of a part, with the rounding steps per unit that `garage2usd.assets.make_part` uses."""
_WIDTHS = {"points": 3, "normals": 3, "st": 2}
"""Numbers per row of two-dimensional arrays."""
_OWN_GROUP_NUMBERS = 8192
"""A shape with more numbers is stored in its own group, all others with the shapes of their class."""
_FLOAT = "<f4"
_LEVEL = 9
"""Compression level: files are written rarely and read often."""


class _Entry(NamedTuple):
    """An asset in the file.

    Attributes
    ----------
    paints
        Paints of the asset.
    parts
        Name, material, collider, piece and pose of each part.
    first
        Index of the first part among those of its group.
    """

    paints: dict[str, str]
    parts: Sequence[tuple[str, str, str | None, str, Sequence[float] | None]]
    first: int


class _Group(NamedTuple):
    """A group of assets, which are read together.

    Attributes
    ----------
    entries
        The assets by the keys of their shapes.
    arrays
        Each array of a part, concatenated over all parts.
    borders
        Start of each part in `arrays`, with the total lengths at the end; int64, shape (parts + 1, arrays).
    """

    entries: dict[str, _Entry]
    arrays: list[NDArray[Any]]
    borders: NDArray[np.int64]


def bake_meshes(shapes: Sequence[Spec], path: Path, *, progress: Progress = silent) -> None:
    """Compute the meshes of shapes without lights and write them to a NumPy ``.npz`` file; `progress` counts shapes.

    Notes
    -----
    The file holds names and end offsets of the groups, then each compressed on its own: builds read what they need.
    """
    groups: dict[str, list[tuple[str, Asset]]] = {}
    for key, shape in counted("shapes", sorted((_key(each), each) for each in shapes), len(shapes), progress):
        asset, name = shape.asset(), type(shape).__name__
        numbers = sum(getattr(part, array).size for part in asset.parts for array in _STEPS)
        groups.setdefault(_own_group(name, key) if numbers > _OWN_GROUP_NUMBERS else name, []).append((key, asset))
    packed = {name: zlib.compress(_packed(assets), _LEVEL) for name, assets in sorted(groups.items())}
    np.savez(
        path,
        names=np.frombuffer(json.dumps([*packed]).encode(), dtype=np.uint8),
        ends=np.cumsum([len(data) for data in packed.values()], dtype=np.int64),
        groups=np.frombuffer(b"".join(packed.values()), dtype=np.uint8),
    )


def _packed(assets: Sequence[tuple[str, Asset]]) -> bytes:
    """Serialise a group: a line of JSON with assets and array types, the lengths of arrays, and the arrays.

    Arrays are integer multiples of their step in the smallest integer type, or floats if they are not, such as the
    points of turned wheels. They are stored column by column, and by the significance of bytes, which compresses
    better.
    """
    entries: dict[str, _Entry] = {}
    parts: list[Part] = []
    for key, asset in assets:
        kept = [(part.name, part.material, part.collider, part.piece, part.pose) for part in asset.parts]
        entries[key] = _Entry(dict(asset.paints), kept, first=len(parts))
        parts += asset.parts
    columns = {name: [getattr(part, name) for part in parts] for name in _STEPS}
    lengths = np.array([[len(array) for array in column] for column in columns.values()], dtype=np.int32).T
    types, arrays = [], []
    for name, column in columns.items():
        whole = np.concatenate(column)
        steps = np.rint(whole.astype(np.float64) * _STEPS[name]).astype(np.int32)
        is_exact = (_of_steps(name, steps) == whole).all()
        bounds = [np.min_scalar_type(bound) for bound in (steps.min(initial=0), steps.max(initial=0))]
        types.append(np.result_type(*bounds).newbyteorder("<").str if is_exact else _FLOAT)
        stored = np.ascontiguousarray((steps if is_exact else whole).T, dtype=types[-1])
        arrays.append(stored.view(np.uint8).reshape(stored.size, stored.itemsize).T.tobytes())
    head = json.dumps({"entries": entries, "types": types}).encode()
    return b"".join([head, b"\n", lengths.astype("<i4").tobytes(), *arrays])


def _unpacked(data: bytes) -> _Group:
    """Deserialise a group, the inverse of `_packed`."""
    head, _, body = data.partition(b"\n")
    said = json.loads(head)
    entries = {key: _Entry(*entry) for key, entry in said["entries"].items()}
    parts = sum(len(entry.parts) for entry in entries.values())
    lengths = np.frombuffer(body, "<i4", parts * len(_STEPS)).reshape(parts, len(_STEPS))
    borders = np.zeros((parts + 1, len(_STEPS)), dtype=np.int64)
    lengths.cumsum(axis=0, out=borders[1:])
    end, arrays = lengths.nbytes, []
    for (name, length), kind in zip(zip(_STEPS, borders[-1].tolist(), strict=True), said["types"], strict=True):
        width = _WIDTHS.get(name, 1)
        size = np.dtype(kind).itemsize
        stored = np.frombuffer(body, np.uint8, length * width * size, offset=end).reshape(size, length * width)
        steps = np.ascontiguousarray(stored.T).view(kind).ravel()
        end += stored.nbytes
        rows = steps.reshape(width, length).T if name in _WIDTHS else steps
        array = np.ascontiguousarray(rows) if kind == _FLOAT else _of_steps(name, rows)
        array.flags.writeable = False  # read-only, as all users of an asset share its arrays
        arrays.append(array)
    return _Group(entries, arrays, borders)


def _of_steps(name: str, steps: NDArray[Any]) -> NDArray[Any]:
    """Convert an array from integer steps to floats, rounded like `make_part` does."""
    if name not in _WIDTHS:
        return steps.astype(np.int32)
    if name == "normals":
        return np.ascontiguousarray(steps.astype(np.float32) / np.float32(_STEPS[name]))
    return np.ascontiguousarray((steps / _STEPS[name]).astype(np.float32))


def baked_asset(shape: Spec) -> Asset | None:
    """Return the precomputed meshes of a shape, equal to its method `asset`; None if it has none."""
    key = _key(shape)
    group = type(shape).__name__
    baked = _group(_own_group(group, key)) or _group(group)
    entry = baked.entries.get(key) if baked else None
    if baked is None or entry is None:
        return None
    parts = []
    for number, (name, material, collider, piece, pose) in enumerate(entry.parts, entry.first):
        spans = zip(_STEPS, baked.arrays, *baked.borders[number : number + 2].tolist(), strict=True)
        arrays: dict[str, Any] = {of: array[start:end] for of, array, start, end in spans}
        touched = None if collider is None else Collider(collider)
        placed = None if pose is None else Pose(*pose)
        parts.append(Part(name=name, material=material, collider=touched, piece=piece, pose=placed, **arrays))
    return Asset(tuple(parts), paints=entry.paints)


def baked_shapes() -> Iterator[Spec]:
    """Yield the shapes with precomputed meshes.

    Raises
    ------
    StageError
        If a class of shapes was renamed or its fields have changed.
    """
    classes = {cls.__name__: cls for cls in _subclasses(Spec)}  # type: ignore[type-abstract]
    for key in chain.from_iterable(group.entries for group in map(_group, _packed_groups()) if group):
        name, measures = json.loads(key)
        try:
            shape = TypeAdapter(classes[name]).validate_python(measures)
        except (KeyError, ValueError):
            raise StageError(MESH_FILE, f"there is no such shape any longer: {key}") from None
        yield shape


@lru_cache(maxsize=1)
def _packed_groups() -> dict[str, bytes]:
    """Compressed groups by name, in the format of `_packed`."""
    with np.load(MESH_FILE) as file:
        names, ends, groups = json.loads(file["names"].tobytes()), file["ends"].tolist(), file["groups"].tobytes()
    return {name: groups[start:end] for name, start, end in zip(names, [0, *ends[:-1]], ends, strict=True)}


@lru_cache(maxsize=1024)
def _group(name: str) -> _Group | None:
    """Read a group of assets; None if the file has no such group."""
    packed = _packed_groups().get(name)
    return None if packed is None else _unpacked(zlib.decompress(packed))


def _own_group(group: str, key: str) -> str:
    """Name of the group of a shape that is stored separately."""
    return f"{group}-{hashlib.blake2b(key.encode(), digest_size=8).hexdigest()}"


def _key(shape: Spec) -> str:
    """Key of a shape: its class and its fields as JSON, which restores every number exactly."""
    return json.dumps([type(shape).__name__, shape], default=_measures)


def _measures(value: Any) -> dict[str, object]:  # noqa: ANN401 - of any dataclass, or of settings
    if isinstance(value, BaseModel):
        return dict(value)
    return {field.name: getattr(value, field.name) for field in fields(value)}


def _subclasses(cls: type[Spec]) -> Iterator[type[Spec]]:
    for subclass in cls.__subclasses__():
        yield subclass
        yield from _subclasses(subclass)


class Prototype(NamedTuple):
    """The asset of a spec, and its variant choices.

    Attributes
    ----------
    name
        Name of the asset in this garage.
    file
        Name of its file, the same in every garage; empty for an asset in the garage's own layer.
    look
        (variant set, variant) pairs that an instance selects.
    """

    name: str
    file: str
    look: Look = ()

    def place(self, asset_folder: str, own_assets: str) -> tuple[str, str]:
        """Layer of the prototype and the name of its prim there, empty for the layer's default prim.

        Both arguments are paths as used by the referring layer.
        """
        return (f"{asset_folder}/{self.file}", "") if self.file else (own_assets, self.name)


def name_prototypes(layout: Layout, files: Mapping[Spec, str]) -> dict[Spec, Prototype]:
    """Name the distinct shapes of a layout, numbered by kind in the order of their first placement.

    Parameters
    ----------
    layout
        The objects.
    files
        Name of the file of each shape; all other shapes are in the garage's own layer of assets.

    Returns
    -------
    dict
        Prototype by spec; asset names are PascalCase: ``Floor_03``, ``Column_01``, ``Car_02``.
    """
    names: dict[Spec, str] = {}
    prototypes: dict[Spec, Prototype] = {}
    counts: Counter[str] = Counter()
    for spec in layout.placements.specs:
        shape = spec.shape
        if shape not in names:
            kind = pascal_case(spec.kind.name)
            counts[kind] += 1
            names[shape] = f"{kind}_{counts[kind]:02d}"
        prototypes[spec] = Prototype(names[shape], files.get(shape, ""), spec.look)
    return prototypes


def asset_of(spec: Spec) -> Asset:
    """Return the meshes of a spec's shape, precomputed or cached."""
    return _asset_of_shape(spec.shape)


@lru_cache(maxsize=4096)
def _asset_of_shape(shape: Spec) -> Asset:
    asset = baked_asset(shape)
    if asset is None and isinstance(shape, CarSpec) and (plain := baked_asset(shape.plain)) is not None:
        asset = shape.asset_from(plain)  # making the body takes ten times as long
    return asset or shape.asset()
