"""Garages that differ in their look alone, and what no look may change of them."""

import json
from functools import cache

from garage2usd.config import GarageConfig
from garage2usd.driving import prove_stalls
from garage2usd.pipeline import generate


def garage(**groups):
    """A small garage whose look has some groups of axes; made once in a process."""
    return _garage(json.dumps(groups, sort_keys=True))


@cache
def _garage(groups):
    return generate(GarageConfig(seed=3, plan={"episodes": 100}, look=json.loads(groups)))


@cache
def beside_its_look(made):
    """Plan, stalls, placements with what cars can touch of them, and proofs, as values that compare."""
    layout = made.layout
    return {
        "structure": layout.structure,
        "stalls": list(layout.stalls),
        "names": [place.name for place in layout.placements],
        "kinds": [place.kind for place in layout.placements],
        "places": [(place.position_m, place.yaw_rad, place.square, place.ordinal) for place in layout.placements],
        "outlines": [place.outlines() for place in layout.placements],
        "cores": layout.cores,
        "proofs": [repr(proof) for proof in prove_stalls(layout)],
    }
