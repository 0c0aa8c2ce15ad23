"""The well of helices between levels: walls, slab edges, helices, the floors where these cross, and lamps.

On each level walls stand around the blocks of the helices; they are guards of the openings in the slab too. Within a
block walls divide the corner, where a helix crosses itself, from the rest, and go along both sides of the helix.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from garage2usd.config import FittingsConfig
from garage2usd.config.look import WallsLook
from garage2usd.garage.ramp_lines import CoilLine, heights_along
from garage2usd.layout.ceiling.lighting import TUBE
from garage2usd.layout.placement import Placement, edge_yaw_rad, placed, rounded, to_world
from garage2usd.layout.shell.well import SLAB_M, Opening, Well, WellLane
from garage2usd.layout.tiles import CEILING_THICKNESS_M
from garage2usd.native import elementary
from garage2usd.objects.ceiling import CeilingSpec
from garage2usd.objects.coil import CoilSpec, CrossingSpec
from garage2usd.objects.kind import Point, Spec
from garage2usd.objects.wall import WallSpec
from garage2usd.structure.grid import Structure
from garage2usd.structure.helix import WALL_M, CoilBlock, Helix
from garage2usd.structure.stalls import Edge

_LAMP_PITCH_M = 6.0
_STEP_RAD = math.pi / 18
"""Turn between two points of a helix's lane."""
_INSIDE = "Middle"
_LAP_M = 0.02
"""Reach of a wall's end into the wall along a helix, so that no two faces lie in one plane."""


class _Span(NamedTuple):
    """A straight wall of a block: its ends along the wall, and the carriageway that may pass through it."""

    name: str
    ends_m: tuple[float, float]
    gap_m: tuple[float, float]
    is_open: bool


@dataclass(frozen=True, eq=False)
class _Block:
    """A block of a helix in the garage.

    Local coordinates (u, v) have their origin in the outer corner of the block; u runs along `CoilBlock.way`, v along
    `CoilBlock.aside`.
    """

    name: str
    block: CoilBlock
    is_down: bool
    line: CoilLine
    origin_m: Point
    sides_m: tuple[float, float]

    @classmethod
    def of(cls, name: str, block: CoilBlock, structure: Structure, wall_m: float) -> "_Block":
        row, col = block.corner
        towards = {block.way, block.aside}
        x = structure.column_edges_m[col + (Edge.LEFT in towards)]
        z = structure.row_edges_m[row + (Edge.UP in towards)]
        along, across = block.sides_m(structure)
        sides = round(sum(along), 6), round(sum(across), 6)
        line = block.line(structure, wall_m)
        return cls(name, block, name == "Down", line, (float(x), float(z)), sides)

    @property
    def turn(self) -> int:
        """1 if v runs along the local +X of an object that looks along u, else -1."""
        x, z = to_world((1.0, 0.0), (0.0, 0.0), edge_yaw_rad(self.block.way))
        down, right = self.block.aside.beyond((0, 0))
        return 1 if x * right + z * down > 0 else -1

    def to_world(self, u: float, v: float) -> Point:
        """Return the (x, z) in the garage of a local point."""
        return rounded(to_world((self.turn * v, u), self.origin_m, edge_yaw_rad(self.block.way)))

    def placed(self, name: str, spec: Spec, u: float, v: float, *, faces: Edge, height_m: float = 0.0) -> Placement:
        """Place an object at a local point with its +Z towards an edge of a square."""
        return placed(name, spec, self.to_world(u, v), height_m=height_m, yaw_rad=edge_yaw_rad(faces))

    def yaw_rad(self, along_u: float, along_v: float) -> float:
        """Return the yaw that turns +Z to a local direction."""
        x, z = to_world((self.turn * along_v, along_u), (0.0, 0.0), edge_yaw_rad(self.block.way))
        return round(float(elementary.arctan2(x, z)), 9)

    def profile(self, rise_m: float, gentle_m: float) -> tuple[Point, ...]:
        """Return the (distance, height) pairs along the helix."""
        return self.line.profile(rise_m, gentle_m, foot_first=not self.block.head_is_first)


