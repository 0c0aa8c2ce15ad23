"""Many small edits of a stage, as other tools make them: each is read, checked, driven and exported, or one line."""

from random import Random

import pytest
from pxr import Gf, UsdGeom, Vt
from support.edited_stages import edited
from support.small_garage import SETTINGS
from support.small_levels import SMALL_LEVELS
from support.soak import soak_but

from garage2usd import GarageConfig, build
from garage2usd.as_built.proofs import prove_built
from garage2usd.checks import RULES, as_table, swept_path, usd
from garage2usd.checks.levels import findings_of_whole
from garage2usd.common.errors import Garage2UsdError
from garage2usd.exports import export
from garage2usd.garage_sources import read_built
from garage2usd.maps.drives import DrivePlanner

QUICK = tuple(rule for rule in RULES if rule not in (*usd.BOOK.rules, *swept_path.BOOK.rules))
SCALES = 0.0, 1.0, 2.0, -1.0, 1e-12, 1e6


def drawn_edit(number):
    """Return the edit of a number."""
    rng = Random(number)  # noqa: S311 - edits are no secrets

    def edit(stage):
        for _ in range(rng.choice([1, 1, 2, 3])):
            prims = [prim for prim in stage.Traverse() if str(prim.GetPath()).startswith("/Garage/")]
            if prims:
                rng.choice(EDITS)(stage, rng.choice(prims), rng)

    return edit


def deactivate(_stage, prim, _rng):
    prim.SetActive(False)


def deactivate_many(_stage, prim, rng):
    for child in prim.GetParent().GetChildren():
        child.SetActive(rng.random() < 0.5)


def hide(_stage, prim, _rng):
    if imageable := UsdGeom.Imageable(prim):
        imageable.MakeInvisible()


def move(_stage, prim, rng):
    while prim and not prim.HasAttribute("xformOp:translate"):
        prim = prim.GetParent()
    if prim:
        attribute = prim.GetAttribute("xformOp:translate")
        place = attribute.Get()
        attribute.Set(type(place)(*(value + rng.choice([0, rng.uniform(-9, 9)]) for value in place)))


def scale(_stage, prim, rng):
    if place := UsdGeom.Xformable(prim):
        place.AddScaleOp(opSuffix="edit").Set(Gf.Vec3f(*(rng.choice(SCALES) for _ in range(3))))


def rename_type(_stage, prim, rng):
    prim.SetTypeName(rng.choice(["Scope", "Mesh", "Xform", "", "Points"]))


def relabel(_stage, prim, rng):
    if attribute := prim.GetAttribute("semantics:labels:class"):
        attribute.Set(Vt.TokenArray([rng.choice(["ramp", "car", "light", "", "wall", "vehicle_door"])]))


def change_value(_stage, prim, rng):
    """Block a value, or empty, halve or shuffle an array."""
    attributes = [attribute for attribute in prim.GetAuthoredAttributes() if attribute.HasAuthoredValue()]
    if not attributes:
        return
    attribute = rng.choice(attributes)
    if not attribute.GetTypeName().isArray or rng.random() < 0.2:
        attribute.Block()
        return
    values = list(attribute.Get())
    rng.shuffle(values)
    attribute.Set(type(attribute.Get())(rng.choice([[], values[: len(values) // 2], values, values[:1] * len(values)])))


def change_lanes(stage, _prim, rng):
    curves = [prim for prim in stage.TraverseAll() if "/LaneGraph" in str(prim.GetPath())]
    change_value(stage, rng.choice(curves), rng)


EDITS = (
    *(deactivate, deactivate_many, hide, move, scale, rename_type, relabel, change_value),
    *(change_lanes, change_lanes, change_lanes),
)


def tries(file, out):
    """Do all that is done with a stage; each step ends in a result or in an error of garage2usd."""
    try:
        garage, profile, *_ = read_built(file)
    except Garage2UsdError:
        return
    as_table(finding for rule in QUICK for level in garage.levels for finding in rule.findings(level, profile))
    as_table(findings_of_whole(garage, profile))
    prove_built(garage)
    names = [stall.name for stall in garage.stalls if stall.takes_cars]
    for step in (
        lambda: DrivePlanner(garage).drive(names[-1] if names else "A1-01"),
        *(
            lambda end=end: export(file, [out / f"a{end}"])
            for end in (".xodr", ".osm", ".xosc", ".add.xml", ".yaml", ".glb", ".sdf")
        ),
    ):
        try:
            step()
        except Garage2UsdError:
            continue


@pytest.fixture(scope="module")
def one_level(tmp_path_factory):
    return build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("one") / "g.usda").stage


@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # of numbers that are too large or none
@pytest.mark.parametrize("number", soak_but(5, range(300)))
def test_an_edited_stage_gives_findings_or_a_line(number, one_level, tmp_path):
    tries(edited(one_level, tmp_path / "edited.usda", drawn_edit(number)), tmp_path)


@pytest.mark.soak
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_edited_stages_of_two_levels_give_findings_or_lines(tmp_path):
    built = build(SMALL_LEVELS, tmp_path / "g.usda").stage
    for number in range(40):
        folder = tmp_path / str(number)
        folder.mkdir()
        tries(edited(built, folder / "edited.usda", drawn_edit(number)), folder)
