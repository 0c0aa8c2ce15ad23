"""What a run of traffic takes, and each form of its tracks.

Usage: python benchmarks/traffic.py   (this part alone, to the standard output)
"""

import resource
import statistics
import sys
import tempfile
import time
import xml.etree.ElementTree as ET
import zipfile
from pathlib import Path

import garage2usd
from garage2usd.config import TrafficConfig
from garage2usd.driving.tracks import Tracks
from garage2usd.garage_sources import read_built
from garage2usd.track_forms import TRACK_SUFFIXES, write_tracks
from garage2usd.traffic import Operation

HERE = Path(__file__).parent
sys.path.append(str(HERE.parent / "tests"))

from support.map_judges import HAS_JUDGES, run_sumo, sumo_network  # noqa: E402

__all__ = ["traffic"]

SAMPLE = "paper_7x9"
SETTINGS = TrafficConfig(minutes=25, arrivals_per_hour=96)
SEEDS = 2
FORMS = {
    ".parquet": "Parquet table",
    ".csv": "CSV table, and JSON",
    ".usdc": "USD layer",
    ".usda": "USD layer as text",
    ".xosc": "OpenSCENARIO, without its map",
    ".fcd.xml": "floating car data, and types",
    ".mcap": "OSI trace",
    ".pkl": "ScenarioNet's dictionary",
}


def traffic() -> str:
    """Two tables: seconds of a run beside SUMO's, and seconds and bytes of each form."""
    config = garage2usd.load_config(HERE.parent / "samples" / f"{SAMPLE}.toml")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        stage = garage2usd.build(config, folder / "garage.usdc").stage
        garage = read_built(stage).garage
        operation, runs, seconds = Operation(garage), [], []
        for seed in range(1 + SEEDS):
            start = time.process_time()
            runs.append(operation.run(SETTINGS, seed=seed))
            seconds.append(time.process_time() - start)
        tracks = runs[-1]
        rows = [
            "## Traffic",
            "",
            (
                f"Runs of {SETTINGS.minutes:g} minutes in the sample {SAMPLE} with {SETTINGS.arrivals_per_hour:g} "
                f"arrivals an hour: processor seconds of one core, the garage built. The first run finds the paths, "
                f"which are kept; the next are the mean of {SEEDS} seeds."
            ),
            "",
            "| what | processor seconds |",
            "|---|---|",
            f"| first run | {seconds[0]:.2f} |",
            f"| a run after it | {statistics.mean(seconds[1:]):.2f} |",
            *_sumo(stage, tracks, folder),
            "",
            (
                f"Forms of the last run, {len(tracks)} agents with {sum(map(len, tracks)):,} samples "
                f"({tracks.facts['arrivals']} arrivals, {tracks.facts['departures']} departures, "
                f"{tracks.facts['walks']} walks): processor seconds with what the first of its kind imports, and "
                "megabytes as it is and in a zip file."
            ),
            "",
            "| extension | form | processor seconds | MB | MB in a zip |",
            "|---|---|---|---|---|",
        ]
        assert set(FORMS) == set(TRACK_SUFFIXES)
        for suffix, form in FORMS.items():
            start = time.process_time()
            files = write_tracks(folder / f"run{suffix}", tracks, garage)
            taken = time.process_time() - start
            files = tuple(file for file in files if file.suffix != ".xodr")
            packed = folder / "packed.zip"
            with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
                for file in files:
                    archive.write(file, file.name)
            whole, zipped = sum(file.stat().st_size for file in files) / 1e6, packed.stat().st_size / 1e6
            rows.append(f"| `{suffix}` | {form} | {taken:.2f} | {whole:.2f} | {zipped:.2f} |")
    return "\n".join(rows)


def _sumo(stage: Path, tracks: Tracks, folder: Path) -> list[str]:
    """SUMO's seconds for the arrivals of tracks, each with a stop in the parking area of its stall."""
    if not HAS_JUDGES:
        return []
    areas, configuration, _ = garage2usd.export(stage, [folder / "garage.add.xml"])
    network = sumo_network(configuration, folder)
    area_of = {
        stall: area
        for area in ET.parse(areas).getroot().iter("parkingArea")  # noqa: S314 - our own
        for stall in area.find("param[@key='stalls']").get("value").split()
    }
    root = ET.parse(network).getroot()  # noqa: S314 - of SUMO, from ours
    names = [edge.get("id") for edge in root.iter("edge") if edge.get("function") != "internal"]
    ways = [(one.get("from"), one.get("to")) for one in root.iter("connection")]
    source = next(name for name in names if name not in {after for _, after in ways})
    sink = next(name for name in names if name not in {before for before, _ in ways})
    trips = ET.Element("routes")
    for track in tracks:
        if track.agent.wheelbase_m and not track.agent.prim and track.stall and track.stall[-1][2] in area_of:
            depart = f"{track.time_s[0]:.1f}"
            trip = ET.SubElement(trips, "trip", {"id": track.agent.name, "depart": depart, "from": source, "to": sink})
            first, last, stall = track.stall[-1]
            parked_s = max(float(track.time_s[last - 1] - track.time_s[first]), 1.0)
            area = area_of[stall]
            trip.attrib |= {"parkingBadges": area.get("acceptedBadges")} if area.get("acceptedBadges") else {}
            ET.SubElement(trip, "stop", {"parkingArea": area.get("id"), "duration": f"{parked_s:.0f}"})
    routes = folder / "trips.rou.xml"
    ET.ElementTree(trips).write(routes)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    said, failed = run_sumo(
        network, routes, folder, "-a", areas, "--step-length", f"{tracks.step_s:g}", "--end", f"{tracks.duration_s:g}"
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if failed:
        raise SystemExit(said)
    taken = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    what = f"SUMO 1.28, the {len(trips)} arrivals of the last run alone, in steps of {tracks.step_s:g} s, no people"
    return [f"| {what} | {taken:.2f} |"]


if __name__ == "__main__":
    print(traffic())
