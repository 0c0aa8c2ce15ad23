"""Directives whose text is made from the code when the documentation is built, so that it cannot lag behind.

``configuration-reference``: all settings, from the JSON schema. ``class-list``: semantic classes with their ids.
``profile-tables``: the clauses of the shipped standards. ``rule-list``: the rules of check. ``deviations``: what
docstrings say after ``Deviation:``.
"""

from collections.abc import Iterator
from typing import Any

from deviations import find_deviations
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from garage2usd.checks import RULES
from garage2usd.common.settings import attribute_docstrings
from garage2usd.config import PlanConfig, config_schema
from garage2usd.config.plan import SarsaParameters
from garage2usd.objects import CLASSES, CLASSES_VERSION, PieceClass
from garage2usd.profiles import PROFILE_NAMES, Clause, Profile, load_profile
from garage2usd.profiles.clauses import Amount, LengthRange, LengthsByAngle, Steps

SECTIONS = {
    "SiteConfig",
    "BayConfig",
    "PlanConfig",
    "FittingsConfig",
    "ParkingConfig",
    "ClutterConfig",
    "StageConfig",
    "MapsConfig",
    "VehiclesConfig",
}

WORDS = {"integer": "whole number", "number": "number", "boolean": "`true`, `false`", "string": "text"}


class MadeFromCode(SphinxDirective):
    """A directive whose Markdown is made by a function."""

    def run(self) -> list[nodes.Node]:
        """Parse what the function makes as a part of the page."""
        return self.parse_text_to_nodes("\n".join(self.lines()), allow_section_headings=True)

    def lines(self) -> Iterator[str]:
        """Lines of Markdown."""
        raise NotImplementedError


class ConfigurationReference(MadeFromCode):
    """All settings, section by section."""

    def lines(self) -> Iterator[str]:
        """A table a section."""
        schema = config_schema()
        definitions = schema["$defs"]
        own = {name: value for name, value in schema["properties"].items() if not _section(value)}
        yield from ("## Top level", "", *_settings_table(own, definitions), "")
        for name, value in schema["properties"].items():
            if section := _section(value):
                # pydantic leaves a description out that the section itself has
                about = value.get("description", definitions[section]["description"])
                yield from (f"## `[{name}]`", "", about, "")
                yield from _section_table(name, definitions[section]["properties"], definitions)


def _section_table(name: str, properties: dict[str, Any], definitions: dict[str, Any]) -> Iterator[str]:
    """The settings of a section, then those of each section within it."""
    inner = {key: definition for key, value in properties.items() if (definition := _inner(value, definitions))}
    own = {key: value for key, value in properties.items() if key not in inner}
    yield from (*_settings_table(own, definitions), "")
    for key, definition in inner.items():
        about = properties[key].get("description", definition["description"])
        yield from (f"### `[{name}.{key}]`", "", about, "")
        yield from _section_table(f"{name}.{key}", definition["properties"], definitions)


def _inner(schema: dict[str, Any], definitions: dict[str, Any]) -> dict[str, Any] | None:
    """The definition of a setting that is a section of its own; None where it is not."""
    name = schema.get("$ref", "").rpartition("/")[2]
    definition = definitions.get(name, {})
    return definition if definition.get("type") == "object" and name != "Profile" else None


def _section(schema: dict[str, Any]) -> str | None:
    name = schema.get("$ref", "").rpartition("/")[2]
    return name if name in SECTIONS else None


def _settings_table(properties: dict[str, Any], definitions: dict[str, Any]) -> Iterator[str]:
    yield from ("| setting | value | default | what it is |", "|---|---|---|---|")
    for name, schema in properties.items():
        default = schema.get("default")
        shown = _by_preset(name) if default is None else f"`{_toml(default)}`"
        yield f"| `{name}` | {_values(schema, definitions)} | {shown} | {_cell(schema['description'])} |"


def _by_preset(setting: str) -> str:
    """What a parameter of Sarsa is that is not given; nothing for any other setting."""
    if setting not in SarsaParameters._fields:
        return ""
    presets = [("paper", PlanConfig(preset="paper").resolved()), ("tuned", PlanConfig().resolved())]
    presets.append(("over aisles", PlanConfig().resolved(aisles=True)))
    values = [(name, _toml(getattr(parameters, setting))) for name, parameters in presets]
    return ", ".join(f"`{value}` {name}" for name, value in values)


def _part(schema: dict[str, Any], definitions: dict[str, Any]) -> str:
    """What a schema of one of several values in a row allows, in words."""
    return _values(schema, definitions) if schema["type"] == "array" else WORDS[schema["type"]]


