"""Building models (IFC) as footprints: elements that are parts of garages, with their heights, storeys and names."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.common.package import of_extra
from garage2usd.survey.drawing_words import PartKind, kind_of
from garage2usd.survey.text import MOST_M

with of_extra("a survey as IFC"):
    import ifcopenshell
    from ifcopenshell import geom
    from ifcopenshell.util import element as ifc_element
    from ifcopenshell.util import geolocation, placement, unit

Floats = NDArray[np.float64]

_MOST_BYTES = 1024 * 1024 * 1024
_KINDS = {
    "IfcColumn": PartKind.COLUMN,
    "IfcWall": PartKind.WALL,
    "IfcCurtainWall": PartKind.WALL,
    "IfcSlab": PartKind.OUTLINE,
    "IfcRamp": PartKind.RAMP,
    "IfcRampFlight": PartKind.RAMP,
    "IfcDoor": PartKind.DOOR,
    "IfcStair": PartKind.SOLID,
    "IfcStairFlight": PartKind.SOLID,
    "IfcTransportElement": PartKind.SOLID,
}
"""Parts that classes of elements are."""
_NAMED = ("IfcSpace", "IfcBuildingElementProxy", "IfcFurnishingElement", "IfcGeographicElement", "IfcVirtualElement")
"""Classes whose names tell what they are."""
_FLAT, _STRAIGHT_M = 1e-6, 0.005
_MOST_REPEATS = 1000
_FAULTS = (
    ifcopenshell.Error,
    OSError,
    RuntimeError,
    ValueError,
    LookupError,
    AttributeError,
    TypeError,
    AssertionError,
)
"""Errors of IfcOpenShell on damaged files."""


class ModelPart(NamedTuple):
    """An element of a building model.

    Attributes
    ----------
    name
        Its class and name.
    kind
        The part of a garage that it is.
    ground
        Its footprint, (x, z) in metres.
    points
        Its vertices, (x, z, height) in metres; float64, shape (n, 3).
    storey
        Number of its storey in `Model.storeys`, -1 for none.
    told
        Its names, and those of its type.
    properties
        Values of its property sets by the name of the property.
    """

    name: str
    kind: PartKind
    ground: shapely.Geometry
    points: Floats
    storey: int
    told: tuple[str, ...]
    properties: dict[str, Any]

    @property
    def base_m(self) -> float:
        """Height of its lowest point."""
        return float(self.points[:, 2].min())

    @property
    def top_m(self) -> float:
        """Height of its highest point."""
        return float(self.points[:, 2].max())


class Model(NamedTuple):
    """A building model: its parts, its storeys by name and height in metres, and latitude and longitude of (0, 0)."""

    parts: list[ModelPart]
    storeys: list[tuple[str, float]]
    origin_deg: tuple[float, float] | None


def read_model(path: Path) -> Model:
    """Read the parts of garages in a building model.

    Raises
    ------
    ConfigError
        If the file is not IFC.
    """
    try:
        if path.stat().st_size > _MOST_BYTES:
            raise ConfigError("SOURCE", str(path), f"a building model of at most {_MOST_BYTES} bytes")
        model = ifcopenshell.open(str(path))
        scale = float(unit.calculate_unit_scale(model))
        found: list[Any] = sorted(model.by_type("IfcBuildingStorey"), key=lambda storey: int(storey.id()))
        storeys = [
            (str(storey.Name or storey.LongName or f"storey {number + 1}"), scale * _elevation(storey))
            for number, storey in enumerate(found)
        ]
        number_of = {storey.id(): number for number, storey in enumerate(found)}
        origin_deg, turn_rad, shift = _on_earth(model, scale)
        parts = list(_parts(model, number_of, turn_rad, shift))
    except _FAULTS as error:
        told = (str(error) or type(error).__name__).splitlines()[0][:120]
        raise ConfigError("SOURCE", str(path), f"a building model as IFC ({told})") from None
    return Model(parts, storeys, origin_deg)


def _elevation(storey: Any) -> float:  # noqa: ANN401 - an element of IfcOpenShell
    height = float(placement.get_storey_elevation(storey) or 0.0)
    return height if math.isfinite(height) else 0.0


def _on_earth(model: Any, scale: float) -> tuple[tuple[float, float] | None, float, tuple[float, float]]:  # noqa: ANN401
    """Return latitude and longitude of the site if given, the turn that leads true north up, and the site's place."""
    for site in model.by_type("IfcSite"):
        if not site.RefLatitude or not site.RefLongitude:
            continue
        latitude, longitude = (float(geolocation.dms2dd(*angle)) for angle in (site.RefLatitude, site.RefLongitude))
        if not (abs(latitude) <= 90 and abs(longitude) <= 180) or latitude == longitude == 0:  # noqa: PLR2004 - degrees
            continue
        turn_rad = -math.radians(float(geolocation.get_true_north(model)))
        at = placement.get_local_placement(site.ObjectPlacement)[:2, 3] * scale if site.ObjectPlacement else (0.0, 0.0)
        return (round(latitude, 7), round(longitude, 7)), turn_rad, (float(at[0]), float(at[1]))
    return None, 0.0, (0.0, 0.0)


