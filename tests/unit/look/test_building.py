"""Columns, walls, ceilings and ducts: that a stage has what is asked for, and everything else stays where it was."""

import math
from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from pxr import Usd, UsdShade
from support.looks import beside_its_look, garage

from garage2usd.assets import MATERIALS
from garage2usd.assets.colours import linear_rgb, material_colour
from garage2usd.config import GarageConfig
from garage2usd.config.look import ColumnSection, Guard
from garage2usd.look import finishes_of
from garage2usd.objects.column import ColumnSpec
from garage2usd.objects.zone_plate import ColumnPlatesSpec
from garage2usd.pipeline import build

LOOKS = {
    "round": {
        "columns": {"section": "round", "guard": "rubber"},
        "ceiling": {"round_ducts": True, "services": "white"},
    },
    "rectangular": {"columns": {"section": "rectangular", "guard": "blue_yellow"}, "walls": {"dado": "none"}},
    "bare": {"columns": {"guard": "none", "colour": "white"}, "walls": {"finish": "blockwork", "dado": "green"}},
}
SIZE_M, CEILING_M = 0.6, 3.2


@pytest.fixture(scope="module")
def usual():
    return garage()


@pytest.fixture(scope="module")
def looks():
    return {name: garage(**groups) for name, groups in LOOKS.items()}


@pytest.mark.parametrize("name", LOOKS)
def test_everything_but_the_look_stays_as_it_is(usual, looks, name):
    assert beside_its_look(looks[name]) == beside_its_look(usual)


def column(**measures):
    spec = ColumnSpec(SIZE_M, CEILING_M, **measures)
    return spec, {part.name: part for part in spec.asset().parts}


def extent(part):
    return tuple(np.ptp(part.points, axis=0).round(4).tolist())


def volume(part):
    """Of a closed part, by the divergence theorem."""
    total = 0.0
    for loop in np.split(part.face_indices, np.cumsum(part.face_counts)[:-1]):
        corners = part.points[loop].astype(float)
        for a, b in pairwise(corners[1:]):
            total += np.dot(corners[0], np.cross(a, b)) / 6
    return total


SECTIONS_M2 = {
    "square": SIZE_M**2 - 2 * 0.03**2,
    "round": math.pi * (SIZE_M / 2) ** 2,
    "rectangular": 0.7 * SIZE_M**2 - 2 * 0.03**2,
}


@pytest.mark.parametrize("section", ColumnSection)
def test_columns_have_their_section_within_the_square(section):
    spec, parts = column(section=section, guard=Guard.NONE)
    shaft = parts["Shaft"]
    # 32 sides take the place of a circle
    assert volume(shaft) / CEILING_M == pytest.approx(SECTIONS_M2[section], rel=0.007)
    wide = 0.7 * SIZE_M if section is ColumnSection.RECTANGULAR else SIZE_M
    assert extent(shaft) == pytest.approx((wide, CEILING_M, SIZE_M))
    turned = column(section=section, guard=Guard.NONE, is_long_along_x=True)[1]["Shaft"]
    assert extent(turned) == pytest.approx((SIZE_M, CEILING_M, wide))
    assert spec.outlines() == ColumnSpec(SIZE_M, CEILING_M).outlines()


@pytest.mark.parametrize("section", ColumnSection)
@pytest.mark.parametrize("guard", Guard)
def test_guards_are_as_high_as_asked_for_and_within_the_square(section, guard):
    _, parts = column(section=section, guard=guard, guard_height_m=0.8)
    made_of = {name: part.material for name, part in parts.items() if name != "Shaft"}
    assert made_of == {
        Guard.NONE: {},
        Guard.RUBBER: {"Rubber": "rubber_black", "YellowRubber": "rubber_yellow"},
    }.get(guard, {"Guard": f"guard_{guard}"})
    points = np.concatenate([part.points for part in parts.values()])
    assert np.abs(points[:, [0, 2]]).max() == pytest.approx(SIZE_M / 2, abs=1e-5)
    if made_of:
        guards = np.concatenate([parts[name].points for name in made_of])
        assert (guards[:, 1].min(), guards[:, 1].max()) == (0.0, pytest.approx(0.8))
    assert parts["Shaft"].points[:, 1].min() == pytest.approx(0.8 if "Guard" in parts else 0.0)


def test_rubber_stands_before_its_shaft_on_all_four_corners_or_all_around():
    _, parts = column(guard=Guard.RUBBER)
    assert extent(parts["Shaft"])[::2] == pytest.approx((SIZE_M - 0.024,) * 2)
    assert extent(parts["Rubber"]) == pytest.approx((SIZE_M, 1.2, SIZE_M))
    # of a side, its middle stays bare
    front = parts["Rubber"].points[np.isclose(parts["Rubber"].points[:, 2], SIZE_M / 2)]
    assert np.abs(front[:, 0]).min() == pytest.approx(SIZE_M / 2 - 0.03 - 0.1, abs=1e-4)
    _, parts = column(section=ColumnSection.ROUND, guard=Guard.RUBBER)
    around = np.hypot(*parts["Rubber"].points[:, [0, 2]].T)
    assert {round(float(radius), 4) for radius in around} == {0.288, 0.3}


