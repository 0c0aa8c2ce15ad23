"""The user's car models: a folder of files, each measured, with front, wheels and plates detected or given."""
# Over 300 lines: the given facts of a model, the detection of the others, and the validation belong together.

import hashlib
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, field_validator

from garage2usd.common.documents import read_toml
from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings, validated
from garage2usd.common.spelling import nearest
from garage2usd.config.vehicles import CAR_BODIES, CarBody, VehicleClass
from garage2usd.scenes.gltf_file import GLTF_SUFFIXES

if TYPE_CHECKING:  # reading models imports USD, and few garages have any
    from garage2usd.scenes.foreign_models import ForeignPart

FIELD = "vehicles.models"
MODEL_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz", *GLTF_SUFFIXES)
"""Extensions of model files."""
FACTS_FILE = "models.toml"
_MOST_MODELS = 500
_LENGTH_M, _WIDTH_M, _HEIGHT_M = (2.0, 7.0), (1.2, 2.6), (1.0, 3.0)
"""Least and largest measures; the width is without mirrors."""
_RADIUS_M, _ON_FLOOR_M, _ROUND, _WIDEST_WHEEL_M = (0.2, 0.55), 0.08, 0.12, 0.6
_PLATE_HALF_M = (0.26, 0.055)
_PLATE_HEIGHTS_M = (0.5, 0.45, 0.55, 0.6, 0.4, 0.7, 0.8, 0.9)
_PLATE_LIFT_M = 0.004
_THIN_M = 0.005
"""Extent of parts that are flat as seen from above, such as the glass of a mirror."""
_FRONT_WORDS = re.compile(r"(?i)front|head_?(lamp|light)|bonnet|hood|windscreen|windshield|grill|steering")
_REAR_WORDS = re.compile(r"(?i)rear|back|tail|trunk|boot|exhaust|brake_?(lamp|light)|tow")
_MIRROR_WORDS = re.compile(r"(?i)(wing|side|door|outer|outside|_|^|/)_?mirror")
_MIRRORS_SHARE = 0.35
"""Distance of the mirrors from the nose as a share of a car's length, if no mirrors are found."""
_AXES = {"+X": (1, 0, 0), "-X": (-1, 0, 0), "+Y": (0, 1, 0), "-Y": (0, -1, 0), "+Z": (0, 0, 1), "-Z": (0, 0, -1)}


Named = Annotated[str, Field(min_length=1)]


class ModelFolder(Settings):
    """The user's car models: a folder of files, or files."""

    folder: Named | Annotated[tuple[Named, ...], Field(min_length=1)]
    """A folder with files of USD or GLB, one car each; one such file, or a list of files. A relative path starts at the
    configuration file."""
    sha256: str = Field("", pattern=r"^([0-9a-f]{64})?$")
    """Digest of all files used from the folder; computed when the folder is read."""


def folder_of(models: object) -> object:
    """Return the table of a setting that may also be a folder, a file or a list of files.

    Raises
    ------
    ValueError
        For values of another type.
    """
    if isinstance(models, str | list | tuple):
        return {"folder": models}
    if models is None or isinstance(models, Mapping | ModelFolder):
        return models
    raise ValueError(f"a folder, or a file that ends in {', '.join(MODEL_SUFFIXES)}, or a list of files")


class _Facts(Settings):
    """Facts on a model from ``models.toml``."""

    front: Annotated[str, Field(pattern=r"^[+-][XYZ]$")] | None = None
    """Axis of the file along which the nose points."""
    length_m: float | None = Field(None, ge=_LENGTH_M[0], le=_LENGTH_M[1])
    """Length to which the model is scaled."""
    wheelbase_m: float | None = Field(None, ge=1.2, le=5.0)
    front_overhang_m: float | None = Field(None, ge=0.2, le=2.0)
    wheel_radius_m: float | None = Field(None, ge=_RADIUS_M[0], le=_RADIUS_M[1])
    """Wheel radius; given together with wheelbase and front overhang if no wheels are detected."""
    plate_heights_m: tuple[float, float] | None = None
    """Heights above the floor of the centres of front and rear plate."""
    semantic_class: VehicleClass = VehicleClass.CAR
    """Semantic class in labels, point clouds and masks."""


