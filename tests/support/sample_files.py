"""The real inputs in ``samples/`` and the formats that each is built to."""

from pathlib import Path

import pytest

from support.soak import soak_but

REPOSITORY = Path(__file__).parents[2]
LEVELS_SAMPLE, HELIX_SAMPLE = REPOSITORY / "samples/two_levels.toml", REPOSITORY / "samples/three_levels.toml"
"""Garages of several levels, which have readers and tests of their own."""
SAMPLES = sorted({*(REPOSITORY / "samples").glob("*.toml")} - {LEVELS_SAMPLE, HELIX_SAMPLE})

SMALL_SAMPLES = [sample for sample in SAMPLES if sample.stem != "large_20x30"]
OBJECT_SAMPLES = [sample for sample in SMALL_SAMPLES if sample.stem not in {"dimensioned", "hand_drawn"}]
"""Samples that have all kinds of objects between them; the others differ in their plans."""

USUAL_SAMPLES = [sample for sample in SAMPLES if sample.stem in {"looks", "mixed_stalls"}]
"""Samples that `make test` takes: one with all kinds of objects, one with all kinds of stalls; the rest is soak."""

each_sample = pytest.mark.parametrize("sample", soak_but(USUAL_SAMPLES, SAMPLES), ids=lambda path: path.stem)
each_small_sample = pytest.mark.parametrize(
    "sample", soak_but(USUAL_SAMPLES, SMALL_SAMPLES), ids=lambda path: path.stem
)
each_object_sample = pytest.mark.parametrize(
    "sample", soak_but(USUAL_SAMPLES, OBJECT_SAMPLES), ids=lambda path: path.stem
)


def _each_sample_as(usual):
    """Samples with all kinds of objects in one format, and one in all."""
    formats = {
        sample: ("usda", "usdc", "usdz") if sample.stem == "paper_7x9" else (usual,) for sample in OBJECT_SAMPLES
    }
    cases = [(sample, extension) for sample, extensions in formats.items() for extension in extensions]
    return pytest.mark.parametrize(
        ("sample", "extension"),
        soak_but([(sample, usual) for sample in USUAL_SAMPLES], cases),
        ids=lambda value: value.stem if isinstance(value, Path) else value,
    )


# that formats hold the same, `test_every_format_holds_the_same` says
each_build = _each_sample_as("usdc")
each_package = _each_sample_as("usdz")
