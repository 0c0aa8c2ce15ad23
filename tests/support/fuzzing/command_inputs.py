"""Hostile inputs for the commands: damaged, absurd and misleading files, each drawn from a seed and its number."""

import json
import os
import re
from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from support.unity import damage, hostile
from support.unity.agreement import STAGES

__all__ = ["Case", "Corpus", "draw_case", "make_corpus"]

CONFIG = """
seed = 3
[site]
width_cells = 4
height_cells = 5
[plan]
episodes = 40
[stage]
texture_quality = "low"
"""
PLAN = "#E###\n.=...\n.===.\n...=.\n###X#\n"
ABSURD = (
    0, -1, 1, 3, 10**6 + 1, -(10**18), 2**63, 10**400, 1e308, float("nan"), float("inf"), -0.0, "", "\0",
    "../../../etc/passwd", "/etc/passwd",
    "/dev/zero", "x" * 100_000, [], {}, [[]], None, True, [10**6, 10**6], {"a": {"b": 1}}, "NaN", "🚗",
)  # fmt: skip
"""Values in the place of others. None is merely large: 1000 x 1000 squares and 10**6 episodes are allowed, and take
their time."""
ABSURD_WORDS = ("nan", "inf", "-inf", "1e999", "9" * 5000, "0x7f", "true", '"' + "x" * 100_000 + '"', "[" * 3000, "{}")
ARGUMENTS = (
    ("--seed", "-1"), ("--seed", "9" * 30), ("--tape", "\x1b[31m"), ("--tape", "U" * 50_000), ("--output", "out"),
    ("--output", "out/a@b.usda"), ("--output", "out/\udcff.usda"), ("--output", "/dev/null/x.usdz"),
    ("--best-plans", "1000000"), ("--best-plans", "-1"), ("--profile", "../../etc/passwd"), ("--profile", "nothing"),
    ("--output", "out/" + "n" * 300 + ".usda"), ("--nonsense",), ("\0",), ("--seed",), ("--profile", ""),
)  # fmt: skip
NUMBER = re.compile(r"(?<![\w.@/\"])-?\d+(\.\d+)?(?![\w@\"])")


@dataclass(frozen=True)
class Case:
    """One call: the arguments, and the files that are there before it."""

    kind: str
    arguments: tuple[str, ...]
    files: dict[str, bytes] = field(default_factory=dict)
    links: dict[str, str] = field(default_factory=dict)
    special: tuple[str, str] | None = None
    """A pipe or a folder at a path."""


@dataclass(frozen=True)
class Corpus:
    """Sound files of one small garage, by their suffix or purpose."""

    files: dict[str, bytes]
    """The garage as ``garage.usda``, ``.usdc``, ``.usdz`` with assets, report and labels, by path."""
    crates: dict[str, bytes]
    """Small stages as crates, by name."""
    profile: bytes


def make_corpus(folder: Path) -> Corpus:
    """Build the garage in its three formats; to be called in a process of its own, as USD starts threads."""
    from pxr import Sdf

    import garage2usd
    from garage2usd.profiles import load_profile

    files = {}
    (folder / "config.toml").write_text(CONFIG)
    for suffix in ("usda", "usdc", "usdz"):
        place = folder / suffix
        garage2usd.build(garage2usd.load_config(folder / "config.toml"), place / f"garage.{suffix}")
        files |= {
            f"{suffix}/{path.relative_to(place)}": path.read_bytes() for path in place.rglob("*") if path.is_file()
        }
    crates = {}
    for path in sorted(STAGES.glob("*.usda")):
        Sdf.Layer.FindOrOpen(str(path)).Export(str(folder / "x.usdc"))
        crates[path.stem] = (folder / "x.usdc").read_bytes()
    profile = json.dumps(load_profile("us-ada").model_dump(mode="json", exclude_none=True))
    return Corpus(files, crates, profile.encode())


def draw_case(corpus: Corpus, seed: int, number: int) -> Case:
    """The case of a number; the same seed and number draw the same."""
    draw = Random(f"{seed} {number}")  # noqa: S311 - of test inputs
    return draw.choice(KINDS)(corpus, draw)


