"""The extras of garage2usd: which modules each brings, and that what needs one says so before its work."""

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec

from garage2usd.common.errors import MissingExtraError
from garage2usd.common.system import HAS_EMBREE

__all__ = ["BLENDER", "PICTURES", "RAYS", "is_there", "of_extra", "require"]

BLENDER = ("bpy", "OpenEXR")
"""Modules that render pictures with Blender and read them."""
PICTURES = ("OpenEXR",)
"""What reads pictures that an installed Blender draws."""
RAYS = ("embreex", "trimesh") if HAS_EMBREE else ("trimesh",)
"""What casts rays; where there is no embreex, `garage2usd.sensors.rays.ray_caster` does, many times as slowly."""

_BROUGHT = {
    "bpy": ("blender", "Blender's Python module"),
    "OpenEXR": ("blender", "OpenEXR"),
    "distributed": ("dataset", "Dask's distributed"),
    "jinja2": ("dataset", "Jinja"),
    "matplotlib": ("dataset", "Matplotlib"),
    "pyarrow": ("dataset", "PyArrow"),
    "gymnasium": ("gymnasium", "Gymnasium"),
    "pyproj": ("maps", "pyproj"),
    "scenariogeneration": ("maps", "scenariogeneration"),
    "embreex": ("sensors", "embreex"),
    "trimesh": ("sensors", "trimesh"),
    "rosbags": ("sensors", "rosbags"),
}
"""By module the extra that brings it, and what people call it."""
_PYTHON_OF_BLENDER = (3, 11)


def require(purpose: str, modules: Iterable[str], *, without: str = "") -> None:
    """Find out whether modules of extras are installed, without loading them.

    Parameters
    ----------
    purpose
        What needs them; begins the sentence that says so.
    modules
        The modules, as they are imported.
    without
        What goes without them, in words; told with what is missing of Blender.

    Raises
    ------
    MissingExtraError
        If one is not there; names all that are missing, and their extras.
    """
    missing = [module for module in modules if not is_there(module)]
    if missing:
        raise _missing(purpose, missing, without)


def is_there(module: str) -> bool:
    """True if a module of an optional extra is installed; does not import the module."""
    return find_spec(module) is not None


@contextmanager
def of_extra(purpose: str) -> Iterator[None]:
    """Import modules of extras.

    Raises
    ------
    MissingExtraError
        If one is not there.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        module = (error.name or "").partition(".")[0]
        if module not in _BROUGHT:
            raise
        raise _missing(purpose, [module]) from error


def _missing(purpose: str, modules: list[str], without: str = "") -> MissingExtraError:
    extras = sorted({_BROUGHT[module][0] for module in modules})
    *others, last = (_BROUGHT[module][1] for module in modules)
    brings = f"{', '.join(others)} and {last}" if others else last
    here = sys.version_info[:2]
    if "bpy" in modules and here != _PYTHON_OF_BLENDER:
        needed, found = (".".join(map(str, version)) for version in (_PYTHON_OF_BLENDER, here))
        brings = f"Python {needed} instead of {found}, and in it {brings}"
    if without and set(BLENDER).intersection(modules):
        brings = f"{brings} ({without})"
    return MissingExtraError(purpose, ",".join(extras), brings)
