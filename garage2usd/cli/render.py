"""The command ``garage2usd render``."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.shell_completion import CompletionItem

from garage2usd.cli.bars import Bars
from garage2usd.cli.options import INPUT_FILE, Place, Several, Size, Span, device_option, echo_table, output_option
from garage2usd.common.errors import ConfigError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from garage2usd.recordings import Recorded, Traffic

_PICTURES = ("colour", "depth", "normals", "instance", "semantic", "semantic_preview")
_POINTS = ("pcd", "bin", "npz")
_SEQUENCES = ("nuscenes", "ros2")
_SLOT_FORMATS = ("json", "coco", "panoptic", "dmpr-ps")


def _rigs(_ctx: click.Context, _param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete the name of a shipped sensor rig, or else a file name."""
    from garage2usd.sensors.rig.rig import RIG_NAMES  # noqa: PLC0415 - keeps --help instant

    names = [CompletionItem(name) for name in RIG_NAMES if name.startswith(incomplete)]
    return names or [CompletionItem(incomplete, type="file")]


@click.command(short_help="Render a stage's cameras with ground truth, by Blender.")
@click.argument("stage", metavar="PATH", type=INPUT_FILE)
@click.option(
    "--camera",
    "cameras",
    metavar="NAME|PRIM",
    multiple=True,
    help="A camera; may be repeated.  [default: all that stand still]",
)
@click.option(
    "--frames",
    metavar="FRAMES",
    help="Frames of cameras that move: 0, 0:96, 0:960x24, several with commas.  [default: every 48th]",
)
@click.option("--at", "at_m", type=Place(), help="A camera of its own at this place of the stage, in metres.")
@click.option("--look-at", "look_at_m", type=Place(), help="With --at: the place in the middle of its picture.")
@click.option("--size", type=Size(), help="Width and height in pixels of a stage's cameras.  [default: 1280x720]")
@click.option(
    "--samples",
    metavar="N",
    type=click.IntRange(1, 65536),
    help="Samples of each pixel of the colour.  [default: 2 to 64, as many as two cores draw in two minutes]",
)
@click.option(
    "--seed",
    metavar="N",
    type=click.IntRange(0, 2**31 - 1),
    default=0,
    show_default=True,
    help="Seed of the samples, not of the garage.",
)
@device_option("What draws: auto is a GPU where Blender finds one; rays is quicker and coarser, without Blender.")
@click.option(
    "--blender",
    metavar="PROGRAM",
    type=click.Path(path_type=Path),
    help="An installed Blender 5.0 or later that draws.  [default: the Python module bpy, else one that is found]",
)
@click.option(
    "--only",
    "pictures",
    type=Several("KIND,...", _PICTURES),
    help=f"Some of {', '.join(_PICTURES)}.  [default: all]",
)
@click.option(
    "--slots",
    type=Several("FORMAT,...", _SLOT_FORMATS),
    help=f"Tell the slots of each frame: slots.json, and some of {', '.join(_SLOT_FORMATS[1:])}.",
)
@click.option(
    "--rig",
    metavar="NAME|FILE",
    shell_complete=_rigs,
    help="Record with the sensors of a rig: avp_around_view, avp_surround, column_camera, lidar_32, woodscape_like or "
    "a TOML file.",
)
@click.option(
    "--along",
    metavar="ENTRANCE:STALL|CAMERA",
    help="With --rig: the proven way from an entrance (1, 2 ...; left out, the nearest) to a stall, as 1:A1-08 "
    "or 1:U2/A1-08, or a camera that moves. A rig in the world needs none.",
)
@click.option(
    "--every-m", metavar="M", type=click.FloatRange(0.01), help="With --rig: metres between two places.  [default: 1]"
)
@click.option(
    "--tracks",
    metavar="FILE",
    type=INPUT_FILE,
    help="With --rig: traffic, as `garage2usd traffic` writes it (.parquet, .csv): agents stand where they are at the "
    "time of each picture, and move while a LiDAR turns.",
)
@click.option(
    "--ego",
    metavar="CAR|avp",
    help="With --tracks: the car of the tracks that carries the rig, or avp for a car of its own that drives to a free "
    "stall (or that of --along) and back. A rig in the world needs none.",
)
@click.option(
    "--every-s", metavar="S", type=click.FloatRange(0.01), help="With --tracks: seconds between poses.  [default: 0.5]"
)
@click.option(
    "--between",
    metavar="S:S",
    type=Span(),
    help="With --tracks: first and last second that is recorded.  [default: all]",
)
@click.option(
    "--scale",
    metavar="X",
    type=click.FloatRange(0, 16, min_open=True),
    help="With --rig: of the pictures' sides.  [default: 1]",
)
@click.option(
    "--points",
    type=Several("FORMAT,...", _POINTS),
    help=f"With --rig: what the points of LiDARs are written as, some of {', '.join(_POINTS)}; without --only the "
    "LiDARs alone record, and Blender is not needed.  [default: all, beside pictures]",
)
@click.option(
    "--also",
    type=Several("KIND,...", _SEQUENCES),
    help="With --rig: what the whole is written as too: nuscenes for its tables, ros2 for a bag with a launch file "
    "and RViz' settings beside it.",
)
@click.option(
    "--birds-eye",
    metavar="M",
    type=click.FloatRange(0.001, 1),
    help="With --rig: a bird's-eye view at each place too, of 600 x 600 pixels that are M metres wide.",
)
@click.option(
    "--flow", is_flag=True, default=None, help="With --rig: the optical flow of each picture to the next pose too."
)
@click.option("--without-cars", is_flag=True, default=None, help="With --birds-eye: it looks through parked cars.")
@output_option("Folder of the data set.", metavar="FOLDER", default="dataset", file_okay=False)
def render(
    *,
    stage: Path,
    cameras: tuple[str, ...],
    frames: str | None,
    at_m: tuple[float, float, float] | None,
    look_at_m: tuple[float, float, float] | None,
    size: tuple[int, int] | None,
    samples: int | None,
    seed: int,
    device: str,
    blender: Path | None,
    pictures: tuple[str, ...] | None,
    slots: tuple[str, ...] | None,
    rig: str | None,
    along: str | None,
    every_m: float | None,
    tracks: Path | None,
    ego: str | None,
    every_s: float | None,
    between: tuple[float, float] | None,
    scale: float | None,
    points: tuple[str, ...] | None,
    also: tuple[str, ...] | None,
    birds_eye: float | None,
    flow: bool | None,
    without_cars: bool | None,
    output: Path,
) -> None:
    """Render the cameras of the stage PATH: colour, depth, normals, instances and classes.

    Needs the extra `blender`, and for Python versions other than 3.11 an installed Blender. frames.json in the folder
    has the pose of each camera and the visible objects.

    --rig records the sensors of a car on a drive, or a sensor on a column; it needs the extra `sensors` too. LiDARs
    alone, as with --points and without --only, need no Blender. The car itself and a car parked in its stall are left
    out. After an interruption finished pictures remain in FOLDER.unfinished, and the same command resumes.

    \b
    Examples:
      garage2usd render garage.usdz --camera Inside --samples 32
      garage2usd render garage.usdz --camera Drive --frames 0:480x24 --only colour,depth -o drive
      garage2usd render garage.usdz --camera Drive --slots coco
      garage2usd render garage.usdz --at 12,1.6,8 --look-at 30,1,8 --size 640x360
      garage2usd render garage.usdz --rig lidar.toml --along 1:A1-08 --points npz --also nuscenes -o drive
      garage2usd render garage.usdz --rig avp_surround --along 1:A1-08 --scale 0.5 -o drive
      garage2usd render garage.usdz --rig lidar_32 --tracks run.parquet --ego avp --points npz --also nuscenes
      garage2usd render garage.usdz --rig avp_surround --along 1:A1-08 --birds-eye 0.02 --slots coco,dmpr-ps -o drive
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.render import Device, Picture, SlotFormat, render_stage  # noqa: PLC0415 - keeps --help instant
    from garage2usd.sensors.rays.birds_eye import BirdsEye  # noqa: PLC0415

    kinds = [Picture(kind) for kind in pictures or _PICTURES]
    told = None if slots is None else [SlotFormat(each) for each in slots]
    if rig is not None:
        from garage2usd.recordings import CloudFormat, Sequence, record  # noqa: PLC0415 - only with a rig

        own = {"camera": cameras or None, "frames": frames, "at": at_m, "look-at": look_at_m, "size": size}
        _refuse(own, "without --rig, which has its own")
        if along is None or tracks is not None:
            _refuse({"every-m": every_m}, "only with --along and without --tracks")
        traffic = _traffic(tracks, ego, every_s, between)
        if birds_eye is None:
            _refuse({"without-cars": without_cars}, "only with --birds-eye")
        above = None if birds_eye is None else BirdsEye(metres_per_px=birds_eye, cars=not without_cars)
        has_pictures = points is None or any(each is not None for each in (pictures, slots, above))
        with Bars(sys.stderr) as progress:
            recorded = record(
                stage,
                output,
                rig=rig,
                along=along,
                every_m=every_m or 1.0,
                traffic=traffic,
                scale=scale or 1.0,
                samples=samples,
                seed=seed,
                device=Device(device),
                blender=blender,
                pictures=kinds if has_pictures else [],
                slots=told,
                birds_eye=above,
                flow=bool(flow),
                points=[CloudFormat(kind) for kind in points or _POINTS],
                sequences=[Sequence(kind) for kind in also or ()],
                progress=progress,
                announce=progress.announce,
            )
        _tell(recorded, also or ())
        return
    in_traffic = {"tracks": tracks, "ego": ego, "every-s": every_s, "between": between, "flow": flow}
    _refuse(in_traffic, "only with --rig")
    with_rig: dict[str, object] = {"along": along, "every-m": every_m, "scale": scale, "points": points, "also": also}
    _refuse({**with_rig, "birds-eye": birds_eye, "without-cars": without_cars}, "only with --rig")
    with Bars(sys.stderr) as progress:
        made = render_stage(
            stage,
            output,
            cameras=cameras,
            frames=frames,
            at_m=at_m,
            look_at_m=look_at_m,
            size_px=size or (1280, 720),
            samples=samples,
            seed=seed,
            slots=told,
            pictures=kinds,
            device=Device(device),
            blender=blender,
            progress=progress,
            announce=progress.announce,
        )
    names = made.names
    drawn = f"{len(names)} ({names[0]} to {names[-1]})" if len(names) > 1 else names[0]
    listed, folder = ", ".join(made.pictures), f"{made.folder}/"
    echo_table([("frames", drawn), ("pictures", listed), ("folder", folder), ("table", str(made.frames))])


def _refuse(options: "Mapping[str, object]", allowed: str) -> None:
    for option, value in options.items():
        if value is not None:
            raise ConfigError(option, value, allowed)


def _traffic(
    tracks: Path | None, ego: str | None, every_s: float | None, between: tuple[float, float] | None
) -> "Traffic | None":
    """Read the tracks around a recording."""
    if tracks is None:
        _refuse({"ego": ego, "every-s": every_s, "between": between}, "only with --tracks")
        return None
    from garage2usd.maps.track_tables import read_tracks  # noqa: PLC0415 - keeps --help instant
    from garage2usd.recordings import Traffic  # noqa: PLC0415

    return Traffic(read_tracks(tracks), ego or "", every_s or 0.5, between)


def _tell(made: "Recorded", also: tuple[str, ...]) -> None:
    """Tell the files of a recording."""
    shots = made.recording.shots
    places, sensors = len({shot.pose for shot in shots}), list(dict.fromkeys(shot.sensor.name for shot in shots))
    echo_table(
        [
            ("places", f"{places} in {shots[-1].time_s - shots[0].time_s:.1f} s"),
            ("sensors", ", ".join(sensors)),
            ("frames", str(len(shots))),
            ("files", ", ".join(dict.fromkeys(kind for shot in shots for kind in shot.files))),
            *(("also", f"{made.folder / kind}/") for kind in also),
            ("folder", f"{made.folder}/"),
            ("table", str(made.frames)),
        ]
    )
