"""Run by a test with the Python of SUMO: play vehicles, and write down where those that park stand."""

import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["SUMO_HOME"]) / "tools"))
import traci


def main(program, network, areas, routes, expected, seconds, output):
    command = [program, "-n", network, "-a", areas, "-r", routes, "--no-step-log", "--duration-log.disable"]
    log = Path(output).with_suffix(".log")
    traci.start([*command, "--error-log", str(log)])
    parked = {}
    try:
        while traci.simulation.getMinExpectedNumber() and traci.simulation.getTime() < float(seconds):
            traci.simulationStep()
            for vehicle in traci.simulation.getParkingStartingVehiclesIDList():
                (stop,) = traci.vehicle.getStops(vehicle, 1)
                parked[vehicle] = {
                    "area": stop.stoppingPlaceID,
                    "at_m": traci.vehicle.getLanePosition(vehicle),
                    "front": traci.vehicle.getPosition3D(vehicle),
                    "angle_deg": traci.vehicle.getAngle(vehicle),
                }
            if len(parked) == int(expected):
                break
    finally:
        traci.close()
    Path(output).write_text(json.dumps({"parked": parked, "said": log.read_text() if log.exists() else ""}))


main(*sys.argv[1:])
