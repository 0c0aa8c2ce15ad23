"""A GLB read with nothing but json and numpy, and what it must agree with a stage on, which pxr alone reads."""

import json
import re
import struct
import zipfile
from collections import defaultdict

import numpy as np
from pxr import Usd, UsdGeom, UsdShade
from scipy.spatial import KDTree

from garage2usd.assets import MATERIALS, pascal_case
from support.places import MILLIMETRE

WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
TYPES = {5121: np.dtype("<u1"), 5123: np.dtype("<u2"), 5125: np.dtype("<u4"), 5126: np.dtype("<f4")}
UNIT = 1e-3
CORNERS = (-1, 1), (1, 1), (1, -1), (-1, -1)
"""Mouth left, mouth right, rear right, rear left; a driver who drives in looks to -Z at a yaw of 0."""
WEIGHTS = np.array([1, 1, 1, 0.1, 0.1, 0.1])
"""A normal that is off by 0.01 is as bad as a place that is off by a millimetre."""
NARROW_M, BAND_OFF_M, MOST_TILT_RAD = 0.0305, 1.05e-3, 0.18
"""Height of a triangle, that by the tilt of its normals, and their tilt, below which they need not be kept."""


ALIKE = {
    pascal_case(key): pascal_case(next(other for other in MATERIALS if MATERIALS[other] == material))
    if not key.startswith("car_paint")
    else "CarPaint"
    for key, material in MATERIALS.items()
}
"""By the name of a material that of the first which looks as it does: a GLB has one of them. The paint of a car is that
of its variant, and so looks as the paint of that name does, which two-wheelers have."""


class Glb:
    """The JSON of a file, and its arrays and images by number."""

    def __init__(self, data):
        magic, version, length = struct.unpack_from("<III", data)
        assert (magic, version, length) == (0x46546C67, 2, len(data))
        size, kind = struct.unpack_from("<II", data, 12)
        assert kind == 0x4E4F534A
        self.json = json.loads(data[20 : 20 + size])
        if len(data) > 20 + size:
            binary, kind = struct.unpack_from("<II", data, 20 + size)
            assert (kind, 28 + size + binary) == (0x004E4942, len(data))
        self.buffer = memoryview(data)[28 + size :]
        self._shapes = {}
        self.parents = {child: number for number, node in enumerate(self.nodes) for child in node.get("children", [])}

    @property
    def nodes(self):
        return self.json["nodes"]

    def view(self, number):
        view = self.json["bufferViews"][number]
        return self.buffer[view.get("byteOffset", 0) : view.get("byteOffset", 0) + view["byteLength"]]

    def array(self, number):
        accessor = self.json["accessors"][number]
        kind, width = TYPES[accessor["componentType"]], WIDTHS[accessor["type"]]
        start, count = accessor.get("byteOffset", 0), accessor["count"] * width
        values = np.frombuffer(self.view(accessor["bufferView"]), kind, count, start).reshape(-1, width)
        return values / np.iinfo(kind).max if accessor.get("normalized") else values

    def matrix(self, number):
        """From a node's space to the world, for columns."""
        node = self.nodes[number]
        x, y, z, w = node.get("rotation", (0, 0, 0, 1))
        turn = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        )
        matrix = np.eye(4)
        matrix[:3, :3] = turn * node.get("scale", (1, 1, 1))
        matrix[:3, 3] = node.get("translation", (0, 0, 0))
        return self.matrix(self.parents[number]) @ matrix if number in self.parents else matrix

    def primitives(self, number):
        return self.json["meshes"][self.nodes[number]["mesh"]]["primitives"]

    def points(self, number):
        """All positions of a node's mesh in the world."""
        matrix = self.matrix(number)
        return self._shape(number)[0] @ matrix[:3, :3].T + matrix[:3, 3]

    def corners(self, number):
        """Which of these are the corners of each triangle; shape (n, 3)."""
        return self._shape(number)[1]

    def _shape(self, number):
        """All positions of a node's mesh in its own space, and the corners of its triangles."""
        mesh = self.nodes[number]["mesh"]
        if mesh not in self._shapes:
            points = [self.array(own["attributes"]["POSITION"]) for own in self.primitives(number)]
            corners = [self.array(own["indices"]).reshape(-1, 3).astype(int) for own in self.primitives(number)]
            self._shapes[mesh] = _joined(points, corners)
        return self._shapes[mesh]


def _joined(points, corners):
    """Points of several meshes as one, and the corners of all of their triangles among them."""
    starts = np.cumsum([0, *map(len, points)])
    moved = [own + start for own, start in zip(corners, starts[:-1], strict=True)]
    return np.concatenate(points), np.concatenate(moved)