@dataclass(frozen=True, kw_only=True)
class OwnCar(CarBody):
    """A car model of the user: its measures, detected or given, and the location of its meshes.

    Attributes
    ----------
    path, sha256
        The file, and a digest of it and of all files that it refers to.
    to_car
        Matrix rows, shape (3, 3), then an offset in metres: row vectors of the file, in metres and Y up, are multiplied
        and shifted into the axes of a parked car.
    outlines
        Convex outlines (x, z) in metres of the body and, if known, of the mirrors.
    remarks
        Lines on the parts and properties of the model that are ignored or changed, one for each kind.
    """

    path: str
    sha256: str
    to_car: tuple[tuple[float, float, float], ...]
    outlines: tuple[tuple[tuple[float, float], ...], ...]
    remarks: tuple[str, ...] = field(default=(), compare=False, repr=False)

    @property
    def measures(self) -> CarBody:
        """The car's measures, without its file."""
        return CarBody(**{each.name: getattr(self, each.name) for each in fields(CarBody)})


class VehiclesConfig(Settings):
    """Settings of the user's car models."""

    models: ModelFolder | None = None
    """A folder of models as USD or GLB, a file, or a list of files (see the guide on own cars)."""
    share: float = Field(0.5, ge=0, le=1)
    """Share of the parked cars that are models of the user, where one fits."""

    @field_validator("models", mode="before")
    @classmethod
    def _folder(cls, models: object) -> object:
        return folder_of(models)

    @field_validator("models")
    @classmethod
    def _read(cls, models: ModelFolder | None) -> ModelFolder | None:
        """Add a digest of the folder's contents; a folder that has a digest is read on use."""
        return read_own_cars(models)[0] if models is not None and not models.sha256 else models


def read_own_cars(folder: ModelFolder) -> tuple[ModelFolder, tuple[OwnCar, ...]]:
    """Read the cars of a folder, sorted by name, and add a digest of their files to the folder.

    Raises
    ------
    ConfigError
        If a file cannot be read or is not a car, or the files do not match the folder's digest.
    """
    given = (folder.folder,) if isinstance(folder.folder, str) else folder.folder
    title = ", ".join(given)
    models: list[str] = []
    stamps: list[tuple[str, int, int]] = []
    for place in map(Path, given):
        is_folder = place.is_dir()
        try:
            files = sorted(place.iterdir()) if is_folder else [place]
            beside = sorted(islice((place if is_folder else place.parent).rglob("*"), 20_000))
            stamps += [(str(path), path.stat().st_size, path.stat().st_mtime_ns) for path in beside]
            if not is_folder:
                place.stat()
        except (OSError, ValueError) as error:
            reason = (error.strerror if isinstance(error, OSError) else None) or error
            raise ConfigError(
                FIELD, str(place), f"a folder that can be read, or a file of a model ({reason})"
            ) from None
        # programs of other systems leave hidden files beside the visible ones
        models += [str(path) for path in files if _is_model(path) and not (is_folder and path.name.startswith("."))]
    if not 0 < len(models) <= _MOST_MODELS:
        allowed = f"1 to {_MOST_MODELS} files that end in {', '.join(MODEL_SUFFIXES)}"
        raise ConfigError(FIELD, f"{title} with {len(models)}", allowed)
    cars = _read(tuple(models), tuple(stamps))
    told = [replace(car, path="") for car in cars]
    digest = hashlib.sha256(repr(told).encode()).hexdigest()
    if folder.sha256 not in {"", digest}:
        raise ConfigError(FIELD, title, f"the models that it was given with, of SHA-256 {folder.sha256[:16]}")
    return ModelFolder(folder=folder.folder, sha256=digest), cars


def cars_by_name(folder: ModelFolder | None) -> dict[str, CarBody]:
    """Return the catalogue of cars by name, extended by the models of a folder under their file stems.

    A model replaces the body of the catalogue with the same name.

    Raises
    ------
    ConfigError
        As `read_own_cars`.
    """
    own = read_own_cars(folder)[1] if folder else ()
    return {body.name: body for body in CAR_BODIES} | {Path(car.path).stem: car for car in own}


def _is_model(path: Path) -> bool:
    return path.suffix.lower() in MODEL_SUFFIXES and path.is_file()


@lru_cache(maxsize=16)
def _read(models: tuple[str, ...], stamps: tuple[tuple[str, int, int], ...]) -> tuple[OwnCar, ...]:
    """Read the cars of some files, cached until one of the files beside them changes."""
    del stamps
    paths = [Path(model) for model in models]
    names = [path.stem for path in paths]
    for name in names:
        if names.count(name) > 1:
            raise ConfigError(FIELD, name, "one file of each name")
    facts = {
        folder: _facts(folder, [path.stem for path in paths if path.parent == folder])
        for folder in dict.fromkeys(path.parent for path in paths)
    }
    return tuple(_car(path, facts[path.parent].get(path.stem, _Facts())) for path in paths)


