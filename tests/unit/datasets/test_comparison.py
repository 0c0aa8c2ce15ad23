"""Comparison of data sets with published figures: distances against scipy and brute force, and the command."""

import json

import numpy as np
import pyarrow.parquet as pq
import pytest
from click.testing import CliRunner
from PIL import Image
from scipy import stats

from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.datasets import read_published
from garage2usd.datasets.comparison import compare_rows
from garage2usd.datasets.manifest import ManifestRow, manifest_table
from garage2usd.datasets.published import Quantiles, Quantity, Uniform

KNOWN = Quantiles(shares=[0.1, 0.25, 0.5, 0.75, 0.9], values=[90, 171, 350, 471, 700])


def row(number, **figures):
    usual = {"key": "k", "split": "all", "shard": "s", "seed": number, "attempt": 0, "alternatives": {}}
    return ManifestRow(**{**usual, "number": number, "levels": 1, **figures})


def test_a_distribution_with_known_ends_has_scipys_distance():
    whole = Quantiles(shares=[0, 0.3, 1], values=[2, 3, 9])
    for seed in range(20):
        values = np.random.default_rng(seed).uniform(1, 10, 30).round(1)
        expected = stats.ks_1samp(values, lambda x: np.interp(x, whole.values, whole.shares)).statistic
        assert whole.distance(values) == pytest.approx(expected, abs=1e-12)


def test_beyond_the_outermost_quantiles_the_nearest_distribution_counts():
    random = np.random.default_rng(1)
    for _ in range(10):
        values = random.lognormal(5.6, 0.9, 40)
        ordered = np.sort(values)
        places = np.concatenate([np.linspace(90, 700, 50_001), *[ordered + shift for shift in (-1e-9, 0)]])
        places = places[(places >= 90) & (places <= 700)]
        inner = np.abs(np.searchsorted(ordered, places, "right") / 40 - np.interp(places, KNOWN.values, KNOWN.shares))
        first, last = np.mean(values < 90) - 0.1, 0.9 - np.mean(values <= 700)
        # at the ends themselves the inner differences hold with the values at them
        assert KNOWN.distance(values) == pytest.approx(max(inner.max(), first, last), abs=2e-4)
    assert KNOWN.distance(np.full(10, 1.0)) == pytest.approx(0.9)
    assert KNOWN.distance(np.full(10, 5000.0)) == pytest.approx(0.9)


def test_a_sample_of_the_distribution_itself_is_near_it():
    shares = (np.arange(1000) + 0.5) / 1000
    values = np.interp(shares, KNOWN.shares, KNOWN.values, left=10, right=2000)
    assert KNOWN.distance(values) < 0.002
    assert Uniform(low=2.3, high=2.75).distance(2.3 + 0.45 * shares) < 0.002


def test_figures_of_the_package_have_sources_and_mark_assumptions():
    figures = read_published().figures
    assert {figure.quantity for figure in figures} == set(Quantity)
    assert all(figure.source for figure in figures)
    assumed = {figure.quantity for figure in figures if figure.assumption}
    assert {Quantity.LEVELS, Quantity.ONE_WAY} <= assumed
    assert not {Quantity.STALLS, Quantity.OCCUPANCY, Quantity.NOSE_OUT} & assumed


def test_quantities_are_counted_over_the_garages_of_their_country():
    rows = [
        row(0, country="US", stalls=10, level_stalls=(10,), cars=4, perpendicular_cars=4, nose_out_cars=1, lanes_m=30),
        row(1, country="CN", levels=5, stalls=30, level_stalls=(10, 20), angled_stalls=6, parallel_stalls=2, cars=15,
            perpendicular_cars=10, nose_out_cars=9, lanes_m=70.0, one_way_lanes_m=40.0, stall_width_m=2.5),
        row(2, error="no room"),
    ]  # fmt: skip
    found = {
        (compared.published.quantity, compared.published.country): compared
        for compared in compare_rows(rows).quantities
    }
    assert found[Quantity.LEVELS, ""].counts == {"1": 1, "2": 0, "3": 0, "4 or more": 1}
    assert found[Quantity.LEVEL_STALLS, ""].values.tolist() == [10, 10, 20]
    assert found[Quantity.KINDS, ""].shares == {"perpendicular": 0.8, "angled": 0.15, "parallel": 0.05}
    assert found[Quantity.KINDS, ""].distance == pytest.approx(5)
    assert found[Quantity.ONE_WAY, ""].shares["one-way"] == 0.4
    assert found[Quantity.OCCUPANCY, ""].values.tolist() == [0.4, 0.5]
    assert found[Quantity.STALL_WIDTH, ""].values.tolist() == [2.5]
    assert found[Quantity.NOSE_OUT, "US"].distance == pytest.approx(19)
    assert found[Quantity.NOSE_OUT, "CN"].distance == pytest.approx(2)
    assert found[Quantity.NOSE_OUT, "BR"].distance is None


def test_the_command_writes_a_table_and_pictures(tmp_path):
    random = np.random.default_rng(4)
    rows = [
        row(n, stalls=int(s), level_stalls=(int(s),), cars=int(s) // 2)
        for n, s in enumerate(random.lognormal(5.8, 0.8, 50))
    ]
    pq.write_table(manifest_table(rows), tmp_path / "manifest.parquet")
    outputs = [str(tmp_path / name) for name in ("a.json", "a.png", "a.svg")]
    said = CliRunner().invoke(main, ["compare", str(tmp_path), *(part for path in outputs for part in ("-o", path))])
    assert said.exit_code == 0, said.output
    told = {
        (figure["quantity"], figure["country"]): figure
        for figure in json.loads((tmp_path / "a.json").read_text())["figures"]
    }
    stalls = told["stalls", ""]
    assert stalls["distance"] == pytest.approx(KNOWN.distance(np.array([row.stalls for row in rows])), abs=1e-6)
    assert f"{stalls['distance']:.3f}" in said.stdout
    assert told["nose_out", "US"]["distance"] is None
    with Image.open(tmp_path / "a.png") as picture:
        assert min(picture.size) > 500
        assert len(picture.convert("RGB").getcolors(2**20)) > 50
    assert (tmp_path / "a.svg").read_text().count("<svg") == 1


def test_a_folder_that_holds_no_data_set_is_refused(tmp_path):
    said = CliRunner().invoke(main, ["compare", str(tmp_path)])
    assert said.exit_code == 1
    assert "the folder of a finished data set" in said.stderr
    (tmp_path / "f.toml").write_text(
        '[[figures]]\nquantity = "stalls"\ntitle = "S"\nsource = "x"\nshares = { one = 1.0 }\n'
    )
    with pytest.raises(ConfigError, match="one of quantiles, uniform, log_normal and between"):
        read_published(tmp_path / "f.toml")