def assert_like_the_stage(data, stage_path, labels):
    """A GLB has the objects of a stage where they are, with their classes, ids, meshes and images."""
    glb, stage = Glb(data), Usd.Stage.Open(str(stage_path))
    number_of = {node["name"]: number for number, node in enumerate(glb.nodes)}
    assert len(number_of) == len(glb.nodes)
    objects = {entry["path"]: entry for entry in labels}
    assert objects.keys() == {name for name, number in number_of.items() if "mesh" in glb.nodes[number]}
    seen, meshes, prototypes, judged = _Drawn(), defaultdict(set), set(), set()
    for path, entry in objects.items():
        number, prim = number_of[path], stage.GetPrimAtPath(path)
        node = glb.nodes[number]
        assert (node["extras"]["class"], node["extras"]["id"]) == (entry["class"], entry["id"])
        prototype = str(prim.GetPrototype().GetPath()) if prim.IsInstance() else path
        if prim.IsInstanceProxy():
            prototype = str(prim.GetPrimInPrototype().GetPath())
        meshes[prototype].add(node["mesh"])
        prototypes.add(prototype)
        points, triangles = seen.shape(prim, prototype)
        found = glb.points(number)
        assert np.abs(_bounds(found) - _bounds(points)).max() < MILLIMETRE, path
        _assert_same_volume(found[glb.corners(number)], triangles, np.ptp(points, axis=0).max(), path)
        if node["mesh"] not in judged:
            judged.add(node["mesh"])
            _assert_same_look(glb, number, points, *seen.looks(prim))
    assert all(len(own) == 1 for own in meshes.values())
    assert len(judged) == len(glb.json["meshes"]) <= len(prototypes)
    _assert_sound_primitives(glb)
    if stage_path.suffix == ".usdz":
        with zipfile.ZipFile(stage_path) as package:
            files = [package.read(name) for name in package.namelist() if name.endswith((".png", ".jpg"))]
        assert sorted(bytes(glb.view(image["bufferView"])) for image in glb.json["images"]) == sorted(files)


def _assert_same_look(glb, number, points, drawn_materials, drawn_smooth):
    """All points are the same, and so are materials, what is seen from both sides, and what is smooth."""
    found, primitives = glb.points(number), glb.primitives(number)
    assert _is_among(found, points)
    assert _is_among(points, found)
    materials = {
        (material["name"], material.get("doubleSided", False))
        for material in (glb.json["materials"][own["material"]] for own in primitives)
    }
    assert {(ALIKE.get(name, name), both) for name, both in materials} == {
        (ALIKE.get(name, name), both) for name, both in drawn_materials
    }
    turn = glb.matrix(number)[:3, :3]
    smooth = [
        np.hstack([glb.array(own["attributes"]["POSITION"]) @ turn.T, glb.array(own["attributes"]["NORMAL"]) @ turn.T])
        for own in primitives
        if "NORMAL" in own["attributes"]
    ]
    if len(drawn_smooth):
        assert smooth
        here = np.concatenate(smooth) + np.hstack([glb.matrix(number)[:3, 3], np.zeros(3)])
        assert _is_among(drawn_smooth * WEIGHTS, here * WEIGHTS)


def _is_among(some, others):
    """Whether each place of one is a place of the others, within a millimetre."""
    return KDTree(others).query(some)[0].max() < MILLIMETRE


def _bounds(points):
    return np.stack([points.min(axis=0), points.max(axis=0)])


def _assert_same_volume(found, drawn, size_m, path):
    """Triangles, shape (n, 3, 3), enclose the volume of others, as exactly as single precision allows."""
    normals = _normals(drawn)
    # single precision over the area of the surface; both are taken from one middle, which need not be the same
    area, open_m2 = np.linalg.norm(normals, axis=1).sum(), np.linalg.norm(normals.sum(axis=0))
    error = 1e-4 * (area * size_m + 1e-6) + open_m2 * size_m
    assert abs(_volume(found, _normals(found)) - _volume(drawn, normals)) < error, path


def _normals(triangles):
    """Normals of triangles, twice as long as the area."""
    return np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])


def _volume(triangles, normals):
    """Signed volume within triangles, seen from their middle."""
    return ((triangles[:, 0] - triangles.mean(axis=(0, 1))) * normals).sum() / 6