def _facts(folder: Path, names: Sequence[str]) -> dict[str, _Facts]:
    """Read the facts on the models of a folder; those on models that are not used are left out."""
    path = folder / FACTS_FILE
    if not path.is_file():
        return {}
    facts = {}
    for name, given in read_toml(path, field=FIELD).items():
        others = [each.stem for each in folder.iterdir() if _is_model(each)]
        if name not in [*names, *others] or not isinstance(given, Mapping):
            allowed = f"tables named as the models are: {', '.join(names)}{nearest(name, names)}"
            raise ConfigError(f"{FIELD}.{name}", str(path), allowed)
        facts[name] = validated(_Facts, given, within=f"{FIELD}.{name}")
    return facts


def placed_parts(car: OwnCar) -> "tuple[ForeignPart, ...]":
    """Return the parts of a car in its own axes: origin in the centre of its footprint on the floor, nose along -Z.

    Raises
    ------
    ConfigError
        If the file cannot be read, or has changed since the settings were read.
    """
    from garage2usd.scenes.foreign_models import model_digest, read_model  # noqa: PLC0415 - as above

    path = Path(car.path)
    if model_digest(path, field=FIELD) != car.sha256:
        raise ConfigError(FIELD, car.path, "a file that stays as it was when the settings were read")
    *rows, offset = np.array(car.to_car)
    turn = np.array(rows) / np.linalg.norm(rows, axis=1, keepdims=True)
    return tuple(
        replace(
            part,
            triangles_m=part.triangles_m @ np.array(rows) + offset,
            normals=None if part.normals is None else part.normals @ turn,
        )
        for part in read_model(path, field=FIELD).parts
    )


def _car(path: Path, facts: _Facts) -> OwnCar:
    from garage2usd.scenes.foreign_models import model_digest, read_model  # noqa: PLC0415 - as above

    digest = model_digest(path, field=FIELD)
    parts, remarks = read_model(path, field=FIELD)
    turn = _turn(path, parts, facts)
    turned = [part.triangles_m.reshape(-1, 3) @ turn for part in parts]
    is_mirror = [bool(_MIRROR_WORDS.search(part.name)) for part in parts]
    every = np.concatenate(turned)
    shell = np.concatenate([points for points, mirror in zip(turned, is_mirror, strict=True) if not mirror] or turned)
    low, high = shell.min(axis=0), shell.max(axis=0)
    if facts.length_m and not (high - low)[2] > 0:
        raise ConfigError(FIELD, f"{path} of 0 m", "cars with a length")
    scale = facts.length_m / (high - low)[2] if facts.length_m else 1.0
    middle = (low + high) / 2
    offset = -scale * np.array([middle[0], every[:, 1].min(), middle[2]])
    size = np.round(scale * (high - low), 4)
    for name, found, (least, most) in zip(
        ("wide", "high", "long"), size.tolist(), (_WIDTH_M, _HEIGHT_M, _LENGTH_M), strict=True
    ):
        if not least <= found <= most:
            raise ConfigError(FIELD, f"{path} of {found:.2f} m", f"cars {least} to {most} m {name}, by length_m too")
    placed = [points * scale + offset for points in turned]
    wheelbase, overhang, radius = _axles(path, placed, facts, float(size[2]))
    whole = np.concatenate(placed)
    overall = max(2 * float(np.abs(whole[:, 0]).max()), float(size[0]))
    if overall > _WIDTH_M[1] + 0.4:
        raise ConfigError(FIELD, f"{path} of {overall:.2f} m over its mirrors", f"at most {_WIDTH_M[1] + 0.4:.1f} m")
    triangles = whole.reshape(-1, 3, 3)
    heights = facts.plate_heights_m or (None, None)
    plates = tuple(_plate(triangles, toward, height) for toward, height in zip((-1, 1), heights, strict=True))
    groups = [[p for p, m in zip(placed, is_mirror, strict=True) if m is wanted] for wanted in (False, True)]
    return OwnCar(
        name=f"own_{re.sub(r'[^a-z0-9]+', '_', path.stem.lower()).strip('_') or 'car'}_{digest[:8]}",
        length_m=float(size[2]),
        width_m=float(size[0]),
        height_m=float(size[1]),
        overall_width_m=round(overall, 4),
        wheelbase_m=wheelbase,
        front_overhang_m=overhang,
        wheel_radius_m=radius,
        mirrors_m=_mirrors(placed, is_mirror, float(size[2])),
        segment="",
        plates=plates,
        semantic_class=facts.semantic_class,
        path=str(path),
        sha256=digest,
        to_car=tuple(_row(row) for row in (*np.round(turn * scale, 9), np.round(offset, 6))),
        outlines=tuple(_hull(np.concatenate(group)) for group in groups if group),
        remarks=tuple(f"{path.name}: {line}" for line in remarks),
    )


