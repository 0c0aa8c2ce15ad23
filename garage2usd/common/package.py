"""The package itself: its version, names of it that are loaded on first use, and the modules of its optional extras."""

import json
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from importlib.metadata import distribution, version
from importlib.util import find_spec
from pathlib import Path

from garage2usd.common.errors import MissingExtraError
from garage2usd.common.system import HAS_EMBREE

BLENDER = ("bpy", "OpenEXR")
"""Modules for rendering with Blender and reading the images."""
PICTURES = ("OpenEXR",)
"""Modules for reading images rendered by an installed Blender."""
RAYS = ("embreex", "trimesh") if HAS_EMBREE else ("trimesh",)
"""Modules for ray casting; without embreex, the much slower `garage2usd.sensors.rays.ray_caster` is used."""
_BROUGHT = {
    "bpy": ("blender", "Blender's Python module"),
    "OpenEXR": ("sensors", "OpenEXR"),
    "distributed": ("dataset", "Dask's distributed"),
    "jinja2": ("dataset", "Jinja"),
    "matplotlib": ("dataset", "Matplotlib"),
    "pyarrow": ("dataset", "PyArrow"),
    "gymnasium": ("gymnasium", "Gymnasium"),
    "pyproj": ("maps", "pyproj"),
    "scenariogeneration": ("maps", "scenariogeneration"),
    "embreex": ("sensors", "embreex"),
    "trimesh": ("sensors", "trimesh"),
    "DracoPy": ("models", "DracoPy"),
    "rosbags": ("sensors", "rosbags"),
    "osi3": ("traffic", "osi-python"),
    "mcap": ("traffic", "MCAP"),
    "mcap_protobuf": ("traffic", "MCAP's support of protobuf"),
    "google": ("traffic", "protobuf"),
    "av": ("video", "PyAV"),
    "playwright": ("video", "Playwright"),
    "ezdxf": ("cad", "ezdxf"),
    "ifcopenshell": ("cad", "IfcOpenShell"),
}
"""Extra and display name of each optional module."""
_PYTHON_OF_BLENDER = (3, 11)
VERSION = version("garage2usd")


def require(purpose: str, modules: Iterable[str], *, without: str = "", extra: str = "") -> None:
    """Check that optional modules are installed, without importing them.

    Parameters
    ----------
    purpose
        Feature that needs them; the beginning of the error message.
    modules
        Import names of the modules.
    without
        Alternative without the modules, in words; appended to the message if Blender's module is missing.
    extra
        An extra that brings them, if several do.

    Raises
    ------
    MissingExtraError
        If a module is missing; names all missing modules and their extras.
    """
    missing = [module for module in modules if not is_there(module)]
    if missing:
        raise _missing(purpose, missing, without, extra)


def is_there(module: str) -> bool:
    """True if a module of an optional extra is installed; does not import the module."""
    return find_spec(module) is not None


@contextmanager
def of_extra(purpose: str, extra: str = "") -> Iterator[None]:
    """Context for imports of optional modules; `extra` names one that brings them, if several do.

    Raises
    ------
    MissingExtraError
        If a module is not installed.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        module = (error.name or "").partition(".")[0]
        if module not in _BROUGHT:
            raise
        raise _missing(purpose, [module], extra=extra) from error


def _missing(purpose: str, modules: list[str], without: str = "", extra: str = "") -> MissingExtraError:
    with_blender = {*BLENDER} if "bpy" in modules else set()
    of_each = ("blender" if module in with_blender else _BROUGHT[module][0] for module in modules)
    extras = [extra] if extra else sorted({*of_each})
    *others, last = (_BROUGHT[module][1] for module in modules)
    brings = f"{', '.join(others)} and {last}" if others else last
    here = sys.version_info[:2]
    if "bpy" in modules and here != _PYTHON_OF_BLENDER:
        needed, found = (".".join(map(str, version)) for version in (_PYTHON_OF_BLENDER, here))
        brings = f"Python {needed} instead of {found}, and in it {brings}"
    if without and with_blender:
        brings = f"{brings} ({without})"
    return MissingExtraError(purpose, ",".join(extras), brings, installation_of(",".join(extras)))


def installation_of(extras: str) -> str:
    """Return the command that installs extras for garage2usd as it is installed: in a checkout or from an index."""
    from urllib.parse import urlsplit  # noqa: PLC0415 - only where an extra is missing
    from urllib.request import url2pathname  # noqa: PLC0415

    origin = json.loads(distribution("garage2usd").read_text("direct_url.json") or "{}")
    place = Path(url2pathname(urlsplit(origin.get("url", "")).path))
    if "url" not in origin or (
        "dir_info" in origin and not place.is_dir()
    ):  # installed from an index, or from a checkout that is gone
        return f"pip install 'garage2usd[{extras}]'"
    if "dir_info" not in origin:  # installed from a wheel or a remote repository
        return f"pip install 'garage2usd[{extras}] @ {origin['url']}'"
    option = "-e " if origin["dir_info"].get("editable") else ""
    return f"pip install {option}'{'.' if place == Path.cwd() else place}[{extras}]'"


def drawn_by(module: str, function: str) -> Callable[[object], str]:
    """Make a method that a function of a room above draws, imported on first use: the form that notebooks display.

    Values know nothing of the rooms above them that draw them, so the function is given by name:
    ``_repr_svg_ = drawn_by("garage2usd.view.notebook", "plan_svg")``.
    """

    def drawn(value: object) -> str:
        return str(getattr(import_module(module), function)(value))

    drawn.__doc__ = f"Draw it for a notebook, by `{module}.{function}`."
    return drawn


def on_first_use(package: str, modules: Mapping[str, Iterable[str]]) -> Callable[[str], object]:
    """Make the ``__getattr__`` of a package; `modules` maps its modules to their public names."""
    home = {name: module for module, names in modules.items() for name in names}

    def load(name: str) -> object:
        if name not in home:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return getattr(import_module(f"{package}.{home[name]}"), name)

    return load
