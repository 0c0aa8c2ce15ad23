"""Instances of a layout's objects as USDA text, number plates on cars, and prototypes of equal tiles."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice, pairwise

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.countries import Country
from garage2usd.assets.number_plates import PLATE_STYLES, plate_coordinates
from garage2usd.garage import Stall
from garage2usd.layout import Layout
from garage2usd.objects import KINDS, Spec
from garage2usd.objects.number_plate import KIND as NUMBER_PLATE
from garage2usd.objects.number_plate import NumberPlateSpec
from garage2usd.reading.labels import CAR_OF_PLATE, PLATE_TEXT
from garage2usd.stage.arrangement import Arrangement
from garage2usd.stage.authoring import (
    group_text,
    header_text,
    inherits_text,
    instance_text,
    place_text,
    pose_text,
    reference_text,
    rounded_deg,
    rounded_m,
)
from garage2usd.stage.prototypes import Prototype
from garage2usd.stage.variants import OCCUPIED_STALL, SWITCHES, occupied_text

CAR_OF_STALL = "garage:stall:car"
"""Relationship of a stall to the car parked in it."""
_SAME_PLACE_M = 1e-5
_SAME_YAW_RAD = 1e-6
_TILES_AT_ONCE = 4096
"""Number of tiles whose objects are compared at once, which limits memory."""
_SHARED = "instanceable = true\n"


def plate_text(text: str, car: str, country: Country = Country.NONE) -> str:
    """Text of the prim of a car's plates, without its place.

    Parameters
    ----------
    text
        Text on the plates.
    car
        Name of the car's prim, a sibling.
    country
        Country whose plate format is used.
    """
    return f'custom string {PLATE_TEXT} = "{text}"\ncustom rel {CAR_OF_PLATE} = <../{car}>\n{_letters(text, country)}'


@lru_cache(maxsize=1 << 12)
def _letters(text: str, country: Country) -> str:
    corners = ",".join(f"({u:.7g},{v:.7g})" for u, v in plate_coordinates(text, country).tolist())
    meshes = "".join(
        f'over "{name}"\n{{\ntexCoord2f[] primvars:st = [{corners}]\n}}\n' for name, _ in PLATE_STYLES[country].meshes
    )
    return f'over "Geom"\n{{\n{meshes}}}\n'


class InstanceWriter:
    """Writer of the instances of one layout.

    Parameters
    ----------
    layout, arrangement
        The objects, and the prim of each.
    prototypes
        Asset and variant choices of every spec in the layout.
    asset_folder, own_assets
        Folder of the assets and the garage's own layer of assets, as referred to by the target layer.
    classes
        Path of the classes from which objects with a switch, and stalls with a car, inherit.
    describe_stalls
        True to write the facts on stalls as attributes. Every stall has a relationship to its car.
    """

    def __init__(
        self,
        layout: Layout,
        arrangement: Arrangement,
        prototypes: Mapping[Spec, Prototype],
        asset_folder: str,
        own_assets: str,
        *,
        classes: str,
        describe_stalls: bool,
    ) -> None:
        self._objects = layout.placements
        self._arrangement = arrangement
        self._prototypes = [prototypes[spec] for spec in self._objects.specs]
        self._assets = asset_folder, own_assets
        self._classes = classes
        stalls, cars = self._objects.rows_of("stall"), layout.cars_in_stalls()
        self._stalls = dict(zip(stalls.tolist(), layout.quads, strict=True)) if describe_stalls else {}
        self._node_squares = layout.node_squares().tolist()
        self._car_of = np.full(len(self._objects), -1)
        self._car_of[stalls] = cars
        plates, wearers = layout.cars_with_plates()
        self._car_of[plates] = wearers
        self._parked = frozenset(layout.parked_motorbikes().tolist())
        self._headers: dict[tuple[int, int, bool, bool], str] = {}

    def texts(self, rows: NDArray[np.intp], origins_m: NDArray[np.float64] | float = 0.0) -> Iterator[str]:
        """Yield the instances of objects by row, each relative to an origin (x, z); origins have shape (n, 2)."""
        objects, names = self._objects, self._arrangement.names
        columns = (
            self._arrangement.name[rows],
            objects.kind[rows],
            objects.spec[rows],
            self._car_of[rows],
        )
        local = objects.position_m[rows]
        local[:, [0, 2]] -= origins_m
        positions = rounded_m(local)
        yaws = rounded_deg(objects.yaw_rad[rows])
        for row, name, kind, spec, car, (x, y, z), yaw in zip(
            rows.tolist(), *(column.tolist() for column in columns), positions, yaws, strict=True
        ):
            stall, shape, has_car = self._stalls.get(row), objects.specs[spec], car >= 0
            is_taken = stall is not None and (has_car or stall.blocked_by is not None)
            is_parked = row in self._parked
            header = self._headers.get((kind, spec, is_taken, is_parked)) or self._header(
                kind, spec, is_taken=is_taken, is_parked=is_parked
            )
            prim = names[name].decode("ascii")
            said = "" if stall is None else _stall_text(stall, self._node_squares[stall.access], is_taken=is_taken)
            if has_car:
                car_name = names[self._arrangement.name[car]].decode("ascii")
                if isinstance(shape, NumberPlateSpec):
                    said += plate_text(shape.text, car_name, shape.country)
                else:
                    said += f"custom rel {CAR_OF_STALL} = <../{car_name}>\n"
            if said:
                yield instance_text(prim, header, pose_text(x, y, z, yaw), said)
            else:
                yield _placed_text(prim, header, x, y, z, yaw)

    def _header(self, kind: int, spec: int, *, is_taken: bool, is_parked: bool) -> str:
        prototype = self._prototypes[spec]
        # the variant of cars also switches motorbikes in stalls, but not those of the clutter
        switch = SWITCHES.get("car" if is_parked else KINDS[kind].name)
        name = OCCUPIED_STALL if is_taken else switch.class_name if switch else None
        base = f"{self._classes}/{name}" if name else None
        layer, root = prototype.place(*self._assets)
        if KINDS[kind] is NUMBER_PLATE:
            # attributes below a prim prevent instancing; objects of the same asset share one header
            header = reference_text(layer, root, base=base)
        else:
            header = header_text(layer, root, look=prototype.look, base=base)
        self._headers[kind, spec, is_taken, is_parked] = header
        return header


@lru_cache(maxsize=1 << 14)
def _placed_text(name: str, header: str, x: float, y: float, z: float, yaw_deg: float) -> str:
    """Text of an instance without attributes, cached because most tiles of a large garage have equal objects."""
    return instance_text(name, header, pose_text(x, y, z, yaw_deg))


def _shape_text(stall: Stall) -> str:
    """Text with kind, angle and size class of a stall, unless it is perpendicular and of the standard size."""
    if stall.is_usual:
        return ""
    return (
        f'custom token garage:stall:kind = "{stall.kind.value}"\n'
        f"custom float garage:stall:angleRad = {round(math.radians(stall.slant_deg), 6)}\n"
        f'custom token garage:stall:size = "{stall.size}"\n'
    )


def _stall_text(stall: Stall, access_square: tuple[int, int], *, is_taken: bool) -> str:
    """Text with the facts on a stall as attributes of its prim; corners are (x, z) in world coordinates.

    Occupancy comes from the inherited class, as variants of the garage remove the cars.
    """
    corners = ",".join(f"({x:.10g},{z:.10g})" for x, z in stall.corners)
    facts, (access_row, access_column) = dict(stall.facts), access_square
    number = str(stall.number or "").replace("\\", "\\\\").replace('"', '\\"')
    kind, row, column, edge = (facts[name] for name in ("type", "row", "column", "entryEdge"))
    return (
        f'custom string garage:stall:id = "{stall.name}"\n'
        f'custom string garage:stall:number = "{number}"\n'
        f'custom token garage:stall:type = "{kind}"\n'
        f'custom token garage:stall:use = "{stall.use.value}"\n'
        f"custom int2 garage:stall:square = ({row}, {column})\n"
        f"custom int2 garage:stall:accessSquare = ({access_row}, {access_column})\n"
        f'custom token garage:stall:entryEdge = "{edge}"\n'
        f"{_shape_text(stall)}"
        f"custom float2[] garage:stall:corners = [{corners}]\n"
        f"{'' if is_taken else occupied_text(is_occupied=False)}"
    )


@dataclass(frozen=True)
class TilePrototypes:
    """Assignment of tiles to prototypes.

    Attributes
    ----------
    name_of
        Name of the prototype of each tile, in the arrangement's order.
    texts
        USDA text of each prototype, a class, by its name: parts first, then tiles.
    """

    name_of: list[str]
    texts: dict[str, str]


def share_tiles(
    layout: Layout, arrangement: Arrangement, labels: Sequence[str], writer: InstanceWriter, folder: str
) -> TilePrototypes:
    """Group equal tiles and parts of tiles of a nested stage, so that they are instances of one prototype.

    Parameters
    ----------
    layout, arrangement
        The objects, and the prim of each.
    labels
        Label of each tile.
    writer
        Writer of the instances.
    folder
        Path of the parent prim of the prototypes.
    """
    names: dict[tuple[str, tuple[bytes, ...]], str] = {}
    name_of: list[str] = []
    first_part: dict[tuple[str, bytes], int] = {}
    for tile, key in enumerate(zip(labels, _contents(layout, arrangement), strict=True)):
        name = names.get(key)
        if name is None:
            name = names[key] = f"Tile_{len(names) + 1:04d}"
            for number, part in enumerate(zip(arrangement.parts, key[1], strict=True), len(arrangement.parts) * tile):
                first_part.setdefault(part, number)
        name_of.append(name)
    part_names = {
        part: f"{part[0]}_{number:04d}" for number, part in enumerate((part for part in first_part if part[1]), 1)
    }
    rows_of = [arrangement.on_part(first_part[part]) for part in part_names]
    tile_of = np.array([first_part[part] for part in part_names]) // len(arrangement.parts)
    origins = np.repeat(arrangement.origins_m[tile_of], [len(rows) for rows in rows_of], axis=0)
    objects = writer.texts(np.concatenate(rows_of), origins)
    texts = {
        name: group_text(name, islice(objects, len(rows)), specifier="class", metadata=_SHARED)
        for name, rows in zip(part_names.values(), rows_of, strict=True)
    }
    place = place_text(0, 0, 0)
    for (label, pieces), name in names.items():
        children = (
            f'def "{part}" (\n{inherits_text(f"{folder}/{part_names[part, piece]}")})\n{{\n}}\n'
            for part, piece in zip(arrangement.parts, pieces, strict=True)
            if piece
        )
        texts[name] = group_text(name, children, specifier="class", label=label, metadata=_SHARED, place=place)
    return TilePrototypes(name_of, texts)


def _contents(layout: Layout, arrangement: Arrangement) -> Iterator[tuple[bytes, ...]]:
    """Yield the content of each part of each tile as bytes: names, kinds, shapes and places relative to the origin."""
    objects, count = layout.placements, len(arrangement.parts)
    for begin in range(0, len(arrangement.squares), _TILES_AT_ONCE):
        origins_m = arrangement.origins_m[begin : begin + _TILES_AT_ONCE]
        borders = arrangement.borders[count * begin : count * (begin + len(origins_m)) + 1]
        rows = arrangement.order[borders[0] : borders[-1]]
        local = objects.position_m[rows]
        local[:, [0, 2]] -= np.repeat(origins_m, np.diff(borders[::count]), axis=0)
        content = np.column_stack(
            [
                arrangement.name[rows],
                objects.kind[rows],
                objects.spec[rows],
                np.rint(local / _SAME_PLACE_M).astype(np.int32),
                np.rint(objects.yaw_rad[rows] / _SAME_YAW_RAD).astype(np.int32),
            ]
        )
        in_bytes, ends = content.tobytes(), ((borders - borders[0]) * content.strides[0]).tolist()
        pieces = (in_bytes[start:end] for start, end in pairwise(ends))
        yield from zip(*[pieces] * count, strict=True)
