"""Take a picture of the viewer's page: with its panels as a user sees it, or without them as a film has it.

Usage: python docs/pictures/viewer_picture.py STAGE PICTURE [--size 960x600] [--level U2]
       [--eye X Y Z --target X Y Z] [--wide 1.0] [--tracks FILE --time SECONDS --camera car_0007]
       [--script JAVASCRIPT]

With ``--script`` the panels stay; the script finds the `viewer` of the page. Heights of ``--eye`` and ``--target`` are
over the floor of the level. ``--wide`` is the share of the usual distance from which a whole level is seen.
"""

import argparse
import base64
from pathlib import Path

from garage2usd.common.limits import lift
from garage2usd.maps.track_tables import read_tracks
from garage2usd.reading.files import open_stage
from garage2usd.view.video import Film, open_page
from garage2usd.view.viewer import Looks, ViewerServer, read_agents, read_scene

_REST = """async () => { const busy = () => viewer.quality.moving || viewer.dirty || viewer.fence;
for (let k = 0; k < 2; k += busy() ? 0 : 1) await new Promise(requestAnimationFrame); }"""
_PLACE = """([eye, target]) => { const at = (v, p) => v.set(p[0], p[1] + viewer.floor, p[2]);
at(viewer.orbit.target, target); at(viewer.camera.position, eye); viewer.orbit.update(); }"""
_NEARER = "share => { viewer.camera.position.sub(viewer.orbit.target).multiplyScalar(share).add(viewer.orbit.target); }"
_FINER = 2
_NEVER = -1.0


def main() -> None:
    """Show the stage to a browser without a window and save what it draws."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stage", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--size", default="960x600")
    parser.add_argument("--level", default="")
    parser.add_argument("--camera", default="above")
    parser.add_argument("--eye", type=float, nargs=3)
    parser.add_argument("--target", type=float, nargs=3)
    parser.add_argument("--wide", type=float, default=1.0)
    parser.add_argument("--script")
    parser.add_argument("--tracks", type=Path)
    parser.add_argument("--time", type=float, default=_NEVER)
    options = parser.parse_args()
    looks = Looks()
    scene = read_scene(open_stage(options.stage), options.stage, looks)
    agents = None if options.tracks is None else read_agents(read_tracks(options.tracks), looks)
    names = [level.name for level in scene.levels]
    film = Film(options.picture, size=options.size)
    with ViewerServer(0) as server:
        server.show(scene, agents)
        lift()
        with open_page(film, server.url) as page:
            if options.script:
                page.evaluate(f"async () => {{ {options.script} }}")
                page.evaluate(_REST)
                page.screenshot(path=options.picture)
                return
            level = names.index(options.level) if options.level else 0
            page.evaluate(
                "([camera, level, scale]) => viewer.film(camera, level, scale)", [options.camera, level, _FINER]
            )
            if options.camera == "above":
                page.evaluate(_NEARER, options.wide)
            if options.eye:
                page.evaluate(_PLACE, [options.eye, options.target])
            address = page.evaluate("time => viewer.still(time)", max(0.0, options.time))
            options.picture.write_bytes(base64.b64decode(address.partition(",")[2]))


if __name__ == "__main__":
    main()
