"""The package as Unity's package manager wants it: manifest, assemblies, metas, documentation, sample."""

import json
import re
import subprocess
from pathlib import Path

import pytest
from make_meta import guid_of, meta_text, seen_by_unity
from support.sample_files import REPOSITORY
from support.unity.reader import PACKAGE

import garage2usd
from garage2usd.common.package import VERSION

LARGEST_SAMPLE_BYTES = 1_500_000
ASSEMBLIES = {path.stem: json.loads(path.read_text()) for path in PACKAGE.rglob("*.asmdef")}
FOLDERS = {
    "Garage.Usd": "Core",
    "Garage.Unity": "Runtime",
    "Garage.Unity.Editor": "Editor",
    "Garage.Unity.Editor.Tests": "Tests/Editor",
    "Garage.Unity.Tests": "Tests/Runtime",
    "Garage.Unity.Samples": "Samples~/SmallGarage",
}


def test_everything_that_unity_sees_has_a_meta_with_a_guid_of_its_own():
    seen = seen_by_unity()
    assert len(seen) > 80
    guids = set()
    for relative in seen:
        meta = PACKAGE / f"{relative}.meta"
        assert meta.read_text() == meta_text(relative), "run Tools~/make_meta.py"
        guids.add(re.search(r"^guid: ([0-9a-f]{32})$", meta.read_text(), re.MULTILINE)[1])
    assert len(guids) == len(seen)
    assert set(PACKAGE.rglob("*.meta")) == {PACKAGE / f"{relative}.meta" for relative in seen}
    # one that has been handed out must never change
    assert guid_of(Path("Editor/UsdImporter.cs")) == "35caad2e519431cadf9a2cdda634e32a"


def test_nothing_that_unity_sees_is_left_out_of_the_repository():
    command = ["git", "-C", PACKAGE, "ls-files", "--others", "--ignored", "--exclude-standard", "--directory", "."]
    ignored = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    assert [name for name in ignored if "__pycache__" not in name] == []


def test_manifest():
    manifest = json.loads((PACKAGE / "package.json").read_text())
    assert manifest["name"] == "org.garage2usd.importer"
    assert manifest["version"] == VERSION
    assert manifest["unity"] == "2021.3"
    assert f"[{manifest['version']}]" in (PACKAGE / "CHANGELOG.md").read_text()
    for sample in manifest["samples"]:
        assert (PACKAGE / sample["path"]).is_dir()
    assert (PACKAGE / "LICENSE.md").read_text() == (REPOSITORY / "LICENSE").read_text()


def test_assemblies_refer_to_those_that_their_sources_need():
    assert ASSEMBLIES.keys() == FOLDERS.keys()
    for name, assembly in ASSEMBLIES.items():
        folder = PACKAGE / FOLDERS[name]
        assert (folder / f"{name}.asmdef").exists()
        assert assembly["name"] == name
        own = [one for one in assembly["references"] if not one.endswith(".TestRunner")]
        text = "\n".join(path.read_text() for path in folder.rglob("*.cs"))
        used = {one for one in FOLDERS if re.search(rf"using {re.escape(one)};", text)}
        used |= (
            {"Garage.Usd"} if "Garage.Usd." in text.replace("Garage.Usd.Dump", "") and name != "Garage.Usd" else set()
        )
        if name not in {"Garage.Usd", "Garage.Unity"}:
            used.add("Garage.Unity")
        assert used - {name} <= set(own), name
        assert set(own) <= FOLDERS.keys()
        is_test = name.endswith("Tests")
        assert ("UNITY_INCLUDE_TESTS" in assembly["defineConstraints"]) == is_test
        assert assembly["includePlatforms"] == (["Editor"] if ".Editor" in name else [])
    assert ASSEMBLIES["Garage.Usd"]["noEngineReferences"]
    (other,) = ASSEMBLIES["Garage.Unity.Editor"]["versionDefines"]
    assert other["name"] == "com.unity.importer.usd"
    assert f"#if {other['define']}\n" in (PACKAGE / "Editor" / "UsdImporter.cs").read_text()


@pytest.mark.parametrize("folder", ["Core", "Runtime", "Samples~", "Tests/Runtime"])
def test_the_editor_is_used_within_its_condition_alone(folder):
    """Players have no ``UnityEditor``; the core has no Unity at all."""
    word = "UnityEngine|UnityEditor" if folder == "Core" else "UnityEditor"
    for source in (PACKAGE / folder).rglob("*.cs"):
        text = re.sub(r"#if UNITY_EDITOR\n.*?#(else|endif)", "", source.read_text(), flags=re.DOTALL)
        assert not re.search(rf"\b({word})\b", text), source


def test_the_importer_stays_thin():
    assert len((PACKAGE / "Editor" / "UsdImporter.cs").read_text().splitlines()) < 150
    for folder in ("Runtime", "Editor", "Tests", "Samples~"):
        for source in (PACKAGE / folder).rglob("*.cs"):
            lines = source.read_text().splitlines()
            assert len(lines) < 400, source
            assert max(map(len, lines)) <= 120, source


def test_documentation():
    text = (PACKAGE / "Documentation~" / "index.md").read_text()
    source = (PACKAGE / "Runtime" / "ImportSettings.cs").read_text()
    settings = re.findall(r"        public \S+ (\w+)(?: =|;)", source)
    assert len(settings) > 10
    for setting in settings:
        assert f"| `{setting}` |" in text
    headings = {
        re.sub(r"[^\w -]", "", line[3:].lower()).replace(" ", "-")
        for line in text.splitlines()
        if line.startswith("## ")
    }
    links = re.findall(r"\]\(([^)]+)\)", text)
    assert {link[1:] for link in links if link.startswith("#")} == headings
    for document in (PACKAGE / "README.md", PACKAGE / "Documentation~" / "index.md"):
        for link in re.findall(r"\]\(([^)#]+)\)", document.read_text()):
            assert (document.parent / link).exists() or link.startswith("https://"), link
    result = (PACKAGE / "Documentation~" / "signatures.md").read_text()
    rows = [re.split(r"\s*\|\s*", line)[1:-1] for line in result.splitlines() if re.match(r"\| \d", line)]
    assert {row[0].split(".")[0] for row in rows} == {"2021", "6000"}
    for _, members, declared, _, missing in rows:
        assert int(members) == int(declared) > 300
        assert missing == "0"


def test_the_sample_is_small_and_complete(prefabs):
    stage = PACKAGE / "Samples~" / "SmallGarage" / "SmallGarage.usdz"
    assert stage.stat().st_size < LARGEST_SAMPLE_BYTES
    prefab = prefabs(stage)
    assert len(prefab.labelled("car")) == 18
    assert len(prefab.found["graph"]["stalls"]) == 33
    config = garage2usd.load_config(stage.with_name("small_garage.toml"))
    assert len(garage2usd.generate(config).layout.stalls) == 33
