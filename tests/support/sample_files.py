"""The real inputs in ``samples/`` and the formats that each is built to."""

from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[2]
SAMPLES = sorted((REPOSITORY / "samples").glob("*.toml"))

each_sample = pytest.mark.parametrize("sample", SAMPLES, ids=lambda path: path.stem)
each_format = pytest.mark.parametrize("extension", ["usda", "usdc", "usdz"])

_FORMATS = {sample: ("usda", "usdc", "usdz") if sample.stem == "paper_7x9" else ("usdc",) for sample in SAMPLES}
each_build = pytest.mark.parametrize(
    ("sample", "extension"),
    [(sample, extension) for sample, extensions in _FORMATS.items() for extension in extensions],
    ids=lambda value: getattr(value, "stem", value),
)
"""Every sample in one format, and one in all: that formats hold the same, `test_every_format_holds_the_same` says."""
