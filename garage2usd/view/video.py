"""Videos of traffic: pictures of the viewer's page in a Chromium without a window, frame by frame, as H.264."""

import base64
import io
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from garage2usd.common.errors import ConfigError, OutputError
from garage2usd.common.output import check_file, publish_at, staging_folder
from garage2usd.common.package import of_extra, require
from garage2usd.common.progress import Progress, silent
from garage2usd.driving.tracks import Tracks
from garage2usd.view.viewer.scene import Scene

FRAMES_PER_SECOND = 25
ABOVE = "above"
_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge")
# without a graphics card, as pictures should be the same on all machines
_ARGUMENTS = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage"]
_READY = "html[data-ready=yes], #curtain.failed"
_SIZE = re.compile(r"([0-9]{2,4})x([0-9]{2,4})")
_MOST_PX, _LONGEST_S = 4096, 3600.0
_FINER = 2
"""Pixels of a drawn picture for one of the video, each way."""
_NAMED = 6
_QUALITY = {"crf": "23", "preset": "medium", "threads": "1"}
"""One thread of x264, so that the same pictures give the same bytes."""


@dataclass(frozen=True)
class Film:
    """A video to make of tracks.

    Attributes
    ----------
    path
        The file, ``.mp4``.
    camera
        ``above``, or the name of an agent, from whose eyes it is seen.
    level
        Name of the level seen from above; empty for the top one.
    start_s, seconds, speed
        First time of the tracks, duration of the video, and seconds of the tracks in one of the video.
    size
        Width and height in pixels, as ``960x540``; even numbers.
    """

    path: Path
    camera: str = ABOVE
    level: str = ""
    start_s: float = 0.0
    seconds: float = 10.0
    speed: float = 1.0
    size: str = "960x540"

    @property
    def frames(self) -> int:
        """Number of pictures."""
        return max(1, round(self.seconds * FRAMES_PER_SECOND))

    def pixels(self) -> tuple[int, int]:
        """Return width and height.

        Raises
        ------
        ConfigError
            If the size is not two even numbers.
        """
        found = _SIZE.fullmatch(self.size)
        width, height = (int(found[1]), int(found[2])) if found else (1, 1)
        if width % 2 or height % 2 or max(width, height) > _MOST_PX:
            raise ConfigError("size", self.size, f"width and height as 960x540, even numbers up to {_MOST_PX}")
        return width, height


def check_film(film: Film, tracks: Tracks) -> None:
    """Check before the work that a video can be made of tracks.

    Raises
    ------
    ConfigError
        If a value of the film is not possible with the tracks.
    MissingExtraError
        If the extra ``video`` is not installed.
    OutputError
        If the file cannot be written.
    """
    if film.path.suffix.lower() != ".mp4":
        raise ConfigError("video", str(film.path), "a path that ends in .mp4")
    check_file(film.path)
    film.pixels()
    names = [track.agent.name for track in tracks]
    if film.camera not in {ABOVE, *names}:
        some = ", ".join(names[:_NAMED]) + (f" and {len(names) - _NAMED} more" if len(names) > _NAMED else "")
        raise ConfigError("camera", film.camera, f"{ABOVE}, or an agent: {some}")
    if not 0 <= film.start_s < tracks.duration_s:
        raise ConfigError("start", film.start_s, f"from 0 to less than {tracks.duration_s:g}, the end of the tracks")
    if not 0 < film.seconds <= _LONGEST_S:
        raise ConfigError("seconds", film.seconds, f"more than 0, up to {_LONGEST_S:g}")
    if not film.speed > 0:
        raise ConfigError("speed", film.speed, "more than 0")
    require("a video", ["av", "playwright"])


def write_film(film: Film, url: str, scene: Scene, progress: Progress = silent) -> Path:
    """Make a video of a page of `ViewerServer` whose scene has traffic; return its path.

    Times of the tracks are set one by one and each picture is taken when it is drawn, so that none is left out however
    long it takes. Beyond the end of the tracks the last picture stays.

    Raises
    ------
    ConfigError
        If the level is unknown.
    OutputError
        If there is no Chromium, or it cannot show the page.
    """
    names = [level.name for level in scene.levels if not level.is_only]
    if film.level and film.level not in names:
        raise ConfigError("level", film.level, f"one of {', '.join(names)}" if names else "none, as there is one level")
    level = names.index(film.level) if film.level else 0
    with staging_folder(film.path) as staging, open_page(film, url) as page:
        page.evaluate("([camera, level, scale]) => viewer.film(camera, level, scale)", [film.camera, level, _FINER])
        draft = staging / film.path.name
        _encode(draft, film, _pictures(page, film, progress))
        return publish_at({draft: film.path})[0]


@contextmanager
def open_page(film: Film, url: str) -> Iterator[Any]:
    """Open a page of `ViewerServer` in a browser without a window, of the size of a film.

    Raises
    ------
    ConfigError
        If the size is not possible.
    OutputError
        If there is no Chromium, or it cannot show the page.
    """
    with of_extra("a video"):
        from playwright.sync_api import Error, sync_playwright  # noqa: PLC0415 - optional
    width, height = film.pixels()
    program = next(filter(None, map(shutil.which, _BROWSERS)), None)
    with sync_playwright() as playwright:
        try:
            browser = playwright.chromium.launch(executable_path=program, args=_ARGUMENTS)
        except Error as error:
            reason = "cannot be started" if program else "is needed: install Chromium, Chrome or Edge on the path"
            words = str(error).strip().splitlines()[0]
            raise OutputError(film.path, f"a browser {reason} ({words})") from None
        try:
            page = browser.new_page(viewport={"width": width, "height": height})
            page.goto(url)
            page.wait_for_selector(_READY, state="attached", timeout=0)
            if page.evaluate("typeof viewer === 'undefined'"):
                raise OutputError(film.path, f"the viewer's page says: {page.inner_text('#note')}")
            yield page
        except Error as error:
            raise OutputError(film.path, f"the browser has stopped ({str(error).strip().splitlines()[0]})") from None
        finally:
            browser.close()


def _pictures(page: Any, film: Film, progress: Progress) -> Iterator[bytes]:  # noqa: ANN401 - playwright is optional
    """Yield the pictures as PNG."""
    for number in range(film.frames):
        time_s = film.start_s + number * film.speed / FRAMES_PER_SECOND
        address = page.evaluate("time => viewer.still(time)", time_s)
        progress("video", number + 1, film.frames)
        yield base64.b64decode(address.partition(",")[2])


def _encode(path: Path, film: Film, pictures: Iterator[bytes]) -> None:
    """Encode pictures as H.264 that browsers play."""
    with of_extra("a video"):
        import av  # noqa: PLC0415 - optional
    import numpy as np  # noqa: PLC0415 - with what is optional
    from PIL import Image  # noqa: PLC0415 - with what is optional

    with av.open(str(path), "w", options={"movflags": "faststart"}) as container:
        stream = container.add_stream("libx264", rate=FRAMES_PER_SECOND, options=_QUALITY)
        stream.width, stream.height = film.pixels()
        stream.pix_fmt = "yuv420p"
        for picture in pictures:
            pixels = np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"))
            for packet in stream.encode(av.VideoFrame.from_ndarray(pixels, format="rgb24")):
                container.mux(packet)
        for packet in stream.encode():
            container.mux(packet)
