"""Many garages, drawn by their seeds and judged: a log with a line each, so that a run goes on."""

import argparse
import json
import tempfile
import time
import traceback
from concurrent.futures import ProcessPoolExecutor, as_completed
from functools import partial
from pathlib import Path


def said_of(judge):
    """The complaints that a judge returns, or, of one that asserts, the assertion that failed."""
    try:
        return [str(complaint) for complaint in judge() or ()]
    except AssertionError as error:
        frame = traceback.extract_tb(error.__traceback__)[-1]
        return [f"{frame.name}: {frame.line} {error}"[:500]]


def judged(judges_of, seed):
    """What is said of one garage: facts, complaints by judge, and the seconds of each judge and of all.

    `judges_of`, called with a seed and an empty folder, returns the facts, for JSON, and a mapping of names to judges:
    callables without arguments which return complaints, or assert.
    """
    start, found = time.perf_counter(), {"seed": seed, "complaints": {}, "judge_seconds": {}}
    with tempfile.TemporaryDirectory() as folder:
        try:
            facts, judges = judges_of(seed, Path(folder))
            found |= facts
            for name, judge in judges.items():
                begun = time.perf_counter()
                found["complaints"][name] = said_of(judge)
                found["judge_seconds"][name] = round(time.perf_counter() - begun, 1)
        except Exception as error:  # noqa: BLE001 - a garage that fails is a line of the log, not the end of the run
            found["complaints"]["failure"] = [f"{type(error).__name__}: {error}"[:500]]
    return {**found, "seconds": round(time.perf_counter() - start, 1)}


def main(judges_of, description):
    """The command line of a batch; 1 if a judge has a complaint, else 0."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=500)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--log", type=Path, required=True)
    asked = parser.parse_args()
    lines = [json.loads(line) for line in asked.log.read_text().splitlines()] if asked.log.exists() else []
    done = {line["seed"] for line in lines}
    with ProcessPoolExecutor(asked.workers) as pool, asked.log.open("a") as log:
        runs = [pool.submit(partial(judged, judges_of), seed) for seed in range(asked.seeds) if seed not in done]
        for run in as_completed(runs):
            lines.append(run.result())
            log.write(json.dumps(lines[-1]) + "\n")
            log.flush()
    bad = [line for line in lines if any(line["complaints"].values())]
    for line in bad:
        print(line["seed"], {name: said[:3] for name, said in line["complaints"].items() if said})
    print(
        f"{len(lines)} garages with {sum(line.get('stalls', 0) for line in lines)} stalls, {len(bad)} with a complaint"
    )
    return int(bool(bad))
