"""Profiles whose clauses are drawn in the ranges that the shipped ones span, and somewhat beyond."""

import numpy as np

from garage2usd.profiles import PROFILE_NAMES, LengthRange, Profile, Steps, load_profile, read_profile
from garage2usd.profiles.clauses import Amount, Count, LengthsByAngle

__all__ = ["random_profile"]

BEYOND = 0.15
"""How far a value may lie outside the range, as a share of its ends: most clauses are the same in all shipped ones."""
RANGES = {
    # what no shipped profile asks for
    "stretch_length": {"value": 61.0, "unit": "m"},
    "column_spacing": {"least": 8.1, "most": 8.5, "unit": "m"},
}
TOLD = {"source": "random", "confidence": "low"}


def random_profile(seed: int) -> Profile:
    """One with about half of all clauses, each of which an error misses."""
    draw = np.random.default_rng(seed)
    shipped = [dict(load_profile(name).clauses()) for name in PROFILE_NAMES]
    rare = read_profile({"name": "rare", **{name: {**TOLD, **clause} for name, clause in RANGES.items()}})
    clauses = {}
    for name in Profile.model_fields:
        known = [profile[name] for profile in (*shipped, dict(rare.clauses())) if name in profile]
        if known and draw.random() < 0.5:
            clauses[name] = {**_drawn(known, draw), **TOLD}
    return read_profile({"name": "random", **clauses})


def _drawn(known, draw):
    if isinstance(known[0], Steps):
        steps = known[draw.integers(len(known))]
        return {key: getattr(steps, key) for key in ("steps", "above", "above_percent", "unit") if getattr(steps, key)}
    if isinstance(known[0], LengthRange):
        least, most = sorted(draw.uniform(*known[draw.integers(len(known))].bounds, 2).tolist())
        return {"least": least, "most": most, "unit": "m"}
    if isinstance(known[0], LengthsByAngle):
        clause = known[draw.integers(len(known))]
        factor = draw.uniform(1 / (1 + BEYOND), 1 + BEYOND)
        values = [round(clause.amount_at(angle) * factor, 3) for angle in clause.angles_deg]
        return {"angles_deg": clause.angles_deg, "values": values, "unit": "m"}
    values = [clause.amount for clause in known if isinstance(clause, Amount)]
    value = draw.uniform(min(values) / (1 + BEYOND), max(values) * (1 + BEYOND))
    is_whole = isinstance(known[0], Count)
    return {"value": round(float(value)) if is_whole else round(float(value), 3), "unit": known[0].reported_in}
