"""The real inputs in ``samples/`` and the formats that each is built to."""

from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[2]
LEVELS_SAMPLE, HELIX_SAMPLE = REPOSITORY / "samples/two_levels.toml", REPOSITORY / "samples/three_levels.toml"
"""Garages of several levels, which have readers and tests of their own."""
SAMPLES = sorted({*(REPOSITORY / "samples").glob("*.toml")} - {LEVELS_SAMPLE, HELIX_SAMPLE})

SMALL_SAMPLES = [sample for sample in SAMPLES if sample.stem != "large_20x30"]
"""All but the largest, which has no kinds of objects of its own."""

each_sample = pytest.mark.parametrize("sample", SAMPLES, ids=lambda path: path.stem)
each_small_sample = pytest.mark.parametrize("sample", SMALL_SAMPLES, ids=lambda path: path.stem)


def _each_sample_as(usual):
    """Every small sample in one format, and one in all."""
    formats = {sample: ("usda", "usdc", "usdz") if sample.stem == "paper_7x9" else (usual,) for sample in SMALL_SAMPLES}
    cases = [(sample, extension) for sample, extensions in formats.items() for extension in extensions]
    return pytest.mark.parametrize(
        ("sample", "extension"), cases, ids=lambda value: value.stem if isinstance(value, Path) else value
    )


# that formats hold the same, `test_every_format_holds_the_same` says
each_build = _each_sample_as("usdc")
each_package = _each_sample_as("usdz")