def configuration(corpus: Corpus, draw: Random) -> Case:
    """A configuration with absurd values or damaged text."""
    text = _absurd_toml(draw) if draw.random() < 0.6 else _damaged(CONFIG.encode(), draw)
    command = draw.choice(
        [("build", "bad.toml", "--output", "out/garage.usda"), ("check", "bad.toml"), ("drive", "bad.toml")]
    )
    return Case("configuration", command, {"bad.toml": text})


def structure(corpus: Corpus, draw: Random) -> Case:
    """S, R and C as text, as JSON, or as a file that a configuration names."""
    text = draw.choice(
        [PLAN, "1 " * 30, "-1 0 1 2 3\n" * 5, ".=" * 50_000, "\n" * 10_000, PLAN * 8, "=" * 10**6 + "\n"]
    )
    data = _damaged(text.encode(), draw)
    match draw.randrange(3):
        case 0:
            return Case("structure as text", ("check", "plan.txt"), {"plan.txt": data})
        case 1:
            value = {"S": PLAN.splitlines(), "R": [8.1] * 5, "C": [8.1] * 5}
            return Case("structure as JSON", ("check", "plan.json"), {"plan.json": _absurd_json(value, draw)})
    name = draw.choice(["plan.txt", "../plan.txt", "/etc/passwd", "/dev/zero", "out", "\\0", "plan.txt"])
    config = f'[site]\nstructure_file = "{name}"\n'.encode()
    files = {"bad.toml": config, "plan.txt": data}
    return Case("structure file", ("build", "bad.toml", "--output", "out/garage.usda"), files)


def report(corpus: Corpus, draw: Random) -> Case:
    """A report with absurd values or damaged text."""
    sound = corpus.files["usda/garage_report.json"]
    data = _absurd_json(json.loads(sound), draw) if draw.random() < 0.6 else _damaged(sound, draw)
    command = draw.choice([("check", "garage_report.json"), ("plan", "garage_report.json", "--output", "out/plan.svg")])
    return Case("report", command, {"garage_report.json": data})


def profile(corpus: Corpus, draw: Random) -> Case:
    """A profile of the user's own."""
    settings = json.loads(corpus.profile)
    _put(settings, draw)
    data = _toml(settings).encode("utf-8", "surrogatepass")
    if draw.random() < 0.4:
        data = _damaged(data, draw)
    files = {"bad.toml": data, "config.toml": CONFIG.encode(), "plan.txt": PLAN.encode()}
    command = draw.choice(
        [("build", "config.toml", "--output", "out/garage.usda"), ("check", "plan.txt"), ("drive", "config.toml")]
    )
    return Case("profile", (*command, "--profile", "bad.toml"), files)


def arguments(corpus: Corpus, draw: Random) -> Case:
    """Options that make no sense, in any order."""
    words = [word for _ in range(draw.randrange(1, 4)) for word in draw.choice(ARGUMENTS)]
    command = draw.choice(
        ["build", "check", "drive", "meshes", "plan", "view", "render", "schema", "textures", "nothing", ""]
    )
    if command == "build":  # which writes beside its configuration if it is told nothing else
        words = ["--output", "out/garage.usdz", *words]
    if command in {"meshes", "textures"}:  # which take their time
        words.append("--nonsense")
    return Case(
        "arguments", (command, draw.choice(["config.toml", "none.toml", ""]), *words), {"config.toml": CONFIG.encode()}
    )


def text_stage(corpus: Corpus, draw: Random) -> Case:
    """The garage as text, damaged or with absurd numbers, paths and arcs."""
    files = _garage(corpus, "usda")
    name = "garage.usda"
    if draw.random() < 0.5:
        files[name] = _damaged(files[name], draw)
    else:
        files[name] = _absurd_text(files[name].decode(), draw).encode("utf-8", "surrogatepass")
    return Case("stage as text", _reading(name, draw), files)


def crate_stage(corpus: Corpus, draw: Random) -> Case:
    """The garage as a crate, or one of its assets, or a small stage, damaged."""
    kind = draw.choice(damage.OF_CRATES)
    if draw.random() < 0.4:
        small = draw.choice(list(corpus.crates.values()))
        return Case(f"crate: {kind.__name__}", _reading("garage.usdc", draw), {"garage.usdc": kind(small, draw)})
    files = _garage(corpus, "usdc")
    name = draw.choice([name for name in files if name.endswith(".usdc")])
    flat = kind if kind is not damage.wrong_tables else damage.other_bytes
    files[name] = flat(files[name], draw)
    return Case(f"crate: {flat.__name__}", _reading("garage.usdc", draw), files)


