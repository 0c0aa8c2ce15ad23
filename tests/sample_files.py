"""The real inputs in ``samples/`` and the formats that each is built to."""

from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[1]
SAMPLES = sorted((REPOSITORY / "samples").glob("*.toml"))

each_sample = pytest.mark.parametrize("sample", SAMPLES, ids=lambda path: path.stem)
each_format = pytest.mark.parametrize("extension", ["usda", "usdc", "usdz"])
