"""``PYTHONPATH=tests python -m support.esmini_player ESMINI [SAMPLE ...]``: esmini parks in each sample and leaves.

Builds every sample, or those that are named, exports the scenarios with the maps that they name, and prints how far
esmini's car is from the proven path and what it touches of the stage on its way. Exits with 1 where that is 2 cm or 1
degree or more, or anything: esmini holds the heading from vertex to vertex, 0.05 s, in which a car that turns on a lane
turns by 0.8 degrees. ESMINI is its program, built without graphics, as docs/guides/esmini.md says.
"""

import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import garage2usd
from garage2usd.config.outputs import Leg, ScenarioConfig
from garage2usd.garage_sources import read_built
from garage2usd.maps.drives import DrivePlanner
from garage2usd.maps.openscenario import EGO
from support.sample_files import SAMPLES
from support.trajectory_judge import OpenWorld

ESMINI = os.environ.get("GARAGE2USD_ESMINI")
"""The program for tests, which has to be compiled; None where there is none."""
STEP_S, MOST_M, MOST_DEG = 0.03, 0.02, 1.0
LOOK = 2
"""Steps from one pose to the next between which the ground that the car sweeps is looked at."""


def played(program, scenario, seconds):
    """The rows of the car, time, x, y, z, heading, pitch; and what esmini says of collisions with parked cars."""
    log = scenario.with_suffix(".csv")
    command = [program, "--headless", "--osc", scenario, "--csv_logger", log, "--fixed_timestep", STEP_S, "--collision"]
    # else it merges vertices within 10 cm, which a car that starts or stops passes slowly
    command += ["--traj_filter", 0]
    run = subprocess.run(
        [str(word) for word in command], cwd=scenario.parent, check=True, capture_output=True, text=True, timeout=1800
    )
    collisions = [line for line in run.stdout.splitlines() if "Collision between" in line]
    with log.open() as lines:
        names = next([cell.strip() for cell in line.split(",")] for line in lines if "World_Position_X" in line)
        # the first vehicle's; a row holds hundreds
        own = names.index("#1 Entity_Name [-]")
        wanted = ("Position_X", "Position_Y", "Position_Z", "Heading_Angle", "Pitch_Angle")
        columns = [names.index("TimeStamp [s]")]
        columns += [next(at for at in range(own, len(names)) if f"World_{word}" in names[at]) for word in wanted]
        cells = [line.split(",", max(columns) + 1) for line in lines]
    assert cells[0][own].strip() == EGO
    found = np.array([[float(row[at]) for at in columns] for row in cells if len(row) > max(columns)])
    return found[found[:, 0] <= seconds], collisions


def agents_played(program, scenario, names, folder, step_s=0.05):
    """The rows of each agent, time, x, y, z, heading, pitch, shape (n, 6), by its name."""
    log = folder / "agents.csv"
    command = [program, "--headless", "--osc", scenario, "--csv_logger", log, "--fixed_timestep", step_s]
    command += ["--traj_filter", 0]
    subprocess.run(
        [str(word) for word in command], cwd=folder, check=True, capture_output=True, text=True, timeout=1800
    )
    rows = {}
    with log.open() as lines:
        header = next([cell.strip() for cell in line.split(",")] for line in lines if "World_Position_X" in line)
        first = header.index("#1 Entity_Name [-]")
        wanted = ("Position_X", "Position_Y", "Position_Z", "Heading_Angle", "Pitch_Angle")
        offsets = [next(at for at in range(first, len(header)) if f"World_{word}" in header[at]) for word in wanted]
        for line in lines:
            cells = [cell.strip() for cell in line.split(",")]
            # a row has those alone that are there
            for at in range(first, len(cells)):
                if cells[at] in names:
                    row = [cells[1], *(cells[at + offset - first] for offset in offsets)]
                    rows.setdefault(cells[at], []).append([float(cell) for cell in row])
    return {name: np.array(own) for name, own in rows.items()}


def main(program, samples):
    faults = 0
    for sample in samples:
        with tempfile.TemporaryDirectory() as name:
            faults += sum(played_amiss(program, sample, Path(name)))
    return faults


def played_amiss(program, sample, folder):
    """For each leg whether esmini plays it otherwise than it was planned."""
    made = garage2usd.build(garage2usd.load_config(sample), folder / f"{sample.stem}.usdc")
    subject, settings = read_built(made.stage).garage, made.garage.config.maps
    planner, world = DrivePlanner(subject, settings.drive), OpenWorld(made.garage)
    stalls = [stall for stall in made.garage.layout.stalls if stall.use.takes_cars]
    stall = stalls[len(stalls) // 2]
    # where another car may stand, which the scenario does not have
    free = {other.name for other in stalls} - {car.stall for car in made.garage.layout.of_kind("car")}
    for leg in (Leg.IN, Leg.OUT):
        asked = ScenarioConfig(stall=stall.name, leg=leg)
        scenario, road = garage2usd.export(made.stage, [folder / f"{leg}.xosc"], settings=settings, scenario=asked)
        drive = planner.drive(stall.name, leg=leg)
        rows, collisions = played(program, scenario, drive.motion.ends_s)
        states = drive.motion.at(rows[:, 0])
        away = np.hypot(rows[:, 1] - states.x_m, rows[:, 2] + states.z_m)
        yaw = rows[:, 4] - math.pi / 2
        askew = np.degrees(np.abs(np.angle(np.exp(1j * (yaw - states.yaw_rad)))))
        high = np.abs(rows[:, 3] - states.y_m)
        end = math.dist(rows[-1, 1:3], (states.x_m[-1], -states.z_m[-1]))
        track = {"x_m": rows[::LOOK, 1], "z_m": -rows[::LOOK, 2], "yaw_rad": yaw[::LOOK]}
        touched = world.swept(track, stall) - (set() if drive.route.is_full else free)
        sys.stdout.write(
            f"{sample.stem} {stall.name} {leg} on {road.name}: {len(rows)} steps, at most {away.max():.6f} m and "
            f"{askew.max():.3f} degrees off, {high.max():.6f} m in height; {end:.6f} m at the end; touches "
            f"{', '.join(sorted(touched) + collisions) or 'nothing'}\n"
        )
        sys.stdout.flush()
        is_off = away.max() >= MOST_M or askew.max() >= MOST_DEG or high.max() >= MOST_M
        yield is_off or bool(touched) or bool(collisions)


if __name__ == "__main__":
    sys.exit(bool(main(sys.argv[1], [Path(name) for name in sys.argv[2:]] or SAMPLES)))