def _row(values: NDArray[np.float64]) -> tuple[float, float, float]:
    x, y, z = (float(value) + 0.0 for value in values)
    return x, y, z


def _mirrors(placed: Sequence[NDArray[np.float64]], is_mirror: Sequence[bool], length_m: float) -> float:
    """Distance in metres from the nose to the centre of the mirrors; the usual one if no mirrors are found."""
    mirrors = [points for points, is_one in zip(placed, is_mirror, strict=True) if is_one]
    if not mirrors:
        return round(_MIRRORS_SHARE * length_m, 4)
    every = np.concatenate(mirrors)[:, 2]
    return round(length_m / 2 + float(every.min() + every.max()) / 2, 4)


def _turn(path: Path, parts: "Sequence[ForeignPart]", facts: _Facts) -> NDArray[np.float64]:
    """Rotation matrix for row vectors, in metres and Y up, that turns the nose to -Z; shape (3, 3)."""
    points = np.concatenate([part.triangles_m.reshape(-1, 3) for part in parts])
    spans = points.max(axis=0) - points.min(axis=0)
    along = 0 if spans[0] > spans[2] else 2
    nose = np.zeros(3)
    if facts.front:
        nose = np.array(_AXES[facts.front], dtype=np.float64)
        if parts[0].is_z_up:
            nose = nose[[0, 2, 1]] * (1, 1, -1)
        if not nose[along]:
            raise ConfigError(f"{FIELD}.{path.stem}.front", facts.front, "an axis along the length of the model")
    else:
        middle = (points.max(axis=0) + points.min(axis=0))[along] / 2
        told = 0.0
        for part in parts:
            sign = bool(_FRONT_WORDS.search(part.name)) - bool(_REAR_WORDS.search(part.name))
            told += sign * float(np.sign(round(float(part.triangles_m[..., along].mean() - middle), 3)))
        if not told:
            allowed = f"names of parts that tell front and rear, or front = '+X' and the like in {FACTS_FILE}"
            raise ConfigError(FIELD, f"{path} without a front", allowed)
        nose[along] = np.sign(told)
    right = np.cross(nose, (0.0, 1.0, 0.0))
    return np.stack([right, (0.0, 1.0, 0.0), -nose], axis=1)


def _axles(path: Path, placed: Sequence[NDArray[np.float64]], facts: _Facts, length_m: float) -> tuple[float, ...]:
    """Wheelbase, front overhang and wheel radius in metres."""
    given = facts.wheelbase_m, facts.front_overhang_m, facts.wheel_radius_m
    known = [value for value in given if value is not None]
    if len(known) == len(given):
        if known[0] + known[1] >= length_m:
            raise ConfigError(f"{FIELD}.{path.stem}.wheelbase_m", known[0], f"axles within {length_m:.2f} m")
        return tuple(known)
    # a part may be one wheel, or all of them
    boxes = [box for points in placed for box in (_Box(points.min(axis=0), points.max(axis=0)), *_pieces(points))]
    wheels: dict[tuple[int, int], _Box] = {}
    for box in sorted(filter(_is_wheel, boxes), key=lambda box: box.high[1] - box.low[1]):
        x, _, z = (box.low + box.high) / 2
        wheels[int(np.sign(x)), int(np.sign(z))] = box  # the largest: a rim is within its tyre
    found = [corner for corner in wheels if all(corner)]
    if len(found) < 4:  # noqa: PLR2004 - wheels of a car
        allowed = f"four wheels on the floor, or wheelbase_m, front_overhang_m and wheel_radius_m in {FACTS_FILE}"
        raise ConfigError(FIELD, f"{path} with {len(found)} wheels", allowed)
    middles = {corner: float((wheels[corner].low + wheels[corner].high)[2] / 2) for corner in found}
    front, rear = (round((middles[-1, end] + middles[1, end]) / 2, 4) for end in (-1, 1))
    radius = round(float(wheels[-1, -1].high[1] - wheels[-1, -1].low[1]) / 2, 4)
    return round(rear - front, 4), round(front + length_m / 2, 4), radius


