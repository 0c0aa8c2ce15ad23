"""Plans, configurations and reports with one thing wrong: exactly the rule meant for it reports it."""

import json

import pytest
from support.broken_plans import CLIENTS, DRAWN, KINDS, LONG_AISLE, SETTINGS_BROKEN, M
from support.small_garage import PLAN, SETTINGS
from support.soak import soak_but

from garage2usd import GarageConfig, build
from garage2usd.as_built import BuiltGarage
from garage2usd.as_built.layout_reader import level_of_layout
from garage2usd.checks import Severity, findings_of
from garage2usd.common.errors import ConfigError, ReportError, StageError
from garage2usd.garage_sources import check
from garage2usd.layout import lay_out
from garage2usd.planning import given_plan, with_stall_kinds
from garage2usd.profiles import load_profile, read_profile
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

FOUND_IN_GOOD_ONE = {"personnel-exits"}
CN = load_profile("cn-jgj100")
CIRCULATION = {"dead-end-depth", "loop", "stretch-length", "lane-field"}


def profile_with(**clauses):
    """The default profile with some clauses of another value."""
    settings = CN.model_dump(mode="json", exclude_none=True)
    for name, clause in clauses.items():
        settings[name] = {"source": "the client", "confidence": "high", **settings.get(name, {}), **clause}
    return read_profile({**settings, "name": "client"})


def found_in(settings, profile=CN):
    config = GarageConfig(**settings)
    side = config.bay.square_side_m
    widths = side if config.bay.column_widths_m is None else config.bay.column_widths_m
    depths = side if config.bay.row_depths_m is None else config.bay.row_depths_m
    structure = Structure.from_arrays(cells_from_text(config.site.structure, field="S"), widths, depths)
    plan = with_stall_kinds(given_plan(structure, bay=config.bay), config)
    structure, graph = plan.structure, build_lane_graph(plan.structure, config.bay, plan.runs)
    subject = level_of_layout(lay_out(structure, graph, config), source="", kind="plan")
    return {finding.rule for finding in findings_of(BuiltGarage.of_level(subject), profile)}


def settings_with(**sections):
    return {
        **SETTINGS,
        **{name: {**SETTINGS.get(name, {}), **values} for name, values in sections.items()},
    }


@pytest.mark.parametrize(("rule", "drawing"), DRAWN.values(), ids=DRAWN)
def test_a_broken_drawing_is_reported_by_the_rule_meant_for_it(rule, drawing, tmp_path):
    (tmp_path / "plan.txt").write_text(drawing)
    findings, profile = check(tmp_path / "plan.txt")
    assert profile is CN
    told = {finding.rule for finding in findings if finding.severity is not Severity.INFO or finding.rule == rule}
    # small drawings hardly circulate, unless that is what they are about
    expected = FOUND_IN_GOOD_ONE if rule in CIRCULATION else FOUND_IN_GOOD_ONE | CIRCULATION
    assert told - expected == {rule}


@pytest.mark.parametrize(("rule", "sections"), SETTINGS_BROKEN.values(), ids=SETTINGS_BROKEN)
def test_what_the_user_sets_stays_and_is_reported(rule, sections):
    assert found_in(settings_with(**sections)) - FOUND_IN_GOOD_ONE == {rule}


@pytest.mark.parametrize(("rule", "clauses"), CLIENTS.values(), ids=CLIENTS)
def test_a_profile_of_ones_own_asks_for_more(rule, clauses):
    assert found_in(SETTINGS, profile_with(**clauses)) - FOUND_IN_GOOD_ONE == {rule}


@pytest.mark.parametrize(("rule", "stalls", "clauses"), KINDS.values(), ids=KINDS)
def test_a_profile_of_ones_own_asks_for_more_of_a_kind_of_stall(rule, stalls, clauses):
    settings = settings_with(stalls=stalls, parking={"occupied_stalls": None})
    before = found_in(settings)
    assert found_in(settings, profile_with(**clauses)) - before == {rule}


