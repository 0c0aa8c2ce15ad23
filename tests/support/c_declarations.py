"""What the C files of garage2usd declare, read from their text, and what Python declares of them."""

import ast
import importlib
import re
import typing
from pathlib import Path
from typing import NamedTuple

import numpy as np

import garage2usd
from garage2usd import native

FOLDER = Path(native.__file__).parent
PACKAGE = Path(garage2usd.__file__).parent
NUMBERS = {"bool": bool, "int64_t": int, "uint64_t": np.uint64, "double": float, "void": type(None)}
DTYPES = {"bool": np.bool_, "int8_t": np.int8, "int32_t": np.int32, "int64_t": np.int64, "uint64_t": np.uint64}
DTYPES |= {"float": np.float32, "double": np.float64}
WORDS = {"Row": 2, "Table": 3, "Cube": 4}


class CFunction(NamedTuple):
    """The type of what a function gives back, and of each argument, as in C but for ``const``."""

    returns: str
    takes: tuple[str, ...]


def c_texts():
    """Every C file and header without its comments, by name."""
    files = (path for pattern in ("*.h", "*.c") for path in sorted(FOLDER.glob(pattern)))
    return {path.name: re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.DOTALL) for path in files}


def c_functions():
    """What C gives to Python, by name."""
    found = {}
    for text in c_texts().values():
        for returns, name, takes in re.findall(r"^FROM_PYTHON\s+(\w+) (\w+)\(([^)]*)\)", text, flags=re.MULTILINE):
            arguments = (re.fullmatch(r"(?:const )?(\w+) (\*?)\w+", " ".join(one.split())) for one in takes.split(","))
            found[name] = CFunction(returns, tuple("".join(argument.groups()) for argument in arguments))
    return found


def c_structs():
    """Fields of each struct of named tuples, as (type, name), by the struct's name."""
    found = {}
    for text in c_texts().values():
        for body, name in re.findall(r"typedef struct \{([^}]*)\} (\w+);", text):
            found[name] = [tuple(line.split()) for line in map(str.strip, body.split(";")) if line]
    return found


def python_functions():
    """Type hints of what Python declares with ``in_c``, in tests too, by the name that it has in C."""
    found = {}
    modules = {path: ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts) for path in PACKAGE.rglob("*.py")}
    modules[Path(__file__).with_name("inner_loops.py")] = "support.inner_loops"
    for path, module in sorted(modules.items()):
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.FunctionDef) and any(
                getattr(one, "id", "") == "in_c" for one in node.decorator_list
            ):
                declared = getattr(importlib.import_module(module), node.name).__wrapped__
                assert node.name.lstrip("_") not in found, f"{node.name} is declared twice"
                found[node.name.lstrip("_")] = typing.get_type_hints(declared, include_extras=True)
    return found


def dtype_of(hint):
    """The type of the numbers of an annotated array, or None."""
    dtype = native.numbers_of(hint)
    return None if dtype is None else dtype.type


def same_type(hint, c_type, structs):
    """Whether an annotation and a type of C have the same bits."""
    if not c_type.endswith("*"):
        return NUMBERS.get(c_type) is hint
    if dtype_of(hint) is np.int64 and c_type[:-1] in structs:  # filled by C
        return {field for field, _ in structs[c_type[:-1]]} == {"int64_t"}
    if dtype_of(hint) is not None:
        return DTYPES.get(c_type[:-1]) is dtype_of(hint)
    return c_type[:-1] in structs and not different_fields(hint, c_type[:-1], structs)


def different_fields(kind, struct, structs):
    """Fields in which a named tuple and its struct differ."""
    hints, fields = typing.get_type_hints(kind, include_extras=True), structs[struct]
    if list(hints) != [name for _, name in fields]:
        return [f"{kind.__name__} has {list(hints)}, {struct} {[name for _, name in fields]}"]
    return [
        f"{kind.__name__}.{name}: {hint}, {c_type}"
        for (name, hint), (c_type, _) in zip(hints.items(), fields, strict=True)
        if not same_field(hint, c_type, structs)
    ]


def same_field(hint, c_type, structs):
    if hint in {bool, int}:
        return c_type == "int64_t"
    if hint is float:
        return c_type == "double"
    if dtype_of(hint) is None:
        return c_type in structs and not different_fields(hint, c_type, structs)
    array = re.fullmatch(r"(Bool|Int8|Int32|Int64|UInt64|Float|Double)(Row|Table|Cube)", c_type)
    names = {"Bool": np.bool_, "Int8": np.int8, "Int32": np.int32, "Int64": np.int64, "UInt64": np.uint64}
    names |= {"Float": np.float32, "Double": np.float64}
    dimensions = next((one for one in typing.get_args(hint) if isinstance(one, int)), 1)
    return array is not None and (names[array[1]], WORDS[array[2]] - 1) == (dtype_of(hint), dimensions)


def size_of(struct, structs):
    """Bytes of a struct, all of whose fields are of words of 8 bytes."""
    sizes = (
        8 * WORDS[c_type[-3:] if c_type.endswith("Row") else re.sub(r".*(Table|Cube)$", r"\1", c_type)]
        if c_type.endswith(tuple(WORDS))
        else size_of(c_type, structs)
        if c_type in structs
        else 8
        for c_type, _ in structs[struct]
    )
    return sum(sizes)