def test_rectangular_columns_are_long_along_the_stalls_beside_them(looks):
    layout = looks["rectangular"].layout
    turned = Counter(place.spec.is_long_along_x for place in layout.of_kind("column"))
    assert turned
    for place in layout.of_kind("column"):
        x, _, z = place.position_m
        near = [stall for stall in layout.stalls if math.dist(stall.centre_m, (x, z)) < 5.0]
        along_x = Counter(abs(math.sin(stall.yaw_rad)) > 0.5 for stall in near)
        if len(along_x) == 1:
            assert place.spec.is_long_along_x in along_x


@pytest.mark.parametrize("name", ["round", "rectangular"])
def test_what_hangs_on_columns_touches_them(looks, name):
    layout = looks[name].layout
    columns = {place.position_m[::2]: place for place in layout.of_kind("column")}
    beam_m = max(place.spec.depth_m for place in layout.of_kind("beam") if hasattr(place.spec, "length_m"))
    assert {place.spec.head_m for place in columns.values()} == {beam_m}
    hung = [place for kind in ("fire_extinguisher", "hydrant_cabinet") for place in layout.of_kind(kind)]
    on_columns = [place for place in hung if "_Column_" in place.name]
    assert on_columns
    assert sum(len(place.spec.boards) for place in columns.values()) <= len(on_columns)
    for place in on_columns:
        x, _, z = place.position_m
        at = min(columns, key=lambda at: math.dist(at, (x, z)))
        pillar = columns[at].spec
        side = {0.0: 0, math.pi / 2: 1, math.pi: 2, -math.pi / 2: 3}[place.yaw_rad]
        boards = [board for board in pillar.boards if board.side == side]
        gap_m = SIZE_M / 2 - pillar.side_m(side)
        assert len(boards) == 1 or (not boards and gap_m == 0)
        for board in boards:
            assert board.left_m < 0 < board.right_m
            assert board.low_m < 1.2 < board.high_m
    plates = [place for place in layout.of_kind("zone_plate") if isinstance(place.spec, ColumnPlatesSpec)]
    assert plates
    for place in plates:
        pillar = columns[place.position_m[::2]].spec
        turn = round(place.yaw_rad / (math.pi / 2)) % 4
        assert place.spec.sides_m == tuple(pillar.side_m(side + turn) for side in range(4))
    for place in layout.of_kind("mirror"):
        x, _, z = place.position_m
        at = min(columns, key=lambda at: math.dist(at, (x, z)))
        if math.dist(at, (x, z)) < 0.6:
            # the arm ends within the shaft, less than its own thickness deep
            end_m = math.dist(at, (x, z)) - place.spec.arm_m
            assert columns[at].spec.diagonal_m - 0.05 < end_m <= columns[at].spec.diagonal_m


@pytest.mark.parametrize(("width", "sides"), [(0.6, (0.3,) * 4), (0.45, (0.225,) * 4)])
def test_plates_bend_around_round_columns(width, sides):
    bent = ColumnPlatesSpec(("A1", "B12", "", "K12"), width, sides, is_round=True).asset()
    for part in bent.parts:
        for loop in np.split(part.face_indices, np.cumsum(part.face_counts)[:-1]):
            corners = part.points[loop].astype(float)
            # in front of the prism that the column is, by 4 mm or 7 mm
            middle = corners.mean(axis=0)[[0, 2]]
            side = np.round(np.degrees(np.arctan2(*middle)) / 11.25 - 0.5) + 0.5
            ahead = np.array([math.sin(math.radians(side * 11.25)), math.cos(math.radians(side * 11.25))])
            out = corners[:, [0, 2]] @ ahead - sides[0] * math.cos(math.pi / 32)
            assert ((out > 0.0039) & (out < 0.0071)).all()


def test_walls_and_cores_have_their_dado(usual, looks):
    def feet(made, kind):
        return {
            (part.material, round(float(part.points[:, 1].max()), 3))
            for place in made.layout.of_kind(kind)
            for part in place.spec.asset().parts
            if part.name in {"Band", "Stripe"}
        }

    assert feet(usual, "wall") == {("wall_band", 1.1), ("band_stripe", 1.22)}
    assert feet(looks["bare"], "wall") == {("wall_band", 1.1)}
    assert feet(looks["rectangular"], "wall") == set()
    assert {name for name, _ in feet(usual, "obstacle")} <= {"hazard"}
    assert {name for name, _ in feet(looks["bare"], "obstacle")} <= {"wall_band"}
    assert feet(looks["rectangular"], "obstacle") == set()


