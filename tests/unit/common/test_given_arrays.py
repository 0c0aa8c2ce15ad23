"""S, R and C as people have them: lists, arrays, files of NumPy and text; what is none of these is refused."""

import io
import time
import tracemalloc
import zipfile

import numpy as np
import pytest

from garage2usd.common.documents import read_arrays
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig, load_config
from garage2usd.garage_sources import check
from garage2usd.profiles import read_profile
from garage2usd.site import make_site

S = np.array([[0, 0, 0, 0], [2, 1, 1, 3], [0, 0, -1, 0]])
R, C = [8.1, 8.0, 7.9, 8.1], [8.1, 8.2, 8.1]
DRAWING = "....\nE==X\n..#."
SAME_R_BY_SQUARES = np.broadcast_to(R, S.shape)


def site_of(config):
    return make_site(config.site, bay=config.bay, seed=0)


@pytest.fixture
def folder(tmp_path):
    np.save(tmp_path / "s.npy", S)
    np.save(tmp_path / "s_by_columns.npy", np.asfortranarray(S.astype(float)))
    np.savez(tmp_path / "garage.npz", S=S, R=R, C=np.array(C)[:, None].repeat(4, axis=1), more=np.zeros(3))
    np.savez_compressed(tmp_path / "alone.npz", S.astype(np.int8))
    np.save(tmp_path / "r.npy", R)
    np.savetxt(tmp_path / "c.csv", C, delimiter=",")
    np.savetxt(tmp_path / "r.txt", SAME_R_BY_SQUARES)
    (tmp_path / "s.txt").write_text(DRAWING)
    return tmp_path


@pytest.mark.parametrize(
    "structure",
    [
        S,
        S.astype(np.int8),
        S.astype(float),
        S.tolist(),
        tuple(map(tuple, S.tolist())),
        DRAWING.split("\n"),
        DRAWING,
    ],
    ids=["array", "int8", "float", "lists", "tuples", "rows", "text"],
)
@pytest.mark.parametrize("widths", [R, np.array(R), SAME_R_BY_SQUARES], ids=["list", "array", "by squares"])
def test_python_takes_lists_and_arrays(structure, widths):
    site = site_of(GarageConfig(site={"structure": structure}, bay={"column_widths_m": widths, "row_depths_m": C}))
    assert str(site) == DRAWING
    assert site.R[0].tolist() == R
    assert site.C[:, 0].tolist() == C


FILES = {
    "array": '[site]\nstructure_file = "s.npy"\n[bay]\ncolumn_widths_file = "r.npy"\nrow_depths_file = "c.csv"\n',
    "by columns": '[site]\nstructure_file = "s_by_columns.npy"\n[bay]\ncolumn_widths_file = "r.txt"\n'
    'row_depths_file = "garage.npz"\n',
    "all in one": '[site]\nstructure_file = "garage.npz"\n',
    "one array": '[site]\nstructure_file = "alone.npz"\n[bay]\ncolumn_widths_file = "garage.npz"\n'
    "row_depths_m = [8.1, 8.2, 8.1]\n",
    "text": f'[site]\nstructure_file = "s.txt"\n[bay]\ncolumn_widths_m = {R}\nrow_depths_file = "c.csv"\n',
}


@pytest.mark.parametrize("text", FILES.values(), ids=FILES)
def test_files_are_read_beside_the_configuration(text, folder):
    (folder / "garage.toml").write_text(text)
    config = load_config(folder / "garage.toml")
    assert not config.names_files
    site = site_of(config)
    assert (str(site), site.R[0].tolist(), site.C[:, 0].tolist()) == (DRAWING, R, C)


def test_a_file_of_numpy_is_checked_as_its_text(folder):
    (folder / "plan.txt").write_text(DRAWING)
    expected = [finding.rule for finding in check(folder / "plan.txt")[0]]
    assert [finding.rule for finding in check(folder / "s.npy")[0]] == expected
    grid = {"least": 8.11, "most": 8.5, "unit": "m", "source": "the client", "confidence": "high"}
    profile = read_profile({"name": "client", "column_spacing": grid})
    assert "column-spacing" in {finding.rule for finding in check(folder / "garage.npz", profile=profile)[0]}