def _values(schema: dict[str, Any], definitions: dict[str, Any]) -> str:  # noqa: PLR0911 - one a type
    """What a schema allows, in words."""
    if "$ref" in schema:
        name = schema["$ref"].rpartition("/")[2]
        return "a table with a profile" if name == "Profile" else _values(definitions[name], definitions)
    if "anyOf" in schema:
        return ", or ".join(_values(part, definitions) for part in schema["anyOf"] if part.get("type") != "null")
    if "enum" in schema:
        return ", ".join(f"`{_toml(value)}`" for value in schema["enum"])
    kind = schema["type"]
    if kind == "array":
        if "prefixItems" in schema:
            return "[" + ", ".join(_part(part, definitions) for part in schema["prefixItems"]) + "]"
        items = _values(schema["items"], definitions)
        return f"list of ({items})" if "," in items and not items.startswith("[") else f"list of {items}"
    if kind == "object" and "properties" not in schema:
        return "a table of shares"
    if kind == "object":
        return "a table with " + ", ".join(f"`{name}`" for name in schema["properties"])
    word = WORDS[kind]
    least = _bound(schema, "minimum", "exclusiveMinimum", ("at least", "over"))
    most = _bound(schema, "maximum", "exclusiveMaximum", ("at most", "below"))
    if "minimum" in schema and "maximum" in schema:
        return f"{word}, {schema['minimum']} to {schema['maximum']}"
    return ", ".join(filter(None, (word, least, most)))


def _bound(schema: dict[str, Any], inclusive: str, exclusive: str, words: tuple[str, str]) -> str:
    for key, word in zip((inclusive, exclusive), words, strict=True):
        if key in schema:
            return f"{word} {schema[key]}"
    return ""


def _toml(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else str(value)


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")


class ClassList(MadeFromCode):
    """Semantic classes with their ids."""

    def lines(self) -> Iterator[str]:
        """One table."""
        yield from (f"Version {CLASSES_VERSION} of the table.", "")
        yield from ("| id | class | nearest Cityscapes class | kind of object, or piece of one |", "|---|---|---|---|")
        for entry in CLASSES:
            what = entry.what if isinstance(entry, PieceClass) else f"`{entry.name}`"
            yield f"| {entry.number} | `{entry.label}` | {entry.cityscapes} | {what} |"


class RuleList(MadeFromCode):
    """The rules of check."""

    def lines(self) -> Iterator[str]:
        """One table."""
        yield from ("| rule | asks that | clauses | severity |", "|---|---|---|---|")
        for rule in RULES:
            clauses = ", ".join(f"`{clause}`" for clause in rule.clauses)
            severity = "the clause's" if rule.clauses else rule.severity.value
            yield f"| `{rule.name}` | {rule.asks} | {clauses} | {severity} |"


class ProfileTables(MadeFromCode):
    """The clauses of every shipped profile."""

    def lines(self) -> Iterator[str]:
        """All clauses side by side, then a table a profile with the sources."""
        profiles = [dict(load_profile(name).clauses()) for name in PROFILE_NAMES]
        yield from ("## All clauses", "")
        yield f"| clause | what it is | {' | '.join(PROFILE_NAMES)} |"
        yield "|---" * (2 + len(PROFILE_NAMES)) + "|"
        meanings = attribute_docstrings(Profile)
        for key in Profile.model_fields:
            if key not in {"name", "title"}:
                values = (_required(clauses[key]) if key in clauses else "" for clauses in profiles)
                yield f"| `{key}` | {_cell(meanings.get(key, ''))} | {' | '.join(values)} |"
        yield ""
        for name in PROFILE_NAMES:
            profile = load_profile(name)
            yield from (f"## {name}", "", f"{profile.title}.", "")
            yield from (
                "| clause | in words | source | read there | confidence | to miss it |",
                "|---|---|---|---|---|---|",
            )
            for key, clause in profile.clauses():
                read = "yes" if clause.verified else ""
                cells = (f"`{key}`", _cell(clause.text), _cell(clause.source), read, clause.confidence)
                yield f"| {' | '.join(cells)} | {clause.severity} |"
            yield ""


def _required(clause: Clause) -> str:
    match clause:
        case Amount():
            return f"{clause.value:g}" if clause.reported_in == "count" else f"{clause.value:g} {_unit(clause)}"
        case LengthsByAngle():
            pairs = zip(clause.angles_deg, clause.values, strict=True)
            return ", ".join(f"{value:g} {clause.unit} at {angle:g} degrees" for angle, value in pairs)
        case LengthRange():
            return f"{clause.least:g} to {clause.most:g} {clause.unit}"
        case Steps():
            steps = ", ".join(f"{number} up to {stalls}" for stalls, number in clause.steps)
            above = f"{clause.above_percent:g} %" if clause.above is None else str(clause.above)
            return f"{steps}, {above} above"
    raise TypeError(type(clause))


def _unit(clause: Amount) -> str:
    unit: str = clause.unit  # type: ignore[attr-defined]
    return unit


class Deviations(MadeFromCode):
    """Where the code departs from the paper."""

    def lines(self) -> Iterator[str]:
        """A table with a row for each ``Deviation:``."""
        yield from ("| where | how |", "|---|---|")
        for where, text in find_deviations():
            yield f"| `{where}` | {_cell(text)} |"


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directives."""
    app.add_directive("configuration-reference", ConfigurationReference)
    app.add_directive("class-list", ClassList)
    app.add_directive("rule-list", RuleList)
    app.add_directive("profile-tables", ProfileTables)
    app.add_directive("deviations", Deviations)
    return {"parallel_read_safe": True}
