"""The files of an SDF world."""

import re
from pathlib import Path

from garage2usd.common.errors import ConfigError

VISUALS = "visuals.glb"
"""Name of the file of visuals among the meshes."""
_MESHES = re.compile(r"visuals\.glb|collision_\d+\.stl")


def sdf_files(path: Path, *, joint: str = "_") -> tuple[Path, Path, Path]:
    """Return the world, its launch file, and the folder of its meshes."""
    return path, path.with_name(f"{path.stem}.launch.py"), path.with_name(f"{path.stem}{joint}meshes")


def check_meshes(folder: Path) -> None:
    """Check that the folder of a world's meshes is free, or has nothing but those of an earlier world.

    Raises
    ------
    ConfigError
        If something else is in its place, which the export would remove.
    """
    is_ours = folder.is_dir() and all(_MESHES.fullmatch(file.name) for file in folder.iterdir())
    if folder.exists() and not is_ours:
        raise ConfigError("output", str(folder), "a path at which nothing stands but the meshes of an earlier export")


def mesh_file(number: int) -> str:
    """Return the name of the file of a mesh."""
    return f"collision_{number + 1:03d}.stl"