@pytest.mark.parametrize("slope_percent", [10.5, 13.103, 14.885])
def test_ramps_of_any_slope_have_their_transitions(slope_percent):
    # half of each lies beside a border of rounding to a tenth of a percent, in the single precision of meshes
    assert found_in(settings_with(fittings={"ramp_slope_percent": slope_percent})) == FOUND_IN_GOOD_ONE


def test_without_sprinklers_less_is_allowed():
    profile = profile_with(fire_compartment_area={"value": 500})
    assert found_in(SETTINGS, profile) == FOUND_IN_GOOD_ONE
    assert found_in(settings_with(fittings={"sprinklers": False}), profile) == FOUND_IN_GOOD_ONE | {"fire-compartment"}


@pytest.mark.parametrize(("sprinklers", "rule"), [(True, "exit-distance-sprinklered"), (False, "exit-distance")])
def test_the_farthest_stall_from_the_stair_cores_is_named(sprinklers, rule):
    drawing = ".......\n..#....\nE=====X\n......."
    settings = settings_with(
        site={"structure": drawing},
        fittings={"sprinklers": sprinklers, "stair_cores": False},
        parking={"occupied_stalls": []},
    )
    near = profile_with(**{rule.replace("-", "_"): {"value": 20}})
    assert found_in(settings, near) - FOUND_IN_GOOD_ONE == {rule}
    assert found_in(settings) - FOUND_IN_GOOD_ONE == set()


def test_a_narrow_aisle_is_reported():
    drawing = "...E...\n.=====.\n.=...=.\n.=...=.\n.=====.\n...X..."
    widths = [8.1, 6.1, 8.1, 8.1, 8.1, 6.3, 8.1]
    settings = settings_with(
        site={"structure": drawing}, bay={"column_widths_m": widths}, parking={"occupied_stalls": []}
    )
    assert found_in(settings) - FOUND_IN_GOOD_ONE - {"column-spacing"} == {"aisle-width"}


def profile_without(*names, **clauses):
    settings = profile_with(**clauses).model_dump(mode="json", exclude_none=True)
    return read_profile({name: value for name, value in settings.items() if name not in names})


WIDE_CIRCLE = {"turning_radius": {"value": 12.0, **M}}


@pytest.mark.parametrize(
    ("profile", "rules"),
    [
        (profile_with(**WIDE_CIRCLE), {"aisle-width"}),
        # the search for one of the stalls ends at its bound
        (profile_without("aisle_width", **WIDE_CIRCLE), {"swept-path", "swept-path-undecided"}),
        (profile_without("aisle_width", "turning_radius", "design_car_height"), set()),
    ],
    ids=["by the rule of aisles", "by the car that does not get round", "not where the usual car gets round"],
)
def test_an_aisle_too_narrow_to_turn_in_is_reported_once(profile, rules):
    settings = settings_with(bay={"row_depths_m": [8.1, 4.2, 8.1], "column_widths_m": 8.1})
    assert found_in(settings, profile) - FOUND_IN_GOOD_ONE - {"portal-width"} == rules


def test_a_stage_and_its_report_say_the_same_of_stalls_that_no_car_gets_into(tmp_path):
    drawing = "...\nE=X"
    free = {"occupied_stalls": []}
    bay = {"row_depths_m": [8.1, 4.2], "column_widths_m": 8.1}
    settings = settings_with(site={"structure": drawing}, bay=bay, parking=free, plan={"unreachable_stalls": "keep"})
    made = build(GarageConfig(**settings), tmp_path / "g.usda")
    profile = profile_without("aisle_width", **WIDE_CIRCLE)
    found = [
        [finding for finding in check(path, profile=profile)[0] if finding.rule == "swept-path"]
        for path in (made.stage, made.report)
    ]
    assert found[0]
    assert found[0] == found[1]


def test_a_turning_radius_that_no_car_has_is_refused():
    with pytest.raises(ConfigError, match="turning_radius"):
        found_in(SETTINGS, profile_with(turning_radius={"value": 2.0, **M}))


