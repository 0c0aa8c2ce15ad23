"""Garages that are exported in five formats and imported again have every stall where it was, as it was."""

import itertools
import json
import math

import numpy as np
import pytest
import shapely
from pyproj import Transformer
from support.sample_files import REPOSITORY
from support.small_levels import SMALL_HELICES, SMALL_LEVELS
from support.soak import soak_but

import garage2usd
from garage2usd.config.outputs import MapsConfig
from garage2usd.garage_sources import read_built
from garage2usd.maps.frame import projection
from garage2usd.maps.georeference import georeference
from garage2usd.survey.reader import SURVEY_SUFFIXES

WITHIN_M = 0.01
IN_DEGREES = {"geojson", "osm.xml"}
FORMATS = [name for name in ("geojson", "osm.xml", "osm", "xodr", "dxf") if f".{name}" in SURVEY_SUFFIXES]
SMALL = {"seed": 4, "site": {"width_cells": 7, "height_cells": 8}, "plan": {"episodes": 60, "starts": 1}}
USES = {
    **SMALL,
    "parking": {"ev_share": 0.3, "accessible_share": 0.1},
    "stalls": {"sizes": {"standard": 0.6, "compact": 0.2, "large": 0.2}},
}
GARAGES = {
    "mixed": REPOSITORY / "samples/mixed_stalls.toml",
    "surveyed": REPOSITORY / "samples/surveys/lot.toml",
    "plain": REPOSITORY / "samples/paper_7x9.toml",
    "contour": REPOSITORY / "samples/irregular.toml",
    "drawn": REPOSITORY / "samples/hand_drawn.toml",
    "uses": garage2usd.GarageConfig(**USES),
    "german": garage2usd.GarageConfig(**{**SMALL, "profile": {"name": "de-garvo"}}),
    "american": garage2usd.GarageConfig(**{**SMALL, "profile": {"name": "us-ada"}, "seed": 9}),
    "levels": SMALL_LEVELS,
    "helices": SMALL_HELICES,
}
QUICK = [("mixed", "geojson"), ("surveyed", "xodr")]


@pytest.fixture(scope="session")
def stage_of(builds, tmp_path_factory):
    """Return the function that makes the stage of a garage once."""
    made = {}

    def stage(name):
        if name not in made:
            source, folder = GARAGES[name], tmp_path_factory.mktemp(name)
            if name == "surveyed":
                made[name] = garage2usd.import_layout(source, folder / "g.usdc", proves=False).stage
            elif isinstance(source, garage2usd.GarageConfig):
                made[name] = garage2usd.build(source, folder / "g.usdc").stage
            else:
                made[name] = builds(source, "usdc").stage
        return made[name]

    return stage


def grounds(built, to_common):
    """Return the stalls of each level with their corners in a frame that two garages have in common."""
    for level in built.levels:
        corners = np.array([stall.corners for stall in level.stalls]).reshape(-1, 2)
        yield level.stalls, to_common(corners).reshape(-1, 4, 2)


def on_earth(built):
    """Return the function from (x, z) of a stage to metres around 49, 9 degrees, or around its own place."""
    place = georeference(built.stage, MapsConfig())
    to_metres = Transformer.from_crs("EPSG:4326", projection(49.0, 9.0), always_xy=True)

    def to_common(points):
        return np.stack(to_metres.transform(*place.degrees(points * (1.0, -1.0)).T), -1) * (1.0, -1.0)

    return to_common


def of_survey(report):
    """Return the function from (x, z) of an imported stage back to the frame of its survey."""
    survey = json.loads(report.read_text())["survey"]
    turn = math.radians(survey["turn_deg"])
    axes = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    return lambda points: (points - survey["shift_m"]) @ axes


@pytest.mark.parametrize(
    ("name", "suffix"), soak_but(len(QUICK), [*QUICK, *sorted({*itertools.product(GARAGES, FORMATS)} - {*QUICK})])
)
def test_every_stall_comes_back(stage_of, tmp_path, name, suffix):
    stage = stage_of(name)
    (file,) = garage2usd.export(stage, [tmp_path / f"g.{suffix}"])
    made = garage2usd.import_layout(file, tmp_path / "again.usdc", proves=False)
    first, second = read_built(stage).garage, read_built(made.stage).garage
    assert len(first.levels) == len(second.levels)
    if suffix in IN_DEGREES:
        before, after = on_earth(first), on_earth(second)
    else:
        before, after = (lambda points: points), of_survey(tmp_path / "again_report.json")
    for (stalls, corners), (others, found) in zip(grounds(first, before), grounds(second, after), strict=True):
        tree = shapely.STRtree(shapely.points(found.mean(axis=1)))
        for stall, quad in zip(stalls, corners, strict=True):
            number = int(tree.nearest(shapely.Point(quad.mean(axis=0))))
            other = others[number]
            apart_m = np.linalg.norm(found[number] - quad, axis=1)
            assert apart_m.max() < WITHIN_M, stall.name  # the mouth is its first side in both
            said = [(str(each.number or ""), each.use, each.kind, each.size) for each in (stall, other)]
            assert said[0] == said[1], stall.name
        assert len(stalls) == len(others)
