"""Damaged and hostile files into the C# readers: ``python -m support.unity.fuzz [--count COUNT] [--seed SEED]``
in ``tests``.

COUNT files into each of the three readers: texts, crates and packages. Each is read or refused with the one exception,
within two seconds and a bounded memory; whatever is not so is kept and named.
"""

import argparse
import shutil
import sys
import tempfile
import zipfile
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from pxr import Sdf

from support.unity import damage, hostile, reader
from support.unity.agreement import STAGES
from support.unity.small_stages import SMALL_STAGES

SLOWEST_S = 2.0
LARGEST_MB = 600.0
HANGS_S = 20.0
FORMATS = ("usda", "usdc", "usdz")

Files = dict[str, bytes]
"""Names and contents of files, the first the root."""


class Fuzz:
    """Draws files for one of the three readers; the same seed draws the same files."""

    def __init__(self, form: str, seed: int) -> None:
        self.form = form
        self.draw = Random(f"{form} {seed}")  # noqa: S311 - of test inputs
        self.texts = {path.stem: path.read_text() for path in sorted(STAGES.glob("*.usda"))}
        for name in ("variants", "instances", "references", "list edits", "inherits", "sublayers with offsets"):
            self.texts[name] = "#usda 1.0\n" + next(iter(SMALL_STAGES[name].values())).replace(" }", "\n}")
        numbers = ", ".join(str(index * 7 % 1000) for index in range(4000))
        arrays = f"int[] i = [{numbers}]\n double[] d = [{numbers}]\n float[] f = [{numbers}]"
        self.texts["arrays"] = f'#usda 1.0\ndef Mesh "A" {{\n {arrays}\n}}\n'
        inner = "usda" if form == "usda" else "usdc"
        self.sound = {name: converted(text, inner) for name, text in self.texts.items()}

    def kinds(self) -> list[Callable]:
        """All kinds of files that this one draws from."""
        if self.form == "usdz":
            return [*damage.OF_PACKAGES, *hostile.ZIP_TRICKS, hostile.circles]
        return [*(damage.OF_TEXTS if self.form == "usda" else damage.OF_CRATES), *hostile.HOSTILE]

    def files(self) -> tuple[str, Files]:
        """The kind of the next case, and its files."""
        kind = self.draw.choice(self.kinds())
        name = self.draw.choice(list(self.sound))
        if kind in hostile.HOSTILE:
            inner = "usda" if self.form == "usda" else "usdc"
            files = {f"{key}": converted(f"#usda 1.0\n{text}", inner) for key, text in kind(self.draw).items()}
            return kind.__name__, {"root.usdz": zipped(files)} if self.form == "usdz" else files
        if self.form != "usdz":
            return kind.__name__, {f"damaged.{self.form}": kind(self.sound[name], self.draw)}
        entries = {f"{name}.usdc": self.sound[name], f"sub/{name}.usda": self.texts[name].encode()}
        if kind in hostile.ZIP_TRICKS:
            return kind.__name__, {"tricky.usdz": kind(entries, self.draw)}
        return kind.__name__, {"damaged.usdz": kind(zipped(entries), self.draw)}


def converted(text: str, form: str) -> bytes:
    """The layer of a text in a format."""
    if form == "usda":
        return text.encode()
    layer = Sdf.Layer.CreateAnonymous(".usda")
    assert layer.ImportFromString(text)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"layer.{form}"
        layer.Export(str(path))
        return path.read_bytes()


def zipped(entries: Files) -> bytes:
    with tempfile.TemporaryFile() as file:
        with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as archive:
            for name, data in entries.items():
                archive.writestr(name, data)
        file.seek(0)
        return file.read()


@dataclass
class Outcome:
    """How many files of each kind were read and refused, what the dearest cost, and what went wrong, a line each."""

    seen: Counter = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)
    slowest_s: float = 0.0
    peak_mb: float = 0.0

    def __str__(self) -> str:
        counts = (
            f"  {kind}: {self.seen[kind, 'read']} read, {self.seen[kind, 'refused']} refused" for kind in self.kinds()
        )
        cost = f"  slowest {self.slowest_s:.2f} s, peak {self.peak_mb:.0f} MB, {len(self.wrong)} wrong"
        return "\n".join([*counts, cost, *self.wrong[:40]])

    def kinds(self) -> list[str]:
        return sorted({kind for kind, _ in self.seen})


def run(count: int, seed: int, form: str, usd_dump: reader.Reader, folder: Path) -> Outcome:
    """Files into one of the readers; those that are not taken well stay in the folder."""
    fuzz, outcome = Fuzz(form, seed), Outcome()
    for number in range(count):
        kind, files = fuzz.files()
        case = folder / f"{form}_{seed}_{number}"
        case.mkdir()
        for name, data in files.items():
            (case / name).write_bytes(data)
        reason = take(kind, case / next(iter(files)), usd_dump, outcome)
        if reason is None:
            shutil.rmtree(case)
        else:
            outcome.wrong.append(f"{case.name} ({kind}): {reason}")
    return outcome


def take(kind: str, path: Path, usd_dump: reader.Reader, outcome: Outcome) -> str | None:
    """Read one file; what is wrong with how that went."""
    usd_dump.forget_peak()
    try:
        answer = usd_dump.ask("fuzz", path, cpu_limit_s=HANGS_S)
    except AssertionError as error:
        usd_dump.close()
        return str(error)
    peak_mb = usd_dump.peak_mb()
    outcome.seen[kind, "refused" if "refused" in answer else "read"] += 1
    outcome.slowest_s = max(outcome.slowest_s, answer["cpu_s"])
    outcome.peak_mb = max(outcome.peak_mb, peak_mb)
    if "crash" in answer:
        return answer["crash"]
    if answer["cpu_s"] > SLOWEST_S:
        return f"took {answer['cpu_s']:.1f} s"
    return f"took {peak_mb:.0f} MB" if peak_mb > LARGEST_MB else None


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    folder = Path(tempfile.mkdtemp(prefix="usd_fuzz_"))
    usd_dump = reader.Reader(reader.compile_program(folder))
    outcomes = [run(arguments.count, arguments.seed, form, usd_dump, folder) for form in FORMATS]
    usd_dump.close()
    for form, outcome in zip(FORMATS, outcomes, strict=True):
        print(f"{form}, {arguments.count} files:\n{outcome}")  # noqa: T201
    if any(outcome.wrong for outcome in outcomes):
        sys.exit(f"kept in {folder}")
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
