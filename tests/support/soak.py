"""Wide tests, which `make soak` runs and `make test` leaves out: sweeps over seeds, samples, bodies and systems.

``@pytest.mark.soak`` marks one; `soak_but` marks the cases of a parametrized test but for a few.
CI runs one of `PARTS` of them, another one each time.
"""

import pytest

from support.durations import UNKNOWN_S, soak_key

PARTS = 8


def soak_but(kept, cases):
    """Cases for ``parametrize``, of which all but the given ones, or the first few, are for `make soak`."""
    cases = list(cases)
    kept = cases[:kept] if isinstance(kept, int) else list(kept)
    left = [case for case in kept if case not in cases]
    if left:
        raise ValueError(f"no case is {left}: {cases}")
    return [case if case in kept else _soak(case) for case in cases]


def chosen(items, *, soak, part, durations):
    """Tests that run and tests that do not: the wide ones, all or one of their `PARTS`, or else all others."""
    run = [item for item in items if (item.get_closest_marker("soak") is not None) == soak]
    if soak and part is not None:
        parts = _parts(run, durations)
        run = [item for item in run if parts[soak_key(item.nodeid)] == part]
    rest = {id(item) for item in run}
    return run, [item for item in items if id(item) not in rest]


def _soak(case):
    is_several = isinstance(case, tuple) and not hasattr(case, "_fields")  # of several parameters
    values = case.values if isinstance(case, type(pytest.param())) else case if is_several else (case,)
    marks = getattr(case, "marks", ())
    return pytest.param(*values, marks=[*marks, pytest.mark.soak], id=getattr(case, "id", None))


def _parts(items, durations):
    """Part of each wide test: the longest first, each to the part that has the least so far."""
    keys = {soak_key(item.nodeid) for item in items}
    filled_s, part_of = [0.0] * PARTS, {}
    for key in sorted(keys, key=lambda key: (-durations.get(key, UNKNOWN_S), key)):
        part = filled_s.index(min(filled_s))
        part_of[key] = part
        filled_s[part] += durations.get(key, UNKNOWN_S)
    return part_of
