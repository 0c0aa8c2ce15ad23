"""Fire hydrants and extinguishers within reach, against distances that are measured here anew."""

from dataclasses import replace

import numpy as np
import pytest
from support.small_garage import SETTINGS

from garage2usd import GarageConfig
from garage2usd.as_built.layout_reader import level_of_layout
from garage2usd.checks import safety
from garage2usd.pipeline import generate
from garage2usd.profiles import load_profile

CN, US = load_profile("cn-jgj100"), load_profile("us-ada")


@pytest.fixture(scope="module")
def subject():
    garage = generate(GarageConfig(**SETTINGS))
    return level_of_layout(garage.layout, source="layout", kind="plan")


LABELS = {"hydrant_cabinet", "fire_extinguisher"}


def found(subject, profile):
    rules = [rule for rule in safety.BOOK.rules if "hydrant" in rule.name or "extinguisher" in rule.name]
    return [finding for rule in rules for finding in rule.findings(subject, profile)]


def with_clause(name, metres):
    clause = getattr(CN, name)
    return CN.model_copy(update={name: clause.model_copy(update={"value": metres})})


def places(subject):
    middles = [np.mean(stall.corners, axis=0) for stall in subject.stalls]
    return np.array(middles + [node.position for node in subject.lanes.nodes if not node.is_portal])


def hung(subject, label):
    return np.array(
        [
            np.concatenate([body.shape.points @ body.matrix[:3, :3] + body.matrix[3, :3] for body in thing.bodies])[
                :, [0, 2]
            ].mean(axis=0)
            for thing in subject.things
            if thing.label == label
        ]
    )


def test_the_small_garage_has_enough_and_a_profile_without_clauses_asks_for_nothing(subject):
    assert found(subject, CN) == found(subject, US) == []
    bare = replace(subject, things=tuple(thing for thing in subject.things if thing.label not in LABELS))
    assert [finding.rule for finding in found(bare, CN)] == ["hydrant-cabinet-distance", "fire-extinguisher-distance"]
    assert found(bare, load_profile("de-garvo")) == []
    assert found(replace(bare, things=()), CN) == []


@pytest.mark.parametrize(
    ("label", "clause", "rule", "count", "norm"),
    [
        ("hydrant_cabinet", "hydrant_reach", "hydrant-cabinet-distance", 2, 2),
        ("fire_extinguisher", "extinguisher_distance", "fire-extinguisher-distance", 1, 1),
    ],
)
def test_the_farthest_place_is_named_with_its_distance(label, clause, rule, count, norm, subject):
    ways = np.abs(places(subject)[:, None] - hung(subject, label)[None])
    distance = np.sort(ways.sum(axis=2) if norm == 1 else np.hypot(*ways.transpose(2, 0, 1)), axis=1)[:, count - 1]
    worst = distance.max()
    assert found(subject, with_clause(clause, float(worst + 0.3))) == []
    (finding,) = found(subject, with_clause(clause, float(worst - 0.3)))
    assert finding.rule == rule
    assert finding.measured == pytest.approx(worst, abs=0.3)
    assert finding.severity.value == "warning"
    nearest = np.abs(places(subject) - finding.position_m).sum(axis=1).argmin()
    assert distance[nearest] == pytest.approx(worst, abs=0.5)


def test_hydrants_are_near_enough_to_each_other(subject):
    at = hung(subject, "hydrant_cabinet")
    apart = np.hypot(*(at[:, None] - at[None]).transpose(2, 0, 1)) + np.diag(np.full(len(at), np.inf))
    worst = apart.min(axis=1).max()
    assert found(subject, with_clause("hydrant_spacing", float(worst + 0.3))) == []
    (finding,) = found(subject, with_clause("hydrant_spacing", float(worst - 0.3)))
    assert (finding.rule, finding.measured) == ("hydrant-spacing", pytest.approx(worst, abs=0.3))
