"""Judge of signs in garages of several levels by the written stage: pxr, numpy, shapely and networkx."""

import re

import numpy as np
import shapely
from pxr import Usd, UsdGeom

from garage2usd.objects.signage import SIGNAGE
from support.lettering import outline, read
from support.level_judge import label_of

LEVELS = [f"U{number}" for number in range(1, 7)]
EXIT_SIGN_ROOM_M = 0.78
"""Least height between clear height and ceiling for exit signs."""
SIGNS = {"exit_sign", "lane_sign", "zone_plate"}


class Sign:
    """A sign of a stage: its class, level, square, place, the way that its reader looks, and the shapes on it."""

    def __init__(self, prim, place):
        self.label, self.path = label_of(prim), str(prim.GetPath())
        self.level = self.path.split("/")[3]
        found = re.search(r"Tile_r(\d+)_c(\d+)", self.path)
        self.square = tuple(map(int, found.groups())) if found else None
        assert np.linalg.det(place[:3, :3]) > 0, "mirrored"
        self.place, self.way = place[3, :3], -place[2, [0, 2]]
        self.shapes, self.low_m, self.high_m, self.width_m = {}, np.inf, -np.inf, 0.0
        for part in Usd.PrimRange(prim, Usd.TraverseInstanceProxies()):
            if part.IsA(UsdGeom.Mesh):
                mesh = UsdGeom.Mesh(part)
                points = np.array(mesh.GetPointsAttr().Get())
                faces = mesh.GetFaceVertexCountsAttr().Get(), mesh.GetFaceVertexIndicesAttr().Get()
                self.low_m = min(self.low_m, points[:, 1].min())
                self.high_m = max(self.high_m, points[:, 1].max())
                if np.ptp(points[:, 2]) < 1e-6:
                    self.shapes[part.GetName()] = outline(points, *faces)

    @property
    def text(self):
        """The level that it names; None if it names none."""
        return read(self.shapes["Name"], LEVELS) if "Name" in self.shapes else None

    @property
    def word(self):
        """The words beside or over the name; None without any."""
        words = {word for signage in SIGNAGE.values() for word in (signage.level, signage.exit)}
        return read(self.shapes["Word"], sorted(words)) if "Word" in self.shapes else None

    @property
    def arrow(self):
        """Unit vector (right, up) of its arrow as its reader sees it; None without one."""
        if "ArrowHead" in self.shapes:
            return _unit(self.shapes["ArrowHead"].centroid, self.shapes["ArrowShaft"].centroid)
        if "Arrow" not in self.shapes or self.text is None:
            return None
        # the head is the heavy end
        middle = shapely.box(*self.shapes["Arrow"].bounds).centroid
        return _unit(self.shapes["Arrow"].centroid, middle)

    @property
    def out(self):
        """The way (x, z) that its arrow shows to a reader on a level floor, as a pair of whole numbers."""
        right, up = self.arrow
        x, z = np.rint(self.way)
        return int(right * -z + up * x), int(right * x + up * z)


def _unit(to, since):
    away = np.array([to.x - since.x, to.y - since.y])
    return tuple(np.rint(away / np.abs(away).max()))


