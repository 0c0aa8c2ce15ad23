"""Heights that files tell: clear heights and ceilings, as the settings of the levels and as meshes."""

import json
from dataclasses import replace

import pytest

from garage2usd.config import GarageConfig
from garage2usd.config.fittings import FittingsConfig
from garage2usd.imports import import_layout
from garage2usd.layout.surveyed.heights import level_config
from garage2usd.survey.reader import read_survey
from garage2usd.survey.survey import Survey

NOTHING = Survey(())


def stall(x):
    return [(x, 0), (x + 2.5, 0), (x + 2.5, 5), (x, 5)]


def geojson(path, **outline):
    def feature(kind, points, **properties):
        ring = {"type": "Polygon", "coordinates": [[*points, points[0]]]}
        return {"type": "Feature", "geometry": ring, "properties": {"kind": kind, **properties}}

    around = feature("outline", [(0, 0), (15, 0), (15, 11), (0, 11)], **outline)
    parts = [around, *(feature("stall", stall(2.5 * number)) for number in range(6))]
    path.write_text(json.dumps({"type": "FeatureCollection", "coordinates": "metres", "features": parts}))
    return path


def osm(path, outline="", entrance=""):
    places = [(0, 0), (15, 0), (15, 11), (0, 11), *(at for number in range(6) for at in stall(2.5 * number)), (15, 8)]
    nodes = "".join(
        f'<node id="{number}" lat="0" lon="0"><tag k="local_x" v="{x}"/><tag k="local_y" v="{y}"/>'
        + (f'<tag k="amenity" v="parking_entrance"/><tag k="maxheight" v="{entrance}"/>' if (x, y) == (15, 8) else "")
        + "</node>"
        for number, (x, y) in enumerate(places, 1)
    )
    ways = [("parking", (1, 2, 3, 4, 1), f'<tag k="maxheight" v="{outline}"/>')]
    ways += [("parking_space", (5 + 4 * n, 6 + 4 * n, 7 + 4 * n, 8 + 4 * n, 5 + 4 * n), "") for n in range(6)]
    text = "".join(
        f'<way id="{number}">{"".join(f"<nd ref={chr(34)}{at}{chr(34)}/>" for at in members)}'
        f'<tag k="amenity" v="{kind}"/>{more}</way>'
        for number, (kind, members, more) in enumerate(ways, 1)
    )
    path.write_text(f'<osm version="0.6">{nodes}{text}</osm>')
    return path


@pytest.mark.parametrize(
    ("outline", "entrance", "height_m"),
    [("2.1", "2", 2.0), ("2.1 m", "none", 2.1), ("default", "6'11\"", 2.1082), ("below_default", "", None)],
)
def test_openstreetmap_tells_the_greatest_height_of_cars(tmp_path, outline, entrance, height_m):
    survey = read_survey(osm(tmp_path / "lot.osm", outline, entrance.replace('"', "&quot;")))
    assert survey.clear_height_m == (None if height_m is None else pytest.approx(height_m))


def test_heights_of_geojson_are_those_of_the_stage(tmp_path):
    path = geojson(tmp_path / "lot.geojson", maxheight=2.0, ceiling_height=2.6)
    made = import_layout(path, tmp_path / "lot.usdc", proves=False)
    fittings = made.garage.levels[0].config.fittings
    assert (fittings.clear_height_m, fittings.ceiling_height_m) == (2.0, 2.6)
    assert {"the clear height is 2 m, as surveyed", "the ceiling is 2.6 m high, as surveyed"} <= set(made.remarks)
    (ceiling_m,) = {place.position_m[1] for place in made.garage.levels[0].layout.of_kind("ceiling")}
    assert ceiling_m == 2.6
    own = GarageConfig(fittings=FittingsConfig(clear_height_m=2.4, ceiling_height_m=3))
    made = import_layout(path, tmp_path / "own.usdc", proves=False, config=own)
    assert made.garage.levels[0].config.fittings == own.fittings


@pytest.mark.parametrize(
    ("number", "storey_m", "clear_m", "ceiling_m", "built", "words"),
    [
        (0, 0.0, None, None, (2.2, 3.2), []),
        (0, 0.0, 3.5, None, (3.5, 3.65), ["3.5 m, as surveyed"]),
        (0, 0.0, 1.8, None, (2.0, 3.2), ["2 m, as near"]),
        (0, 0.0, None, 2.3, (2.2, 2.4), ["2.4 m high, as near"]),
        (0, 0.0, 2.3, 2.4, (2.25, 2.4), ["2.4 m high, as surveyed", "2.25 m, as near"]),
        (0, 0.0, 9.0, 30.0, (6.0, 8.0), ["8 m high, as near", "6 m, as near"]),
        (1, 2.8, None, None, (2.2, 2.55), []),
        (1, 2.8, 3.0, None, (2.4, 2.55), ["2.4 m, as near"]),
    ],
)
def test_heights_are_those_of_the_survey_as_far_as_garages_have_them(
    number, storey_m, clear_m, ceiling_m, built, words
):
    survey = replace(NOTHING, clear_height_m=clear_m, ceiling_height_m=ceiling_m)
    config, told = level_config(GarageConfig(), number, storey_m, survey)
    fittings = config.fittings
    assert (fittings.clear_height_m, fittings.ceiling_height_m) == pytest.approx(built)
    FittingsConfig.model_validate(fittings.model_dump())
    assert len(told) == len(words)
    assert all(word in remark for word, remark in zip(words, told, strict=True))