def package_stage(corpus: Corpus, draw: Random) -> Case:
    """The garage's package damaged, or small packages with tricks."""
    if draw.random() < 0.5:
        kind = draw.choice(damage.OF_PACKAGES)
        files = _garage(corpus, "usdz")
        files["garage.usdz"] = kind(files["garage.usdz"], draw)
    else:
        kind = draw.choice(hostile.ZIP_TRICKS)
        files = {"garage.usdz": kind({"root.usda": b'#usda 1.0\ndef Cube "C" {}\n'}, draw)}
    return Case(f"package: {kind.__name__}", _reading("garage.usdz", draw), files)


def composed_stage(corpus: Corpus, draw: Random) -> Case:
    """Arcs in circles, arcs in doubling numbers, prims within prims."""
    kind = draw.choice(hostile.HOSTILE)
    texts = kind(draw)
    files = {
        f"{name}.usda": "#usda 1.0\n" + re.sub(r"@(\w+)@", r"@./\1.usda@", text) + "\n" for name, text in texts.items()
    }
    return Case(
        f"stage: {kind.__name__}", _reading("root.usda", draw), {name: text.encode() for name, text in files.items()}
    )


def labels(corpus: Corpus, draw: Random) -> Case:
    """A table of labels with absurd values or damaged text."""
    files = _garage(corpus, "usdz")
    sound = files["garage_labels.json"]
    files["garage_labels.json"] = (
        _absurd_json(json.loads(sound), draw) if draw.random() < 0.6 else _damaged(sound, draw)
    )
    return Case("labels", draw.choice([_view("garage.usdz"), _render("garage.usdz")]), files)


def misplaced(corpus: Corpus, draw: Random) -> Case:
    """A path that is no file: a folder, a pipe, a link in a circle or to somewhere else, or nothing at all."""
    name = draw.choice(["a.usda", "a.usdc", "a.usdz", "a.toml", "a.json", "a.txt"])
    command = draw.choice(
        [("check", name), _view(name), _render(name), ("build", name, "--output", "out/garage.usda"), ("drive", name)]
    )
    match draw.randrange(5):
        case 0:
            return Case("folder", command, special=("folder", name))
        case 1:
            return Case("pipe", command, special=("pipe", name))
        case 2:
            return Case("link", command, links={name: draw.choice([name, "/etc/passwd", "/dev/zero", "nowhere", "/"])})
        case 3:
            return Case("empty", command, {name: b""})
    return Case("nothing there", command)


KINDS: tuple[Callable[[Corpus, Random], Case], ...] = (
    configuration, structure, report, profile, arguments, text_stage, crate_stage, crate_stage, package_stage,
    composed_stage, labels, misplaced,
)  # fmt: skip


def _garage(corpus: Corpus, suffix: str) -> dict[str, bytes]:
    start = f"{suffix}/"
    return {name.removeprefix(start): data for name, data in corpus.files.items() if name.startswith(start)}


def _reading(name: str, draw: Random) -> tuple[str, ...]:
    return draw.choice([("check", name), ("check", name, "--json"), _view(name), _render(name)])


def _view(name: str) -> tuple[str, ...]:
    return "view", name, "--no-browser"


def _render(name: str) -> tuple[str, ...]:
    return "render", name, "--camera", "Inside", "--size", "32x18", "--samples", "1", "--output", "out/set"


def _damaged(data: bytes, draw: Random) -> bytes:
    for _ in range(draw.choice([1, 1, 2])):
        data = draw.choice(damage.OF_TEXTS)(data, draw) or b" "
    return data


def _put(document: object, draw: Random) -> None:
    """Put absurd values in the place of some."""
    for _ in range(draw.choice([1, 1, 2, 5])):
        place = document
        while isinstance(place, dict | list) and place:
            key = draw.choice(list(place)) if isinstance(place, dict) else draw.randrange(len(place))
            inner = place[key]
            if not (isinstance(inner, dict | list) and inner) or draw.random() < 0.15:
                if draw.random() < 0.15:
                    del place[key]
                else:
                    place[key] = deepcopy(draw.choice(ABSURD))  # the next value may go into this one
                break
            place = inner


