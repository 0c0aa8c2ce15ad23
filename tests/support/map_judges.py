"""Programs of others that judge maps, in an environment of their own: ASAM's checker, CARLA, SUMO, Lanelet2."""

import json
import os
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pyproj

JUDGES = Path(os.environ.get("GARAGE2USD_JUDGES", Path(__file__).parents[2] / ".venv/judges"))
CLIENTS = Path(__file__).parents[1] / "clients"


def has(package):
    """Whether the environment has a package, which some Pythons have no build of."""
    return any(JUDGES.glob(f"lib/python*/site-packages/{package}"))


HAS_JUDGES = all((JUDGES / "bin" / name).exists() for name in ("qc_opendrive", "netconvert")) and has("carla")
HAS_LANELET2 = has("lanelet2")


def _run(*command, folder, **environment):
    inherited = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    run = subprocess.run(
        [str(part) for part in command],
        capture_output=True,
        text=True,
        timeout=1800,
        cwd=folder,
        env={**inherited, **environment},
        check=False,
    )
    assert run.returncode == 0, run.stdout[-2000:] + run.stderr[-2000:]
    return run.stdout


def asam_issues(path, folder):
    """What asam-qc-opendrive finds in a map; it runs every checker, those skipped are for older versions."""
    config, result = folder / "config.xml", folder / "result.xqar"
    config.write_text(
        f'<Config><Param name="InputFile" value="{path}"/><CheckerBundle application="xodrBundle">'
        f'<Param name="resultFile" value="{result}"/></CheckerBundle></Config>'
    )
    _run(JUDGES / "bin/qc_opendrive", "-c", config, folder=folder)
    checkers = list(ET.parse(result).getroot().iter("Checker"))
    assert sum(checker.get("status") == "completed" for checker in checkers) >= 22
    assert all(checker.get("status") == "completed" or "1.8.0" in checker.get("summary") for checker in checkers)
    return [
        f"{checker.get('checkerId')}: {issue.get('description')}"
        for checker in checkers
        for issue in checker.iter("Issue")
    ]


def sumo_schema_faults(path, schema, folder):
    """What a schema of SUMO's finds in an XML file."""
    code = (
        "import sys, sumo; from pathlib import Path; from lxml import etree; "
        "schema = etree.XMLSchema(etree.parse(str(Path(sumo.__file__).parent / 'data/xsd' / sys.argv[1]))); "
        "schema.validate(etree.parse(sys.argv[2])); print(schema.error_log)"
    )
    return _run(JUDGES / "bin/python", "-c", code, schema, path, folder=folder).split("\n")[:-1]


def carla_map(path, folder):
    """CARLA's waypoints, every half metre on each lane, and pairs of lanes that follow each other.

    Its frame has y downwards, which is the stage's (x, z).
    """
    output = folder / "carla.json"
    _run(JUDGES / "bin/python", CLIENTS / "carla_topology.py", path, output, folder=folder)
    found = json.loads(output.read_text())
    ways = [(tuple(before), tuple(after)) for before, after in found["topology"]]
    return np.array(found["waypoints"], dtype=float), ways


def sumo_spaces(path, folder):
    """Corners (x, z) of each parking space of SUMO's network, by its number, from its degrees back to metres."""
    net, polygons = folder / "sumo.net.xml", folder / "sumo.poly.xml"
    home = _sumo_home(folder)
    options = ["--precision", 6, "--precision.geo", 13, "--opendrive.import-all-lanes"]
    command = ["--opendrive-files", path, "-o", net, "--polygon-output", polygons, *options]
    _run(JUDGES / "bin/netconvert", *command, folder=folder, SUMO_HOME=home)
    location = ET.parse(net).getroot().find("location")
    to_metres = pyproj.Transformer.from_crs("EPSG:4326", location.get("projParameter"), always_xy=True)
    spaces = {}
    for polygon in ET.parse(polygons).getroot().iter("poly"):
        if polygon.get("type") == "parkingSpace":
            # with a height where the map has any
            degrees = np.array([place.split(",")[:2] for place in polygon.get("shape").split()], dtype=float)
            x, y = to_metres.transform(*degrees.T)
            spaces[int(polygon.get("id"))] = np.stack([x, -np.asarray(y)], axis=1)[:4]
    return spaces


def _sumo_home(folder):
    return _run(JUDGES / "bin/python", "-c", "import sumo; print(sumo.SUMO_HOME)", folder=folder).strip()


def sumo_network(configuration, folder):
    """Let netconvert make the network that its configuration tells of."""
    _run(JUDGES / "bin/netconvert", "-c", configuration, folder=folder, SUMO_HOME=_sumo_home(folder))
    return configuration.with_suffix(".net.xml")


def sumo_parked(network, areas, routes, folder, *, expected, seconds=36000):
    """Where vehicles stand that SUMO parks, and what it says; see `tests/clients/sumo_parking.py`."""
    output = folder / "parked.json"
    script = [JUDGES / "bin/python", CLIENTS / "sumo_parking.py", JUDGES / "bin/sumo"]
    _run(*script, network, areas, routes, expected, seconds, output, folder=folder, SUMO_HOME=_sumo_home(folder))
    return json.loads(output.read_text())


def run_sumo(network, routes, folder, *options):
    """What SUMO says to a network and vehicles that it may refuse, and whether it does."""
    command = [JUDGES / "bin/sumo", "-n", network, "-r", routes, "--no-step-log", "--duration-log.disable", *options]
    environment = {**os.environ, "SUMO_HOME": _sumo_home(folder)}
    command = [str(part) for part in command]
    run = subprocess.run(command, capture_output=True, text=True, timeout=600, env=environment, check=False)
    return run.stderr, run.returncode != 0


def run_sumo_tool(tool, *arguments, folder):
    """Run a program of SUMO's tools, for which SUMO without a window is that with one."""
    home = _sumo_home(folder)
    binaries = {"GUISIM_BINARY": str(JUDGES / "bin/sumo"), "SUMO_HOME": home}
    return _run(JUDGES / "bin/python", Path(home) / "tools" / tool, *arguments, folder=folder, **binaries)


def run_python(text, folder):
    """What a program in Python prints that imports the judges."""
    return _run(JUDGES / "bin/python", "-c", text, folder=folder)


def lanelet2_map(path, folder, latitude_deg, longitude_deg):
    """What Lanelet2 reads in a map, in metres around a place on the earth; see `tests/clients/lanelet2_dump.py`."""
    output = folder / "lanelet2.json"
    script = CLIENTS / "lanelet2_dump.py"
    _run(JUDGES / "bin/python", script, path, latitude_deg, longitude_deg, output, folder=folder)
    return json.loads(output.read_text())
