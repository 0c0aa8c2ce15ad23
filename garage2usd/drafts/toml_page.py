"""A TOML document that is changed key by key and keeps its comments, order and spacing."""

import tomllib
from collections.abc import Mapping, MutableMapping, Sequence
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, Array, Table

from garage2usd.common.errors import ConfigError


class TomlPage:
    """A TOML document, and what it says as plain values.

    Parameters
    ----------
    text
        TOML that is valid.
    """

    def __init__(self, text: str) -> None:
        self._document: MutableMapping[str, Any] = tomlkit.parse(text)
        self.settings: dict[str, Any] = tomllib.loads(text)

    def get(self, name: str) -> Any:  # noqa: ANN401 - any value of TOML
        """Return the plain value of a dotted name, None where there is none."""
        found: Any = self.settings
        for key in name.split("."):
            found = found.get(key) if isinstance(found, Mapping) else None
        return found

    def put(self, name: str, value: Any) -> None:  # noqa: ANN401
        """Set the value of a dotted name, or remove it for None; a list that stays as long is changed in place."""
        *tables, key = name.split(".")
        if value is None:
            self._remove(tables, key)
            return
        place, plain = self._document, self.settings
        for depth, table in enumerate(tables):
            if not isinstance(plain.get(table, {}), dict):
                raise ConfigError(".".join(tables[: depth + 1]), plain[table], "a table")
            if table not in place:
                place[table] = tomlkit.table(is_super_table=depth + 1 < len(tables))
            place, plain = place[table], plain.setdefault(table, {})
        if plain.get(key) != value:
            if key not in place or not _changed_within(place[key], plain[key], value):
                if key in place and isinstance(place[key], AoT):
                    del place[key]
                place[key] = _item(value)
            plain[key] = value

    def add(self, name: str, table: Mapping[str, Any]) -> None:
        """Append a table to the list of tables of a name at the top of the document."""
        if name not in self._document:
            self._document[name] = tomlkit.aot()
        tables = self._document[name]
        tables.append(_table(table) if isinstance(tables, AoT) else _item(table))
        self.settings.setdefault(name, []).append(dict(table))

    def alter(self, name: str, at: int, keys: Mapping[str, Any]) -> None:
        """Set keys of a table of such a list, or remove those that are None; raises `ConfigError` for no such table."""
        self._number(name, at)
        place, plain = self._document[name][at], self.settings[name][at]
        for key, value in keys.items():
            if value is None and key in plain:
                del place[key], plain[key]
            elif value is not None and plain.get(key) != value:
                place[key] = _item(value)
                plain[key] = value

    def take(self, name: str, at: int) -> None:
        """Take a table out of such a list, and an empty list out of the document; raises `ConfigError`."""
        self._number(name, at)
        del self._document[name][at], self.settings[name][at]
        if not self.settings[name]:
            del self._document[name], self.settings[name]

    def _number(self, name: str, at: int) -> None:
        count = len(self.settings.get(name, ()))
        if not 0 <= at < count:
            raise ConfigError("at", at, f"a number below {count}, of {name}")

    def _remove(self, tables: Sequence[str], key: str) -> None:
        """Remove a key, and the tables that are left with nothing, not even a comment."""
        holders = [(self._document, self.settings)]
        for table in tables:
            place, plain = holders[-1]
            if not isinstance(plain.get(table), dict):
                return
            holders.append((place[table], plain[table]))
        place, plain = holders.pop()
        if key not in plain:
            return
        del place[key], plain[key]
        for (holder, outer), table in zip(reversed(holders), reversed(tables), strict=True):
            left = holder[table]
            if outer[table] or (isinstance(left, Table) and left.value.body):
                return
            del holder[table], outer[table]

    def text(self) -> str:
        """Write the document.

        Raises
        ------
        ConfigError
            If TOML's rules for tables in the order of this file leave no place for a new key.
        """
        said = "another place of a table; write this setting into the file by hand"
        try:
            text = tomlkit.dumps(self._document)
            is_same = tomllib.loads(text) == self.settings
        except (TOMLKitError, ValueError):
            is_same = False
        if not is_same:
            raise ConfigError("configuration", "tables in this order", said)
        return text


def _changed_within(item: Any, old: Any, new: Any) -> bool:  # noqa: ANN401
    """Change the entries of a list that differ, so that comments between its lines stay; False where it is no list."""
    if not (isinstance(item, Array) and isinstance(new, list) and isinstance(old, list) and len(old) == len(new)):
        return False
    for number, (before, after) in enumerate(zip(old, new, strict=True)):
        if before != after:
            item[number] = _item(after)
    return True


def _table(values: Mapping[str, Any]) -> Table:
    table = tomlkit.table()
    table.trivia.indent = "\n"  # an empty line before its header
    for key, value in values.items():
        table[key] = _item(value)
    return table


def _item(value: Any) -> Any:  # noqa: ANN401
    if isinstance(value, str) and "\n" in value:
        escaped = value.replace("\\", "\\\\").replace('"', '\\"')
        return tomlkit.value(f'"""\n{escaped}"""')  # the first line break is not part of the text
    if isinstance(value, Mapping):
        table = tomlkit.inline_table()
        for key, each in value.items():
            table[key] = _item(each)
        return table
    if isinstance(value, list):
        array = tomlkit.array()
        for each in value:
            array.append(_item(each))
        return array.multiline(any(isinstance(each, Mapping) for each in value))
    try:
        return tomlkit.item(value)
    except ValueError:
        raise ConfigError("value", value, "a value of TOML") from None
