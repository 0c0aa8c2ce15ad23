"""What the docstrings of garage2usd say after ``Deviation:``."""

import ast
import inspect
import re
from collections.abc import Iterator
from pathlib import Path

import garage2usd

MARK = "Deviation:"
_OWNERS = ast.Module | ast.ClassDef | ast.FunctionDef


def find_deviations() -> Iterator[tuple[str, str]]:
    """Dotted name and text of each deviation, which ends at the next one or with its paragraph."""
    package = Path(garage2usd.__file__).parent
    for file in sorted(package.rglob("*.py")):
        module = ".".join(file.relative_to(package.parent).with_suffix("").parts).removesuffix(".__init__")
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if not isinstance(node, _OWNERS):
                continue
            name = module if isinstance(node, ast.Module) else f"{module}.{node.name}"
            for paragraph in re.split(r"\n\s*\n", inspect.cleandoc(ast.get_docstring(node) or "")):
                for text in paragraph.split(MARK)[1:]:
                    yield name, " ".join(text.replace("``", "`").split())
