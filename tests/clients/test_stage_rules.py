"""No stage of ours breaks a rule of USD, and a stage with one mistake breaks the one rule meant for it."""

import pytest
from pxr import Usd, UsdPhysics
from support.broken_usd import BROKEN, open_small_stage
from support.sample_files import each_build

from garage2usd.as_built.garage import garage_of_stage
from garage2usd.as_built.stage_reader import level_of_stage
from garage2usd.checks import findings_of
from garage2usd.checks.feasibility import BOOK as CONSISTENCY
from garage2usd.checks.usd import BOOK
from garage2usd.profiles import Profile

NO_CLAUSES = Profile(name="none")
RULES = {rule.name: rule for rule in BOOK.rules}
VALIDATORS = "usd-validation"  # proven on the samples by tests/clients/test_validators.py


def prims_of(stage):
    return Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())


@each_build
def test_stages_break_no_rule(sample, extension, builds):
    stage = Usd.Stage.Open(str(builds(sample, extension).stage))
    assert stage.GetDefaultPrim().GetPath() == "/Garage"
    assert not [prim for prim in prims_of(stage) if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    subject = level_of_stage(stage, source=sample.stem)
    rules = [rule for rule in (*RULES.values(), *CONSISTENCY.rules) if rule.name != VALIDATORS]
    assert [finding for rule in rules for finding in rule.findings(subject, NO_CLAUSES)] == []


def rules_broken(stage):
    """Rules that a stage breaks, apart from being no garage."""
    return {finding.rule for finding in findings_of(garage_of_stage(stage, source=""), NO_CLAUSES)} - {"lane-graph"}


def test_the_small_stage_breaks_no_rule(tmp_path):
    stage = open_small_stage(tmp_path)
    assert [prim for prim in prims_of(stage) if prim.HasAPI(UsdPhysics.CollisionAPI)]
    assert rules_broken(stage) == set()


@pytest.mark.parametrize(("rule", "changes"), BROKEN.values(), ids=BROKEN)
def test_a_broken_stage_breaks_one_rule(rule, changes, tmp_path):
    assert rules_broken(open_small_stage(tmp_path, changes)) == {rule}
