"""The settings that the page has controls for, from the models of the configuration: choices, bounds, colours."""

from collections.abc import Iterator
from enum import StrEnum
from functools import cache
from typing import Any, get_args

from garage2usd.common.settings import Settings, attribute_docstrings
from garage2usd.config import GarageConfig
from garage2usd.config.look import COLOURS, NATURAL, LookConfig
from garage2usd.profiles import PROFILE_NAMES

_OTHER = (
    "seed", "parking.occupancy", "plan.aisles", "building.ramps", "building.storey_m", "bay.stall_width_m",
    "bay.square_side_m",
)  # fmt: skip


@cache
def controls() -> list[dict[str, Any]]:
    """Describe a control for each setting: name, group, kind of value, choices or bounds, and what it is."""
    found = [_control(name, "garage") for name in _OTHER]
    found.insert(
        1,
        {
            "name": "profile",
            "group": "garage",
            "kind": "choice",
            "choices": [*PROFILE_NAMES],
            "text": "Standard that the garage is designed to.",
        },
    )
    found += [_control(f"look.{group}.{axis}", group) for group, axis in _axes()]
    return [control for control in found if control["kind"] != "text"]


def colours() -> dict[str, str]:
    """Named colours of looks, with their values for swatches."""
    return dict(COLOURS)


def values(config: GarageConfig) -> dict[str, Any]:
    """Return the values of all controls, given or by default."""
    found = {}
    for control in controls():
        value, _ = _value_of(config, control["name"])
        found[control["name"]] = value if isinstance(value, int | float | str) else str(getattr(value, "name", value))
    return found


def given(config: GarageConfig) -> list[str]:
    """Name the controls whose values are given, so that all others are defaults."""
    return [control["name"] for control in controls() if _value_of(config, control["name"])[1]]


def _value_of(config: GarageConfig, name: str) -> tuple[Any, bool]:
    """Return the value of a setting, and whether it is given."""
    value: Any = config
    is_given = True
    for key in name.split("."):
        is_given = is_given and key in value.model_fields_set
        value = getattr(value, key)
    return value, is_given


def _axes() -> Iterator[tuple[str, str]]:
    for group, field in LookConfig.model_fields.items():
        model = field.annotation
        if isinstance(model, type) and issubclass(model, Settings):
            yield from ((group, axis) for axis in model.model_fields)


def _control(name: str, group: str) -> dict[str, Any]:
    *path, key = name.split(".")
    model: Any = GarageConfig
    for part in path:
        model = model.model_fields[part].annotation
    field = model.model_fields[key]
    told: dict[str, Any] = {"name": name, "group": group, "text": _first_sentence(attribute_docstrings(model)[key])}
    kind = next((each for each in (field.annotation, *get_args(field.annotation)) if isinstance(each, type)), str)
    if issubclass(kind, StrEnum):
        return {**told, "kind": "choice", "choices": [each.value for each in kind]}
    if kind is bool:
        return {**told, "kind": "switch"}
    if issubclass(kind, int | float):
        limits = {
            name: getattr(bound, mark)
            for bound in field.metadata
            for name, mark in (("least", "ge"), ("most", "le"), ("most", "lt"))
            if getattr(bound, mark, None) is not None
        }
        return {**told, "kind": "whole" if kind is int else "number", **limits}
    if "colour" in key or key in {"dado", "services", "bays"}:
        words = [NATURAL] if NATURAL in str(field.default) or key == "services" else []
        words += {"dado": ["none"], "bays": ["coated", "aisle"]}.get(key, [])
        return {**told, "kind": "colour", "words": list(dict.fromkeys(words))}
    return {**told, "kind": "text"}


def _first_sentence(text: str) -> str:
    return " ".join(text.split()).partition(". ")[0].rstrip(".") + "."
