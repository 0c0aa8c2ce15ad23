"""Data sets of many garages that differ, made by a recipe on many processes."""

from importlib.util import find_spec

from garage2usd.errors import MissingExtraError

if any(find_spec(name) is None for name in ("distributed", "jinja2", "matplotlib", "pyarrow")):
    raise MissingExtraError("dataset", "dataset", "Dask's distributed, Jinja, Matplotlib and PyArrow")

from garage2usd.datasets.making import DataSet, make_dataset
from garage2usd.datasets.recipe import Recipe, load_recipe
from garage2usd.datasets.verification import Fault, verify_dataset

__all__ = ["DataSet", "Fault", "Recipe", "load_recipe", "make_dataset", "verify_dataset"]
