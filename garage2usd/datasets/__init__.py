"""Data sets of many distinct garages, generated from a recipe by many processes."""

from typing import TYPE_CHECKING

from garage2usd.common.extras import require
from garage2usd.common.public_names import on_first_use

if TYPE_CHECKING:
    from garage2usd.datasets.making import DataSet, make_dataset
    from garage2usd.datasets.recipe import Recipe, load_recipe
    from garage2usd.datasets.verification import Fault, verify_dataset

require("a data set", ("distributed", "jinja2", "matplotlib", "pyarrow"))

__all__ = ["DataSet", "Fault", "Recipe", "load_recipe", "make_dataset", "verify_dataset"]

_HOME = {
    "DataSet": "making",
    "Fault": "verification",
    "Recipe": "recipe",
    "load_recipe": "recipe",
    "make_dataset": "making",
    "verify_dataset": "verification",
}
# each worker imports this package, and needs little of it
__getattr__ = on_first_use(__name__, _HOME)


def __dir__() -> list[str]:
    """Return the public names."""
    return __all__
