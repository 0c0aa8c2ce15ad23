"""A look as text: TOML tables that a configuration can include, or a one-line summary."""

import json
from typing import Any

from garage2usd.common.settings import Settings
from garage2usd.config.look import LookConfig

_TOLD = (
    ("floor", ("finish", "colour", "gloss")),
    ("markings", ("pattern", "colour", "wear")),
    ("columns", ("section", "guard")),
    ("walls", ("finish",)),
    ("lights", ("temperature_k",)),
)
"""Axes in the one-line summary, by group."""


def look_text(look: LookConfig) -> str:
    """Write all axes of a look as TOML tables of a configuration, each with its value; none is left to the seed."""
    tables = {name: group for name in type(look).model_fields if isinstance(group := getattr(look, name), Settings)}
    textures = tables.pop("textures", None)
    blocks = [] if textures is None else [_table("look", {"textures": getattr(textures, "folder")})]  # noqa: B009
    blocks += [_table(f"look.{name}", group.model_dump(mode="json")) for name, group in tables.items()]
    return "\n\n".join(blocks) + "\n"


def look_in_words(look: LookConfig) -> str:
    """Summarise a look in one line."""
    values = look.model_dump(mode="json")
    parts = (
        " ".join(f"{values[group][axis]:g}" if axis.endswith("_k") else str(values[group][axis]) for axis in axes)
        for group, axes in _TOLD
    )
    return ", ".join(parts).replace("_", " ") + " K"


def _table(name: str, values: dict[str, Any]) -> str:
    # strings, numbers and booleans are written alike in JSON and in TOML
    return "\n".join([f"[{name}]", *(f"{key} = {json.dumps(value)}" for key, value in values.items())])