@pytest.mark.parametrize(
    ("text", "field", "allowed"),
    [
        ('[site]\nstructure_file = "no.npy"\n', "site.structure_file", "readable file"),
        ('[site]\nstructure_file = "r.npy"\n', "site.structure_file", "not the shape (4,) in r.npy"),
        ('[bay]\ncolumn_widths_file = "s.npy"\n', "bay.column_widths_file", "s.npy"),
        ('[bay]\nrow_depths_file = "s.txt"\n', "bay.row_depths_file", "metres as numbers"),
        ('[bay]\nrow_depths_file = "garage.toml"\n', "bay.row_depths_file", "metres as numbers"),
        (
            '[site]\nstructure_file = "garage.npz"\n[bay]\ncolumn_widths_m = 8.1\n',
            "bay.column_widths_m",
            "no R beside that of",
        ),
        (
            '[site]\nstructure_file = "garage.npz"\n[bay]\nrow_depths_file = "c.csv"\n',
            "bay.row_depths_file",
            "no C beside that of",
        ),
        ('[bay]\ncolumn_widths_m = 8.1\ncolumn_widths_file = "r.npy"\n', "bay", "only one of column_widths_m and"),
    ],
)
def test_what_does_not_fit_is_named_with_its_file(text, field, allowed, folder):
    (folder / "garage.toml").write_text(text)
    with pytest.raises(ConfigError) as caught:
        load_config(folder / "garage.toml")
    assert caught.value.field == field
    assert allowed in str(caught.value)
    assert "\n" not in str(caught.value)


def test_files_are_read_by_load_config_alone():
    for bay in ({"column_widths_file": "r.npy"}, {"row_depths_file": "c.csv"}):
        with pytest.raises(ConfigError, match="a file read by load_config"):
            site_of(GarageConfig(bay=bay))


@pytest.mark.parametrize(
    ("structure", "allowed"),
    [
        ([[0, 0], [2]], "rows of equal length"),
        ([[0, 7]], "whole numbers -1"),
        ([[0.5]], "whole numbers -1"),
        ([[float("nan"), float("inf")]], "whole numbers -1"),
        ([[0, "E"]], "whole numbers -1"),
        ([[[0]]], "not the shape (1, 1, 1)"),
        (np.zeros((2001, 2001), np.int8), "4000000 squares"),
        ([], "not the shape (0,)"),
    ],
)
def test_what_is_no_structure_is_refused(structure, allowed):
    with pytest.raises(ConfigError) as caught:
        GarageConfig(site={"structure": structure})
    assert caught.value.field == "site.structure"
    assert allowed in str(caught.value)


def header(text):
    return b"\x93NUMPY\x01\x00" + (len(text) + 1).to_bytes(2, "little") + text + b"\n"


def zipped(name, data):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, data)
    return file.getvalue()


def saved(array, **options):
    file = io.BytesIO()
    np.save(file, array, **options)
    return file.getvalue()


HOSTILE = {
    "nothing.npy": b"",
    "text.npy": b"0 1 2\n",
    "objects.npy": saved(np.array([print, {}], dtype=object), allow_pickle=True),
    "strings.npy": saved(np.array([["E", "X"]])),
    "complex.npy": saved(np.array([[1j]])),
    "more than there is.npy": header(b"{'descr': '<i8', 'fortran_order': False, 'shape': (100000000000,), }"),
    "overflow.npy": header(b"{'descr': '<i8', 'fortran_order': False, 'shape': (4294967296, 4294967296), }"),
    "negative.npy": header(b"{'descr': '<i8', 'fortran_order': False, 'shape': (-1, -1), }") + b"12345678",
    "no tuple.npy": header(b"{'descr': '<i8', 'fortran_order': False, 'shape': 3, }"),
    "no type.npy": header(b"{'descr': ((((((((('<i8'))))))))), 'fortran_order': 3, 'shape': (1,), }"),
    "deep.npy": header(b"(" * 9000),
    "a call.npy": header(b"{'descr': __import__('os'), 'fortran_order': False, 'shape': (1,), }"),
    "cut.npy": saved(S)[:-3],
    "version.npy": b"\x93NUMPY\x09\x00v\x00{}",
    "nothing.npz": b"",
    "text.npz": b"PK\x03\x04 and so on",
    "cut.npz": zipped("S.npy", saved(S))[:-9],
    "damaged.npz": zipped("S.npy", saved(S)).replace(b"\x93NUMPY", b"\x93NUMPX")[:60] + b"\0" * 40,
    "bomb.npz": zipped("S.npy", b"\0" * 200_000_000),
    "no array.npz": zipped("S.npy", b"no array"),
    "objects.npz": zipped("S.npy", saved(np.array([{}], dtype=object), allow_pickle=True)),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files_are_refused_in_a_moment_and_little_memory(name, tmp_path):
    (tmp_path / name).write_bytes(HOSTILE[name])
    start = time.process_time()
    tracemalloc.start()
    with pytest.raises(ConfigError) as caught:
        read_arrays(tmp_path / name, field="site.structure_file", names=["S"])
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert caught.value.field == "site.structure_file"
    assert "\n" not in str(caught.value)
    assert peak < 100_000_000
    assert time.process_time() - start < 2


def test_an_archive_without_the_array_is_refused(tmp_path):
    np.savez(tmp_path / "two.npz", A=S, B=S)
    with pytest.raises(ConfigError, match="an \\.npz file with the array S, or with one array alone"):
        read_arrays(tmp_path / "two.npz", field="PATH", names=["S", "R"])
