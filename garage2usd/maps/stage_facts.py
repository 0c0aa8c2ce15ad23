"""Provenance of a stage."""

from pxr import Usd

__all__ = ["stage_facts"]

_FACTS = ("generator", "version", "seed", "configDigest", "structureDigest")


def stage_facts(stage: Usd.Stage | None) -> dict[str, str | int]:
    """Read generator, version, seed and digests from a stage's default prim, as far as given."""
    prim = stage.GetDefaultPrim() if stage else None
    data = prim.GetCustomData() if prim else {}
    return {name: data[name] for name in _FACTS if isinstance(data.get(name), str | int)}
