"""Damaged and hostile files: read or refused, quickly and within bounds (``fuzz.py`` runs as many as one likes)."""

import struct
import tempfile
import zipfile
from pathlib import Path

import pytest
from pxr import Sdf
from support.unity import fuzz
from support.unity.agreement import STAGES
from support.unity.crate_tables import unpacked


@pytest.mark.parametrize("form", fuzz.FORMATS)
def test_damaged_and_hostile_files(usd_dump, tmp_path, form):
    outcome = fuzz.run(80, 2, form, usd_dump, tmp_path)
    assert outcome.wrong == []
    assert outcome.kinds() == sorted(kind.__name__ for kind in fuzz.Fuzz(form, 2).kinds())
    # neither harmless nor hopeless: some of the damaged files can be read
    assert {"read", "refused"} == {verdict for _, verdict in outcome.seen}


def test_tables_of_crates_survive_packing():
    """What the fuzzer writes differs from a sound crate by nothing but the damage."""
    crate = fuzz.converted((STAGES / "values.usda").read_text(), "usdc")
    assert exported(unpacked(crate).packed()) == exported(crate)


def exported(crate: bytes) -> str:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "layer.usdc"
        path.write_bytes(crate)
        return Sdf.Layer.OpenAsAnonymous(str(path)).ExportToString()


def test_instances_that_double(usd_dump, tmp_path):
    """Shared, they are cheap to compose; shown, they would be a million prims for each that is there."""
    lines = ["#usda 1.0"]
    for level in range(30):
        kids = "".join(f'def "k{i}" ( instanceable = true references = </L{level + 1}> ) {{}}\n' for i in range(2))
        lines.append(f'def "L{level}" {{\n{kids}}}')
    path = tmp_path / "doubling.usda"
    path.write_text("\n".join(lines))
    assert "refused" not in usd_dump.ask("stage", path)
    assert "instances stand for more than" in usd_dump.ask("scene", path)["refused"][2]


def zipped(path, entries: dict[str, bytes], method=zipfile.ZIP_STORED):
    with zipfile.ZipFile(path, "w", method) as archive:
        for name, data in entries.items():
            archive.writestr(name, data)
    return path


LAYER = b'#usda 1.0\ndef "A" {}\n'


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("../up.usda", "no plain path"),
        ("/root.usda", "no plain path"),
        ("a/../../b.usda", "no plain path"),
        ("C:/x.usda", "no plain path"),
        ("a\\..\\b.usda", "no plain path"),
    ],
)
def test_entries_that_leave_their_package(usd_dump, tmp_path, name, reason):
    package = zipped(tmp_path / "bad.usdz", {"r.usda": LAYER, "x" * len(name): LAYER})
    package.write_bytes(package.read_bytes().replace(b"x" * len(name), name.encode()))
    assert reason in usd_dump.ask("stage", package)["refused"][2]


def test_packages_that_lie(usd_dump, tmp_path):
    compressed = zipped(tmp_path / "compressed.usdz", {"r.usda": LAYER * 50}, zipfile.ZIP_DEFLATED)
    assert "is compressed" in usd_dump.ask("stage", compressed)["refused"][2]
    twice = zipped(tmp_path / "twice.usdz", {"r.usda": LAYER, "s.usda": LAYER})
    twice.write_bytes(twice.read_bytes().replace(b"s.usda", b"r.usda"))
    assert "twice" in usd_dump.ask("stage", twice)["refused"][2]
    other = zipped(tmp_path / "other.usdz", {"r.usda": LAYER})
    data = bytearray(other.read_bytes())
    data[data.index(b"r.usda")] = ord("q")
    other.write_bytes(data)
    assert "another name" in usd_dump.ask("stage", other)["refused"][2]
    long = zipped(tmp_path / "long.usdz", {"r.usda": LAYER})
    data = bytearray(long.read_bytes())
    directory = data.index(b"PK\x01\x02")
    data[directory + 20 : directory + 28] = struct.pack("<II", 2**31, 2**31)
    long.write_bytes(data)
    assert "beyond the end" in usd_dump.ask("stage", long)["refused"][2]


@pytest.mark.parametrize(
    "asset", ["/etc/passwd", "../secret.usda", "a/../../secret.usda", "file:///secret.usda", "\\\\host\\x.usda"]
)
def test_paths_out_of_the_folder_are_not_followed(usd_dump, tmp_path, asset):
    (tmp_path / "secret.usda").write_bytes(LAYER)
    (tmp_path / "in" / "a").mkdir(parents=True)
    root = tmp_path / "in" / "root.usda"
    root.write_text(f'#usda 1.0\ndef "B" ( references = @{asset}@</A> ) {{}}\n')
    found = usd_dump.ask("stage", root)
    assert list(found["prims"]) == ["/B"]
    assert "is not a relative path within the root folder" in found["warnings"][0]


def test_references_that_double(usd_dump, tmp_path):
    lines = ["#usda 1.0"]
    for level in range(30):
        kids = "".join(f'def "k{i}" ( references = </L{level + 1}> ) {{}}\n' for i in range(2))
        lines.append(f'def "L{level}" {{\n{kids}}}')
    path = tmp_path / "doubling.usda"
    path.write_text("\n".join(lines))
    answer = usd_dump.ask("fuzz", path)
    assert "than its layers can need" in answer["refused"] or "than the stage can need" in answer["refused"]
    assert answer["cpu_s"] < fuzz.SLOWEST_S
    assert answer["bytes"] < fuzz.LARGEST_MB * 1e6
