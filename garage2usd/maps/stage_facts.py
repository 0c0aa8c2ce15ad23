"""What a stage says of where it comes from."""

from pxr import Usd

__all__ = ["stage_facts"]

_FACTS = ("generator", "version", "seed", "configDigest", "structureDigest")


def stage_facts(stage: Usd.Stage | None) -> dict[str, str | int]:
    """Generator, version, seed and digests of a stage's default prim, as far as it says so."""
    prim = stage.GetDefaultPrim() if stage else None
    data = prim.GetCustomData() if prim else {}
    return {name: data[name] for name in _FACTS if isinstance(data.get(name), str | int)}