@dataclass(frozen=True, eq=False)
class CoilWell(Well):
    """The well of two helices."""

    pair: Helix

    def walls(self, structure: Structure, fittings: FittingsConfig, look: WallsLook) -> list[Placement]:
        """Place the walls around blocks and crossings, and the edge of the slab over openings."""
        height = round(fittings.ceiling_height_m if self.is_top else self.building.storey_m, 6)
        plain = WallSpec(1.0, height, self.wall_m, look.dado_m, look.has_stripe)
        bare = replace(plain, thickness_m=WALL_M, dado_m=0.0, has_stripe=False)
        over = replace(bare, thickness_m=self.wall_m, height_m=round(height - fittings.ceiling_height_m, 6))
        found: list[Placement] = []
        for one in self._blocks(structure):
            line, (length, depth) = one.line, one.sides_m
            half, (corner_u, corner_v) = line.width_m / 2, line.corner
            first = line.first_v_m - half, line.first_v_m + half
            last = line.last_u_m - half, line.last_u_m + half
            opens_first, opens_last = self._opens(one.block)
            way, aside = one.block.way, one.block.aside
            for span, across_m, along_v, faces, spec in (
                (_Span("First", (0.0, depth), first, opens_first), 0.0, True, way.opposite, plain),
                (_Span("Last", (0.0, length), last, opens_last), 0.0, False, aside.opposite, plain),
                (_Span("End", (0.0, depth), first, is_open=False), length, True, way, plain),
                (_Span(f"{_INSIDE}First", (0.0, corner_v), first, opens_first), corner_u, True, way.opposite, bare),
                (_Span(f"{_INSIDE}Last", (0.0, corner_u), last, opens_last), corner_v, False, aside.opposite, bare),
            ):
                is_inside = span.name.startswith(_INSIDE)
                pieces = [(name, ends, spec, 0.0) for name, ends in _pieces(span, _LAP_M if is_inside else 0.0)]
                if span.is_open and not is_inside and over.height_m > 0:
                    pieces.append(("Over", span.gap_m, over, fittings.ceiling_height_m))
                for name, (start, end), shape, low in pieces:
                    own = replace(shape, length_m=round(end - start, 6))
                    middle = (start + end) / 2
                    u, v = (across_m, middle) if along_v else (middle, across_m)
                    title = f"Wall_Well_{span.name}{name}{one.name}"
                    found.append(one.placed(title, own, u, v, faces=faces, height_m=low))
        return found

    def openings(self, structure: Structure) -> list[Opening]:
        """Return the openings to the helices whose foot is on this level."""
        if self.is_top:
            return []
        found = []
        for one in self._blocks(structure):
            line, block = one.line, one.block
            if block.head_is_first:
                place, faces = one.to_world(line.last_u_m, 0.0), block.aside.opposite
            else:
                place, faces = one.to_world(0.0, line.first_v_m), block.way.opposite
            found.append(Opening(one.name, place, faces, line.width_m))
        return found

    def beside_floors(self, walls: list[Placement]) -> list[Placement]:
        """Return the walls around the blocks, without inner walls and pieces over openings."""
        return [wall for wall in walls if _INSIDE not in wall.name and not wall.position_m[1]]

    def ramps(self, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
        """Place the helices whose foot is on this level, and the floor of this level where they cross."""
        found = []
        building = self.building
        for one in self._blocks(structure):
            corner_u, corner_v = one.line.corner
            flat = CrossingSpec(corner_v, corner_u, SLAB_M)
            way = one.block.way
            found.append(one.placed(f"Crossing_{one.name}", flat, corner_u / 2, corner_v / 2, faces=way))
            if self.is_top:
                continue
            clear_m, top_m = building.storey_m - SLAB_M, 2 * building.storey_m
            if self.level == 1:  # the walls end at the top ceiling
                clear_m = top_m = building.storey_m + fittings.ceiling_height_m
            spec = CoilSpec(
                one.line,
                one.profile(building.storey_m, building.ramp_transition_m),
                one.turn,
                SLAB_M,
                WALL_M,
                round(clear_m, 6),
                round(top_m, 6),
            )
            found.append(one.placed(f"Ramp_{one.name}", spec, 0.0, 0.0, faces=way))
        return found

    def ceilings(self, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
        """Place the ceilings over the blocks on the top level."""
        if not self.is_top:
            return []
        found = []
        for one in self._blocks(structure):
            length, depth = one.sides_m
            spec = CeilingSpec(depth, length, CEILING_THICKNESS_M)
            found.append(
                one.placed(
                    f"Ceiling_Well_{one.name}",
                    spec,
                    length / 2,
                    depth / 2,
                    faces=one.block.way,
                    height_m=fittings.ceiling_height_m,
                )
            )
        return found

    def tubes(self, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
        """Place tube lights over the crossings, and over helices: on the top ceiling, else on the helix above."""
        building = self.building
        found = []
        for one in self._blocks(structure):
            under = fittings.ceiling_height_m if self.is_top else building.storey_m - SLAB_M
            middle = one.line.last_u_m, one.line.first_v_m
            name = f"Tube_Well_{one.name}_0"
            found.append(one.placed(name, TUBE, *middle, faces=one.block.way, height_m=round(under, 6)))
            if self.level == 1:
                continue
            profile = one.profile(building.storey_m, building.ramp_transition_m)
            start, end = profile[1][0], profile[-2][0]
            count = max(1, round((end - start) / _LAMP_PITCH_M))
            runs = start + (np.arange(count) + 0.5) * (end - start) / count
            places, heights = one.line.at(runs), heights_along(profile, runs)
            for number, (u, v, along_u, along_v, rise) in enumerate(zip(*places, heights, strict=True), start=1):
                over = under if self.is_top else under + float(rise)
                found.append(
                    placed(
                        f"Tube_Well_{one.name}_{number}",
                        TUBE,
                        one.to_world(float(u), float(v)),
                        height_m=round(over, 6),
                        yaw_rad=one.yaw_rad(float(along_u), float(along_v)),
                    )
                )
        return found

    def lanes(self, structure: Structure) -> list[WellLane]:
        """Return the carriageways of the helix down and of the one up from the level above to this one."""
        building = self.building
        found = []
        for one in self._blocks(structure):
            profile = one.profile(building.storey_m, building.ramp_transition_m)
            inner = one.line.stations_m(profile, step_rad=_STEP_RAD)
            runs = np.concatenate([[0.0], inner, [one.line.length_m]])
            heights = heights_along(profile, runs).round(6)
            places = one.line.at(runs)
            points = [
                (x, float(height), z)
                for u, v, height in zip(places.u_m, places.v_m, heights, strict=True)
                for x, z in [one.to_world(float(u), float(v))]
            ]
            if one.is_down is not one.block.head_is_first:
                points.reverse()
            slope = one.line.inner_slope(building.storey_m, building.ramp_transition_m)
            found.append(WellLane(tuple(points), one.line.width_m, one.line.length_m, slope))
        return found

    def _blocks(self, structure: Structure) -> Iterator[_Block]:
        for name, block in zip(("Down", "Up"), self.pair.blocks, strict=True):
            yield _Block.of(name, block, structure, self.wall_m)

    def _opens(self, block: CoilBlock) -> tuple[bool, bool]:
        """Return True for the first and for the last straight of a helix if cars pass through it on this level."""
        head, foot = not self.is_bottom, not self.is_top
        return (head, foot) if block.head_is_first else (foot, head)


def _pieces(span: _Span, lap_m: float) -> Iterator[tuple[str, tuple[float, float]]]:
    """Yield the pieces of a wall beside its opening."""
    (start, end), (low, high) = span.ends_m, span.gap_m
    if not span.is_open:
        yield "", (start, end)
        return
    yield "Low", (start, low - lap_m)
    yield "High", (high + lap_m, end)
