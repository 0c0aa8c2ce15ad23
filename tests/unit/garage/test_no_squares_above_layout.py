"""Above `layout` a garage is lanes and stalls in metres: nobody asks for squares or for the layout's own stalls."""

import ast
import re

import pytest
from support.sample_files import REPOSITORY

PACKAGE = REPOSITORY / "garage2usd"
GRID_ROOMS = {"structure", "planning", "site", "layout"}
GRID_NAMES = {
    "Edge", "LaneSquares", "NEIGHBOUR_STEPS", "PlacedStall", "Square", "StallPlace", "StallRow", "StallTable",
    "StallType", "Tile", "TileGrid", "box_inside", "build_lane_graph", "edge_yaw_rad", "stall_name", "stall_rows",
    "stalls_of", "unproven_lane_graph",
}  # fmt: skip
GRID_FIELDS = {"access_square", "lane_squares", "stall_places", "stall_rows", "stall_type", "stall_types"}
ALLOWED = {
    # the road from a structure to its layout, of a configuration and of a file
    "level_plans.py": {"LaneSquares", "build_lane_graph", "stall_rows"},
    "garage_model.py": {"LaneSquares"},
    "pipeline.py": {"LaneSquares"},
    "as_built/plan_reader.py": {"build_lane_graph", "stall_rows", "unproven_lane_graph"},
    # squares themselves are drawn
    "drafts/change.py": {"Edge"},
}
NAMED_AFTER_SQUARES = {"stage/arrangement.py", "driving/layout_garage.py"}
"""Modules with names of prims: of tiles, and of objects on them."""


def modules():
    for path in sorted(PACKAGE.rglob("*.py")):
        place = path.relative_to(PACKAGE)
        if place.parts[0] not in GRID_ROOMS:
            yield place.as_posix(), path.read_text(encoding="utf-8")


def grid_names(source):
    """What a module imports or reads of the grid."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom) and {*(node.module or "").split(".")} & GRID_ROOMS:
            found |= {name.name for name in node.names} & GRID_NAMES
        elif isinstance(node, ast.Attribute):
            found |= {node.attr} & GRID_FIELDS
    return found


def names_squares(source):
    """True if a module puts a name like ``r03_c07`` together or takes one apart."""
    return bool(re.search(r"r\{[^}]*02d\}|_c\{|_c\(*\\+d|r\d\d_c\d\d", without_docstrings(source)))


def without_docstrings(source):
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            node.value = ast.Constant(value=0)
    return ast.unparse(tree)


def test_nobody_above_layout_asks_for_the_grid():
    found = {place: names for place, source in modules() if (names := grid_names(source))}
    assert found == ALLOWED


def test_only_names_of_prims_are_made_of_squares():
    assert {place for place, source in modules() if names_squares(source)} == NAMED_AFTER_SQUARES


def test_one_lane_graph_and_one_stall_stand_above_structure():
    defined = {
        node.name: place
        for place, source in modules()
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.ClassDef) and re.search(r"Stall$|LaneGraph$|LaneNode$|LaneEdge$", node.name)
    }
    assert defined == {
        "LaneGraph": "garage/lanes.py",
        "LaneNode": "garage/lanes.py",
        "LaneEdge": "garage/lanes.py",
        "Stall": "garage/stalls.py",
        "SurveyedStall": "survey/survey.py",  # as a drawing of others has it, before it is placed
        "DrawnStall": "survey/toml_survey.py",  # its settings in a TOML drawing
        "FoundStall": "survey/dxf_stalls.py",  # as a drawing has it, in its units
        "FittedStall": "survey/fitted_stalls.py",  # with its mouth and lane
        "ReportedStall": "reading/report.py",  # the record of one in the report's JSON
    }


@pytest.mark.parametrize(
    ("source", "names"),
    [
        ("from garage2usd.structure.stalls import Edge", {"Edge"}),
        ("from garage2usd.layout import Layout, PlacedStall", {"PlacedStall"}),
        ("def way(layout):\n    return layout.lane_squares.graph", {"lane_squares"}),
        ("from garage2usd.garage import LaneGraph", set()),
    ],
)
def test_the_rule_sees_what_breaks_it(source, names):
    assert grid_names(source) == names


def test_a_name_of_a_square_is_seen():
    assert names_squares('name = f"Stall_r{row:02d}_c{col:02d}"')
    assert names_squares('import re\nre.match(r"Stall_r(\\d+)_c(\\d+)", name)')
    assert not names_squares('"""A stall, such as ``Stall_r03_c07_2``."""')
