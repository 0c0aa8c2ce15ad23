"""What drawn garages are worth to a detector that learns from them and is tested on photographs.

Usage: python benchmarks/real.py FOLDER [-o OUT]                draws, trains on each teacher, tests, writes the table
       python benchmarks/real.py draw RECIPE -o DRAWN           draws the strips of a recipe's garages
       python benchmarks/real.py recorded DATASET -o DRAWN      takes the strips out of a data set's recordings
       python benchmarks/real.py train FOLDER [--drawn DRAWN]   trains on those, or on photographs of the other garages
       python benchmarks/real.py slots FOLDER --drawn DRAWN     trains to find slots and free ground, on those alone
       python benchmarks/real.py outside FOLDER --drawn DRAWN --weights FILE
                                                                what SPFCN, trained by others, finds in both

FOLDER has photographs as `strips` tells; how to get some and the weights says ``docs/guides/real_pictures.md``. Drawing
needs the extras blender and dataset, training what ``real_requirements.txt`` names, ``outside`` what
``outside_requirements.txt`` does.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from average_precision import at_threshold, matched, score
from drawn_folder import drawn_garages, read_drawn, read_labelled, write_drawn
from strips import Strip, read_strips

from garage2usd.common.errors import ConfigError, Garage2UsdError

if TYPE_CHECKING:
    from teachers import Outcome, Teacher

HERE = Path(__file__).parent
RECIPES = {"one look": HERE / "one_look.toml", "drawn looks": HERE / "drawn_looks.toml"}
ASIDE, LEAST_WITH_ASIDE = 4, 20
"""Of more garages than that so many are not learnt from: what is found in them is drawn."""
THRESHOLDS = 0.2, 0.5, 0.8
"""Of confidence, at which recall and precision are told; pictures show what is found at the middle one."""
ASIDE_SHARE = 4
"""One of so many drawn garages of a folder is not learnt from, as slots are measured in it."""


def main(arguments: Sequence[str]) -> None:
    """Do what is asked for; without a command, all."""
    commands = {
        "draw": _draw,
        "recorded": _recorded,
        "train": _train,
        "slots": _slots,
        "all": _all,
        "outside": _outside,
    }
    if arguments and arguments[0] not in {*commands, "-h", "--help"}:
        arguments = ["all", *arguments]
    asked = _parser().parse_args(arguments)
    try:
        commands[asked.command](asked)
    except Garage2UsdError as error:
        sys.exit(f"error: {error}")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    draw = commands.add_parser("draw", help="strips of a recipe's garages")
    draw.add_argument("recipe", type=Path)
    draw.add_argument("-o", "--output", type=Path, required=True)
    recorded = commands.add_parser("recorded", help="strips of a data set, as of recorded.toml")
    recorded.add_argument("dataset", metavar="DATASET", type=Path)
    recorded.add_argument("-o", "--output", type=Path, required=True)
    recorded.add_argument("--pictures", type=int, default=11, help="of each garage at most")
    train = commands.add_parser("train", help="one teacher")
    train.add_argument("--drawn", type=Path, action="append", help="what draw wrote; several are learnt from together")
    slots = commands.add_parser("slots", help="slots as pairs of corners, and free ground")
    slots.add_argument("--drawn", type=Path, action="append", required=True, help="what draw wrote")
    everything = commands.add_parser("all", help="draw, and train on each teacher")
    outside = commands.add_parser("outside", help="what a detector of others finds in photographs and drawn strips")
    outside.add_argument("--drawn", type=Path, action="append", required=True, help="what draw wrote")
    outside.add_argument("--weights", type=Path, required=True, help="stable_parameter_0914.pkl of SPFCN")
    outside.add_argument("--recipe", type=Path, help="that of the drawn garages, for figures by their lines")
    for command in (train, slots, everything, outside):
        command.add_argument("folder", metavar="FOLDER", type=Path, help="photographs")
        command.add_argument("-o", "--output", type=Path, default=Path("out/real"), help="gets table and pictures")
    for command in (train, slots, everything):
        command.add_argument("--runs", type=int, default=3, help="trainings of each teacher")
        command.add_argument("--steps", type=int, default=1000, help="of each training")
    for command in (draw, everything):
        command.add_argument("--garages", type=int, default=154)
        command.add_argument("--pictures", type=int, default=11, help="of each garage at most")
        command.add_argument("--workers", type=int, default=2)
        command.add_argument("--device", choices=["rays", "cpu"], default="rays", help="what draws; cpu is Blender")
        command.add_argument("--effects", action="store_true", help="as cameras take pictures, with noise and exposure")
        command.add_argument("--version", default="", help="garages drawn with another are drawn anew")
    return parser


def _draw(asked: argparse.Namespace) -> None:
    _drawn(asked.recipe, asked.output, asked)


def _drawn(recipe: Path, folder: Path, asked: argparse.Namespace) -> None:
    """Draw the strips of a recipe's garages, and say how far it is."""
    # only drawing needs Blender and what data sets do
    from drawn_strips import StripSettings, draw_strips  # noqa: PLC0415

    from garage2usd.datasets import load_recipe  # noqa: PLC0415

    settings = StripSettings(pictures=asked.pictures, device=asked.device, effects=asked.effects)
    places: list[Path] = []
    pictures, cpu_s, start = 0, 0.0, time.monotonic()
    for drawn in draw_strips(
        load_recipe(recipe), asked.garages, folder, version=asked.version, settings=settings, workers=asked.workers
    ):
        places.append(drawn.folder)
        write_drawn(folder, places)
        pictures, cpu_s = pictures + drawn.pictures, cpu_s + drawn.cpu_s
        each = f"{cpu_s / pictures:.2f} processor seconds each, {time.monotonic() - start:.0f} s"
        print(f"{len(places)} of {asked.garages} garages, {pictures} pictures, {each}", flush=True)


