"""`hatch_build.py`, which stands beside the package and belongs to no other."""

import importlib.util

from support.sample_files import REPOSITORY

_SPEC = importlib.util.spec_from_file_location("hatch_build", REPOSITORY / "hatch_build.py")
_MODULE = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(_MODULE)

compile_loops = _MODULE.compile_loops
asked_target = _MODULE._asked_target
LIBRARY, TARGETS = _MODULE.LIBRARY, _MODULE.TARGETS
