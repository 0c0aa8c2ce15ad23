"""The stage of a garage: that of its only level, or those of its levels at their floors under ``/Garage/Levels``."""

import posixpath
from collections.abc import Mapping, Sequence
from pathlib import Path

from pxr import Sdf

from garage2usd.common.documents import json_text
from garage2usd.common.progress import Progress, silent
from garage2usd.config.outputs import AssetPlace, StageConfig, StageForm, UpAxis
from garage2usd.garage.levels import GARAGE_NAME, LEVELS_NAME
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.objects.kind import VariantSet
from garage2usd.reading.label_table import LabelledObject, LabelTable
from garage2usd.stage.authoring import anchored, turn_text
from garage2usd.stage.curves import LANE_GRAPH_FILE, STALL_OUTLINES, Drivable, write_lane_graph
from garage2usd.stage.forms import make_flat, pack
from garage2usd.stage.labels import label_table
from garage2usd.stage.level_stage import StageFiles, StageFormat, arrangement_of, asset_folder_name, write_level_stage
from garage2usd.stage.variants import BLOCKED_BY, OCCUPIED, SWITCHES

_PHYSICS = "PhysicsScene"
_ALL = "all"
_POINT_OFFSET_DECIMALS = 3
_INT_END = 2**31


def stages_of_levels(garage: Garage, stage: Path) -> list[Path]:
    """Return the stage of each level by itself, beside that of a garage whose form is not flat."""
    folder = stage.parent / asset_folder_name(stage)
    return [stage if level.place.is_only else folder / f"{level.name}.usdc" for level in garage.levels]


def write_labels(garage: Garage, path: Path) -> None:
    """Write the table of all labelled objects of the stage of a garage as JSON; ids go on from level to level."""
    config = garage.config.stage
    tables = [label_table(level.layout, arrangement_of(level.layout, config).paths()) for level in garage.levels]
    objects: dict[str, tuple[LabelledObject, ...]] = {}
    parked: list[tuple[int, int]] = []
    plates: list[tuple[int, int, str]] = []
    offset = 0
    for level, table in zip(garage.levels, tables, strict=True):
        for parent, rows in table.objects.items():
            objects[level.place.path_in_whole(parent)] = tuple(_lifted(row, level.floor_m, offset) for row in rows)
        parked += [(stall + offset, car + offset) for stall, car in table.parked]
        plates += [(plate + offset, car + offset, text) for plate, car, text in table.number_plates]
        offset += sum(map(len, table.objects.values()))
    whole = LabelTable(
        classes_version=tables[0].classes_version,
        classes=tables[0].classes,
        objects=objects,
        parked=tuple(parked),
        number_plates=tuple(plates),
    )
    path.write_text(json_text(whole.model_dump()), encoding="utf-8", newline="\n")


def write_stage(
    garage: Garage,
    path: Path,
    *,
    config: StageConfig | None = None,
    shared: Path | None = None,
    own: str | None = None,
    progress: Progress = silent,
) -> StageFiles:
    """Write the stage of a garage into an empty folder.

    Parameters
    ----------
    garage
        The garage.
    path
        The stage's file in an existing, empty folder; its extension selects the format.
    config
        Texture quality and form of the stage; those of the garage if left out.
    shared
        Folder of the shared assets, from `shared_folder` for the final path of the stage. Missing assets are added,
        damaged ones are written again.
    own
        Prefix of the names of this garage's own layers, beside a stage with shared assets; if left out, the layers
        stand in a folder named by `asset_folder_name`.
    progress
        Called after each prototype.

    Returns
    -------
    StageFiles
        The files in the folder.

    Raises
    ------
    OutputError
        If the shared assets cannot be written.
    """
    config = config or garage.config.stage
    if not garage.levels[0].place.is_only:
        return _write_levels(garage, path, config, shared=shared, own=own, progress=progress)
    layout = garage.layout
    return write_level_stage(
        layout,
        path,
        arrangement=arrangement_of(layout, config),
        metadata=garage.metadata,
        config=config,
        shared=shared,
        own=own,
        progress=progress,
    )