def test_round_ducts_stay_in_the_box_of_the_usual_ones(usual, looks):
    pairs = list(zip(usual.layout.of_kind("duct"), looks["round"].layout.of_kind("duct"), strict=True))
    assert pairs
    for old, new in pairs:
        points = [np.concatenate([part.points for part in place.spec.asset().parts]) for place in (old, new)]
        (low, high), (new_low, new_high) = ((each.min(axis=0), each.max(axis=0)) for each in points)
        # along its length a branch leads on into the duct that it joins
        assert (new_low[:2] >= low[:2] - 1e-6).all()
        assert (new_high[:2] <= high[:2] + 1e-6).all()
        body = next(part for part in new.spec.asset().parts if part.name == "Body")
        assert extent(body)[:2] == pytest.approx((0.8, 0.3))
        assert volume(body) == pytest.approx(2 * math.pi * 0.15**2 * extent(body)[2], rel=0.02)
    assert {place.spec.joint for _, place in pairs} > {0}


COLOURED = [
    ({"columns": {"colour": "#c9c4b8"}}, "column_concrete", "column_painted", "#c9c4b8"),
    ({"walls": {"finish": "painted", "colour": "#b9b6ae"}}, "wall_concrete", "wall_painted", "#b9b6ae"),
    ({"walls": {"finish": "blockwork", "colour": "#a8a49a"}}, "wall_concrete", "wall_blockwork", "#a8a49a"),
    ({"walls": {"finish": "panels", "colour": "#a8a49a"}}, "wall_concrete", "wall_panels", "#a8a49a"),
    ({"walls": {"colour": "#6b6863"}}, "wall_concrete", "wall_concrete", "#6b6863"),
    ({"walls": {"dado": "#4a6f9c"}}, "wall_band", "wall_dado", "#4a6f9c"),
    ({"ceiling": {"finish": "white"}}, "ceiling_concrete", "ceiling_painted", None),
    ({"ceiling": {"finish": "black"}}, "ceiling_concrete", "ceiling_painted", "#26272a"),
    ({"ceiling": {"finish": "boards"}}, "ceiling_concrete", "ceiling_insulation", None),
    ({"ceiling": {"services": "#2a2b2d"}}, "service_steel", "housing_white", "#2a2b2d"),
    ({"ceiling": {"services": "#2a2b2d"}}, "service_pipe", "housing_white", "#2a2b2d"),
]


@pytest.mark.parametrize(("groups", "role", "key", "colour"), COLOURED)
def test_finishes_have_the_material_and_the_mean_colour(groups, role, key, colour):
    finish = finishes_of(GarageConfig(look=groups).look)[role]
    assert finish.key == key
    assert finish.material.colour_texture == MATERIALS[key].colour_texture
    expected = linear_rgb(colour) if colour else material_colour(MATERIALS[key])
    assert material_colour(finish.material) == pytest.approx(expected, abs=0.01)


def test_usual_groups_have_no_finishes():
    roles = {"column_concrete", "wall_concrete", "wall_band", "ceiling_concrete", "service_steel", "service_pipe"}
    assert roles.isdisjoint(finishes_of(GarageConfig().look))
    usual = MATERIALS["wall_concrete"], MATERIALS["steel_galvanised"], MATERIALS["pipe_red"], MATERIALS["steel_dark"]
    own = "column_concrete", "service_steel", "service_pipe", "service_hanger"
    assert tuple(MATERIALS[role] for role in own) == usual


def test_a_stage_has_the_look(tmp_path):
    look = {
        "columns": {"section": "round", "guard": "red_white", "colour": "#c9c4b8"},
        "walls": {"finish": "blockwork", "dado": "blue", "dado_height_m": 0.7},
        "ceiling": {"finish": "boards", "services": "black", "round_ducts": True},
    }
    built = build(GarageConfig(seed=3, plan={"episodes": 100}, look=look), output=tmp_path / "garage.usda")
    stage = Usd.Stage.Open(str(built.stage))
    textures = {}
    for prim in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()):
        if prim.IsA(UsdShade.Material) and prim.GetName() not in textures:
            files = [
                str(shader.GetInput("file").Get().path)
                for shader in map(UsdShade.Shader, prim.GetChildren())
                if shader.GetInput("file") and shader.GetInput("file").Get()
            ]
            textures[prim.GetName()] = sorted(file.rsplit("/", 1)[-1].rsplit("_", 1)[0] for file in files)
    assert textures["ColumnConcrete"] == ["column_painted_colour"]
    assert textures["GuardRedWhite"] == ["guard_red_white"]
    assert textures["WallConcrete"] == ["blockwork_colour", "blockwork_normal"]
    assert "dado_colour" in textures["WallBand"]
    assert textures["CeilingConcrete"] == ["insulation_colour"]
    assert textures["ServiceSteel"] == []
    assert "BandStripe" not in textures
