"""Shards and splits: who goes where, and what is taken for whole."""

import gzip
import tarfile

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.data_sets import small_recipe, tree_of
from support.soak import soak_but

from garage2usd.checks import Severity
from garage2usd.common.errors import OutputError
from garage2usd.datasets.drawn_plan import DrawnPlan
from garage2usd.datasets.plans import planned
from garage2usd.datasets.shards import made_rows, make_shard, shards_of, sweep
from garage2usd.garage_sources import check
from garage2usd.pipeline import build


def plans(count, failed=()):
    return [DrawnPlan(number=n, attempt=0, seed=n, error="no" if n in failed else "") for n in range(count)]


@given(
    count=st.integers(0, 300),
    ratios=st.lists(st.floats(0.01, 10), min_size=1, max_size=4),
    size=st.integers(1, 40),
    seed=st.integers(0, 2**40),
)
def test_each_garage_is_in_one_split_by_ratio(count, ratios, size, seed):
    splits = {f"s{number}": ratio for number, ratio in enumerate(ratios)}
    recipe = small_recipe(splits=splits, shards={"garages": size}, seed=seed)
    shards = shards_of(recipe, plans(count))
    numbers = [drawn.number for shard in shards for drawn in shard.plans]
    assert sorted(numbers) == list(range(count))
    assert len({shard.name for shard in shards}) == len(shards)
    for split, ratio in splits.items():
        mine = [shard for shard in shards if shard.split == split]
        share = sum(len(shard.plans) for shard in mine)
        assert abs(share - count * ratio / sum(ratios)) < 1
        assert all(len(shard.plans) == size for shard in mine[:-1])


def test_garages_without_a_plan_are_in_no_shard():
    shards = shards_of(small_recipe(), plans(9, failed={2, 5}))
    assert sorted(drawn.number for shard in shards for drawn in shard.plans) == [0, 1, 3, 4, 6, 7, 8]


@pytest.fixture(scope="module", params=soak_but(1, ["tar", "folder"]))
def made(request, tmp_path_factory):
    """A data set of one shard, and its rows."""
    recipe = small_recipe(splits={"train": 1}, shards={"garages": 2, "form": request.param})
    (shard,) = shards_of(recipe, planned(recipe, [(0, 0), (1, 0)]))
    folder = tmp_path_factory.mktemp("shard")
    return recipe, shard, folder, make_shard(recipe, folder, shard)


def test_a_shard_has_the_files_that_its_rows_name_and_can_be_made_again(made, tmp_path):
    recipe, shard, folder, rows = made
    assert made_rows(folder, shard, recipe.shards.form) == rows
    assert [row.number for row in rows] == [0, 1]
    assert {file.suffix for file in rows[0].files} == {
        ".Drive.usdc", ".LaneGraph.usdc", ".difficulty.json", ".labels.json", ".plan.png", ".report.json", ".usdc",
    }  # fmt: skip
    assert make_shard(recipe, tmp_path, shard) == rows
    assert tree_of(tmp_path) == tree_of(folder)


def test_stages_of_a_shard_are_those_of_a_build_and_have_no_errors(made, tmp_path):
    recipe, shard, folder, rows = made
    if recipe.shards.form == "tar":
        with tarfile.open(folder / "shards" / "train-000000.tar") as archive:
            assert {member.mtime for member in archive} == {0}
            archive.extractall(folder / "shards", filter="data")
    for row, drawn in zip(rows, shard.plans, strict=True):
        config, _ = recipe.drawn(drawn.seed)
        built = build(config, tmp_path / "a" / f"{row.number}" / "garage.usdc")
        assert built.garage.plan.structure.digest() == row.structure_digest
        assert built.garage.layout.parking_stalls == row.stalls
        stage = folder / "shards" / f"{row.key}.usdc"
        found, _ = check(stage)
        expected, _ = check(built.stage)
        assert [finding.message for finding in found] == [finding.message for finding in expected]
        assert not [finding for finding in found if finding.severity is Severity.ERROR]


def test_a_damaged_shard_is_not_taken_for_whole(made, tmp_path):
    recipe, shard, _, _ = made
    make_shard(recipe, tmp_path, shard)
    place = tmp_path / "shards"
    form = recipe.shards.form
    lines, held = place / "train-000000.jsonl", place / "train-000000.tar"
    if form == "folder":
        held = place / "train-000000" / "00000001.usdc"
    whole_lines, whole = lines.read_bytes(), held.read_bytes()
    for path, data in [
        (lines, whole_lines[: len(whole_lines) // 2]),
        (lines, b""),
        (held, whole[: len(whole) // 2]),
        (held, whole[:700] + bytes([whole[700] ^ 1]) + whole[701:]),
    ]:
        path.write_bytes(data)
        assert made_rows(tmp_path, shard, form) is None
        lines.write_bytes(whole_lines)
        held.write_bytes(whole)
        assert made_rows(tmp_path, shard, form) is not None
    held.unlink()
    assert made_rows(tmp_path, shard, form) is None


def test_a_garage_that_cannot_be_made_has_its_error_in_its_row(tmp_path):
    recipe = small_recipe(splits={"train": 1})
    good, other = planned(recipe, [(0, 0), (1, 0)])
    bad = other.model_copy(update={"rows": ("E#X",), "column_widths_mm": (8000,) * 3, "row_depths_mm": (8000,)})
    (shard,) = shards_of(recipe, [good, bad])
    rows = make_shard(recipe, tmp_path, shard)
    assert [bool(row.error) for row in rows] == [False, True]
    assert rows[1].seed == bad.seed
    assert not rows[1].files
    assert made_rows(tmp_path, shard, recipe.shards.form) == rows


def test_a_folder_that_cannot_be_written_is_an_error_and_leaves_nothing(tmp_path):
    recipe = small_recipe(splits={"train": 1})
    (shard,) = shards_of(recipe, planned(recipe, [(0, 0)]))
    (tmp_path / "shards").write_text("a file in the way")
    with pytest.raises(OutputError):
        make_shard(recipe, tmp_path, shard)
    assert list(tree_of(tmp_path)) == ["shards"]


def test_what_a_killed_run_left_is_swept(tmp_path):
    left = tmp_path / "shards" / ".garage2usd-abc"
    left.mkdir(parents=True)
    (left / "00000000.usdc").write_bytes(b"half")
    (tmp_path / "shards" / ".garage2usd-1-train-000000.jsonl").write_bytes(b"half")
    sweep(tmp_path)
    assert not list((tmp_path / "shards").iterdir())


def test_texts_are_compressed_where_asked(tmp_path):
    plain, packed = (
        small_recipe(splits={"train": 1}, make={"exports": ["xodr"], "gzip": packs}, shards={"form": "folder"})
        for packs in (False, True)
    )
    drawn = planned(plain, [(0, 0)])
    for name, recipe in (("plain", plain), ("packed", packed)):
        (shard,) = shards_of(recipe, drawn)
        make_shard(recipe, tmp_path / name, shard)
    place = "shards/train-000000/00000000"
    for suffix in (".xodr", ".labels.json", ".report.json", ".difficulty.json"):
        whole = (tmp_path / "plain" / f"{place}{suffix}").read_bytes()
        data = (tmp_path / "packed" / f"{place}{suffix}.gz").read_bytes()
        assert gzip.decompress(data) == whole
        assert data[4:8] == bytes(4)  # no time, so that the bytes are the same each time
    stages = [(tmp_path / name / f"{place}.usdc").read_bytes() for name in ("plain", "packed")]
    assert stages[0] == stages[1]
