"""Occupancy grids: walls and columns of the table of labels are occupied, proven paths are free; faults are found."""

import json
from dataclasses import replace

import numpy as np
import pytest
import shapely
import yaml
from support.driven_cells import covered
from support.label_tables import labelled_objects
from support.map_faults import Fault, planted
from support.map_reader import FREE, OCCUPIED, UNKNOWN, read_map
from support.sample_files import each_sample
from support.small_garage import SETTINGS
from support.soak import soak_but

from garage2usd import GarageConfig, build
from garage2usd.as_built.driven_ground import driven_garage
from garage2usd.common.errors import ConfigError, StageError
from garage2usd.config.look import ColumnSection
from garage2usd.config.outputs import GridConfig
from garage2usd.driving import DesignCar, prove_garage
from garage2usd.garage_sources import read_built
from garage2usd.maps.occupancy import _Raster, write_grid

SLACK_M = 0.02
"""By which bounds of labels may be wider than what they hold, such as a stripe on a wall."""
LOW_M, HIGH_M = 0.1, 1.8
APART_M = 0.1
PAINTED = {"stall_line", "lane_line", "lane_arrow", "crossing", "hatching", "stall_symbol"}
NOT_SOLID = {
    "drain",
    "floor",
    "floor_stain",
    "parking_stall",
    "stall_number",
    "zone_plate",
    "number_plate",
    "sky",
    "speed_bump",
    *PAINTED,
}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A small garage with its subject and its proofs."""
    built = build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("grid") / "small.usdc")
    return built, *driven(built)


def driven(built):
    (subject,) = read_built(built.stage).garage.levels
    garage, car = driven_garage(subject), DesignCar()
    return subject, garage, prove_garage(garage, car=car), car


def objects_of(built):
    """Class and corners (x, height, y) of the bounds of each object of the table of labels."""
    found = []
    for entry in labelled_objects(built.stage.with_name(f"{built.stage.stem}_labels.json")):
        (x0, low, z0), (x1, high, z1) = entry["min_m"], entry["max_m"]
        found.append((entry["class"], (x0, low, -z1), (x1, high, -z0)))
    return found


def between(middles, low, high):
    """Which of ascending numbers lie between two."""
    return slice(np.searchsorted(middles, low, side="right"), np.searchsorted(middles, high, side="left"))


def judge(write, made, folder, *, side_m=0.05):
    built, subject, garage, proofs, car = made
    objects = objects_of(built)
    grid = GridConfig(resolution_m=side_m, low_m=LOW_M, high_m=HIGH_M)
    assert write(subject, folder / "map.yaml", grid) == (folder / "map.yaml", folder / "map.pgm")
    read = read_map(folder / "map.yaml")
    assert read.side == side_m
    expected = np.full(read.cells.shape, fill_value=False)
    x, y = read.middles()
    for label, low, high in objects:
        if label in {"wall", "column"}:
            inner = read.within((low[0] + SLACK_M, low[2] + SLACK_M), (high[0] - SLACK_M, high[2] - SLACK_M))
            if label == "column" and built.garage.layout.look.columns.section is ColumnSection.ROUND:
                inner = inner[_within_round(inner.shape)]
                assert inner.size
            assert (inner == OCCUPIED).all(), (label, low)
        if label not in NOT_SOLID and low[1] <= HIGH_M and high[1] >= LOW_M:
            expected[
                between(y, low[2] - APART_M, high[2] + APART_M), between(x, low[0] - APART_M, high[0] + APART_M)
            ] = True
    assert not ((read.cells == OCCUPIED) & ~expected).any()
    inside = np.full(read.cells.shape, fill_value=False)
    for label, low, high in objects:
        if label in {"floor", "ramp"}:
            inside[between(y, low[2], high[2]), between(x, low[0], high[0])] = True
        if label == "floor" or label in PAINTED:  # paint is floor
            assert not (read.within((low[0], low[2]), (high[0], high[2])) == UNKNOWN).any()
    assert inside[read.cells == FREE].all()
    for label, low, high in objects:
        if label in {"ramp", "vehicle_door"}:
            middle = read.within(*_middle_of(low, high))
            assert middle.size
            assert (middle == FREE).all(), label
    write(subject, folder / "low.yaml", GridConfig(low_m=0.0))
    low_read = read_map(folder / "low.yaml")
    for label, low, high in objects:
        if label == "speed_bump":
            assert (low_read.within((low[0], low[2]), (high[0], high[2])) == FREE).all()
    if side_m <= 0.05:
        assert len(covered(read, garage, proofs, car)) == 0
    return read


def _within_round(shape):
    """Which cells of a rectangle lie wholly in the ellipse that fills it."""
    rows, columns = ((np.abs(np.arange(size) - (size - 1) / 2) + 1) / (size / 2) for size in shape)
    return rows[:, None] ** 2 + columns**2 <= 1


def _middle_of(low, high):
    """A square of 1 m in the middle of bounds."""
    x, y = (low[0] + high[0]) / 2, (low[2] + high[2]) / 2
    return (x - 0.5, y - 0.5), (x + 0.5, y + 0.5)


@pytest.mark.parametrize("side_m", soak_but([0.05], [0.02, 0.05, 0.2]))
def test_it_is_the_garage(made, side_m, tmp_path):
    read = judge(write_grid, made, tmp_path, side_m=side_m)
    assert set(np.unique(read.cells)) == {OCCUPIED, FREE, UNKNOWN}


@each_sample
def test_paths_are_free_and_walls_occupied_on_a_sample(sample, builds, tmp_path):
    built = builds(sample, "usdc")
    judge(write_grid, (built, *driven(built)), tmp_path)


def test_its_bytes_are_always_the_same(made, tmp_path):
    files = [write_grid(made[1], tmp_path / f"{n}.yaml", GridConfig(keepout=True, speed=True)) for n in (1, 2)]
    assert [file.name for file in files[0]] == [
        f"1{part}{end}" for part in ("", "_keepout", "_speed") for end in (".yaml", ".pgm")
    ]
    for one, other in zip(*files, strict=True):
        assert one.read_bytes().replace(b"1", b"2") == other.read_bytes().replace(b"1", b"2")


FAULTS = (
    Fault("mirrored y", "frame", "(1.0, -1.0)", "(1.0, 1.0)"),
    Fault("first row lowest", "occupancy", "file.write(cells.data)", "file.write(cells[::-1].tobytes())"),
    Fault(
        "origin in the middle of a cell",
        "occupancy",
        "round(self.column * self.side_m, 6)",
        "round((self.column + 0.5) * self.side_m, 6)",
    ),
    Fault("origin upside down", "occupancy", "round(self.row * self.side_m, 6)", "round(-self.row * self.side_m, 6)"),
    Fault(
        "a row too high",
        "occupancy",
        "rows - band], inside,",
        "rows - band], np.roll(inside, -1, axis=0),",
    ),
    Fault("a column too far", "occupancy", "np.ceil(low[side, 0]", "np.ceil(1 + low[side, 0]"),
    Fault("unknown read as free", "occupancy", "_FREE_THRESHOLD = 0.65, 0.196", "_FREE_THRESHOLD = 0.65, 0.25"),
    Fault("every cell that is touched", "occupancy", "_NEAR_CELLS = 0.25", "_NEAR_CELLS = 2.0"),
    Fault("doors shut", "occupancy", "if solid.label not in {_DOOR, _RAMP,", "if solid.label not in {_RAMP,"),
    Fault("ramps filled", "occupancy", "if not (_is_sheet(body)", "if True or (_is_sheet(body)"),
    Fault(
        "what hangs counts",
        "occupancy",
        "level.solids.between(low_m, high_m)",
        "level.solids.between(low_m, 9.0)",
    ),
    Fault("speed bumps stand", "occupancy", "_RAMP, _DRIVEN_OVER}", "_RAMP}"),
    Fault(
        "walls alone",
        "occupancy",
        "            yield solid.footprint",
        "            yield solid.footprint.boundary",
    ),
    Fault(
        "no floor of ramps",
        "occupancy",
        "*stalls, *ramp_floors(level)]",
        "*stalls]",
    ),
)


@pytest.mark.parametrize("fault", soak_but(3, FAULTS), ids=lambda fault: fault.name)
def test_a_planted_fault_is_found(fault, made, tmp_path):
    with planted(fault, "occupancy") as module, pytest.raises((AssertionError, ValueError)):
        judge(module.write_grid, made, tmp_path)


@pytest.mark.parametrize("seed", range(5))
def test_filled_cells_are_those_that_geos_finds_inside(seed):
    draw = np.random.default_rng(seed)
    rings = [shapely.Point(draw.uniform(0, 30, 2)).buffer(draw.uniform(0.2, 8), quad_segs=2) for _ in range(12)]
    grounds = [one.difference(other) for one, other in zip(rings[::2], rings[1::2], strict=True)]
    grounds.append(shapely.box(12.03, 12.03, 19.07, 19.07).difference(shapely.box(13.03, 13.03, 15.07, 18.07)))
    raster = _Raster(0.1, -20, -320, (340, 345))
    cells = np.zeros(raster.shape, dtype=np.uint8)
    raster.fill(cells, grounds, 7)
    x, y = np.meshgrid((np.arange(345) - 20 + 0.5) * 0.1, (np.arange(340)[::-1] - 320 + 0.5) * 0.1)
    inside = shapely.contains_xy(shapely.union_all(grounds), x, -y)  # y is -z
    assert ((cells == 7) == inside).all()


NAMES = [
    "a: b # c", "- a", "a, b", "*a", "&a", "!a", "%a", "@a", "`a`", "{a}", "[a]", "'a'", '"a\\"', "| a", "> a", "? a",
    " a ", "#", "~", "null", "yes", "1e3", "0x1f", "12:30", "a\x85b", "a\u2028b", "\ufeffa", "é😀", "\U000e0001",
]  # fmt: skip


@pytest.mark.parametrize("name", soak_but(4, NAMES))
def test_any_name_is_read_back_as_it_is(made, tmp_path, name):
    files = write_grid(made[1], tmp_path / f"{name}.yaml", GridConfig(resolution_m=1.0, keepout=True))
    for file, picture in zip(files[::2], files[1::2], strict=True):
        text = file.read_text(encoding="utf-8")
        said = yaml.safe_load(text)
        assert said["image"] == picture.name
        assert said["mode"] in {"trinary", "raw"}
        assert said == yaml.load(text, yaml.CSafeLoader)
        assert (file.parent / said["image"]).read_bytes()[:2] == b"P5"


def test_masks_of_filters(made, tmp_path):
    built, subject, *_ = made
    report = json.loads(built.report.read_text())
    write_grid(subject, tmp_path / "a.yaml", GridConfig(keepout=True, speed=True))
    plain, keepout, speed = (read_map(tmp_path / f"a{part}.yaml") for part in ("", "_keepout", "_speed"))
    assert plain.cells.shape == keepout.cells.shape == speed.cells.shape
    assert plain.origin == keepout.origin == speed.origin
    kept = [stall for stall in report["levels"][0]["stalls"] if stall["use"] in {"access_aisle", "unreachable"}]
    assert kept
    for stall in kept:
        (x, z), half = stall["centre_m"], min(stall["width_m"], stall["length_m"]) / 2
        assert (keepout.within((x - half, -z - half), (x + half, -z + half)) == OCCUPIED).all()
    area = sum(stall["width_m"] * stall["length_m"] for stall in kept)
    assert (keepout.cells == OCCUPIED).sum() * keepout.side**2 == pytest.approx(area, rel=0.05)
    assert set(np.unique(keepout.cells)) == {0, 100}
    assert set(np.unique(speed.cells)) == {0, 30, 50}
    for label, low, high in objects_of(built):
        if label == "speed_bump":
            assert (speed.within((low[0], low[2]), (high[0], high[2])) == 30).all()
        if label == "ramp":
            assert (speed.within(*_middle_of(low, high)) == 50).all()


def test_too_many_cells_are_refused(made, tmp_path, monkeypatch):
    monkeypatch.setattr("garage2usd.maps.occupancy._MOST_CELLS", 1000)
    with pytest.raises(ConfigError, match=r"maps\.grid\.resolution_m.*at least .* m? ?for this garage"):
        write_grid(made[1], tmp_path / "a.yaml", GridConfig())
    assert not list(tmp_path.iterdir())


def test_a_garage_without_floors_is_refused(made, tmp_path):
    bare = replace(made[1], things=tuple(thing for thing in made[1].things if thing.label != "floor"))
    with pytest.raises(StageError, match="class floor"):
        write_grid(bare, tmp_path / "a.yaml", GridConfig())


def test_the_allowed_side_is_enough(made, tmp_path, monkeypatch):
    monkeypatch.setattr("garage2usd.maps.occupancy._MOST_CELLS", 100_000)
    with pytest.raises(ConfigError) as refused:
        write_grid(made[1], tmp_path / "a.yaml", GridConfig())
    least_m = float(str(refused.value).partition("at least ")[2].split()[0])
    write_grid(made[1], tmp_path / "a.yaml", GridConfig(resolution_m=least_m + 0.01))
