"""``python tests/support/esmini_player.py ESMINI [SAMPLE ...]``: esmini plays one parking and one leaving a sample.

Prints how far its car is from the trajectory, and exits with 1 where that is 2 cm or 1 degree or more: esmini holds the
heading from vertex to vertex, 0.05 s, in which a car that turns on a lane turns by 0.8 degrees. ESMINI is its
program, built without graphics (``-DUSE_OSG=False -DUSE_OSI=False -DUSE_SUMO=False -DUSE_GTEST=False``).
"""

import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import garage2usd
from garage2usd.checks.layout_reader import layout_subject
from garage2usd.maps.drives import DrivePlanner, Leg
from garage2usd.maps.openscenario import EGO, write_scenario
from garage2usd.maps.parked_cars import parked_cars

SAMPLES = Path(__file__).parents[2] / "samples"
STEP_S, MOST_M, MOST_DEG = 0.01, 0.02, 1.0
LEVEL_ROAD = """<?xml version="1.0" encoding="UTF-8"?>
<OpenDRIVE><header revMajor="1" revMinor="6" name="level"/>
<road name="level" length="600" id="1" junction="-1"><planView>
<geometry s="0" x="-300" y="0" hdg="0" length="600"><line/></geometry></planView>
<lanes><laneSection s="0"><left><lane id="1" type="driving" level="false">
<width sOffset="0" a="300" b="0" c="0" d="0"/></lane></left>
<center><lane id="0" type="none" level="false"/></center>
<right><lane id="-1" type="driving" level="false"><width sOffset="0" a="300" b="0" c="0" d="0"/></lane></right>
</laneSection></lanes></road></OpenDRIVE>
"""
"""A level road under the whole garage."""


def played(program, scenario, seconds):
    """The rows of the car: time, x, y, z, heading, pitch."""
    log = scenario.with_suffix(".csv")
    command = [program, "--headless", "--osc", scenario, "--csv_logger", log, "--fixed_timestep", str(STEP_S)]
    command += [
        "--traj_filter",
        "0",
    ]  # else it merges vertices within 10 cm, which a car that starts or stops passes slowly
    subprocess.run([str(word) for word in command], cwd=scenario.parent, check=True, capture_output=True, timeout=600)
    rows = list(csv.reader(log.read_text().splitlines()))
    head = next(number for number, row in enumerate(rows) if any("World_Position_X" in cell for cell in row))
    names = [cell.strip() for cell in rows[head]]

    def column(word, after=0):
        return next(at for at, name in enumerate(names) if at >= after and word in name)

    own = next(at for at, name in enumerate(names) if "Entitity_Name" in name or "Entity_Name" in name)
    columns = [
        column("TimeStamp"),
        *(column(f"World_{word}", own) for word in ("Position_X", "Position_Y", "Position_Z")),
    ]
    columns += [column(f"World_{word}_Angle", own) for word in ("Heading", "Pitch")]
    found = np.array([[float(row[at]) for at in columns] for row in rows[head + 1 :] if len(row) > max(columns)])
    assert rows[head + 1][own].strip() == EGO
    return found[found[:, 0] <= seconds]


def main(program, samples):
    faults = 0
    for sample in samples:
        garage = garage2usd.generate(garage2usd.load_config(sample))
        subject = layout_subject(garage.layout, garage.graph, source=str(sample), kind="plan")
        planner = DrivePlanner(subject)
        stalls = [stall.name for stall in garage.layout.stalls if stall.use.takes_cars]
        stall = stalls[len(stalls) // 2]
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "level.xodr").write_text(LEVEL_ROAD)
            for leg in (Leg.IN, Leg.OUT):
                drive = planner.drive(stall, leg=leg)
                scenario = Path(folder) / f"{leg}.xosc"
                write_scenario(
                    scenario,
                    drive.motion.sampled(0.05),
                    car=drive.car,
                    settings=drive.settings,
                    road_file="level.xodr",
                    parked=parked_cars(subject, free=[stall]),
                    name=f"{leg} {stall}",
                )
                rows = played(program, scenario, drive.motion.ends_s)
                states = drive.motion.at(rows[:, 0])
                away = np.hypot(rows[:, 1] - states.x_m, rows[:, 2] + states.z_m)
                turned = rows[:, 4] - states.yaw_rad - math.pi / 2
                askew = np.degrees(np.abs(np.angle(np.exp(1j * turned))))
                high = np.abs(rows[:, 3] - states.y_m)
                end = math.dist(rows[-1, 1:3], (states.x_m[-1], -states.z_m[-1]))
                sys.stdout.write(
                    f"{sample.stem} {stall} {leg}: {len(rows)} steps, at most {away.max():.4f} m and {askew.max():.3f} "
                    f"degrees off, {high.max():.4f} m in height; {end:.4f} m at the end\n"
                )
                faults += bool(away.max() >= MOST_M or askew.max() >= MOST_DEG or high.max() >= MOST_M)
    return faults


if __name__ == "__main__":
    sys.exit(bool(main(sys.argv[1], [Path(name) for name in sys.argv[2:]] or sorted(SAMPLES.glob("*.toml")))))
