"""Files of a garage: its stage, labels, report and pictures, and the report read again.

A garage of one level and one of several have other forms of these files. They are chosen here alone.
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

from PIL import Image

from garage2usd.common.errors import ConfigError
from garage2usd.common.version import VERSION
from garage2usd.config import GarageConfig
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.layout.shell.well import SLAB_M
from garage2usd.reading.levels_report import LevelReport, LevelsReport, ReportedLink, read_levels_report
from garage2usd.reading.report import LearningFigures, Report, UnmetClause, read_report
from garage2usd.report import area_figures, make_report
from garage2usd.view.learning_picture import draw_learning_curve, draw_structures
from garage2usd.view.plan_picture import draw_plan
from garage2usd.view.raster import to_image

__all__ = [
    "Reported",
    "draw_pictures",
    "make_garage_report",
    "read_garage_report",
    "reported_links",
]


def draw_pictures(
    garage: Garage, *, learning_curve: bool = False, best_plans: int = 0, joint: str = "_"
) -> dict[str, Image.Image]:
    """Draw the plans of a garage, and the learning curve and the best plans of each level where they are asked for.

    Parameters
    ----------
    garage
        The garage.
    learning_curve, best_plans
        As for `garage2usd.build`.
    joint
        Stands between the name of a level and that of its picture.

    Returns
    -------
    dict
        The pictures by name: ``plan``, ``learning`` and ``best``; among several levels ``U1_plan`` and so on.

    Raises
    ------
    ConfigError
        If pictures of learning are asked for without learning.
    """
    for field, asked in (("learning_curve", learning_curve), ("best_plans", best_plans)):
        if asked and not all(level.plan.archive for level in garage.levels):
            raise ConfigError(field, asked, "only where lanes are learnt, not with a tape or lanes that are given")
    return {
        level.place.in_whole(name, joint=joint): picture
        for level in garage.levels
        for name, picture in _pictures(level, learning_curve=learning_curve, best_plans=best_plans).items()
    }


def _pictures(level: GarageLevel, *, learning_curve: bool, best_plans: int) -> dict[str, Image.Image]:
    pictures = {"plan": to_image(draw_plan(level.layout))}
    if learning_curve:
        pictures["learning"] = draw_learning_curve(level.plan.learning_curve)
    if best_plans:
        pictures["best"] = draw_structures(
            [
                (entry.structure, f"{entry.score.value:.2f} {'polished' if entry.is_polished else 'learnt'}")
                for entry in level.plan.archive[:best_plans]
            ]
        )
    return pictures


def make_garage_report(
    garage: Garage,
    *,
    seconds: Mapping[str, float],
    unmet: Sequence[Sequence[UnmetClause]] | None = None,
    learning: LearningFigures | None = None,
) -> Report | LevelsReport:
    """Make the report of a garage; it is reproducible, except for ``seconds``.

    Parameters
    ----------
    garage
        The garage.
    seconds
        Duration of each step.
    unmet
        Clauses of the profile that the design of each level violates; None if unknown.
    learning
        Results of learning, for the plan of a single level without its archive.
    """

    def of_level(number: int, seconds: Mapping[str, float]) -> Report:
        level, clauses = garage.levels[number], None if unmet is None else unmet[number]
        return make_report(
            config=level.config,
            plan=level.plan,
            layout=level.layout,
            seconds=seconds,
            learning=learning,
            unmet=clauses,
        )

    if garage.building.ramps is None:
        return of_level(0, seconds)
    return LevelsReport(
        version=VERSION,
        seed=garage.config.seed,
        config_digest=garage.config.digest(),
        config=garage.config,
        tape=garage.tape,
        parking_stalls=garage.parking_stalls,
        **area_figures([level.layout for level in garage.levels]),
        remarks=garage.config.remarks(),
        links=reported_links(garage),
        levels=tuple(
            LevelReport(name=level.name, floor_m=level.floor_m, report=of_level(number, {}))
            for number, level in enumerate(garage.levels)
        ),
        seconds={step: round(value, 4) for step, value in seconds.items()},
    )


def reported_links(garage: Garage) -> tuple[ReportedLink, ...]:
    """Return the records of the ramps between levels; none of a single level."""
    building = garage.building
    clear_m = min(garage.config.fittings.ceiling_height_m, building.storey_m - SLAB_M)
    links = []
    for upper, lower in pairwise(garage.levels):
        layout = lower.layout
        lanes = layout.well.lanes(layout.structure) if layout.well else ()
        links += [
            ReportedLink(
                kind=link.kind,
                upper=upper.name,
                lower=lower.name,
                direction="down" if link.is_down else "up",
                squares=link.squares,
                head=link.head,
                foot=link.foot,
                rise_m=building.storey_m,
                run_m=round(lane.run_m, 6),
                steepest_percent=round(100 * lane.slope, 3),
                clear_width_m=lane.width_m,
                clear_height_m=round(clear_m, 6),
            )
            for link, lane in zip(building.links, lanes, strict=True)
        ]
    return tuple(links)


class Reported(NamedTuple):
    """The settings and the tape by which `garage2usd.generate` makes a reported garage again.

    Attributes
    ----------
    config
        The settings; those of a single level have its lanes.
    tape
        The tape of several levels; None of one.
    levels
        The reports of several levels; empty of one.
    """

    config: GarageConfig
    tape: str | None = None
    levels: tuple[LevelReport, ...] = ()


def read_garage_report(path: Path) -> Reported:
    """Read how the garage of a report is made again.

    Raises
    ------
    ConfigError
        If the file cannot be read, or this version does not allow a setting in it.
    ReportError
        If the file is not a report.
    """
    several = read_levels_report(path)
    if several is None:
        return Reported(read_report(path).garage_config())
    return Reported(several.config.with_seed(several.seed), several.tape, several.levels)
