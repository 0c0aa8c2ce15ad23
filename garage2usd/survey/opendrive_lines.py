"""Reference lines of OpenDRIVE roads: lines, arcs, spirals, cubic polynomials and parametric ones."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import fresnel

from garage2usd.survey.text import number_of, refuse

Floats = NDArray[np.float64]
Curve = Callable[[Floats], tuple[Floats, Floats, Floats]]
"""From distances along a geometry to x, y and heading in its own frame."""

_MOST_LENGTH_M = 1e6
_MOST_CURVATURE = 1e3
_SAME_M = 1e-9
_INTEGRATED_M = 0.02
"""Step along polynomials, by which their lengths are summed."""
_ANGLE = 1e6


class _Geometry(NamedTuple):
    """A piece of a reference line: distance along the road, pose, length and curve."""

    s_m: float
    x: float
    y: float
    heading_rad: float
    length_m: float
    curve: Curve


@dataclass(frozen=True)
class RoadLine:
    """The reference line of a road.

    Attributes
    ----------
    geometries
        Pieces in order.
    length_m
        Length of the road, which may end before its last piece.
    """

    geometries: tuple[_Geometry, ...]
    length_m: float

    @property
    def joints_m(self) -> list[float]:
        """Distance along the line of the start of each piece."""
        return [geometry.s_m for geometry in self.geometries]

    def at(self, s_m: Floats) -> tuple[Floats, Floats]:
        """Evaluate points and headings.

        Parameters
        ----------
        s_m
            Distances along the line; shape (n,). The first and the last piece extend beyond the ends.

        Returns
        -------
        points
            (x, y); shape (n, 2).
        headings_rad
            Counter-clockwise from x; shape (n,).
        """
        starts = np.array(self.joints_m)
        piece = np.clip(np.searchsorted(starts, s_m + _SAME_M, side="right") - 1, 0, None)
        points, headings = np.empty((len(s_m), 2)), np.empty(len(s_m))
        for index, geometry in enumerate(self.geometries):
            here = piece == index
            if not here.any():
                continue
            u, v, turned = geometry.curve(s_m[here] - geometry.s_m)
            cos, sin = math.cos(geometry.heading_rad), math.sin(geometry.heading_rad)
            points[here] = np.stack([geometry.x + u * cos - v * sin, geometry.y + u * sin + v * cos], axis=1)
            headings[here] = geometry.heading_rad + turned
        return points, headings

    def beside(self, s_m: Floats, t_m: Floats) -> Floats:
        """Evaluate the points (x, y) at distances along the line and offsets to its left; shape (n, 2)."""
        points, headings = self.at(s_m)
        beside: Floats = points + t_m[:, None] * np.stack([-np.sin(headings), np.cos(headings)], axis=1)
        return beside


class Cubics(NamedTuple):
    """A piecewise cubic polynomial: where each begins, and its coefficients from the constant on; shape (n, 4)."""

    starts_m: Floats
    coefficients: Floats

    def at(self, s_m: Floats) -> Floats:
        """Evaluate it at distances; 0 before its start."""
        if not len(self.starts_m):
            return np.zeros(len(s_m))
        piece = np.searchsorted(self.starts_m, s_m + _SAME_M, side="right") - 1
        a, b, c, d = self.coefficients[np.clip(piece, 0, None)].T
        run = s_m - self.starts_m[np.clip(piece, 0, None)]
        return np.where(piece < 0, 0.0, a + run * (b + run * (c + run * d)))


def cubics_of(elements: Sequence[ET.Element], start: str, place: str) -> Cubics:
    """Return the piecewise cubic of elements with the attributes ``a``, ``b``, ``c`` and ``d``.

    Parameters
    ----------
    elements
        Elements in the order of the file.
    start
        Name of the attribute with the start of each element.
    place
        Place of the elements in messages.
    """
    rows = [
        [
            number_of(element.get(start, 0), f"{place}, {start}"),
            *(number_of(element.get(key, 0), f"{place}, {key}", most=1e12, unit="metres") for key in "abcd"),
        ]
        for element in elements
    ]
    values = np.array(sorted(rows, key=lambda row: row[0])).reshape(-1, 5)
    return Cubics(values[:, 0], values[:, 1:])


def road_line(road: ET.Element, place: str) -> RoadLine:
    """Return the reference line of a road.

    Raises
    ------
    ConfigError
        For a road without geometry, or with one that is wrong.
    """
    geometries = []
    for index, element in enumerate(road.findall("planView/geometry")):
        here = f"{place}, geometry {index}"
        s_m, x, y = (number_of(element.get(key), f"{here}, {key}") for key in ("s", "x", "y"))
        heading = number_of(element.get("hdg"), f"{here}, hdg", most=_ANGLE, unit="radians")
        length_m = number_of(element.get("length"), f"{here}, length", most=_MOST_LENGTH_M)
        if length_m > _SAME_M:
            geometries.append(_Geometry(s_m, x, y, heading, length_m, _curve(element, length_m, here)))
    if not geometries:
        refuse(f"{place}, planView", "nothing", "a geometry with a length above 0")
    geometries.sort(key=lambda geometry: geometry.s_m)
    end_m = geometries[-1].s_m + geometries[-1].length_m
    length_m = number_of(road.get("length", end_m), f"{place}, length", most=_MOST_LENGTH_M)
    return RoadLine(tuple(geometries), min(length_m, end_m))


def _curve(element: ET.Element, length_m: float, place: str) -> Curve:
    shape = next((child for child in element if child.tag in _CURVES), None)
    if shape is None:
        refuse(place, ", ".join(child.tag for child in element) or "nothing", f"one of {', '.join(_CURVES)}")
    return _CURVES[shape.tag](shape, length_m, f"{place}, {shape.tag}")


def _line(_shape: ET.Element, _length_m: float, _place: str) -> Curve:
    return lambda run: (run, np.zeros_like(run), np.zeros_like(run))


def _curvature(shape: ET.Element, key: str, place: str) -> float:
    return number_of(shape.get(key), f"{place}, {key}", most=_MOST_CURVATURE, unit="1 / metres")


def _bend(curvature: float) -> Curve:
    if abs(curvature) < _SAME_M:
        return lambda run: (run, np.zeros_like(run), np.zeros_like(run))

    def at(run: Floats) -> tuple[Floats, Floats, Floats]:
        turned = curvature * run
        return np.sin(turned) / curvature, (1 - np.cos(turned)) / curvature, turned

    return at


def _arc(shape: ET.Element, _length_m: float, place: str) -> Curve:
    return _bend(_curvature(shape, "curvature", place))


def _spiral(shape: ET.Element, length_m: float, place: str) -> Curve:
    """Return a clothoid, by Fresnel's integrals from the point where its curvature would be 0."""
    start, end = (_curvature(shape, key, place) for key in ("curvStart", "curvEnd"))
    rate = (end - start) / length_m
    if abs(rate) < _SAME_M:
        return _bend((start + end) / 2)
    scale = math.sqrt(math.pi / abs(rate))
    offset_m, sign = start / rate, math.copysign(1.0, rate)
    heading = rate * offset_m**2 / 2
    cos, sin = math.cos(heading), math.sin(heading)

    def standard(run: Floats | float) -> tuple[Floats, Floats]:
        sines, cosines = fresnel(np.asarray(run) / scale)
        return cosines * scale, sines * scale * sign

    start_u, start_v = standard(offset_m)

    def at(run: Floats) -> tuple[Floats, Floats, Floats]:
        u, v = standard(run + offset_m)
        u, v = u - start_u, v - start_v
        return u * cos + v * sin, v * cos - u * sin, rate * (run + offset_m) ** 2 / 2 - heading

    return at


