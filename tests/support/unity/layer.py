"""The Unity layer compiled against fakes of Unity's classes, assembly by assembly as Unity does."""

import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from support.unity.reader import PACKAGE

EDITOR = "UNITY_EDITOR"
UNITY_6 = "UNITY_6000_0_OR_NEWER"
LAYER = ["Garage.Usd", "UnityFakes", "Garage.Unity"]
FLAGS = ["-warnaserror", "-langversion:7.2", "-optimize+", "-r:System.Core"]


def compile_assembly(
    output: Path, sources: list[Path], references: list[str], defines: tuple[str, ...], *, documented: bool = False
) -> None:
    """An assembly beside those that it refers to; each warning is an error, and so may be a missing comment."""
    target = "exe" if output.suffix == ".exe" else "library"
    command = ["mcs", f"-target:{target}", *FLAGS, *(f"-define:{name}" for name in defines), f"-out:{output}"]
    if documented:
        command.append(f"-doc:{output.with_suffix('.xml')}")
    command += [f"-r:{output.parent / name}.dll" for name in references] + [str(source) for source in sources]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(done.stdout + done.stderr)


def sources_of(*folders: str) -> list[Path]:
    return sorted(source for folder in folders for source in (PACKAGE / folder).rglob("*.cs"))


def compile_layer(folder: Path, *defines: str) -> None:
    """The assemblies of the package and the fakes that stand for Unity's; the editor's where ``EDITOR`` is given."""
    folder.mkdir(parents=True, exist_ok=True)
    core, fakes, layer = "Garage.Usd", "UnityFakes", "Garage.Unity"
    compile_assembly(folder / f"{core}.dll", sources_of("Core"), [], defines)
    compile_assembly(folder / f"{fakes}.dll", sources_of("Tools~/UnityFakes"), [], defines)
    compile_assembly(folder / f"{layer}.dll", sources_of("Runtime"), [core, fakes], defines, documented=True)
    if EDITOR in defines:
        editor = folder / f"{layer}.Editor.dll"
        compile_assembly(editor, sources_of("Editor"), [core, fakes, layer], defines, documented=True)


def compile_package(folder: Path, *defines: str) -> list[str]:
    """All assemblies of the package that Unity compiles, with its tests and samples for the editor; their names."""
    compile_layer(folder, *defines)
    compile_assembly(folder / "NUnitFakes.dll", sources_of("Tools~/NUnitFakes"), [], defines)
    tests = [*LAYER, "NUnitFakes"]
    compile_assembly(folder / "Garage.Unity.Samples.dll", sources_of("Samples~"), LAYER, defines)
    compile_assembly(folder / "Garage.Unity.Tests.dll", sources_of("Tests/Runtime"), tests, defines)
    names = ["Garage.Unity", "Garage.Unity.Samples", "Garage.Unity.Tests"]
    if EDITOR in defines:
        editor = [*tests, "Garage.Unity.Editor"]
        compile_assembly(folder / "Garage.Unity.Editor.Tests.dll", sources_of("Tests/Editor"), editor, defines)
        names += ["Garage.Unity.Editor", "Garage.Unity.Editor.Tests"]
    return names


def compile_prefab_dump(folder: Path, *defines: str) -> Path:
    """The program that imports stages on the fakes and prints the prefabs."""
    compile_layer(folder, EDITOR, *defines)
    compile_assembly(folder / "Garage.Unity.Samples.dll", sources_of("Samples~"), LAYER, (EDITOR, *defines))
    program = folder / "PrefabDump.exe"
    sources = [*sources_of("Tools~/PrefabDump"), PACKAGE / "Tools~" / "UsdDump" / "JsonText.cs"]
    assemblies = [*LAYER, "Garage.Unity.Editor", "Garage.Unity.Samples"]
    compile_assembly(program, sources, assemblies, (EDITOR, *defines))
    return program


@dataclass(frozen=True, eq=False)
class Prefab:
    """An import as the program prints it."""

    found: dict

    def __post_init__(self):
        assert "crash" not in self.found, self.found["crash"]
        assert self.found["errors"] == []
        assert self.found["progressBarLeft"] is False

    @property
    def objects(self) -> list[dict]:
        return self.found["objects"]

    @property
    def assets(self) -> dict[str, dict]:
        return self.found["assets"]

    def of_type(self, *types: str) -> dict[str, dict]:
        """Assets by their types."""
        return {name: asset for name, asset in self.assets.items() if asset["type"] in types}

    def labelled(self, label: str) -> list[dict]:
        """Objects by their class."""
        return [item for item in self.objects if label in item.get("labels", {}).get("class", [])]

    def named(self, name: str) -> dict:
        """The one object of this name."""
        (found,) = [item for item in self.objects if item["path"].rpartition("/")[2] == name]
        return found


def place_of(item: dict) -> np.ndarray:
    """Where an object stands, shape (3,)."""
    return np.array(item["world"]).reshape(3, 4)[:, 3]


def axes_of(item: dict) -> np.ndarray:
    """What becomes of the axes, column by column, shape (3, 3)."""
    return np.array(item["world"]).reshape(3, 4)[:, :3]


def world_vertices(prefab: Prefab, item: dict) -> np.ndarray:
    """The vertices of an object's mesh in the world, shape (n, 3)."""
    mesh = prefab.assets[item["mesh"]]
    return np.array(mesh["vertices"]).reshape(-1, 3) @ axes_of(item).T + place_of(item)


def from_usd(points: np.ndarray) -> np.ndarray:
    """Points or directions of a Y-up stage in Unity's axes."""
    return np.asarray(points, dtype=float) * [1, 1, -1]