class _Drawn:
    """What pxr's own traversal finds of all meshes at and below a prim, in the world, less what is labelled below."""

    def __init__(self):
        self.cache, self.known = UsdGeom.XformCache(), {}

    def _meshes(self, root):
        below = iter(Usd.PrimRange(root, Usd.TraverseInstanceProxies()))
        for prim in below:
            if prim != root and prim.HasAPI("SemanticsLabelsAPI", "class"):
                below.PruneChildren()
            elif prim.IsA(UsdGeom.Mesh) and UsdGeom.Imageable(prim).ComputePurpose() in {"default", "render"}:
                yield prim

    def _matrix(self, prim):
        """From a prim's space to the world, for rows."""
        return np.array(self.cache.GetLocalToWorldTransform(prim))

    def shape(self, root, prototype):
        """World places of the corners of its meshes, and the triangles; all of a prototype have the same within it."""
        key = prototype, UsdGeom.Imageable(root).ComputePurpose()
        if key not in self.known:
            to_root, points, corners = np.linalg.inv(self._matrix(root)), [], []
            for prim in self._meshes(root):
                own, triangles = _triangles_of(prim)
                matrix = self._matrix(prim) @ to_root
                used, own_corners = np.unique(triangles, return_inverse=True)
                points.append(own[used] @ matrix[:3, :3] + matrix[3, :3])
                corners.append(own_corners.reshape(-1, 3))
            self.known[key] = _joined(points, corners)
        points, corners = self.known[key]
        matrix = self._matrix(root)
        places = points @ matrix[:3, :3] + matrix[3, :3]
        return places, places[corners]

    def looks(self, root):
        """Materials with whether both sides are seen, and world places and normals of the smooth corners."""
        materials, smooth = set(), [np.zeros((0, 6))]
        for prim in self._meshes(root):
            material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0].GetPrim()
            # what it is made of, where its own name says what it usually is
            finish = material.GetAttribute("garage:material:finish")
            name = finish.Get() if finish else material.GetName()
            materials.add((name, bool(UsdGeom.Mesh(prim).GetDoubleSidedAttr().Get())))
            roughness = material.GetChild("Surface").GetAttribute("inputs:roughness").Get()
            is_matte = roughness is None or roughness >= 0.5
            smooth.append(_smooth_corners(prim, self._matrix(prim), is_matte=is_matte))
        return materials, np.concatenate(smooth)


def _triangles_of(prim):
    """Points of a mesh, and the corners of the triangles that its faces are fans of."""
    mesh = UsdGeom.Mesh(prim)
    counts, corners = (np.array(a.Get()) for a in (mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr()))
    return np.array(mesh.GetPointsAttr().Get(), dtype=float), corners[_fans(counts)]


def _fans(counts):
    """Numbers of the corners of the triangles that faces are fans of; shape (triangles, 3)."""
    fans = counts - 2
    first = np.repeat(np.cumsum(counts) - counts, fans)
    following = np.arange(1, fans.sum() + 1) - np.repeat(np.cumsum(fans) - fans, fans)
    return np.stack([first, first + following, first + following + 1], axis=1)


def _smooth_corners(prim, matrix, *, is_matte):
    """World place and normal of the corners of triangles whose normals are not the triangle's; shape (n, 6).

    Those of matte triangles so narrow that nobody sees whether they are smooth are left out.
    """
    mesh = UsdGeom.Mesh(prim)
    primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar("normals")
    if not primvar or primvar.GetInterpolation() != "faceVarying":
        return np.zeros((0, 6))
    normals = np.array(primvar.ComputeFlattened()) @ matrix[:3, :3]
    places = np.array(mesh.GetPointsAttr().Get(), dtype=float) @ matrix[:3, :3] + matrix[3, :3]
    own = places[np.array(mesh.GetFaceVertexIndicesAttr().Get())]
    fans = _fans(np.array(mesh.GetFaceVertexCountsAttr().Get()))
    sides = own[fans] - own[np.roll(fans, 1, axis=1)]
    facing = np.cross(sides[:, 1], -sides[:, 0])
    area = np.linalg.norm(facing, axis=1)
    cosine = (normals[fans] * facing[:, None]).sum(axis=2) / np.maximum(area, 1e-12)[:, None]
    height = area / np.linalg.norm(sides, axis=2).max(axis=1)
    tilt = np.arccos(np.clip(cosine, -1, 1)).max(axis=1)
    narrow = (height < NARROW_M) & (tilt * height < BAND_OFF_M) & (tilt < MOST_TILT_RAD)
    kept = (cosine < 0.999) & (area > 0)[:, None] & ~(narrow & is_matte)[:, None]
    return np.hstack([own[fans[kept]], normals[fans[kept]]])


def _assert_sound_primitives(glb):
    """Normals look out of their triangles, tangents lie across them along u, and coordinates are there for textures."""
    for mesh in glb.json["meshes"]:
        for primitive in mesh["primitives"]:
            attributes = {name: glb.array(number) for name, number in primitive["attributes"].items()}
            corners = glb.array(primitive["indices"]).reshape(-1, 3)
            points = attributes["POSITION"][corners].astype(float)
            areas = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
            material = glb.json["materials"][primitive["material"]]
            textures = {name for name in {**material, **material["pbrMetallicRoughness"]} if name.endswith("Texture")}
            assert ("TEXCOORD_0" in attributes) == bool(textures)
            assert ("TANGENT" in attributes) == ("normalTexture" in textures)
            if "NORMAL" in attributes:
                normals = attributes["NORMAL"]
                assert np.abs(np.linalg.norm(normals, axis=1) - 1).max() < UNIT
                outwards = (normals[corners].sum(axis=1) * areas).sum(axis=1)
                assert (outwards >= -1e-9).all()
            if "TANGENT" in attributes:
                _assert_tangents(attributes, corners, points)


