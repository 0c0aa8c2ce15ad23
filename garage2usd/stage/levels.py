"""The stage of a garage of several levels: the stage of each level, placed at its floor under ``/Garage/Levels``."""

import posixpath
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from pxr import Sdf

from garage2usd.common.json_text import json_text
from garage2usd.common.progress import Progress, silent
from garage2usd.config.stage import AssetPlace, StageConfig, StageForm
from garage2usd.layout import Layout
from garage2usd.objects.kind import VariantSet
from garage2usd.reading.label_table import LabelledObject, LabelTable
from garage2usd.reading.whole_garage import LEVELS
from garage2usd.stage import StageFiles, StageFormat, arrangement_of, asset_folder_name, write_stage
from garage2usd.stage.arrangement import ROOT_NAME
from garage2usd.stage.flat import flatten_stage
from garage2usd.stage.labels import label_table
from garage2usd.stage.lane_curves import LANE_GRAPH_FILE, STALL_OUTLINES, Drivable, write_lane_graph
from garage2usd.stage.prim_text import anchored
from garage2usd.stage.usdz import write_usdz
from garage2usd.stage.variants import BLOCKED_BY, OCCUPIED, SWITCHES

__all__ = ["LevelLayout", "path_on_level", "write_level_labels", "write_levels_stage"]

_PHYSICS = "PhysicsScene"
_ALL = "all"
_POINT_OFFSET_DECIMALS = 3
_INT_END = 2**31


class LevelLayout(NamedTuple):
    """One level of a garage.

    Attributes
    ----------
    name
        Name of its prim, ``U1``.
    floor_m
        Height of its floor.
    layout
        Its objects, as of a garage whose floor is at 0.
    metadata
        Written into the customData of its prim.
    """

    name: str
    floor_m: float
    layout: Layout
    metadata: Mapping[str, str | int]


def write_level_labels(levels: Sequence[LevelLayout], path: Path, config: StageConfig) -> None:
    """Write the table of all labelled objects of all levels as JSON; ids go on from level to level."""
    tables = [(level, label_table(level.layout, arrangement_of(level.layout, config).paths())) for level in levels]
    objects: dict[str, tuple[LabelledObject, ...]] = {}
    parked: list[tuple[int, int]] = []
    plates: list[tuple[int, int, str]] = []
    offset = 0
    for level, table in tables:
        for parent, rows in table.objects.items():
            objects[path_on_level(parent, level.name)] = tuple(_lifted(row, level.floor_m, offset) for row in rows)
        parked += [(stall + offset, car + offset) for stall, car in table.parked]
        plates += [(plate + offset, car + offset, text) for plate, car, text in table.number_plates]
        offset += sum(map(len, table.objects.values()))
    whole = LabelTable(
        classes_version=tables[0][1].classes_version,
        classes=tables[0][1].classes,
        objects=objects,
        parked=tuple(parked),
        number_plates=tuple(plates),
    )
    path.write_text(json_text(whole.model_dump()), encoding="utf-8", newline="\n")


