"""What CARLA makes of a package, rebuilt from its code as read in November 2026, and Unreal's module as far as used.

Branches on Unreal Engine 4: ``Util/BuildTools/Import.py``, ``MoveAssetsCommandlet.cpp``, ``SSTags.h``,
``PrepareAssetsForCookingCommandlet.cpp``, ``Tagger.cpp``; ue58-dev: ``Util/Tools/Import.py`` and the files of the same
names below ``Unreal/CarlaUnreal``, with ``Tagger.h``.
"""

import json
import re
import types
from pathlib import Path

TEXT = {"type": "string", "minLength": 1}
MAP = {
    "type": "object",
    # names are parted at blanks by MoveAssets, and are parts of paths; what is left out after a dot is another warning
    "properties": {
        "name": {**TEXT, "pattern": "^[A-Za-z0-9_]+$"},
        "source": {**TEXT, "pattern": r"\.fbx$"},
        "xodr": {**TEXT, "pattern": r"\.xodr$"},
        "use_carla_materials": {"type": "boolean"},
        "tile_size": {"type": "number"},
        "tiles": {"type": "array", "items": TEXT},
    },
    "required": ["name", "xodr"],  # read without a question in build_binary_for_navigation of both branches
    "oneOf": [{"required": ["source"]}, {"required": ["tiles"]}],
    "additionalProperties": False,
}
PROP = {
    "type": "object",
    "properties": {
        "name": TEXT,
        "source": TEXT,
        "tag": TEXT,
        "size": {"enum": ["tiny", "small", "medium", "big", "huge"]},
    },
    "required": ["name", "source", "tag", "size"],
    "additionalProperties": False,
}
SCHEMA = {
    "type": "object",
    "properties": {"maps": {"type": "array", "items": MAP}, "props": {"type": "array", "items": PROP}},
    "required": ["maps", "props"],
    "additionalProperties": False,
}
LABELS = frozenset(
    [
        "Building",
        "Fence",
        "Pedestrian",
        "Pole",
        "Other",
        "Road",
        "RoadLine",
        "SideWalk",
        "TrafficSign",
        "Vegetation",
        "Car",
        "Wall",
        "Sky",
        "Ground",
        "Bridge",
        "RailTrack",
        "GuardRail",
        "TrafficLight",
        "Static",
        "Dynamic",
        "Water",
        "Terrain",
        "Truck",
        "Motorcycle",
        "Bicycle",
        "Bus",
        "Rider",
        "Train",
    ]
)
"""Folders that ATagger::GetLabelByFolderName knows in both branches."""
_RULES = (
    ("Road", ("road_road", "roads_road")),
    ("RoadLine", ("road_marking", "roads_marking")),
    ("Terrain", ("terrain",)),
    ("SideWalk", ("road_sidewalk", "roads_sidewalk", "road_curb", "roads_curb", "road_gutter", "roads_gutter")),
)


def package_jsons(folder):
    """The descriptions that Import.py finds: every JSON file, however deep."""
    return [path for path in Path(folder).rglob("*.json") if path.name != "roadpainter_decals.json"]


def moved_to(asset):
    """The folder to which MoveAssets moves a mesh: FString::Contains knows no case."""
    name = asset.lower()
    return next((folder for folder, words in _RULES if any(word in name for word in words)), "Terrain")


def is_spawned(asset, materials):
    """Whether PrepareAssetsForCooking places a mesh in the map (ValidateStaticMesh)."""
    return not any(word in name.lower() for name in (asset, *materials) for word in ("light", "sign"))


def label_of(path):
    """The label of an asset by its path (GetLabelByPath): that of the fifth part."""
    parts = path.split("/")
    return parts[4] if len(parts) > 4 and parts[4] in LABELS else None


def imported(package, names):
    """Paths of the assets of a package's map, after the import, for the names of its meshes; collisions are parts."""
    (entry,) = json.loads(package.read_text())["maps"]
    stem = Path(entry["source"]).stem
    assets = [f"{stem}_{name}" for name in names if not name.startswith("UCX_")]
    return [f"/Game/{package.stem}/Static/{moved_to(asset)}/{entry['name']}/{asset}" for asset in assets]


class Collisions:
    """The collision meshes that Unreal gives to each mesh: UCX_ and its name, then perhaps an underscore and digits."""

    def __init__(self, names):
        self.of = {name: [] for name in names if not name.startswith("UCX_")}
        for name in names:
            if name.startswith("UCX_"):
                whole = name.removeprefix("UCX_")
                owners = {whole, re.sub(r"_\d+$", "", whole)} & self.of.keys()
                assert len(owners) == 1, (name, owners)
                self.of[owners.pop()].append(name)


def fake_unreal(assets, levels):
    """Unreal's module as far as the program for the editor asks; `assets` are the paths of all meshes."""
    unreal = types.ModuleType("unreal")
    unreal.actors, unreal.said, unreal.saved = [], [], []

    class Thing:
        def __init__(self, *values):
            self.values = values

    class Component:
        def __init__(self):
            self.properties = {}

        def set_editor_property(self, name, value):
            self.properties[name] = value

        def __getattr__(self, name):
            assert name in {"set_mobility", "set_light_color", "set_intensity"}, name
            return lambda value: self.properties.__setitem__(name.removeprefix("set_"), value)

    class Actor:
        def __init__(self, kind, place, turn):
            self.kind, self.place, self.turn, self.label, self.component = kind, place.values, turn, "", Component()

        def set_actor_label(self, label):
            self.label = label

        def get_actor_label(self):
            return self.label

        def get_component_by_class(self, kind):
            assert kind == f"{self.kind}Component"
            return self.component

    def rename(path, target):
        assert path in assets
        assert target not in assets
        assets[assets.index(path)] = target
        return True

    def spawn(kind, place, turn):
        unreal.actors.append(Actor(kind, place, turn))
        return unreal.actors[-1]

    for kind in ("Rect", "Spot", "Point", "Directional"):
        setattr(unreal, f"{kind}Light", f"{kind}Light")
        setattr(unreal, f"{kind}LightComponent", f"{kind}LightComponent")
    unreal.Vector = unreal.LinearColor = Thing
    unreal.MathLibrary = types.SimpleNamespace(make_rot_from_xz=lambda x, z: (x.values, z.values))
    unreal.LightUnits = types.SimpleNamespace(CANDELAS="cd")
    unreal.ComponentMobility = types.SimpleNamespace(MOVABLE="movable")
    unreal.log = unreal.log_warning = unreal.said.append
    unreal.EditorAssetLibrary = types.SimpleNamespace(
        list_assets=lambda place, **_: [
            f"{path}.{path.rpartition('/')[2]}" for path in assets if path.startswith(f"{place}/")
        ],
        rename_asset=rename,
    )
    unreal.EditorLevelLibrary = types.SimpleNamespace(
        load_level=lambda path: path in levels,
        get_all_level_actors=lambda: list(unreal.actors),
        destroy_actor=unreal.actors.remove,
        spawn_actor_from_class=spawn,
        save_current_level=lambda: unreal.saved.append("level"),
    )
    unreal.EditorLoadingAndSavingUtils = types.SimpleNamespace(
        save_dirty_packages=lambda *_: unreal.saved.append("packages")
    )
    return unreal