def test_what_build_would_refuse_is_reported_in_its_words(tmp_path):
    (tmp_path / "narrow.toml").write_text(f'[site]\nstructure = """{PLAN}"""\n[bay]\nrow_depths_m = [8.1, 3.1, 8.1]\n')
    findings, _ = check(tmp_path / "narrow.toml")
    assert {f.rule for f in findings} - FOUND_IN_GOOD_ONE == {"aisle-width", "plan-refused"}
    assert "bay.row_depths_m: got 3.1; allowed: at least 3.20 m" in next(
        f.message for f in findings if f.rule == "plan-refused"
    )
    (tmp_path / "empty.txt").write_text("E===X")
    assert {f.rule for f in check(tmp_path / "empty.txt")[0]} - FOUND_IN_GOOD_ONE == {"plan-refused"}


def test_a_narrow_door_is_reported():
    drawing = "...E...\n...=...\n.=====.\n.=...=.\n.=====X\n......."
    settings = settings_with(
        site={"structure": drawing},
        bay={"column_widths_m": [8.1, 8.1, 8.1, 6.2, 8.1, 8.1, 8.1]},
        parking={"occupied_stalls": []},
    )
    assert found_in(settings) - FOUND_IN_GOOD_ONE - {"column-spacing"} == {"portal-width"}


@pytest.mark.parametrize(("kept_free", "rules"), [("standard", set()), ("allow", {"dead-end"})])
def test_a_long_dead_end_needs_a_turning_stall_and_is_too_deep_with_one(kept_free, rules):
    settings = settings_with(
        site={"structure": ".......\nE=====.\n.=.....\n.=====X\n......."},
        plan={"dead_ends": kept_free},
        parking={"occupied_stalls": []},
    )
    assert found_in(settings) - FOUND_IN_GOOD_ONE == rules | {"dead-end-depth"}
    assert found_in(settings, profile_without("dead_end_depth")) - FOUND_IN_GOOD_ONE == rules


@pytest.mark.parametrize(
    ("rule", "drawing"),
    [DRAWN["a dead end with branches that are short"], ("stretch-length", LONG_AISLE)],
    ids=["a dead end with branches", "a long aisle without a junction"],
)
def test_circulation_is_measured_in_metres(rule, drawing):
    """The same squares as short as a stall break no rule of lengths."""
    cells = cells_from_text(drawing, field="S")
    bay = {"row_depths_m": 6.8, "column_widths_m": 6.8}
    settings = settings_with(site={"structure": drawing}, bay=bay, parking={"occupied_stalls": []})
    limit = {"dead-end-depth": "dead_end_depth", "stretch-length": "stretch_length"}[rule]
    squares = {"dead-end-depth": 4, "stretch-length": cells.shape[1] - 2}[rule]
    for metres, rules in ((6.8 * squares, set()), (6.8 * squares - 0.01, {rule})):
        profile = profile_without("column_spacing", **{limit: {"value": metres, "unit": "m"}})
        assert found_in(settings, profile) - FOUND_IN_GOOD_ONE == rules


@pytest.mark.parametrize("form", soak_but(1, ["instanced", "nested", "flat"]))
def test_a_stage_and_its_report_say_the_same_of_circulation(form, tmp_path):
    drawing = "\n".join([*DRAWN["a dead end with branches that are short"][1].split("\n"), "..=.=.."])
    settings = settings_with(
        site={"structure": drawing}, parking={"occupied_stalls": []}, stage={"form": form}, plan={"dead_ends": "allow"}
    )
    made = build(GarageConfig(**settings), tmp_path / "g.usda")
    profile = profile_without(loops={"steps": [[10, 0]], "above": 1}, stretch_length={"value": 10, **M})
    found = [
        [finding for finding in check(path, profile=profile)[0] if finding.rule in CIRCULATION]
        for path in (made.stage, made.report)
    ]
    assert {finding.rule for finding in found[0]} == {"dead-end-depth", "loop", "stretch-length"}
    assert found[0] == found[1]


