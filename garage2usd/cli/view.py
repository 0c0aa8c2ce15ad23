"""The command ``garage2usd view``."""

import sys
import threading
import time
import webbrowser
from pathlib import Path

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.options import INPUT_FILE

_MOST_PORT = 65535


port_option = click.option(
    "--port", metavar="N", type=click.IntRange(0, _MOST_PORT), default=0, help="TCP port.  [default: any that is free]"
)
no_browser_option = click.option("--no-browser", is_flag=True, help="Say the address only; open no browser.")


@click.command(short_help="Show a stage in the browser.")
@click.argument("path", type=INPUT_FILE)
@port_option
@no_browser_option
@click.option("--tracks", metavar="FILE", type=INPUT_FILE, help="Play tracks of cars and people: .parquet or .csv.")
@click.option(
    "--video",
    metavar="FILE",
    type=click.Path(path_type=Path),
    help="Write a video of the tracks instead (.mp4) and end.",
)
@click.option(
    "--camera",
    metavar="NAME",
    default="above",
    show_default=True,
    help="Where a video is seen from: above, or an agent such as car_0007.",
)
@click.option("--level", metavar="NAME", default="", help="Level seen from above.  [default: the top one]")
@click.option("--start", metavar="SECONDS", type=float, default=0.0, help="Time of the tracks at which a video starts.")
@click.option("--seconds", type=float, default=10.0, show_default=True, help="Duration of a video.")
@click.option("--speed", type=float, default=1.0, show_default=True, help="Seconds of the tracks in one of the video.")
@click.option("--size", metavar="WxH", default="960x540", show_default=True, help="Width and height of a video.")
def view(
    *,
    path: Path,
    port: int,
    no_browser: bool,
    tracks: Path | None,
    video: Path | None,
    camera: str,
    level: str,
    start: float,
    seconds: float,
    speed: float,
    size: str,
) -> None:
    """Show the stage at PATH (.usd, .usda, .usdc or .usdz) in a browser until Ctrl-C.

    Only this machine can see it, and nothing is fetched from elsewhere. Drag to orbit, or walk with W A S D; click an
    object for its class, id and prim, and on a stall for its number, use and type. A garage of several levels has a
    switch of levels, which hides those above. With --tracks a time line plays cars and people; with --video too, their
    pictures are written as a video of 25 frames per second, for which a Chromium draws without a window.

    \b
    Examples:
      garage2usd view garage.usdz
      garage2usd view out/garage.usdc --port 8000 --no-browser
      garage2usd view garage.usdz --tracks run.parquet
      garage2usd view garage.usdz --tracks run.parquet --video run.mp4 --start 300 --speed 4
      garage2usd view garage.usdz --tracks run.parquet --video drive.mp4 --camera car_0007 --start 120
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.common.errors import ConfigError  # noqa: PLC0415 - keeps --help instant
    from garage2usd.common.limits import lift  # noqa: PLC0415
    from garage2usd.reading.files import open_stage  # noqa: PLC0415
    from garage2usd.view.video import Film, check_film, write_film  # noqa: PLC0415
    from garage2usd.view.viewer import Looks, ViewerServer, read_agents, read_scene  # noqa: PLC0415

    begun = time.perf_counter()
    played = None
    if tracks is not None:
        from garage2usd.maps.track_tables import read_tracks  # noqa: PLC0415 - needs an extra

        played = read_tracks(tracks)
    film = None if video is None else Film(video, camera, level, start, seconds, speed, size)
    if film is not None:
        if played is None:
            raise ConfigError("video", str(video), "with --tracks, which it shows")
        check_film(film, played)
    stage = open_stage(path)
    with ViewerServer(port) as server:
        try:
            if film is None:
                click.echo(f"{path.name} at {server.url}")
            looks = Looks()
            with Bars(sys.stderr) as progress:
                progress("reading", 0, 1)
                scene = read_scene(stage, path, looks)
            server.show(scene, None if played is None else read_agents(played, looks))
            # before the browser starts, which would inherit the limits of a process that reads a stage
            lift()
            if film is not None:
                with Bars(sys.stderr) as progress:
                    click.echo(write_film(film, server.url, scene, progress))
                return
            if not no_browser:
                threading.Thread(target=webbrowser.open, args=(server.url,), daemon=True).start()
            shown = f"{len(scene.objects)} objects of {len(scene.counts())} classes"
            click.echo(f"{shown}, read in {time.perf_counter() - begun:.1f} s; Ctrl-C ends")
            threading.Event().wait()
        except KeyboardInterrupt:
            click.echo("\nstopped", err=True)
