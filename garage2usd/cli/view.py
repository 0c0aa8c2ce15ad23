"""The command ``garage2usd view``."""

import threading
import time
import webbrowser
from pathlib import Path

import click

from garage2usd.cli.options import INPUT_FILE

_MOST_PORT = 65535


@click.command(short_help="Show a stage in the browser.")
@click.argument("path", type=INPUT_FILE)
@click.option(
    "--port", metavar="N", type=click.IntRange(0, _MOST_PORT), default=0, help="TCP port.  [default: any that is free]"
)
@click.option("--no-browser", is_flag=True, help="Say the address only; open no browser.")
@click.option("--tracks", metavar="FILE", type=INPUT_FILE, help="Play tracks of cars and people: .parquet or .csv.")
def view(*, path: Path, port: int, no_browser: bool, tracks: Path | None) -> None:
    """Show the stage at PATH (.usd, .usda, .usdc or .usdz) in a browser until Ctrl-C.

    Only this machine can see it, and nothing is fetched from elsewhere. Drag to orbit, or walk with W A S D; click an
    object for its class, id and prim, and on a stall for its number, use and type. A garage of several levels has a
    switch of levels, which hides those above. With --tracks a time line plays cars and people as plain bodies.

    \b
    Examples:
      garage2usd view garage.usdz
      garage2usd view out/garage.usdc --port 8000 --no-browser
      garage2usd view garage.usdz --tracks run.parquet
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.common.limits import lift  # noqa: PLC0415 - keeps --help instant
    from garage2usd.reading.files import open_stage  # noqa: PLC0415
    from garage2usd.view.viewer import Looks, ViewerServer, read_agents, read_scene  # noqa: PLC0415

    start = time.perf_counter()
    played = None
    if tracks is not None:
        from garage2usd.maps.track_tables import read_tracks  # noqa: PLC0415 - needs an extra

        played = read_tracks(tracks)
    stage = open_stage(path)
    with ViewerServer(port) as server:
        try:
            click.echo(f"{path.name} at {server.url}")
            looks = Looks()
            scene = read_scene(stage, path, looks)
            server.show(scene, played and read_agents(played, looks))
            # before the browser starts, which would inherit the limits of a process that reads a stage
            lift()
            if not no_browser:
                threading.Thread(target=webbrowser.open, args=(server.url,), daemon=True).start()
            shown = f"{len(scene.objects)} objects of {len(scene.counts())} classes"
            click.echo(f"{shown}, read in {time.perf_counter() - start:.1f} s; Ctrl-C ends")
            threading.Event().wait()
        except KeyboardInterrupt:
            click.echo("\nstopped", err=True)
