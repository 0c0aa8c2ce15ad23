"""Any value in any place ends in an error of ours, or is accepted."""

import copy
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garage2usd.common.errors import Garage2UsdError
from garage2usd.config import GarageConfig, config_from_mapping
from garage2usd.garage_sources import read_built
from garage2usd.planning import play
from garage2usd.profiles import DEFAULT_PROFILE, load_profile, read_profile
from garage2usd.structure.grid import Cell, Structure, cells_from_text

scalars = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.integers(-(10**400), 10**400)
    | st.floats()
    | st.sampled_from([1e308, -1e308, 5e-324, 1e15])
    | st.text(max_size=20)
    | st.sampled_from(["nan", "\0", "../../etc/passwd", "\udcff", "1e999"])
)
values = st.recursive(
    scalars,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4),
    max_leaves=12,
)
SECTIONS = GarageConfig().model_dump()
PLACES = [(name,) for name in SECTIONS]
PLACES += [(name, key) for name, section in SECTIONS.items() if isinstance(section, dict) for key in section]
PROFILE = load_profile(DEFAULT_PROFILE).model_dump(mode="json") | {"name": "own"}
DRAWING = "#E###\n.=...\n.===.\n...=.\n###X#"


def put(document, place, value):
    """The same with a value in place of another one."""
    changed = copy.deepcopy(document)
    inner = changed
    for key in place[:-1]:
        inner = inner.setdefault(key, {})
    inner[place[-1]] = value
    return changed


def attempt(call, *arguments, **named):
    """What a call gives, or its error of ours."""
    try:
        return call(*arguments, **named), None
    except Garage2UsdError as error:
        return None, error


@settings(max_examples=300, deadline=None)
@given(st.sampled_from(PLACES), values)
def test_settings_are_accepted_or_named(place, value):
    config, error = attempt(config_from_mapping, put({}, place, value))
    if error is not None:
        assert error.field.split(".")[0].split("[")[0] == place[0]
    else:
        assert config_from_mapping(config.model_dump(mode="json")).digest() == config.digest()


@settings(max_examples=200, deadline=None)
@given(st.sampled_from(sorted(PROFILE)), values)
def test_clauses_are_accepted_or_named(name, value):
    profile, error = attempt(read_profile, put(PROFILE, (name,), value))
    assert profile is not None or name in error.field


@settings(max_examples=300, deadline=None)
@given(st.text(alphabet="#.=EX0123-, \n\t\rab\0", max_size=80) | st.text(max_size=40))
def test_drawings_are_matrices_or_refused(text):
    cells, error = attempt(cells_from_text, text, field="S")
    if error is not None:
        assert error.field.startswith("S")
    else:
        assert cells.ndim == 2
        assert np.isin(cells, list(Cell)).all()


@settings(max_examples=300, deadline=None)
@given(values, values, values)
def test_matrices_make_a_structure_or_are_refused(S, R, C):
    structure, error = attempt(Structure.from_arrays, S, R, C)
    assert structure is not None or error.field[0] in "SRC"


@settings(max_examples=200, deadline=None)
@given(st.text(max_size=30) | st.text(alphabet="UDLR", max_size=40))
def test_tapes_are_played_or_refused(tape):
    site = Structure.from_arrays(cells_from_text("#E###\n.....\n.....\n.....\n###X#", field="S"), 8.1, 8.1)
    plan, error = attempt(play, site, tape)
    assert error.field.startswith("tape") if plan is None else (plan.cells == Cell.LANE).any()


@settings(max_examples=120, deadline=None)
@given(st.sampled_from(["config", "S", "R", "C", "stalls", "unreachable_stalls"]), values)
def test_reports_are_read_or_refused(report, key, value):
    path, document = report
    path.write_text(json.dumps(put(document, (key,), value)))
    read, error = attempt(read_built, path)
    assert error is not None or read.garage.lanes.nodes


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """A report as far as a check reads it."""
    document = {
        "seed": 0,
        "config": GarageConfig(site={"structure": DRAWING}).model_dump(mode="json"),
        "S": DRAWING.splitlines(),
        "R": [8.1] * 5,
        "C": [8.1] * 5,
        "stalls": [],
    }
    return tmp_path_factory.mktemp("report") / "report.json", document
