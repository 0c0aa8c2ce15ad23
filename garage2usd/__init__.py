"""Generate underground parking garages and export them as OpenUSD stages.

>>> import garage2usd
>>> build = garage2usd.build(output="garage.usdz", seed=7)
>>> stalls = build.garage.layout.stalls
"""

from typing import TYPE_CHECKING

from garage2usd.common.package import on_first_use

if TYPE_CHECKING:
    from garage2usd.common.errors import ConfigError, Garage2UsdError, GenerationError, UnreachableStallError
    from garage2usd.config import GarageConfig, load_config
    from garage2usd.exports import export
    from garage2usd.garage_model import Garage
    from garage2usd.garage_sources import check, drive
    from garage2usd.imports import import_layout
    from garage2usd.pipeline import Build, build, generate
    from garage2usd.planning.optimum import Optimum, find_optimum
    from garage2usd.recordings import record
    from garage2usd.structure.grid import Structure
    from garage2usd.view.viewer.notebook import show

__all__ = [
    "Build",
    "ConfigError",
    "Garage",
    "Garage2UsdError",
    "GarageConfig",
    "GenerationError",
    "Optimum",
    "Structure",
    "UnreachableStallError",
    "build",
    "check",
    "drive",
    "export",
    "find_optimum",
    "generate",
    "import_layout",
    "load_config",
    "record",
    "show",
]

_MODULES = {
    "common.errors": ("ConfigError", "Garage2UsdError", "GenerationError", "UnreachableStallError"),
    "config": ("GarageConfig", "load_config"),
    "exports": ("export",),
    "garage_model": ("Garage",),
    "garage_sources": ("check", "drive"),
    "imports": ("import_layout",),
    "pipeline": ("Build", "build", "generate"),
    "planning.optimum": ("Optimum", "find_optimum"),
    "recordings": ("record",),
    "structure.grid": ("Structure",),
    "view.viewer.notebook": ("show",),
}
__getattr__ = on_first_use(__name__, _MODULES)


def __dir__() -> list[str]:
    """Return the public names of the package."""
    return __all__
