"""Provenance of a stage."""

from pxr import Usd

from garage2usd.reading.whole_garage import garage_root

__all__ = ["stage_facts"]

_FACTS = ("generator", "version", "seed", "configDigest", "structureDigest")


def stage_facts(stage: Usd.Stage | None) -> dict[str, str | int]:
    """Read generator, version, seed and digests from a stage's default prim, as far as given."""
    prim = garage_root(stage) if stage else None
    data = prim.GetCustomData() if prim else {}
    return {name: data[name] for name in _FACTS if isinstance(data.get(name), str | int)}
