"""Base classes and validation of settings and records in files, and what their docstrings say of each field."""

import ast
import inspect
import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeVar, get_args

from pydantic import BaseModel, ConfigDict, GetJsonSchemaHandler, ValidationError
from pydantic_core import CoreSchema

from garage2usd.common.errors import ConfigError
from garage2usd.common.spelling import nearest

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo
    from pydantic_core import ErrorDetails


@cache
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
    except (OSError, TypeError):  # a class that is written in C, or has no file
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


class Settings(BaseModel):
    """Base class of settings written by users: frozen; unknown keys, NaN and infinity are rejected."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, validate_default=True)

    @classmethod
    def __get_pydantic_json_schema__(cls, core_schema: CoreSchema, handler: GetJsonSchemaHandler, /) -> dict[str, Any]:
        """Describe each setting in the JSON schema by the docstring below it."""
        schema = handler(core_schema)
        properties = handler.resolve_ref_schema(schema).get("properties", {})
        for name, text in attribute_docstrings(cls).items():
            if name in properties:
                properties[name].setdefault("description", text)
        return schema


Model = TypeVar("Model", bound=Settings)


class Record(BaseModel):
    """Base class of records in files that garage2usd writes and reads: frozen; unknown keys are ignored."""

    model_config = ConfigDict(frozen=True, allow_inf_nan=False)


def validated(model: type[Model], settings: Mapping[str, Any], *, within: str = "") -> Model:
    """Validate settings given as nested mappings, as TOML reads them.

    Parameters
    ----------
    model
        Model of the settings.
    settings
        The mappings.
    within
        Name of the enclosing setting, if any.

    Raises
    ------
    ConfigError
        If a value is invalid; names the setting, its value and the allowed values.
    """
    try:
        return model(**settings)
    except ValidationError as error:
        raise config_error(error, model, within=within) from None


def config_error(error: ValidationError, model: type[Settings], *, within: str = "") -> ConfigError:
    """Convert a validation error to the error of its first invalid setting.

    Parameters
    ----------
    error
        Error from pydantic.
    model
        Model of the settings.
    within
        Name of the enclosing setting, if any.
    """
    finding, others = _first(error)
    cause = finding.get("ctx", {}).get("error")
    if isinstance(cause, ConfigError) and not within:  # an error in a file named by a setting
        return cause
    keys = [within] if within else []
    holders: list[type[BaseModel]] = []
    models: list[type[BaseModel]] = [model]
    fields: list[FieldInfo] = []
    for part in finding["loc"]:
        fields = [group.model_fields[part] for group in models if part in group.model_fields]
        if fields:
            holders, models = models, [group for field in fields for group in _models(field.annotation)]
        elif isinstance(part, str):  # the name of a branch of a union is not a key of the user
            models = [group for group in models if part in _kinds(group)] or models
        if fields or isinstance(part, int):
            keys.append(str(part))
    if finding["type"] == "extra_forbidden":
        known = list(dict.fromkeys(key for group in models for key in group.model_fields))
        key = str(finding["loc"][-1])
        return ConfigError(
            ".".join([*keys, key]), finding["input"], f"one of the keys {', '.join(known)}{nearest(key, known)}"
        )
    if finding["type"] in {"union_tag_invalid", "union_tag_not_found"}:
        kinds = dict.fromkeys(tag for group in models for tag in _kinds(group))
        given = finding["input"].get("kind", "nothing") if isinstance(finding["input"], dict) else finding["input"]
        return ConfigError(".".join([*keys, "kind"]), given, f"one of {', '.join(kinds)}")
    place = ".".join(keys) or "configuration"
    if isinstance(cause, ConfigError):
        return ConfigError(place, cause.value, cause.allowed)
    if finding["type"] == "missing":
        needed = [key for group in holders for key, field in group.model_fields.items() if field.is_required()]
        is_key = keys[-1] in needed  # else a row lacks a number
        return ConfigError(
            place, "nothing", f"a value; {'.'.join(keys[:-1])} needs {', '.join(needed)}" if is_key else "a value"
        )
    is_branch = bool(finding["loc"]) and not fields and not isinstance(finding["loc"][-1], int)
    return ConfigError(place, finding["input"], _allowed_by_all(finding, others if is_branch else [], models))


def _first(error: ValidationError) -> "tuple[ErrorDetails, list[ErrorDetails]]":
    """Return the most useful error and the others; a misspelt key comes before a missing key beside it."""
    finding, *others = error.errors(include_url=False)
    if finding["type"] == "missing":
        unknown = (other for other in others if other["type"] == "extra_forbidden")
        finding = next((other for other in unknown if other["loc"][:-1] == finding["loc"][:-1]), finding)
    return finding, others


def first_fault(error: ValidationError) -> str:
    """Describe the first error in a file: the key and, if it has one, its value and the allowed values."""
    fault = error.errors(include_url=False)[0]
    place = ".".join(map(str, fault["loc"]))
    cause = fault.get("ctx", {}).get("error")
    said = cause.allowed if isinstance(cause, ConfigError) else _allowed(fault)
    if not place:
        return said
    value = cause.value if isinstance(cause, ConfigError) else fault["input"]
    return f"{place}: {said}" if fault["type"] == "missing" else str(ConfigError(place, value, said))


def _models(annotation: Any) -> Iterator[type[BaseModel]]:  # noqa: ANN401 - any type
    """Yield all models that a value of a type may be or contain."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _models(part)


def _kinds(model: type[BaseModel]) -> tuple[Any, ...]:
    """Allowed values of the key ``kind`` of a model, the discriminator of unions."""
    return get_args(model.model_fields["kind"].annotation) if "kind" in model.model_fields else ()


def _allowed_by_all(
    finding: "ErrorDetails", others: "Sequence[ErrorDetails]", models: Sequence[type[BaseModel]]
) -> str:
    """Describe the allowed values of a union, whose branches each have an error."""
    same = (other for other in others if other["loc"][:-1] == finding["loc"][:-1])
    return " or ".join(dict.fromkeys(_allowed(each, models) for each in (finding, *same)))


_MOST_NAMED = 20

_IN_WORDS = {
    "bool_parsing": "true or false",
    "bool_type": "true or false",
    "dataclass_type": "a table",
    "dict_type": "a table",
    "float_parsing": "a number",
    "float_type": "a number",
    "frozen_set_type": "a list",
    "int_from_float": "a whole number",
    "int_parsing": "a whole number",
    "int_type": "a whole number",
    "is_instance_of": "another kind of value",
    "list_type": "a list",
    "mapping_type": "a table",
    "model_attributes_type": "a table",
    "model_type": "a table",
    "path_type": "a path as text",
    "set_type": "a list",
    "string_type": "text",
    "tuple_type": "a list",
}
"""Allowed values by pydantic's name of the error, for messages of pydantic that name classes of Python."""

_COUNT = re.compile(r"\w+ should have (at (?:least|most) \d+ \w+).*")


def _allowed(finding: "ErrorDetails", models: Sequence[type[BaseModel]] = ()) -> str:
    """Describe the allowed values at the place of an error; `models` are the ones that may stand there."""
    said = _IN_WORDS.get(finding["type"])
    if said is None or finding["msg"].endswith((" an object", " array")):  # words of JSON schema
        return _COUNT.sub(r"\1", finding["msg"].removeprefix("Value error, ").removeprefix("Input should be "))
    keys = dict.fromkeys(key for group in models for key in group.model_fields) if said == "a table" else {}
    return f"{said} with the keys {', '.join(keys)}" if 0 < len(keys) <= _MOST_NAMED else said
