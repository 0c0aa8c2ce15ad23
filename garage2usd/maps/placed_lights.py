"""Lights of a stage that shine, with their places and photometric data, for formats that hold such lights."""

from collections.abc import Iterable, Iterator

from pxr import Usd, UsdLux

from garage2usd.as_built.contents import PlacedLight, placed_light
from garage2usd.maps.glb_lights import why_left_out
from garage2usd.reading.lights import unsaid_of
from garage2usd.scenes.prims import PlacedObject
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.values import metres_per_unit


def placed_lights(
    stage: Usd.Stage, objects: Iterable[PlacedObject], remarks: Remarks
) -> Iterator[tuple[str, PlacedLight]]:
    """Yield the path and the photometric data of each light that shines.

    Parameters
    ----------
    stage
        The stage.
    objects
        Its objects in metres with Y up.
    remarks
        Receives remarks on lights and properties that are left out.
    """
    units = metres_per_unit(stage)
    for placed in objects:
        for part in placed.parts:
            if not part.prim.HasAPI(UsdLux.LightAPI):
                continue
            path = placed.path + part.path
            if reason := why_left_out(part.prim, glows=False):
                remarks.add(reason, path)
                continue
            light = placed_light(part.prim, part.matrix @ placed.matrix, units)
            source = light.source
            if max(source.candela, source.lux) * light.nits_per_unit > 0 and source.cone_deg > 0:
                for reason in unsaid_of(part.prim):
                    remarks.add(reason, path)
                yield path, light
