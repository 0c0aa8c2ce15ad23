"""Lazy loading of a package's public names, so that its import is fast."""

from collections.abc import Callable, Mapping
from importlib import import_module

__all__ = ["on_first_use"]


def on_first_use(package: str, home: Mapping[str, str]) -> Callable[[str], object]:
    """Make the ``__getattr__`` of a package; `home` maps its public names to modules."""

    def load(name: str) -> object:
        if name not in home:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return getattr(import_module(f"{package}.{home[name]}"), name)

    return load
