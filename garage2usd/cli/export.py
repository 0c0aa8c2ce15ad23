"""The command ``garage2usd export``."""

import sys
from pathlib import Path

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.options import INPUT_FILE, drive_options, echo_notices, echo_table, end_incomplete, output_option


@click.command(short_help="Export a stage as a map, a scene or a grid.")
@click.argument("path", type=INPUT_FILE)
@output_option(
    "A file: .add.xml for the stalls as parking areas of SUMO with the map of their network beside it, .autoware for a "
    "folder of maps for Autoware, .carla.zip for a package of CARLA's importer, .dxf for a drawing, .geojson for "
    "GeoJSON, .glb for a scene, .osm for a Lanelet2 map, .osm.xml for OpenStreetMap, .sdf for a world of Gazebo with "
    "its meshes, launch file and occupancy grid beside it, .xodr for an OpenDRIVE map, .xosc for an OpenSCENARIO "
    "scenario with the map it names beside it, .yaml for a robot's occupancy grid with its picture beside it, and the "
    "masks that maps.grid asks for; may be repeated.",
    several=True,
    required=True,
)
@click.option(
    "--config",
    metavar="FILE",
    type=INPUT_FILE,
    help="A configuration (TOML) whose section [maps] holds, in place of the report's or the defaults.",
)
@click.option(
    "--workers",
    metavar="N",
    type=click.IntRange(1, 4096),
    help="How many files are written at a time; one a core.",
)
@drive_options("Of a scenario", "Where the car of a scenario parks, in place of the first free stall")
def export(
    *,
    path: Path,
    outputs: tuple[Path, ...],
    config: Path | None,
    workers: int | None,
    stall: str | None,
    entrance: int | None,
    exit_: int | None,
    leg: str | None,
) -> None:
    """Export a garage for programs without USD support.

    PATH is a stage, whose current content is exported even if other tools have edited it; or the report of a build,
    whose garage is rebuilt. A garage that was moved, turned or partly hidden is exported whole, in its own frame.

    Parts of a stage that a format cannot represent, such as area lights, are reported on standard error and left out.
    If the extra `maps`, `sensors`, `cad` or `blender` is missing, the files that do without it are written and the
    others named; the exit code is 3.

    The car of a scenario drives from an entrance to a stall, parks, and drives to an exit, as with `garage2usd drive
    --stall`. Any option on the drive replaces the whole section maps.scenario of the configuration.

    \b
    Examples:
      garage2usd export garage.usdz -o garage.glb -o garage.xodr
      garage2usd export garage_report.json -o garage.glb -o garage.yaml
      garage2usd export garage.usdz -o garage.carla.zip
      garage2usd export garage.usdz -o garage.xosc --stall A1-08 --leg in
      garage2usd export garage.usdz -o garage.sdf
      garage2usd export garage.usdz -o garage.autoware/
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.common.system import cores  # noqa: PLC0415
    from garage2usd.config import load_config  # noqa: PLC0415 - keeps --help instant
    from garage2usd.config.outputs import ScenarioConfig  # noqa: PLC0415
    from garage2usd.exports import export as export_garage  # noqa: PLC0415
    from garage2usd.exports import without_lacking  # noqa: PLC0415

    settings = load_config(config).maps if config else None
    asked = {"stall": stall, "entrance": entrance, "exit": exit_, "leg": leg}
    given = {name: value for name, value in asked.items() if value is not None}
    written, lacking = without_lacking(outputs)
    is_driven = not any(path.suffix.lower() == ".xosc" for path in {*outputs} - {*written})
    scenario = ScenarioConfig.model_validate(given) if given and is_driven else None
    notices: list[str] = []
    with Bars(sys.stderr) as progress:
        files = export_garage(
            path,
            written,
            settings=settings,
            scenario=scenario,
            progress=progress,
            workers=workers or cores(),
            notice=notices.append,
        )
    echo_notices(notices)
    echo_table(("file", str(file)) for file in files)
    end_incomplete(lacking)
