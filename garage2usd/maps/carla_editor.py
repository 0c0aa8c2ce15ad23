"""Finish an imported garage in Unreal's editor: a folder for each semantic class, and lamps.

CARLA's importer gives meshes the classes Road, RoadLine, SideWalk and Terrain by their names, and Terrain to all the
others. This program moves the others to the folders of their classes, and places the lamps of the garage in the level.
Run it once after the import, in the editor or without its window:

    UnrealEditor CarlaUnreal.uproject -run=pythonscript -script="/path/to/finish_in_editor.py"

Nothing is changed that is already as it should be, so it may run again.
"""

import json
import sys
from pathlib import Path
from typing import Any

import unreal

_HERE = Path(globals().get("__file__") or sys.argv[0]).resolve().parent
_CM = 100.0
_REACH_M = 20.0
_LABEL = "GarageLamp"


def main() -> None:
    """Finish the garage of the file beside this program."""
    garage = json.loads((_HERE / "garage.json").read_text(encoding="utf-8"))
    level = "/Game/{package}/Maps/{map}/{map}".format(**garage)
    if not unreal.EditorLevelLibrary.load_level(level):
        raise SystemExit(f"{level} is not there: import the garage first")
    moved = sort_meshes(garage)
    placed = place_lamps(garage["lamps"])
    unreal.EditorLevelLibrary.save_current_level()
    unreal.EditorLoadingAndSavingUtils.save_dirty_packages(True, True)
    unreal.log(f"{moved} meshes are in the folders of their classes, {placed} lamps are in {level}")


def sort_meshes(garage: dict[str, Any]) -> int:
    """Move meshes to the folders of their classes; return the number of meshes that are there."""
    package, name, assets = garage["package"], garage["map"], unreal.EditorAssetLibrary
    folder_of = {mesh["mesh"]: mesh["folder"] for mesh in garage["meshes"]}
    sorted_meshes = 0
    for place in (f"/Game/{package}/Static", f"/Game/{package}/Maps/{name}"):
        for path in assets.list_assets(place, recursive=True, include_folder=False):
            asset = path.rpartition("/")[2].partition(".")[0]
            folder = folder_of.get(asset.removeprefix(f"{name}_"))
            if folder is None:
                continue
            target = f"/Game/{package}/Static/{folder}/{name}/{asset}"
            if path.partition(".")[0] == target or assets.rename_asset(path.partition(".")[0], target):
                sorted_meshes += 1
            else:
                unreal.log_warning(f"{path} could not be moved to {target}")
    return sorted_meshes


def place_lamps(lamps: list[dict[str, Any]]) -> int:
    """Place lamps in the level in place of those of an earlier run; return their number."""
    for actor in unreal.EditorLevelLibrary.get_all_level_actors():
        if actor.get_actor_label().startswith(_LABEL):
            unreal.EditorLevelLibrary.destroy_actor(actor)
    kinds = {
        "rect": (unreal.RectLight, unreal.RectLightComponent),
        "spot": (unreal.SpotLight, unreal.SpotLightComponent),
        "point": (unreal.PointLight, unreal.PointLightComponent),
        "sun": (unreal.DirectionalLight, unreal.DirectionalLightComponent),
    }
    for number, lamp in enumerate(lamps):
        kind, component_kind = kinds[lamp["kind"]]
        place = unreal.Vector(*(_CM * lamp[axis] for axis in "xyz"))
        turn = unreal.MathLibrary.make_rot_from_xz(unreal.Vector(*lamp["forward"]), unreal.Vector(*lamp["up"]))
        actor = unreal.EditorLevelLibrary.spawn_actor_from_class(kind, place, turn)
        actor.set_actor_label(f"{_LABEL}_{number:04d}")
        light = actor.get_component_by_class(component_kind)
        light.set_mobility(unreal.ComponentMobility.MOVABLE)
        light.set_light_color(unreal.LinearColor(*lamp["colour_rgb"], 1.0))
        if lamp["kind"] == "sun":
            light.set_intensity(lamp["lux"])
            continue
        light.set_editor_property("intensity_units", unreal.LightUnits.CANDELAS)
        light.set_intensity(lamp["candela"])
        light.set_editor_property("attenuation_radius", _CM * _REACH_M)
        if lamp["kind"] == "rect":
            light.set_editor_property("source_width", _CM * lamp["width_m"])
            light.set_editor_property("source_height", _CM * lamp["height_m"])
        if lamp["kind"] == "spot":
            light.set_editor_property("outer_cone_angle", lamp["cone_deg"])
    return len(lamps)


if __name__ == "__main__":
    main()
