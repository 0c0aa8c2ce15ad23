"""Stages for the readers, and that both say the same of them."""

from importlib.util import find_spec
from pathlib import Path

from pxr import Sdf, Usd

from support.unity import stages_of_pxr, values_of_pxr

STAGES = Path(__file__).parent / "stages"


def installed(package: str, endings: tuple[str, ...]) -> list[Path]:
    spec = find_spec(package)
    folders = [] if spec is None else spec.submodule_search_locations
    return sorted(path for folder in folders for path in Path(folder).rglob("*") if path.suffix in endings)


def same(reader, path, *root) -> list[str]:
    """Both say the same of a stage, of a root folder where one is given; gives the warnings."""
    return as_pxr_says(reader.ask("stage", path, *root), path)


def as_pxr_says(found, path) -> list[str]:
    """A dump of a stage is what ``pxr`` says of it; gives the warnings."""
    assert "refused" not in found, found
    warnings = found.pop("warnings")
    wanted = stages_of_pxr.stage_dump(Usd.Stage.Open(str(path)))
    stages_of_pxr.numbered_alike(wanted, found)
    assert not stages_of_pxr.misplaced(wanted, found)
    assert not values_of_pxr.differences(wanted, found)
    return warnings


def written(folder, files: dict[str, str], form: str):
    """Write layers as text or crates; the path of the first."""
    for name, text in files.items():
        layer = Sdf.Layer.CreateAnonymous(".usda")
        # pxr wants each statement on a line of its own
        layer.ImportFromString("#usda 1.0\n" + text.replace(" }", "\n}"))
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        assert layer.Export(str(path), args={"format": form})
    return folder / next(iter(files))


def scene_of(reader, path) -> dict:
    scene = reader.ask("scene", path)
    assert "refused" not in scene, scene
    return scene