def write_levels_stage(
    levels: Sequence[LevelLayout],
    lanes: Drivable,
    path: Path,
    *,
    metadata: Mapping[str, str | int],
    config: StageConfig,
    shared: Path | None = None,
    own: str | None = None,
    progress: Progress = silent,
) -> StageFiles:
    """Write a stage of several levels into a folder of its own.

    Parameters
    ----------
    levels
        The levels, the top one first.
    lanes
        Lanes and stalls of all levels together.
    path
        The stage's file in an existing, empty folder; its extension decides the format.
    metadata
        Written into the root's customData.
    config
        Texture quality and form.
    shared
        Folder of the assets that it shares with others, as for `garage2usd.stage.write_stage`.
    own
        Prefix of the names of the levels' layers and of their own ones, which then stand beside the stage; only with
        shared assets. If left out, they stand in a folder named by `garage2usd.stage.asset_folder_name`.
    progress
        Called with each prototype that is written.

    Returns
    -------
    StageFiles
        What now stands in the folder.

    Notes
    -----
    The layer of each level is the stage that a garage of this level alone has; the root layer refers to it. The lane
    graph of the whole building takes the place of those of the levels.
    """
    packed, is_flat = path.suffix == StageFormat.USDZ, config.form is StageForm.FLAT
    beside = own is not None and shared is not None
    if beside:
        folder, layers, assets = path.parent, f"{own}", config.asset_folder
    else:
        folder = path.parent / ("assets" if packed else asset_folder_name(path))
        folder.mkdir()
        layers = f"{folder.name}/"
        assets = "." if shared is None else posixpath.join("..", config.asset_folder)
    form = StageForm.INSTANCED if is_flat else config.form
    of_level = config.model_copy(update={"assets": AssetPlace.SHARED, "asset_folder": assets, "form": form})
    last_frame = 0
    for level in levels:
        made = write_stage(
            level.layout,
            path.parent / f"{layers}{level.name}.usdc",
            arrangement=arrangement_of(level.layout, of_level),
            metadata=level.metadata,
            config=of_level,
            shared=folder if shared is None else shared,
            own=f"{own}{level.name}." if beside else f"{level.name}_",
            progress=progress,
        )
        last_frame = max(last_frame, made.last_frame)
    write_lane_graph(path.parent / f"{layers}{LANE_GRAPH_FILE}", lanes)
    layer_path = path.with_suffix(".usda") if packed else path
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(_root_text(levels, lanes, layers, metadata, last_frame))
    layer.Export(str(layer_path))
    if is_flat:
        flat = layer_path.with_stem(f"{layer_path.stem}_flat")
        flatten_stage(layer_path, flat)
        flat.replace(layer_path)
        for asset in folder.glob("*.usdc"):
            asset.unlink()
    if beside:
        return StageFiles(path, None, last_frame)
    if not packed:
        return StageFiles(path, folder if any(folder.iterdir()) else None, last_frame)
    files = sorted(file for file in folder.rglob("*") if file.is_file())
    named = [(f"{folder.name}/{file.relative_to(folder).as_posix()}", file.read_bytes()) for file in files]
    write_usdz(path, [(layer_path.name, layer_path.read_bytes()), *named])
    shutil.rmtree(folder)
    layer_path.unlink()
    return StageFiles(path, None, last_frame)


def _root_text(
    levels: Sequence[LevelLayout], lanes: Drivable, layers: str, metadata: Mapping[str, str | int], last_frame: int
) -> str:
    """Return the root layer as text; `layers` precedes the names of the layers that it refers to."""
    data = "".join(
        f"{_integer_type(value)} {key} = {value}\n" if isinstance(value, int) else f'string {key} = "{value}"\n'
        for key, value in metadata.items()
    )
    names = ", ".join(f'"{level.name}"' for level in levels)
    floors = ", ".join(str(level.floor_m) for level in levels)
    sets = [*_switch_sets(levels, lanes), _level_set(levels)]
    set_names = ", ".join(f'"{name}"' for name, _, _ in sets)
    selections = "".join(f'string {name} = "{usual}"\n' for name, usual, _ in sets)
    bodies = "".join(body for _, _, body in sets)
    places = "".join(_level_text(level, layers) for level in levels)
    return (
        f'#usda 1.0\n(\ndefaultPrim = "{ROOT_NAME}"\nendTimeCode = {last_frame}\nframesPerSecond = 24\n'
        "kilogramsPerUnit = 1\nmetersPerUnit = 1\nstartTimeCode = 0\ntimeCodesPerSecond = 24\n"
        f'upAxis = "Y"\n)\n\ndef Xform "{ROOT_NAME}" (\nkind = "assembly"\n'
        f"customData = {{\n{data}string[] levels = [{names}]\ndouble[] floorsM = [{floors}]\n}}\n"
        f"variants = {{\n{selections}}}\nprepend variantSets = [{set_names}]\n)\n{{\n{bodies}"
        f'def Xform "{LEVELS}" (\nkind = "group"\n)\n{{\n{places}}}\n'
        f'def "{Path(LANE_GRAPH_FILE).stem}" (\n'
        f"prepend references = @{anchored(f'{layers}{LANE_GRAPH_FILE}')}@\n)\n{{\n}}\n"
        f'def {_PHYSICS} "{_PHYSICS}"\n{{\n}}\n}}\n'
    )


