"""Tables of a recipe's settings, with distributions in place of values."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeGuard

from garage2usd.config.files import with_textures
from garage2usd.config.texture_sets import TextureFolder, read_texture_sets
from garage2usd.datasets.distribution import distribution_of

__all__ = ["first_value", "merge_settings", "pin_textures", "resolved"]


def merge_settings(settings: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    """Merge settings over others, table by table; a distribution replaces a table or value as a whole."""
    merged = dict(settings)
    for key, value in above.items():
        below = merged.get(key)
        merged[key] = merge_settings(below, value) if _is_table(below, key) and _is_table(value, key) else value
    return merged


def _is_table(value: object, key: str) -> TypeGuard[Mapping[str, Any]]:
    """Test if a value is a table of settings and not a distribution."""
    return isinstance(value, Mapping) and distribution_of(value, field=key) is None


def resolved(settings: Mapping[str, Any], within: str, resolve: Callable[[Any, str], Any]) -> dict[str, Any]:
    """Replace each distribution in settings by `resolve` of the distribution and its dotted name."""
    found = {}
    for key, value in settings.items():
        field = f"{within}.{key}"
        if _is_table(value, field):
            found[key] = resolved(value, field, resolve)
        else:
            found[key] = resolve(value, field)
    return found


def first_value(
    value: object, field: str, *, ends_of: dict[str, tuple[Any, ...]], given: Mapping[str, Any] | None = None
) -> object:
    """Return the given or else the first value of a distribution, and record its extreme values."""
    distribution = distribution_of(value, field=field)
    if distribution is None:
        return value
    if given and field in given:
        return given[field]
    ends_of[field] = distribution.ends()
    return ends_of[field][0]


def pin_textures(recipe: Mapping[str, Any], folder: Path) -> None:
    """Make paths of texture folders in a recipe absolute, and add digests of their contents.

    Parameters
    ----------
    recipe
        Parsed recipe, valid or not; its tables of settings are changed in place.
    folder
        Folder of relative paths.

    Raises
    ------
    ConfigError
        If textures are invalid.
    """
    groups = recipe.get("groups")
    of_groups = groups.values() if isinstance(groups, dict) else ()
    alternatives = [each for group in of_groups if isinstance(group, list) for each in group]
    for holder in (recipe, *alternatives):
        match holder:
            case {"garage": dict() as table}:
                match with_textures(table, folder):
                    case {"look": {"textures": str(named)} as look}:
                        textures, _ = read_texture_sets(TextureFolder(folder=named))
                        table["look"] = {**look, "textures": textures.model_dump()}