def test_findings_of_circulation_tell_place_and_figures(tmp_path):
    (tmp_path / "plan.txt").write_text(DRAWN["a dead end with branches that are short"][1])
    (finding,) = (f for f in check(tmp_path / "plan.txt")[0] if f.rule == "dead-end-depth")
    assert (finding.place, finding.position_m) == ("[4, 2]", pytest.approx((16.45, 27.9)))
    assert (finding.measured, finding.required, finding.unit) == (pytest.approx(26.5, abs=0.05), 24.0, "m")
    assert finding.severity == "warning"
    assert "6 lane squares" in finding.message
    (tmp_path / "plan.txt").write_text(DRAWN["lanes side by side"][1])
    (finding,) = (f for f in check(tmp_path / "plan.txt")[0] if f.rule == "lane-field")
    assert (finding.place, finding.measured, finding.required) == ("[1, 2]", pytest.approx(12.7), 11.0)


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    made = build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("report") / "small.usda")
    return json.loads(made.report.read_text())


REPORTS = {
    "a stall that was moved": lambda stalls: stalls[3].update(centre_m=[1.0, 2.0]),
    "a stall that was widened": lambda stalls: stalls[3].update(width_m=2.5),
    "a stall that was taken out": lambda stalls: stalls.pop(),
    "a stall that was put in": lambda stalls: stalls.append({**stalls[0], "name": "Stall_r99_c99_1"}),
    "a use that was changed": lambda stalls: stalls[0].update(use="turning"),
    "a stall of nonsense": lambda stalls: stalls.append(["?"]),
}


@pytest.mark.parametrize("change", [None, *REPORTS.values()], ids=["nothing", *REPORTS])
def test_a_report_lists_the_stalls_that_its_plan_gives(change, report, tmp_path):
    document = json.loads(json.dumps(report))
    if change:
        change(document["levels"][0]["stalls"])
    (tmp_path / "g_report.json").write_text(json.dumps(document))
    findings, _ = check(tmp_path / "g_report.json")
    assert {f.rule for f in findings} - FOUND_IN_GOOD_ONE == ({"report-stalls"} if change else set())


def test_the_same_plan_in_every_form_is_judged_alike(tmp_path):
    rows = PLAN.strip().splitlines()
    forms = {
        "plan.txt": PLAN,
        "plan.json": json.dumps(rows),
        "matrices.json": json.dumps({"S": rows, "R": [8.1] * 4, "C": 8.1}),
        "numbers.json": json.dumps([[".=EX".index(symbol) for symbol in row] for row in rows]),
        "plan.toml": f'[site]\nstructure = """{PLAN}"""\n[bay]\ncolumn_widths_m = 8.1\nrow_depths_m = 8.1\n',
    }
    grid = profile_with(column_spacing={"least": 8.2, "most": 8.3})
    for name, text in forms.items():
        (tmp_path / name).write_text(text)
        findings, _ = check(tmp_path / name)
        assert [f.rule for f in findings if f.severity is not Severity.INFO] == sorted(FOUND_IN_GOOD_ONE), name
        # who gives sizes keeps them, who gives none gets the grid that is asked for
        is_sized = name in {"matrices.json", "plan.toml"}
        findings, _ = check(tmp_path / name, profile=grid)
        assert any(f.rule == "column-spacing" for f in findings) is is_sized


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("a.txt", "....\n", "a plan with lanes"),
        ("a.txt", "E?X", "'?'"),
        ("a.toml", "seed = 1\n", "a plan with lanes"),
        ("a.json", "{", "JSON"),
        ("a.json", "[" * 100_000, "JSON"),
        ("a.json", '{"S": 3}', "rows of symbols"),
        ("a.json", '{"config": {}, "S": ["E=X"]}', "a report with config, S, R and C"),
        ("a.json", '{"config": {"sed": 1}, "S": ["E=X"], "R": 8.1, "C": 8.1}', "sed"),
        ("a.json", '{"S": ["E=X"], "R": NaN, "C": 8.1}', "NaN"),
        ("a.usda", "#usda 2.0", "USD cannot read it"),
        ("a.usdz", "PK", "not a package"),
    ],
)
def test_what_is_no_plan_is_refused_in_one_line(name, text, said, tmp_path):
    (tmp_path / name).write_text(text)
    with pytest.raises((ConfigError, ReportError, StageError)) as caught:
        check(tmp_path / name)
    assert said in str(caught.value)