class SignJudge:
    """The signs of a stage, and the lanes that they hang over."""

    def __init__(self, judge):
        self.judge = judge
        cache = UsdGeom.XformCache()
        self.signs = [
            Sign(prim, np.array(cache.GetLocalToWorldTransform(prim)))
            for prim in judge.stage.Traverse(Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate))
            if prim.GetTypeName() == "Xform" and prim.HasAttribute("semantics:labels:class") and label_of(prim) in SIGNS
        ]
        nodes = judge.stage.GetPrimAtPath(f"{judge.stage.GetDefaultPrim().GetPath()}/LaneGraph/Nodes")
        rows, columns = (nodes.GetAttribute(f"garage:lane:{name}").Get() for name in ("row", "column"))
        squares = [*zip(rows, columns, strict=True)]
        self.node_at = {
            (judge.names[level], square): node
            for node, (level, square) in reversed([*enumerate(zip(judge.levels, squares, strict=True))])
        }
        self.exit_signs = {}
        for sign in self.signs:
            if sign.label == "exit_sign":
                x, z = np.rint(sign.way).astype(int)
                self.exit_signs[self.node_at[sign.level, sign.square], (int(x), int(z))] = sign.out

    def way(self, start, end):
        """The way (x, z) from a lane node to the next one, as a pair of whole numbers."""
        away = (self.judge.places[end] - self.judge.places[start])[[0, 2]]
        x, z = np.rint(away / np.linalg.norm(away))
        return int(x), int(z)

    def next_by(self, node, way):
        """The lane node that lies that way of another one."""
        (found,) = (other for other in self.judge.lanes.successors(node) if self.way(node, other) == way)
        return found

    def onward(self, start, end):
        """Where one drives on to from a lane node, without turning round."""
        return [node for node in self.judge.lanes.successors(end) if node != start]

    def signs_lead_to_the_street(self):
        """From every lane, in each direction, exit signs lead to an exit on the street, never over a ramp down.

        Who meets no sign drives on; at a dead end, or at a junction where the signs of the others show back to where he
        comes from, he turns.
        """
        lanes, places, kinds = self.judge.lanes, self.judge.places, self.judge.kinds
        for edge in lanes.edges:
            (last, node), has_read, height_m = edge, False, -np.inf
            for _ in range(2 * len(lanes.edges)):
                if has_read:
                    assert places[node][1] >= height_m - 1e-3, "a sign to a ramp down"
                    height_m = places[node][1]
                if kinds[node] == "exit":
                    break
                out = self.exit_signs.get((node, self.way(last, node)))
                onward = self.onward(last, node)
                if out is not None:
                    has_read, following = True, self.next_by(node, out)
                elif len(onward) == 1:
                    following = onward[0]
                elif not onward:
                    following = last
                else:
                    others = {out for (at, _), out in self.exit_signs.items() if at == node}
                    assert others == {self.way(node, last)}, f"no signs at {places[node]}"
                    following = last
                last, node = node, following
            assert kinds[node] == "exit", "round in circles"

    def levels_are_named(self, clear_m, ceiling_m):
        """Each ramp has a sign at its start that says where it leads, one that names the level at its end, and signs
        before it that lead to it; plates name their level too."""
        judge = self.judge
        hung = [sign for sign in self.signs if sign.label == "lane_sign" and sign.text]
        floors = [judge.places[judge.levels.index(number)][1] for number in range(len(judge.names))]
        for sign in hung:
            floor_m = floors[judge.names.index(sign.level)]
            assert sign.place[1] - floor_m + sign.low_m >= clear_m - 1e-4
            assert sign.place[1] - floor_m + sign.high_m <= ceiling_m + 1e-4
            assert all(shape.within(sign.shapes["Border"].convex_hull) for shape in sign.shapes.values())
        starts = {}
        for ramp in judge.ramps():
            rises = bool(ramp[-1][1] > ramp[0][1])
            level, to = (judge.names[int(np.argmin(np.abs(np.array(floors) - end[1])))] for end in (ramp[0], ramp[-1]))
            starts[level, to] = self.node_of(level, ramp[0])
            (over,) = (s for s in hung if s.level == level and _is_over(s, ramp[0], ramp[1] - ramp[0]))
            assert (over.text, over.arrow) == (to, (0, 1 if rises else -1))
            assert (over.word in {signage.exit for signage in SIGNAGE.values()}) is rises
            # signs of a junction right behind it have arrows
            arrivals = [s for s in hung if s.level == to and s.arrow is None]
            (there,) = (s for s in arrivals if _is_over(s, ramp[-1], ramp[-1] - ramp[-2]))
            assert there.text == to
            assert there.word in {signage.level for signage in SIGNAGE.values()}
            hung = [sign for sign in hung if sign not in {over, there}]
        for sign in hung:
            node = self.node_at[sign.level, sign.square]
            last, following = node, self.next_by(node, sign.out)
            while following != starts[sign.level, sign.text]:
                last, (following,) = following, self.onward(last, following)
        plates = [sign for sign in self.signs if sign.label == "zone_plate" and sign.text]
        assert all(sign.text == sign.level for sign in plates)
        return hung, plates

    def node_of(self, level, place):
        """The lane node at a place of a level."""
        far = np.linalg.norm(self.judge.places - place, axis=1)
        assert self.judge.names[self.judge.levels[int(far.argmin())]] == level
        return int(far.argmin())


def _is_over(sign, landing, way):
    """Whether a sign hangs in the half of a landing that lies before a driver, and faces him."""
    way = way[[0, 2]] / np.linalg.norm(way[[0, 2]])
    off = (sign.place - landing)[[0, 2]]
    ahead, aside = off @ way, abs(off @ [-way[1], way[0]])
    return 0 < ahead < 4.5 and aside < 2.0 and sign.way @ way > 0.99


def signs_are_right(judge, config):
    """Signs of a stage name its levels and lead to the street; only where these find no room are there none."""
    signs, fittings = SignJudge(judge), config.fittings
    if fittings.ceiling_height_m - fittings.clear_height_m >= EXIT_SIGN_ROOM_M:
        signs.signs_lead_to_the_street()
    else:
        assert not signs.exit_signs
    signs.levels_are_named(fittings.clear_height_m, fittings.ceiling_height_m)
