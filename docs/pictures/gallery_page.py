"""The page of the gallery, ``docs/gallery.md``, as the table of pictures and the configurations make it."""

import shlex
from pathlib import Path
from typing import Any

from table import REPOSITORY, Picture, read_records, read_table

PAGE = "docs/gallery.md"
_A_ROW = 4
_STARTING_POINTS = "garage2usd/config/starting_points"
_VARY = "\n# What differs among"
"""Begins what a starting point says of data sets."""
_HEAD = """# Gallery

{count} garages, from one level to four, to copy and to change. Each has its configuration and the commands that
build it; all were built from just what stands here. Stalls are those for cars, and square metres are all ground
inside the outline, of all levels.

{index}
"""
_ENTRY = """
## {title}

![{title}](gallery/{stem}.jpg)

{words} **{figures}.**
{more}
<details><summary>Configuration and commands</summary>

```toml
# {stem}.toml
{settings}```

```sh
{commands}
```

</details>
"""


def page(repository: Path = REPOSITORY) -> str:
    """Return the text of the page."""
    records = read_records(repository)
    table = {name: entry for name, entry in read_table(repository).items() if entry.title}
    entries = [_entry(Path(name).stem, entry, records.get(name, {}), repository) for name, entry in table.items()]
    links = [
        f"[![{entry.title}](gallery/{Path(name).stem}.jpg)<br>{entry.title}](#{_anchor(entry.title)})"
        for name, entry in table.items()
    ]
    rows = [f"| {' | '.join(links[first : first + _A_ROW])} |" for first in range(0, len(links), _A_ROW)]
    index = "\n".join(["|" + " |" * _A_ROW, "|" + "---|" * _A_ROW, *rows])
    return _HEAD.format(count=len(table), index=index) + "".join(entries)


def write_page() -> None:
    """Write the page."""
    (REPOSITORY / PAGE).write_text(page(), encoding="utf-8")


def configuration(of: str, repository: Path = REPOSITORY) -> str:
    """Return the text of the file that makes a garage: a configuration, a starting point, or a drawing in metres."""
    _, *words = shlex.split(of)
    if words[0] == "--like":
        text = (repository / _STARTING_POINTS / f"{words[1]}.toml").read_text(encoding="utf-8")
        settings = text.partition(_VARY)[0]
        seed = words[words.index("--seed") + 1]
        return settings.replace("profile =", f"seed = {seed}\nprofile =", 1)
    return (repository / words[0]).read_text(encoding="utf-8")


def _entry(stem: str, entry: Picture, record: dict[str, Any], repository: Path) -> str:
    figures = record.get("figures", {"stalls": 0, "levels": 0, "area_m2": 0})
    levels = "one level" if figures["levels"] == 1 else f"{figures['levels']} levels"
    told = f"{figures['stalls']} stalls, {levels}, {figures['area_m2']:,} m2"
    kind, *words = shlex.split(entry.of)
    commands = [f"garage2usd {kind} {stem}.toml -o {stem}.usdz"]
    more = ""
    if any(command.startswith("garage2usd traffic") for command in entry.commands):
        commands += [f"garage2usd traffic {stem}.usdz --minutes 5 -o {stem}.csv"]
        commands += [f"garage2usd view {stem}.usdz --tracks {stem}.csv"]
        more = f"\n[Twenty seconds of video](gallery/{stem}.mp4) of four minutes, seen from above.\n"
    if words[0] == "--like":
        told += f"; `garage2usd build --like {words[1]}`"
    return _ENTRY.format(
        title=entry.title,
        stem=stem,
        words=entry.words,
        figures=told,
        more=more,
        settings=configuration(entry.of, repository),
        commands="\n".join(commands),
    )


def _anchor(title: str) -> str:
    return "".join(letter for letter in title.lower().replace(" ", "-") if letter.isalnum() or letter == "-")


if __name__ == "__main__":
    write_page()