def _write_levels(
    garage: Garage, path: Path, config: StageConfig, *, shared: Path | None, own: str | None, progress: Progress
) -> StageFiles:
    """Write the stage of several levels.

    The layer of each level is the stage that a garage of this level alone has; the root layer refers to it. The lane
    graph of the whole building takes the place of those of the levels.
    """
    levels, lanes = garage.levels, garage.joined
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
        made = write_level_stage(
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
    layer.ImportFromString(_root_text(levels, lanes, layers, garage.metadata, last_frame, config.up_axis))
    layer.Export(str(layer_path))
    if is_flat:
        make_flat(layer_path, folder)
    if beside:
        return StageFiles(path, None, last_frame)
    if not packed:
        return StageFiles(path, folder if any(folder.iterdir()) else None, last_frame)
    pack(path, layer_path, folder)
    return StageFiles(path, None, last_frame)


def _root_text(
    levels: Sequence[GarageLevel],
    lanes: Drivable,
    layers: str,
    metadata: Mapping[str, str | int],
    last_frame: int,
    up_axis: UpAxis,
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
        f'#usda 1.0\n(\ndefaultPrim = "{GARAGE_NAME}"\nendTimeCode = {last_frame}\nframesPerSecond = 24\n'
        "kilogramsPerUnit = 1\nmetersPerUnit = 1\nstartTimeCode = 0\ntimeCodesPerSecond = 24\n"
        f'upAxis = "{up_axis}"\n)\n\ndef Xform "{GARAGE_NAME}" (\nkind = "assembly"\n'
        f"customData = {{\n{data}string[] levels = [{names}]\ndouble[] floorsM = [{floors}]\n}}\n"
        f"variants = {{\n{selections}}}\nprepend variantSets = [{set_names}]\n)\n{{\n{turn_text(up_axis)}{bodies}"
        f'def Xform "{LEVELS_NAME}" (\nkind = "group"\n)\n{{\n{places}}}\n'
        f'def "{Path(LANE_GRAPH_FILE).stem}" (\n'
        f"prepend references = @{anchored(f'{layers}{LANE_GRAPH_FILE}')}@\n)\n{{\n}}\n"
        f'def {_PHYSICS} "{_PHYSICS}"\n{{\n}}\n}}\n'
    )


def _integer_type(value: int) -> str:
    """Return the type in which USD's Python module stores an integer."""
    return "int" if abs(value) < _INT_END else "int64"


def _level_text(level: GarageLevel, layers: str) -> str:
    """Return the prim of a level, without what the whole garage has once."""
    off = "".join(f'over "{name}" (\nactive = false\n)\n{{\n}}\n' for name in (Path(LANE_GRAPH_FILE).stem, _PHYSICS))
    return (
        f'def "{level.name}" (\nprepend references = @{anchored(f"{layers}{level.name}.usdc")}@\n)\n{{\n'
        f'custom token garage:level = "{level.name}"\n'
        f"float3 xformOp:translate = (0, {level.floor_m}, 0)\n"
        f'uniform token[] xformOpOrder = ["xformOp:translate"]\n{off}}}\n'
    )


def _switch_sets(levels: Sequence[GarageLevel], lanes: Drivable) -> list[tuple[str, str, str]]:
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
            choices += f'"{choice}" {{\nover "{LEVELS_NAME}"\n{{\n{overs}}}\n{beside}}}\n'
        found.append((str(name), switch.usual, f'variantSet "{name}" = {{\n{choices}}}\n'))
    return found


def _level_set(levels: Sequence[GarageLevel]) -> tuple[str, str, str]:
    """Return the variant set that shows all levels or one of them."""
    choices = f'"{_ALL}" {{\n}}\n'
    for shown in levels:
        overs = "".join(
            f'over "{level.name}"\n{{\ntoken visibility = "invisible"\n}}\n' for level in levels if level is not shown
        )
        choices += f'"{shown.name}" {{\nover "{LEVELS_NAME}"\n{{\n{overs}}}\n}}\n'
    return "level", _ALL, f'variantSet "level" = {{\n{choices}}}\n'


def _lifted(row: LabelledObject, floor_m: float, offset: int) -> LabelledObject:
    """Return a row of a level's table in the garage."""
    low, high = (
        None if corner is None else (corner[0], round(corner[1] + floor_m, _POINT_OFFSET_DECIMALS) + 0.0, corner[2])
        for corner in (row.min_m, row.max_m)
    )
    return row._replace(id=row.id + offset, min_m=low, max_m=high)