def _absurd_json(document: object, draw: Random) -> bytes:
    _put(document, draw)
    text = json.dumps(document)
    if draw.random() < 0.1:
        text = draw.choice(["[" * 100_000, '{"config":' * 50_000, text + text, text.replace('"', "'"), "9" * 10**6])
    return text.encode("utf-8", "surrogatepass")


def _absurd_toml(draw: Random) -> bytes:
    settings: dict = {
        "seed": 3,
        "site": {
            "width_cells": 4,
            "height_cells": 5,
            "rectangles": 0,
            "entrances": 1,
            "obstacles": 0,
            "structure": PLAN,
        },
        "bay": {"stall_width_m": 2.4, "column_size_m": 0.6, "column_widths_m": [8.1] * 5, "row_depths_m": [8.1] * 5},
        "plan": {"episodes": 40, "dead_ends": "standard", "preset": "tuned"},
        "fittings": {"ceiling_height_m": 2.8, "clear_height_m": 2.2, "lane_lux": 50, "wheel_stops": True},
        "parking": {"occupancy": 0.6, "ev_share": 0.1, "occupied_stalls": ["Stall_r01_c00_1"]},
        "stage": {"form": "flat", "texture_quality": "low", "arrangements": 5},
    }
    for section in draw.sample([name for name in settings if name != "seed"], draw.randrange(6)):
        del settings[section]
    settings.setdefault("site", {"width_cells": 4, "height_cells": 5})
    settings.setdefault("plan", {"episodes": 40})
    _put(settings, draw)
    return _toml(settings).encode("utf-8", "surrogatepass")


def _toml(table: dict, name: str = "") -> str:
    """TOML of nested tables; None stays out, as TOML has none."""
    plain = {key: value for key, value in table.items() if not isinstance(value, dict) and value is not None}
    lines = [f"[{name}]"] if name else []
    lines += [f"{json.dumps(key)} = {_toml_value(value)}" for key, value in plain.items()]
    for key, value in table.items():
        if isinstance(value, dict):
            inner = json.dumps(key)
            lines.append(_toml(value, f"{name}.{inner}" if name else inner))
    return "\n".join(lines) + "\n"


def _toml_value(value: object) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {_toml_value(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_toml_value(inner) for inner in value if inner is not None) + "]"
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "")


def _absurd_text(text: str, draw: Random) -> str:
    """A stage's text with other numbers, paths, types or arcs."""
    for _ in range(draw.choice([1, 2, 5])):
        match draw.randrange(5):
            case 0 | 1:
                places = [found.span() for found in NUMBER.finditer(text)]
                start, end = draw.choice(places)
                text = text[:start] + draw.choice(ABSURD_WORDS) + text[end:]
            case 2:
                other = draw.choice(
                    ["/etc/passwd", "../../../../etc/passwd", "garage.usda", "", "http://[", "x" * 5000, "\0"]
                )
                text = re.sub(r"@[^@]*@", f"@{other}@".replace("\\", ""), text, count=draw.choice([1, 1, 50]))
            case 3:
                types = ("Xform", "Mesh", "PointInstancer", "BasisCurves", "Camera", "SphereLight", "Material", "X")
                text = re.sub(r"def \w+ ", f"def {draw.choice(types)} ", text, count=draw.choice([1, 3, 200]))
            case _:
                old = draw.choice(["token", "float3", "float", "string", "int2", "prepend", "instanceable", "garage:"])
                text = text.replace(
                    old, draw.choice(["int", "double3", "token[]", "rel", "delete", "xformOp:"]), draw.choice([1, 9])
                )
    return text


def lay_out(case: Case, folder: Path) -> None:
    """Put the files of a case into a folder."""
    for name, data in case.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    for name, target in case.links.items():
        (folder / name).symlink_to(target)
    if case.special is not None:
        kind, name = case.special
        (folder / name).mkdir() if kind == "folder" else os.mkfifo(folder / name)