def _parts(
    model: Any,  # noqa: ANN401 - a file of IfcOpenShell
    storeys: dict[int, int],
    turn_rad: float,
    shift: tuple[float, float],
) -> Iterator[ModelPart]:
    kinds: dict[int, tuple[PartKind, tuple[str, ...], dict[str, Any]]] = {}
    elements = []
    classes = [name for name in (*_NAMED, *_KINDS) if _is_known(model, name)]
    for element in sorted({item.id(): item for name in classes for item in model.by_type(name)}.items()):
        told = _names(element[1])
        values = {
            key: value
            for group in ifc_element.get_psets(element[1], psets_only=True).values()
            for key, value in group.items()
        }
        kind = _kind(element[1], told, values)
        if kind is not None:
            kinds[element[0]] = kind, told, values
            elements.append(element[1])
    if all(kind is not PartKind.STALL for kind, _, _ in kinds.values()):
        return  # nothing to lay out, whatever shapes there are
    settings = geom.settings()  # type: ignore[no-untyped-call]
    settings.set("use-world-coords", True)
    settings.set("disable-opening-subtractions", True)  # walls stand over and under openings, and cuts are slow
    settings.set("disable-boolean-result", True)
    settings.set("dimensionality", ifcopenshell.ifcopenshell_wrapper.CURVES_SURFACES_AND_SOLIDS)
    iterator = geom.iterator(settings, model, include=elements)
    cos, sin = math.cos(turn_rad), math.sin(turn_rad)
    found: dict[int, tuple[Floats, shapely.Geometry]] = {}
    if iterator.initialize():
        # of lines that are written many times, shapes come many times
        for _ in range(_MOST_REPEATS + 4 * len(elements)):
            shape: Any = iterator.get()  # type: ignore[no-untyped-call]
            places = np.array([] if shape.id in found else shape.geometry.verts, np.float64).reshape(-1, 3)
            if len(places) and (np.abs(places) <= MOST_M).all():
                x, y = places[:, 0] - shift[0], places[:, 1] - shift[1]
                points = np.stack([x * cos - y * sin, -(x * sin + y * cos), places[:, 2]], axis=-1)
                found[shape.id] = points, _footprint(points, shape.geometry)
            if len(found) == len(elements) or not iterator.next():
                break
    for element in elements:
        if element.id() in found:
            points, ground = found[element.id()]
            kind, told, values = kinds[element.id()]
            name = f"{element.is_a()} {element.Name or element.GlobalId}"
            yield ModelPart(name, kind, ground, points, _storey(element, storeys), told, values)


def _is_known(model: Any, name: str) -> bool:  # noqa: ANN401
    try:
        model.by_type(name)
    except RuntimeError:  # of a later schema
        return False
    return True


def _names(element: Any) -> tuple[str, ...]:  # noqa: ANN401
    kind = ifc_element.get_type(element)
    texts = [getattr(element, key, None) for key in ("Name", "LongName", "ObjectType", "Description", "Tag")]
    texts += [getattr(kind, "Name", None), getattr(kind, "ElementType", None)]
    return tuple(str(text) for text in texts if text)


def _kind(element: Any, told: tuple[str, ...], values: dict[str, Any]) -> PartKind | None:  # noqa: ANN401
    if any(element.is_a(name) for name in _NAMED):
        if element.is_a("IfcSpace") and getattr(element, "PredefinedType", None) == "PARKING":
            return PartKind.LANE if values.get("IsAisle") else PartKind.STALL
        return next((kind for kind in map(kind_of, told) if kind is not None), None)
    return next((kind for name, kind in _KINDS.items() if element.is_a(name)), None)


def _storey(element: Any, storeys: dict[int, int]) -> int:  # noqa: ANN401
    above: Any = element
    for _ in range(20):
        above = ifc_element.get_container(above) or ifc_element.get_aggregate(above)
        if above is None or above.id() in storeys:
            break
    return -1 if above is None else storeys.get(above.id(), -1)


def _footprint(points: Floats, geometry: Any) -> shapely.Geometry:  # noqa: ANN401 - a triangulation of IfcOpenShell
    """Return the union of all triangles as seen from above, or of the areas within lines if there are none."""
    faces = np.array(geometry.faces, np.int64).reshape(-1, 3)
    triangles = points[faces][:, :, :2]
    one, other = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    seen = triangles[np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]) > _FLAT]
    if len(seen):
        return shapely.union_all(shapely.polygons(seen), grid_size=1e-4).simplify(_STRAIGHT_M)
    edges = np.array(geometry.edges, np.int64).reshape(-1, 2)
    lines = shapely.union_all(shapely.linestrings(points[edges][:, :, :2])) if len(edges) else shapely.Point()
    return shapely.union_all(shapely.get_parts(shapely.polygonize([lines])))