def _integer_type(value: int) -> str:
    """Return the type in which USD's Python module stores an integer."""
    return "int" if abs(value) < _INT_END else "int64"


def _level_text(level: LevelLayout, layers: str) -> str:
    """Return the prim of a level, without what the whole garage has once."""
    off = "".join(f'over "{name}" (\nactive = false\n)\n{{\n}}\n' for name in (Path(LANE_GRAPH_FILE).stem, _PHYSICS))
    return (
        f'def "{level.name}" (\nprepend references = @{anchored(f"{layers}{level.name}.usdc")}@\n)\n{{\n'
        f'custom token garage:level = "{level.name}"\n'
        f"float3 xformOp:translate = (0, {level.floor_m}, 0)\n"
        f'uniform token[] xformOpOrder = ["xformOp:translate"]\n{off}}}\n'
    )


def _switch_sets(levels: Sequence[LevelLayout], lanes: Drivable) -> list[tuple[str, str, str]]:
    """Return name, usual choice and text of the variant sets that set those of all levels."""
    found = []
    for name in VariantSet:
        switch = next(each for each in SWITCHES.values() if each.variant_set == name)
        choices = ""
        for choice in (switch.usual, switch.other):
            overs = "".join(
                f'over "{level.name}" (\nvariants = {{\nstring {name} = "{choice}"\n}}\n)\n{{\n}}\n' for level in levels
            )
            beside = ""
            if name is VariantSet.OCCUPANCY and choice == switch.other:
                beside = f"custom int[] {OCCUPIED} = [{', '.join('0' * len(lanes.quads))}]\n"
                beside += f"custom token[] {BLOCKED_BY} = []\n" if lanes.blocked else ""
                for prim in reversed(STALL_OUTLINES):
                    beside = f'over "{prim}"\n{{\n{beside}}}\n'
            choices += f'"{choice}" {{\nover "{LEVELS}"\n{{\n{overs}}}\n{beside}}}\n'
        found.append((str(name), switch.usual, f'variantSet "{name}" = {{\n{choices}}}\n'))
    return found


def _level_set(levels: Sequence[LevelLayout]) -> tuple[str, str, str]:
    """Return the variant set that shows all levels or one of them."""
    choices = f'"{_ALL}" {{\n}}\n'
    for shown in levels:
        overs = "".join(
            f'over "{level.name}"\n{{\ntoken visibility = "invisible"\n}}\n' for level in levels if level is not shown
        )
        choices += f'"{shown.name}" {{\nover "{LEVELS}"\n{{\n{overs}}}\n}}\n'
    return "level", _ALL, f'variantSet "level" = {{\n{choices}}}\n'


def path_on_level(place: str, name: str) -> str:
    """Return the path in the whole stage of a prim of a level's own; any other place after the level's name."""
    if place.startswith(f"/{ROOT_NAME}"):
        return place.replace(f"/{ROOT_NAME}", f"/{ROOT_NAME}/{LEVELS}/{name}", 1)
    return f"{name}/{place}" if place else name


def _lifted(row: LabelledObject, floor_m: float, offset: int) -> LabelledObject:
    """Return a row of a level's table in the garage."""
    low, high = (
        None if corner is None else (corner[0], round(corner[1] + floor_m, _POINT_OFFSET_DECIMALS) + 0.0, corner[2])
        for corner in (row.min_m, row.max_m)
    )
    return row._replace(id=row.id + offset, min_m=low, max_m=high)
