"""What settings mean, from the docstrings below them: read for schemas and documentation, not when a program starts."""

import ast
import inspect
import textwrap
from itertools import pairwise

__all__ = ["attribute_docstrings"]


def attribute_docstrings(cls: type) -> dict[str, str]:
    """Return the docstring below each annotated attribute that a class or one of its bases declares.

    Their source is parsed, which for all settings takes about a quarter of the time of loading the package.
    """
    found: dict[str, str] = {}
    for base in reversed(cls.__mro__):
        if "__annotations__" in vars(base):
            found |= _declared(base)
    return found


def _declared(cls: type) -> dict[str, str]:
    try:
        source = inspect.getsource(cls)
    except (OSError, TypeError):  # a class of C, or one without a file
        return {}
    (declaration,) = ast.parse(textwrap.dedent(source)).body
    if not isinstance(declaration, ast.ClassDef):
        return {}
    return {
        before.target.id: inspect.cleandoc(after.value.value)
        for before, after in pairwise(declaration.body)
        if isinstance(before, ast.AnnAssign)
        and isinstance(before.target, ast.Name)
        and isinstance(after, ast.Expr)
        and isinstance(after.value, ast.Constant)
        and isinstance(after.value.value, str)
    }
