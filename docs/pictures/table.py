"""The table of pictures: what each shows, how it is drawn, and which are older than what they show."""

import hashlib
import json
import os
import re
import tomllib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

REPOSITORY = Path(__file__).parents[2]
MADE_OF = "docs/pictures/made_of.json"
_TABLE = "docs/pictures/pictures.toml"
_FOLDERS = ("docs/pictures", "docs/gallery")
_SUFFIXES = {".png", ".jpg", ".svg", ".mp4"}
_LINK = re.compile(r"\]\(([^)#:\s]+)\)")
_PROSE = ("title", "words")
"""Keys that say something about a picture and change nothing in it."""


@dataclass(frozen=True)
class Picture:
    """An entry of the table.

    Attributes
    ----------
    of
        The garage that is shown: ``build ...``, ``import ...`` or ``dataset ...`` with the options of that command, or
        ``files ...``, which are those of the repository that decide what is seen.
    commands
        Commands that draw, in a folder with that garage as ``garage.usdc``, or the data set as ``garages/``, and with
        the repository's ``samples``, ``docs`` and ``benchmarks``.
    take
        The files that are taken then; several, also by a pattern, stand beside each other in `columns`.
    columns, width, crop, brighter
        Columns of pictures; width in pixels to which each is made smaller, 0 for as it is; left, top, right and bottom
        that are kept of each, as shares of its sides; share of its pixels that get at least the brightness of a lit
        floor, 0 for none.
    elsewhere
        By what it is drawn that this program does not run. Such a picture has no other key, and is not judged.
    title, words
        Heading and text of a garage of the gallery.
    """

    of: str = ""
    commands: tuple[str, ...] = ()
    take: tuple[str, ...] = ()
    columns: int = 1
    width: int = 0
    crop: tuple[float, ...] = ()
    brighter: float = 0.0
    elsewhere: str = ""
    title: str = ""
    words: str = ""

    def told(self) -> dict[str, Any]:
        """Return what the record of a drawn picture holds of the entry, as JSON has it."""
        usual = asdict(Picture())
        keys = {key: value for key, value in asdict(self).items() if value != usual[key] and key not in _PROSE}
        kept: dict[str, Any] = json.loads(json.dumps(keys))
        return kept


@dataclass
class Found:
    """What a check finds: reasons by the path of a picture.

    Attributes
    ----------
    wrong
        Pictures that are missing, were altered, stand in no table, or are shown nowhere.
    older
        Pictures of what has changed since they were drawn.
    """

    wrong: dict[str, str] = field(default_factory=dict)
    older: dict[str, str] = field(default_factory=dict)

    def lines(self) -> list[str]:
        """Return a line for each picture."""
        return [f"{name}: {reason}" for name, reason in sorted({**self.older, **self.wrong}.items())]


def read_table(repository: Path = REPOSITORY) -> dict[str, Picture]:
    """Return the entries by the path of the picture in the repository."""
    tables = tomllib.loads((repository / _TABLE).read_text(encoding="utf-8"))
    return {
        f"docs/{name}": Picture(**{key: tuple(v) if isinstance(v, list) else v for key, v in keys.items()})
        for name, keys in tables.items()
    }


def read_records(repository: Path = REPOSITORY) -> dict[str, Any]:
    """Return what each picture was made of, by its path."""
    file = repository / MADE_OF
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}


def shown_pictures(repository: Path = REPOSITORY) -> dict[str, str]:
    """Return the pictures in the folders of this table that pages link to, each with the first page that does."""
    shown: dict[str, str] = {}
    for page in [repository / "README.md", *sorted((repository / "docs").rglob("*.md"))]:
        for target in _LINK.findall(page.read_text(encoding="utf-8")):
            path = Path(os.path.normpath(page.parent / target))
            if path.suffix in _SUFFIXES and path.is_relative_to(repository):
                name = path.relative_to(repository).as_posix()
                if name.startswith(_FOLDERS):
                    shown.setdefault(name, page.relative_to(repository).as_posix())
    return shown


def check(repository: Path = REPOSITORY, stages: Mapping[str, str] | None = None) -> Found:
    """Find the pictures that are not what the table, their records and their garages say.

    Parameters
    ----------
    repository
        The folder with the table, the records and the pages.
    stages
        Digest of garages, by `Picture.of`, as they are now; others are not compared.
    """
    table, records, shown = read_table(repository), read_records(repository), shown_pictures(repository)
    files = {
        path.relative_to(repository).as_posix()
        for folder in _FOLDERS
        for path in (repository / folder).glob("*")
        if path.suffix in _SUFFIXES
    }
    found = Found()
    for name in sorted({*table, *files, *shown, *records}):
        entry, record = table.get(name), records.get(name)
        if entry is None:
            found.wrong[name] = f"has no entry in {_TABLE}"
        elif name not in shown:
            found.wrong[name] = "is shown on no page"
        elif name not in files:
            found.wrong[name] = f"is missing; {shown[name]} shows it"
        elif entry.elsewhere:
            continue
        elif record is None:
            found.wrong[name] = f"has no record in {MADE_OF}"
        elif record["picture"] != file_digest(repository / name):
            found.wrong[name] = "was altered after it was drawn"
        elif {key: record["entry"].get(key) for key in {*record["entry"], *entry.told()}} != entry.told():
            found.older[name] = "is drawn otherwise now, by its entry"
        elif (now := (stages or {}).get(entry.of, record["stage"])) != record["stage"]:
            found.older[name] = f"shows {entry.of} of another content: {record['stage']}, now {now}"
    return found


def file_digest(path: Path) -> str:
    """Return the first digits of the SHA-256 of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]
