"""The command ``garage2usd draw``."""

import threading
import webbrowser
from pathlib import Path

import click

from garage2usd.cli.view import no_browser_option, port_option


@click.command(short_help="Draw a garage in the browser.")
@click.argument("config", required=False, type=click.Path(path_type=Path))
@click.option("--trace", is_flag=True, help="Begin a new survey, traced over a picture, for `garage2usd import`.")
@port_option
@no_browser_option
def draw(*, config: Path | None, trace: bool, port: int, no_browser: bool) -> None:
    """Draw the garage of the configuration CONFIG (TOML) in a browser, or a new one, until Ctrl-C.

    Squares are painted with the mouse, a finger or the keyboard; the plan and what `check` finds on it follow at once.
    Lanes are drawn or planned, sizes are dragged in metres, and a button shows the garage in 3D. The page saves the
    configuration, with its comments, which `build` takes. Without CONFIG it is a new garage.toml in this folder. Only
    this machine can see the page, by the address with its token.

    CONFIG may also be a survey in metres (TOML), for `garage2usd import`: outline, stalls, lanes and portals are traced
    over a picture with a scale. --trace begins a new one.

    \b
    Examples:
      garage2usd draw
      garage2usd draw samples/hand_drawn.toml
      garage2usd draw --trace
      garage2usd draw garage.toml --port 8000 --no-browser
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.drafts.draft_file import DraftFile  # noqa: PLC0415 - keeps --help instant
    from garage2usd.drafts.opening import desk_of  # noqa: PLC0415
    from garage2usd.drafts.server import DrawServer  # noqa: PLC0415

    file = DraftFile.new(Path(), "lot" if trace else "garage") if config is None else DraftFile(config)
    desk = desk_of(file, is_new_survey=trace)
    desk.hold()
    with DrawServer(desk, port) as server:
        try:
            click.echo(f"{file.path.name} at {server.url}")
            if not no_browser:
                threading.Thread(target=webbrowser.open, args=(server.url,), daemon=True).start()
            click.echo("Ctrl-C ends; unsaved work is kept beside the file")
            threading.Event().wait()
        except KeyboardInterrupt:
            click.echo("\nstopped", err=True)
