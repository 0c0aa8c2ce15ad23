"""Draw a car of ``garage2usd/Parking-v0`` on its way by the planner's actions, from above.

Usage: python docs/pictures/parking_picture.py PICTURE [--seed 0] [--share 0.7]
"""

import argparse
from pathlib import Path

import gymnasium
from PIL import Image

from garage2usd.config import GarageConfig
from garage2usd.environment.reference import reference_actions


def main() -> None:
    """Drive a share of the actions and save what the environment draws."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--share", type=float, default=0.7)
    options = parser.parse_args()
    name = "garage2usd.environment:garage2usd/Parking-v0"
    environment = gymnasium.make(name, source=GarageConfig(seed=7), render_mode="rgb_array")
    environment.reset(seed=options.seed)
    actions = list(reference_actions(environment.unwrapped.task))  # type: ignore[attr-defined]
    for action in actions[: round(options.share * len(actions))]:
        environment.step(action)
    Image.fromarray(environment.render()).save(options.picture)  # type: ignore[arg-type]


if __name__ == "__main__":
    main()