def _polynomial(parameter: Floats, coefficients: Sequence[float]) -> tuple[Floats, Floats]:
    """Evaluate a cubic and its derivative."""
    a, b, c, d = coefficients
    return a + parameter * (b + parameter * (c + parameter * d)), b + parameter * (2 * c + parameter * 3 * d)


def _coefficients(shape: ET.Element, axis: str, place: str) -> list[float]:
    return [number_of(shape.get(f"{key}{axis}"), f"{place}, {key}{axis}", most=1e12) for key in "abcd"]


def _poly3(shape: ET.Element, length_m: float, place: str) -> Curve:
    """Return a cubic v(u), with u found from the length along it."""
    return _parametric([0.0, 1.0, 0.0, 0.0], _coefficients(shape, "", place), length_m, by_length=True)


def _param_poly3(shape: ET.Element, length_m: float, place: str) -> Curve:
    u, v = (_coefficients(shape, axis, place) for axis in "UV")
    form = shape.get("pRange", "normalized")
    if form not in {"arcLength", "normalized"}:
        refuse(f"{place}, pRange", form, "arcLength or normalized")
    range_m = length_m if form == "normalized" else 1.0
    u, v = ([value / range_m**power for power, value in enumerate(axis)] for axis in (u, v))
    return _parametric(u, v, length_m, by_length=False)


def _parametric(u: Sequence[float], v: Sequence[float], length_m: float, *, by_length: bool) -> Curve:
    """Return a curve of two cubics of a parameter, which is about the distance along it.

    Parameters
    ----------
    u, v
        Coefficients.
    length_m
        Length of the curve.
    by_length
        True if the parameter is computed from the length along the curve; False if it is that length.
    """
    steps = np.linspace(0.0, length_m, max(2, min(math.ceil(length_m / _INTEGRATED_M), 100_000)))
    (_, du), (_, dv) = _polynomial(steps, u), _polynomial(steps, v)
    speeds = np.hypot(du, dv)
    lengths = np.concatenate([[0.0], np.cumsum((speeds[1:] + speeds[:-1]) / 2 * np.diff(steps))])

    def at(run: Floats) -> tuple[Floats, Floats, Floats]:
        parameter = np.interp(run, lengths, steps) if by_length else np.clip(run, 0.0, length_m)
        (at_u, along), (at_v, aside) = _polynomial(parameter, u), _polynomial(parameter, v)
        heading = np.arctan2(aside, along)
        beyond = run - np.clip(run, 0.0, length_m)
        return at_u + beyond * np.cos(heading), at_v + beyond * np.sin(heading), heading

    return at


_CURVES = {"line": _line, "arc": _arc, "spiral": _spiral, "poly3": _poly3, "paramPoly3": _param_poly3}
