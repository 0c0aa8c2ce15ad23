"""What LiDAR costs: reading a stage's surfaces once, and sweeps of 65,536 rays."""

import statistics
import tempfile
import time
from pathlib import Path

import numpy as np

import garage2usd
from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import read_labels
from garage2usd.reading.lanes import read_lanes
from garage2usd.sensors.rays.lidar import raster_beams, scan, spinning_beams
from garage2usd.sensors.rays.ray_scene import read_ray_scene

__all__ = ["lidar"]

HERE = Path(__file__).parent
SAMPLES = ("paper_7x9", "large_20x30")
ROUNDS = 20
PATTERNS = {
    "64 beams x 1024 steps": spinning_beams(np.linspace(-25, 15, 64), 1024),
    "raster of 256 x 256": raster_beams(120, 60, 256, 256),
}


def lidar() -> str:
    """Seconds to read a stage, for the first sweep, and for each one after that."""
    rows = [
        "## LiDAR",
        "",
        f"Seconds from the roof of a car between lanes; sweeps: median and slowest of {ROUNDS}.",
        "",
        "| sample | triangles | read the open stage | first sweep | pattern | sweep | slowest | points |",
        "|---|---|---|---|---|---|---|---|",
    ]
    with tempfile.TemporaryDirectory() as folder:
        for sample in SAMPLES:
            config = garage2usd.load_config(HERE.parent / "samples" / f"{sample}.toml")
            built = garage2usd.build(config, Path(folder) / f"{sample}.usdc")
            stage = open_stage(built.stage)
            labels = read_labels(stage, built.stage)
            node = next(node.position for node in read_lanes(stage).nodes if not node.is_portal)
            place = np.array([[1.0, 0, 0, node[0]], [0, 0, 1, 1.8], [0, -1, 0, node[1]], [0, 0, 0, 1]])
            start = time.perf_counter()
            scene = read_ray_scene(stage, labels)
            read_s = time.perf_counter() - start
            for name, beams in PATTERNS.items():
                seconds = []
                for _ in range(1 + ROUNDS):
                    start = time.perf_counter()
                    cloud = scan(scene, beams, place, range_m=(0.3, 100.0), range_noise_m=0.02)
                    seconds.append(time.perf_counter() - start)
                first = f"{seconds[0]:.2f} s" if name == next(iter(PATTERNS)) else ""
                later = seconds[1:]
                rows.append(
                    f"| {sample} | {len(scene.triangles):,} | {read_s:.2f} s | {first} | {name} | "
                    f"{statistics.median(later):.3f} s | {max(later):.3f} s | {len(cloud):,} |"
                )
    return "\n".join(rows)
