"""The pictures of a garage that a build writes: the plan of each level, its learning curve and its best plans."""

from PIL import Image

from garage2usd.common.errors import ConfigError
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.view.drawing import to_image
from garage2usd.view.plan_picture import draw_plan
from garage2usd.view.thumbnails import draw_learning_curve, draw_structures


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