class _Box(NamedTuple):
    """An axis-aligned box by its lowest and highest corner, each of shape (3,)."""

    low: NDArray[np.float64]
    high: NDArray[np.float64]


def _is_wheel(box: _Box) -> bool:
    wide, high, long = box.high - box.low
    is_round = abs(high - long) <= _ROUND * high and 2 * _RADIUS_M[0] <= high <= 2 * _RADIUS_M[1]
    return bool(is_round and wide <= _WIDEST_WHEEL_M and box.low[1] <= _ON_FLOOR_M)


def _pieces(points: NDArray[np.float64]) -> list[_Box]:
    """Boxes of the connected components of a mesh, from the corners of its triangles, shape (3 n, 3)."""
    # imported on use: SciPy is slow to import, and few garages use own models
    from scipy.sparse import coo_array  # noqa: PLC0415
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    _, which = np.unique(np.round(points, 4), axis=0, return_inverse=True)
    corners = which.reshape(-1, 3)
    pairs = np.concatenate([corners[:, :2], corners[:, 1:]])
    count = int(corners.max()) + 1
    links = coo_array((np.ones(len(pairs), dtype=np.int8), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    number, label = connected_components(links, directed=False)
    low, high = np.full((number, 3), np.inf), np.full((number, 3), -np.inf)
    of_corner = label[which.ravel()]
    np.minimum.at(low, of_corner, points)
    np.maximum.at(high, of_corner, points)
    return [_Box(*pair) for pair in zip(low, high, strict=True)]


def _plate(triangles: NDArray[np.float64], toward: int, height_m: float | None) -> tuple[float, float, float]:
    """Place a plate on the flattest part of nose or tail: direction along Z, and Y and Z of its centre in metres."""
    best = (np.inf, 0.0, 0.0)
    for height in _PLATE_HEIGHTS_M if height_m is None else (height_m,):
        half_x, half_y = _PLATE_HALF_M
        places = [(x, height + y) for x in (-half_x, 0.0, half_x) for y in (-half_y, 0.0, half_y)]
        hits = np.array([_outermost(triangles, place, toward) for place in places])
        spread = float(np.ptp(hits)) if np.isfinite(hits).all() else 1.0
        reach = float(np.max(toward * hits[np.isfinite(hits)], initial=-np.inf))
        if not np.isfinite(reach):
            reach = float(np.max(toward * triangles[..., 2]))
            spread = 2.0
        if spread < best[0] - 0.01:
            best = (spread, height, toward * reach)
    return float(toward), round(best[1], 4), round(best[2] + toward * _PLATE_LIFT_M, 4)


def _outermost(triangles: NDArray[np.float64], place: tuple[float, float], toward: int) -> float:
    """Z of the outermost surface on a line along Z at (x, y); NaN if there is none."""
    a, b, c = (triangles[:, corner] for corner in range(3))
    x, y = place
    area: NDArray[np.float64] = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1])
    of_b = (x - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (y - a[:, 1])
    of_c = (b[:, 0] - a[:, 0]) * (y - a[:, 1]) - (x - a[:, 0]) * (b[:, 1] - a[:, 1])
    with np.errstate(divide="ignore", invalid="ignore"):
        beta, gamma = of_b / area, of_c / area
        is_met = (np.abs(area) > 1e-9) & (beta >= 0) & (gamma >= 0) & (beta + gamma <= 1)  # noqa: PLR2004
        z = a[:, 2] + beta * (b[:, 2] - a[:, 2]) + gamma * (c[:, 2] - a[:, 2])
    return float(toward * (toward * z[is_met]).max()) if is_met.any() else np.nan


def _hull(points: NDArray[np.float64]) -> tuple[tuple[float, float], ...]:
    """Convex hull (x, z) of points, in the vertex order of `garage2usd.objects.kind.rectangle`."""
    from scipy.spatial import ConvexHull  # noqa: PLC0415 - as above

    flat = points[:, [0, 2]]
    if not np.ptp(flat, axis=0).all() or np.linalg.matrix_rank(flat - flat[0], tol=_THIN_M) < 2:  # noqa: PLR2004
        flat = np.concatenate([flat + np.array([x, z]) for x in (-_THIN_M, _THIN_M) for z in (-_THIN_M, _THIN_M)])
    corners = np.round(flat[ConvexHull(flat).vertices][::-1], 4)
    return tuple((float(x), float(z)) for x, z in corners)
