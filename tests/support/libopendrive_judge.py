"""``PYTHONPATH=tests python -m support.libopendrive_judge PROGRAM [SAMPLE ...]``: maps as libOpenDRIVE has them.

Builds and exports every sample, or those that are named, and prints how far corners of parking spaces are from the
stage's stalls of the same names, and what is wrong with the places, widths, heights, directions and ways of lanes.
Exits with 1 where anything is, corners by 1 mm or more. PROGRAM is made of ``libopendrive_dump.cpp``, which says how.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import garage2usd
from support.opendrive_judge import ACCESS, NEAR_M, MapJudge
from support.sample_files import SAMPLES


def dumped(program, path):
    """Rows of lanes as `MapJudge` takes them, pairs of lanes that follow each other, and corners (x, z) by name."""
    run = subprocess.run([str(program), str(path)], capture_output=True, text=True, check=True, timeout=600)
    points, ways, spaces = [], [], {}
    for kind, *words in map(str.split, run.stdout.splitlines()):
        if kind == "lane":
            road, lane, x, y, height, heading, width = map(float, words)
            points.append((road, lane, x, -y, height, -np.degrees(heading), width))
        elif kind == "way":
            numbers = tuple(map(int, words))
            ways.append((numbers[:2], numbers[2:]))
        else:
            name, *numbers = words
            assert name not in spaces, f"{name} is there twice"
            spaces[name] = np.array(numbers, dtype=float).reshape(-1, 3)[:, :2] * (1, -1)
    return np.array(points), ways, spaces


def complaints(program, judge):
    """What is wrong with a map, and the most that a corner is off."""
    points, ways, spaces = dumped(program, judge.path)
    found = list(judge.of_lanes(points, ways))
    stalls = {name: stall["corners"] for name, stall in judge.lanes.stalls.items() if stall["use"] in ACCESS}
    if spaces.keys() != stalls.keys():
        found.append(f"{sorted(spaces.keys() ^ stalls.keys())} are in one of stage and map only")
    # by name and corner by corner, in the stage's order
    off = {name: np.abs(spaces[name] - stalls[name]).max() for name in spaces.keys() & stalls.keys()}
    found += [f"{name} is {value:.4f} m off" for name, value in off.items() if not value < NEAR_M]
    return found, max(off.values()), (len(points), len(ways), len(spaces))


def main(program, samples):
    faults = 0
    for sample in samples:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            made = garage2usd.build(garage2usd.load_config(sample), folder / f"{sample.stem}.usdc")
            (path,) = garage2usd.export(made.stage, [folder / f"{sample.stem}.xodr"])
            found, off, (places, ways, spaces) = complaints(program, MapJudge(made.stage, path, folder))
        sys.stdout.write(
            f"{sample.stem}: {spaces} spaces, corners at most {off * 1e6:.2f} um off; {places} places on lanes, {ways} "
            f"ways between them: {len(found)} complaints\n"
        )
        sys.stdout.writelines(f"    {complaint}\n" for complaint in found)
        sys.stdout.flush()
        faults += len(found)
    return faults


if __name__ == "__main__":
    sys.exit(bool(main(sys.argv[1], [Path(name) for name in sys.argv[2:]] or SAMPLES)))
