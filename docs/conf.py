"""Settings of Sphinx: ``make -C docs html`` builds the pages into ``docs/out``, and a warning is an error."""

import sys
from pathlib import Path

from garage2usd.common.package import VERSION

sys.path.insert(0, str(Path(__file__).parent / "directives"))

project = "garage2usd"
author = "The garage2usd authors"
version = release = VERSION
html_title = f"garage2usd {VERSION}"
html_theme = "furo"
html_copy_source = False
html_show_sphinx = False
html_static_path: list[str] = []

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_click", "made_from_code"]
exclude_patterns = ["out", "pictures/*.py"]
myst_heading_anchors = 3

smartquotes = False  # options begin with two hyphens
default_role = "code"  # single backticks in docstrings
add_module_names = False
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_preserve_defaults = True
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True