def _recorded(asked: argparse.Namespace) -> None:
    from recorded_strips import convert  # noqa: PLC0415 - only this and drawing need what data sets do

    pictures = [written for _, written in convert(asked.dataset, asked.output, pictures=asked.pictures)]
    print(f"{len(pictures)} garages, {sum(pictures)} pictures")


def _train(asked: argparse.Namespace) -> None:
    photographs = read_strips(asked.folder)
    if not asked.drawn:
        _report([_taught_by_photographs(photographs, [], asked)], asked)
    else:
        names = " and ".join(folder.name for folder in asked.drawn)
        _report([_taught_by_drawn(names, asked.drawn, photographs, asked)], asked)


def _slots(asked: argparse.Namespace) -> None:
    """Train to find slots and free ground, and write tables and pictures of hits and misses."""
    from slot_teaching import teach_slots  # noqa: PLC0415 - only training needs what networks do

    photographs, learnt, aside = read_strips(asked.folder), [], []
    for folder in asked.drawn:
        garages = read_labelled(folder)
        kept = len(garages) - max(1, len(garages) // ASIDE_SHARE)
        if not kept:
            raise ConfigError("drawn", str(folder), "two garages at least, as the last is not learnt from")
        learnt += [strip for garage in garages[:kept] for strip in garage]
        aside += [strip for garage in garages[kept:] for strip in garage]
    name = " and ".join(folder.name for folder in asked.drawn).replace("_", " ")
    teach_slots(name, learnt, aside, photographs, runs=asked.runs, steps=asked.steps, output=asked.output)


def _all(asked: argparse.Namespace) -> None:
    photographs = read_strips(asked.folder)
    outcomes: list[Outcome] = []
    aside: list[Strip] = []
    for name, recipe in RECIPES.items():
        folder = asked.output / name.replace(" ", "_")
        try:
            _drawn(recipe, folder, asked)
        except ConfigError as error:
            print(f"{name} left out: {error}", flush=True)  # of a version without them
            continue
        outcomes.append(_taught_by_drawn(name, [folder], photographs, asked))
        _report(outcomes, asked)
        aside += _learnt_and_aside([folder])[1]
    _report([*outcomes, _taught_by_photographs(photographs, aside, asked)], asked)


def _outside(asked: argparse.Namespace) -> None:
    """Write what the outside detector finds in photographs of each garage and in each folder of drawn ones."""
    from detections_sheet import write_sheet  # noqa: PLC0415
    from outside_detector import read_detector  # noqa: PLC0415 - only this needs its network

    def progress(step: str, done: int, total: int) -> None:
        print(f"{step}: {done} of {total} pictures", file=sys.stderr)

    detector, sets = read_detector(asked.weights), _outside_sets(asked)
    strips = list(dict.fromkeys(strip for some in sets.values() for strip in some))
    found = dict(zip(strips, detector.detect(strips, progress), strict=True))
    at = " | ".join(f"recall, precision at {threshold}" for threshold in THRESHOLDS)
    rows = [f"| corners in | pictures | corners | AP | {at} |", "|---|" + "---|" * (3 + len(THRESHOLDS))]
    asked.output.mkdir(parents=True, exist_ok=True)
    for name, some in sets.items():
        results = [matched(found[strip], strip.corners_px, strip.is_occluded) for strip in some]
        corners = sum(result.true for result in results)
        cells = [name, f"{len(some):,}", f"{corners:,}", f"{score(results).average_precision:.3f}"]
        cells += ["{:.3f}, {:.3f}".format(*at_threshold(results, threshold)) for threshold in THRESHOLDS]
        rows.append(f"| {' | '.join(cells)} |")
        sheet = f"outside_{name.replace(',', '').replace(' ', '_')}.png"
        write_sheet(some, [found[strip] for strip in some], THRESHOLDS[1], asked.output / sheet)
    text = "\n".join(rows)
    (asked.output / "outside.md").write_text(f"{text}\n", encoding="utf-8")
    print(text, flush=True)


def _outside_sets(asked: argparse.Namespace) -> dict[str, list[Strip]]:
    """Strips by what tables call them: of each real garage, of each folder, and of each kind of drawn lines."""
    from drawn_lines import lines  # noqa: PLC0415

    from garage2usd.datasets import load_recipe  # noqa: PLC0415 - only this and drawing need what data sets do

    recipe = load_recipe(asked.recipe) if asked.recipe else None
    sets: dict[str, list[Strip]] = {}
    for strip in read_strips(asked.folder):
        sets.setdefault(f"photographs of {strip.garage}", []).append(strip)
    for folder in asked.drawn:
        for garage in drawn_garages(folder):
            strips = read_strips(garage)
            for kind in ["", f", {lines(recipe, garage)}"] if recipe else [""]:
                sets.setdefault(f"drawn in {folder.name}{kind}", []).extend(strips)
    return sets


def _taught_by_photographs(photographs: list[Strip], aside: list[Strip], asked: argparse.Namespace) -> "Outcome":
    from teachers import photographs_of_others  # noqa: PLC0415 - only training needs what networks do

    return _outcome(photographs_of_others(photographs), photographs, aside, asked)


def _taught_by_drawn(
    name: str, folders: Sequence[Path], photographs: list[Strip], asked: argparse.Namespace
) -> "Outcome":
    from teachers import Teacher  # noqa: PLC0415 - only training needs what networks do

    learnt, aside = _learnt_and_aside(folders)
    everything = frozenset(strip.garage for strip in photographs)
    return _outcome(Teacher(name, [(learnt, everything)]), photographs, aside, asked)


def _learnt_and_aside(folders: Sequence[Path]) -> tuple[list[Strip], list[Strip]]:
    """The strips of drawn garages that are learnt from, and those of the last garages of each folder, which are not."""
    learnt: list[Strip] = []
    aside: list[Strip] = []
    for folder in folders:
        garages = read_drawn(folder)
        kept = len(garages) - ASIDE if len(garages) > LEAST_WITH_ASIDE else len(garages)
        learnt += [strip for garage in garages[:kept] for strip in garage]
        aside += [strip for garage in garages[kept:] for strip in garage]
    return learnt, aside


def _outcome(teacher: "Teacher", photographs: list[Strip], aside: list[Strip], asked: argparse.Namespace) -> "Outcome":
    """Train and test, and draw what is found in photographs and in drawn strips that nothing was learnt from."""
    from detections_sheet import write_sheet  # noqa: PLC0415
    from teachers import TOGETHER, Training, measured  # noqa: PLC0415 - only training needs what networks do

    def tell(outcome: "Outcome") -> None:
        said = ", ".join(f"{garage} {scores[-1].average_precision:.3f}" for garage, scores in outcome.scores.items())
        best, run = outcome.scores[TOGETHER][-1].best_f1, len(outcome.scores[TOGETHER])
        print(f"{teacher.name}, run {run}: AP {said}; best F1 {best:.3f}; {time.monotonic() - start:.0f} s", flush=True)

    def progress(step: str, done: int, total: int) -> None:
        print(f"{step} on {teacher.name}: {done} of {total} steps, {time.monotonic() - start:.0f} s", file=sys.stderr)

    start = time.monotonic()
    asked.output.mkdir(parents=True, exist_ok=True)
    training = Training(steps=asked.steps)
    outcome = measured(teacher, photographs, runs=asked.runs, training=training, progress=progress, tell=tell)
    threshold = outcome.scores[TOGETHER][-1].threshold
    stem = teacher.name.replace(" ", "_")
    found = [outcome.found[strip.name] for strip in photographs]
    write_sheet(photographs, found, threshold, asked.output / f"{stem}_in_photographs.png")
    if aside:
        write_sheet(aside, outcome.networks[0].detect(aside), threshold, asked.output / f"{stem}_in_drawn.png")
    return outcome


def _report(outcomes: Sequence["Outcome"], asked: argparse.Namespace) -> None:
    """Write the table of what is measured so far."""
    from teachers import table  # noqa: PLC0415 - only training needs what networks do

    text = table(outcomes)
    (asked.output / "table.md").write_text(f"{text}\n", encoding="utf-8")
    print(text, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
