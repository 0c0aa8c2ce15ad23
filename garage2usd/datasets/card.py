"""The data card of a data set: a README of its contents, origin and use."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import jinja2

from garage2usd.common.version import VERSION
from garage2usd.datasets.manifest import ManifestRow
from garage2usd.datasets.recipe import Recipe, ShardForm

__all__ = ["data_card"]

_TEMPLATE = jinja2.Template(
    Path(__file__).with_name("card.md.jinja").read_text(encoding="utf-8"),
    keep_trailing_newline=True,
    autoescape=False,
)


def data_card(recipe: Recipe, rows: Sequence[ManifestRow]) -> str:
    """Write the data card of a data set in Markdown."""
    made = [row for row in rows if not row.error]
    splits = [
        {
            "name": split,
            "garages": sum(row.split == split for row in made),
            "stalls": sum(row.stalls for row in made if row.split == split),
            "cars": sum(row.cars for row in made if row.split == split),
            "shards": len({row.shard for row in made if row.split == split}),
        }
        for split in recipe.splits
    ]
    suffixes = Counter(file.suffix for row in made for file in row.files)
    first = next((row for row in made), None)
    text: str = _TEMPLATE.render(
        recipe=recipe,
        version=VERSION,
        rows=made,
        stalls=sum(row.stalls for row in made),
        failed=len(rows) - len(made),
        splits=splits,
        is_tar=recipe.shards.form is ShardForm.TAR,
        suffixes=sorted(suffixes),
        example=first,
        stage_suffix=".usdz" if recipe.make.self_contained else ".usdc",
    )
    return text
