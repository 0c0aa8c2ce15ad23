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
def view(*, path: Path, port: int, no_browser: bool) -> None:
    """Show the stage at PATH (.usd, .usda, .usdc or .usdz) in a browser until Ctrl-C.

    Only this machine can see it, and nothing is fetched from elsewhere. Drag to orbit, or walk with W A S D; click an
    object for its class, id and prim, and on a stall for its number, use and type. A garage of several levels has a
    switch of levels, which hides those above.

    \b
    Examples:
      garage2usd view garage.usdz
      garage2usd view out/garage.usdc --port 8000 --no-browser
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.common.limits import lift  # noqa: PLC0415 - keeps --help instant
    from garage2usd.reading.files import open_stage  # noqa: PLC0415
    from garage2usd.view.viewer import ViewerServer, read_scene  # noqa: PLC0415

    start = time.perf_counter()
    stage = open_stage(path)
    with ViewerServer(port) as server:
        try:
            click.echo(f"{path.name} at {server.url}")
            scene = read_scene(stage, path)
            server.show(scene)
            # before the browser starts, which would inherit the limits of a process that reads a stage
            lift()
            if not no_browser:
                threading.Thread(target=webbrowser.open, args=(server.url,), daemon=True).start()
            shown = f"{len(scene.objects)} objects of {len(scene.counts())} classes"
            click.echo(f"{shown}, read in {time.perf_counter() - start:.1f} s; Ctrl-C ends")
            threading.Event().wait()
        except KeyboardInterrupt:
            click.echo("\nstopped", err=True)
