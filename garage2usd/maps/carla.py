"""CARLA package: a garage as an archive of a map for CARLA's importer, with programs that finish and enliven it."""

import json
import shutil
import zipfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from pxr import Usd

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.common.documents import json_text
from garage2usd.common.errors import StageError
from garage2usd.config.outputs import MapsConfig
from garage2usd.maps.carla_meshes import map_meshes, write_job
from garage2usd.maps.carla_names import plain_name
from garage2usd.maps.carla_places import FRAME, lamps, parked, parking_spots, spawn_points
from garage2usd.maps.facts import stage_facts
from garage2usd.maps.ground_plan import GroundPlan
from garage2usd.maps.level_networks import LevelNetwork
from garage2usd.maps.opendrive import write_opendrive
from garage2usd.reading.labels import read_labels
from garage2usd.scenes.prims import PlacedObject
from garage2usd.scenes.remarks import Remarks

FBX_PROGRAM = Path(__file__).with_name("carla_fbx.py")
"""The program that writes the FBX of a job, for Blender."""
_PROGRAMS = {"carla_client.py": "play_in_carla.py", "carla_editor.py": "finish_in_editor.py"}
_README = Path(__file__).with_name("carla_readme.md")
_STORED = frozenset({".png", ".jpg"})
_FIRST_DATE = (1980, 1, 1, 0, 0, 0)
RunBlender = Callable[[Mapping[str, Any], Path], object]
"""Runs `FBX_PROGRAM` with a job, in a folder for its files."""


def write_carla(
    stage: Usd.Stage,
    path: Path,
    garage: BuiltGarage,
    settings: MapsConfig,
    *,
    name: str,
    run_blender: RunBlender,
    objects: Sequence[PlacedObject],
    networks: Sequence[LevelNetwork],
    plan: GroundPlan,
    remarks: Remarks,
) -> None:
    """Write a garage as a ZIP archive for CARLA.

    Parameters
    ----------
    stage
        The stage.
    path
        The archive, in an existing folder.
    garage, settings, networks, plan
        As for `garage2usd.maps.opendrive.write_opendrive`.
    name
        Name of the garage, of which `plain_name` makes that of map and package.
    run_blender
        Runs the program that writes the FBX.
    objects
        Objects from `garage2usd.scenes.walk.placed_objects` in metres, Y up.
    remarks
        Receives remarks on what CARLA or FBX lacks.

    Raises
    ------
    StageError
        If the stage has nothing to draw, or lacks the lane graph that the OpenDRIVE map needs.
    RenderError
        If Blender fails.

    Notes
    -----
    ``NAME/Import/NAME`` goes into the folder ``Import`` of CARLA: the description of the package, which both
    ``Util/BuildTools/Import.py`` of the branches on Unreal Engine 4 and ``Util/Tools/Import.py`` of ``ue58-dev`` read,
    and a folder with mesh, textures and OpenDRIVE map. Importers read every ``.json`` below ``Import``, so
    ``garage.json`` and the programs that read it lie outside.
    """
    plain, file = plain_name(name), stage.GetRootLayer().realPath
    meshes = map_meshes(objects, read_labels(stage, Path(file) if file else None), remarks)
    if not meshes.meshes:
        raise StageError(file, "nothing in it can be drawn")
    work = path.with_name("package")
    whole = work / plain
    map_folder = whole / "Import" / plain / plain
    map_folder.mkdir(parents=True)
    write_opendrive(garage, map_folder / f"{plain}.xodr", settings, networks=networks, plan=plan)
    run_blender(write_job(meshes, work, map_folder / f"{plain}.fbx"), work)
    package = {
        "maps": [
            {
                "name": plain,
                "source": f"{plain}/{plain}.fbx",
                "xodr": f"{plain}/{plain}.xodr",
                "use_carla_materials": False,
            }
        ],
        "props": [],
    }
    _write(whole / "Import" / plain / f"{plain}.json", json.dumps(package, indent=2) + "\n")
    document = {
        "map": plain,
        "package": plain,
        "frame": FRAME,
        "facts": stage_facts(stage),
        "spawn_points": list(spawn_points(networks)),
        "parking_spots": list(parking_spots(networks)),
        "parked_cars": list(parked(garage)),
        "lamps": list(lamps(stage, objects, remarks)),
        "meshes": [mesh.facts() for mesh in meshes.meshes],
    }
    _write(whole / "garage.json", json_text(document))
    for program, shown in _PROGRAMS.items():
        _write(whole / shown, Path(__file__).with_name(program).read_text(encoding="utf-8"))
    _write(whole / "README.md", _README.read_text(encoding="utf-8").replace("NAME", plain))
    _pack(work, whole, path)
    shutil.rmtree(work)


def _write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8", newline="\n")


def _pack(folder: Path, whole: Path, path: Path) -> None:
    """Pack a folder with fixed times, and compress what is not compressed already."""
    with zipfile.ZipFile(path, "w") as archive:
        for file in sorted(whole.rglob("*")):
            if file.is_file():
                entry = zipfile.ZipInfo(file.relative_to(folder).as_posix(), _FIRST_DATE)
                entry.create_system = 0
                entry.compress_type = zipfile.ZIP_STORED if file.suffix in _STORED else zipfile.ZIP_DEFLATED
                archive.writestr(entry, file.read_bytes())
