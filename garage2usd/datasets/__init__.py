"""Data sets of many distinct garages, generated from a recipe by many processes."""

from typing import TYPE_CHECKING

from garage2usd.common.package import on_first_use, require

if TYPE_CHECKING:
    from garage2usd.datasets.comparison import Comparison, compare_dataset
    from garage2usd.datasets.making import DataSet, make_dataset
    from garage2usd.datasets.published import PublishedFigures, read_published
    from garage2usd.datasets.recipe import Recipe, load_recipe
    from garage2usd.datasets.verification import Fault, verify_dataset

require("a data set", ("distributed", "jinja2", "matplotlib", "pyarrow"))

__all__ = [
    "Comparison",
    "DataSet",
    "Fault",
    "PublishedFigures",
    "Recipe",
    "compare_dataset",
    "load_recipe",
    "make_dataset",
    "read_published",
    "verify_dataset",
]

_MODULES = {
    "comparison": ("Comparison", "compare_dataset"),
    "making": ("DataSet", "make_dataset"),
    "published": ("PublishedFigures", "read_published"),
    "recipe": ("Recipe", "load_recipe"),
    "verification": ("Fault", "verify_dataset"),
}
# each worker imports this package, and needs little of it
__getattr__ = on_first_use(__name__, _MODULES)


def __dir__() -> list[str]:
    """Return the public names."""
    return __all__