def _assert_tangents(attributes, corners, points):
    tangents, normals = attributes["TANGENT"], attributes["NORMAL"]
    assert np.abs(np.linalg.norm(tangents[:, :3], axis=1) - 1).max() < UNIT
    assert np.abs((tangents[:, :3] * normals).sum(axis=1)).max() < UNIT
    # the way from corner to corner along which u, or v upwards, alone grows
    uv = attributes["TEXCOORD_0"][corners].astype(float) * (1, -1)
    sides, steps = points[:, 1:] - points[:, :1], uv[:, 1:] - uv[:, :1]
    spread = np.abs(np.linalg.det(steps)) >= 1e-9
    along_u, along_v = np.moveaxis(np.linalg.inv(steps[spread]) @ sides[spread], 1, 0)[:, :, None]
    tangent, side = tangents[corners[spread], :3], tangents[corners[spread], 3]
    assert ((tangent * along_u).sum(axis=2) > 0).all()
    assert (side * (np.cross(normals[corners[spread]], tangent) * along_v).sum(axis=2) > 0).all()


def stalls_of(report):
    """By id: number, use and corners (x, z) of each stall of a report."""
    stalls = {}
    for stall in report["levels"][0]["stalls"]:
        half = np.array([stall["width_m"], stall["length_m"]]) / 2
        sin, cos = np.sin(stall["yaw_rad"]), np.cos(stall["yaw_rad"])
        across, along = np.array([cos, -sin]), np.array([sin, cos])
        corners = [stall["centre_m"] + a * half[0] * across + b * half[1] * along for a, b in CORNERS]
        angle = stall.get("angle_rad", np.pi / 2)
        if angle == 0:  # the mouth is on the left of the car
            corners = [corners[3], corners[0], corners[1], corners[2]]
        elif angle < np.pi / 2 - 1e-6:
            # of which side the lane is on, the report tells by the square that the stall opens onto
            (row, column), (to_row, to_column) = stall["square"], stall["access_square"]
            lane = np.array([to_column - column, to_row - row])
            slope = np.sign(lane @ across) / np.tan(angle)
            rise = (half[1] + abs(slope) * half[0]) * along
            ends = [stall["centre_m"] + a * half[0] * (across - slope * along) for a in (-1, 1)]
            corners = [ends[0] + rise, ends[1] + rise, ends[1] - rise, ends[0] - rise]
        stalls[stall["name"]] = stall["number"], stall["use"], corners
    return stalls


def assert_stalls(data, report, labels):
    """The stall nodes say what the report says of its stalls, and the cars which they stand in, by their names."""
    glb, stalls = Glb(data), stalls_of(report)
    cars = {
        entry["path"]: re.sub(r".*/Tile_(r\d+_c\d+)/Car_(\d+)$", r"Stall_\1_\2", entry["path"])
        for entry in labels
        if entry["class"] == "car"
    }
    nodes = {node["name"]: (number, node) for number, node in enumerate(glb.nodes)}
    found = {name.partition("/")[2]: value for name, value in nodes.items() if name.startswith("stalls/")}
    assert found.keys() == stalls.keys()
    taken = {stall: car for car, stall in cars.items()}
    for name, (number, node) in found.items():
        said, (label, use, corners) = node["extras"]["stall"], stalls[name]
        assert (said["id"], said["number"], said["use"]) == (name, label, use)
        assert (said["occupied"], said.get("car")) == (name in taken, taken.get(name))
        assert np.abs(np.array(said["corners_m"])[:, [0, 2]] - corners).max() < MILLIMETRE
        matrix, corners = glb.matrix(number), np.array(corners)
        assert np.abs(matrix[[0, 2], 3] - corners.mean(axis=0)).max() < MILLIMETRE
        mouth = corners[:2].mean(axis=0) - corners[2:].mean(axis=0)
        assert np.abs(matrix[[0, 2], 2] - mouth / np.linalg.norm(mouth)).max() < UNIT
    named = {name: node["extras"]["stall"]["id"] for name, (_, node) in nodes.items() if _class(node) == "car"}
    assert named == cars
    grounds = {node["extras"]["stall"]["id"] for _, node in nodes.values() if _class(node) == "parking_stall"}
    assert grounds == stalls.keys()


def _class(node):
    return node.get("extras", {}).get("class")
