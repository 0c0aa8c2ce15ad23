"""Binary format of a scene sent to the page: a JSON header, then arrays.

``G2UV``, the header's length in bytes as uint32 (little endian), the header padded with blanks to a multiple of four
bytes, and the arrays, each aligned to four bytes. The header refers to each array by ``{"at", "count"}`` in elements of
its type.
"""

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.light import EXPOSURE_EV
from garage2usd.assets.skeletons import PARENTS
from garage2usd.garage import Stall
from garage2usd.reading.lanes import GUIDE_LIFT_M, Lanes
from garage2usd.stage.cameras import FRAMES_PER_SECOND
from garage2usd.stage.track_people import Gait, figure_of
from garage2usd.view.viewer.agents import ShownSkin, ShownTraffic
from garage2usd.view.viewer.reading import collider_lines
from garage2usd.view.viewer.scene import Scene, Shape, moved

_MAGIC = b"G2UV"
_ALIGNMENT = 4


def encode_scene(scene: Scene, traffic: ShownTraffic | None = None) -> bytes:
    """Encode a scene, and traffic to play in it, in the format that the page reads (``web/src/scene_file.ts``)."""
    buffers = _Buffers()
    skins = traffic.skins if traffic else {}
    shapes = _shapes(scene.shapes, skins, buffers)
    parts = [part for agent in traffic.agents for part in agent.parts] if traffic else []
    objects = [*scene.objects, *parts]
    labels = list(dict.fromkeys([*scene.counts(), *(part.label for part in parts)]))
    paths, squares = [placed.path for placed in scene.objects], sorted({placed.square for placed in objects})
    square_of = {square: number for number, square in enumerate(squares)}
    label_of = {label: number for number, label in enumerate(labels)}
    matrices = np.array([placed.matrix for placed in objects])
    header: dict[str, Any] = {
        "name": scene.name,
        "facts": dict(scene.facts),
        "remarks": list(scene.remarks),
        "exposure": 2.0**EXPOSURE_EV,
        "boundsM": np.round(scene.bounds_m, 4).tolist(),
        "levels": [{"name": level.name, "path": level.path} for level in scene.levels if not level.is_only],
        "labels": labels,
        "squares": squares,
        "textures": len(scene.textures),
        "surfaces": _surfaces(scene),
        "palettes": [list(palette) for palette in scene.palettes],
        "shapes": shapes,
        "objects": {
            "paths": paths,
            "ids": [scene.ids.get(path, 0) for path in paths],
            "label": buffers.add(np.array([label_of[placed.label] for placed in objects], np.uint32)),
            "square": buffers.add(np.array([square_of[placed.square] for placed in objects], np.uint32)),
            "shape": buffers.add(np.array([placed.shape for placed in objects], np.uint32)),
            "palette": buffers.add(np.array([placed.palette for placed in objects], np.uint32)),
            # points are rows, so that the first three columns are the rows of the shader's matrix
            "matrix": buffers.add(matrices[:, :, :3].transpose(0, 2, 1).astype(np.float32)),
        },
        "lanes": _lanes(scene.lanes, buffers) if scene.lanes.nodes or scene.lanes.stalls else None,
        "tracks": None if traffic is None else _tracks(traffic, len(paths), buffers),
        "arrays": buffers.places,
    }
    text = json.dumps(header, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % _ALIGNMENT)
    return b"".join([_MAGIC, len(text).to_bytes(4, "little"), text, *buffers.parts])


def encode_colliders(scene: Scene) -> bytes:
    """Encode the lines of each shape's colliders: a uint32 count of points per shape, then all points as float32."""
    lines = [[collider_lines(collider) for collider in shape.colliders] for shape in scene.shapes]
    counts = np.array([sum(2 * len(own) for own in shape) for shape in lines], dtype=np.uint32)
    return counts.tobytes() + b"".join(own.tobytes() for shape in lines for own in shape)


class _Buffers:
    """Arrays to be appended to the file."""

    def __init__(self) -> None:
        self.parts: list[bytes] = []
        self.places: list[dict[str, int]] = []
        self._bytes = 0

    def add(self, values: NDArray[Any]) -> int:
        """Append an array; return its index."""
        data = np.ascontiguousarray(values).tobytes()
        data += bytes(-len(data) % _ALIGNMENT)
        self.places.append({"at": self._bytes, "count": int(values.size)})
        self.parts.append(data)
        self._bytes += len(data)
        return len(self.places) - 1


def _tracks(traffic: ShownTraffic, objects: int, buffers: _Buffers) -> dict[str, Any]:
    """Header of tracks whose parts are numbered from `objects` on; appends times, poses and levels of all samples."""
    tracks = [agent.track for agent in traffic.agents]
    firsts = np.cumsum([0, *map(len, tracks)]).tolist()
    parts = np.cumsum([objects, *(len(agent.parts) for agent in traffic.agents)]).tolist()
    columns = ("time_s", "x_m", "y_m", "z_m", "yaw_rad", "pitch_rad", "steering_rad")
    samples = _joined(
        [
            np.stack([*(getattr(agent.track, name) for name in columns), agent.rolled_rad], axis=1)
            for agent in traffic.agents
        ],
        np.float32,
        len(columns) + 1,
    )
    return {
        "step": traffic.step_s,
        "duration": traffic.duration_s,
        "agents": [
            {
                "name": agent.track.agent.name,
                "kind": agent.track.agent.kind,
                "size": [agent.track.agent.width_m, agent.track.agent.height_m, agent.track.agent.length_m],
                "prim": agent.track.agent.prim,
                "first": first,
                "count": len(agent.track),
                "parts": [
                    {"object": number, "steers": "Front" in part.path, "rolls": part.path.endswith("Wheel")}
                    for number, part in enumerate(agent.parts, start)
                ],
                "gait": agent.gait and _gait(agent.gait, figure_of(agent.track.agent)[2], buffers),
            }
            for agent, first, start in zip(traffic.agents, firsts[:-1], parts[:-1], strict=True)
        ],
        "times": buffers.add(samples[:, 0]),
        "poses": buffers.add(samples[:, 1:]),
        "levels": buffers.add(_joined([track.level for track in tracks], np.uint32)),
    }


def _gait(gait: Gait, factor: float, buffers: _Buffers) -> dict[str, Any]:
    """Header of the poses of a person; appends their times, rotations of joints, and places of the hips."""
    return {
        "factor": factor,
        "times": buffers.add((gait.frames[gait.poses] / FRAMES_PER_SECOND).astype(np.float32)),
        "rotations": buffers.add(gait.motion.rotations.astype(np.float32)),
        "hips": buffers.add(gait.motion.hips_m.astype(np.float32)),
    }


def _shapes(shapes: Sequence[Shape], skins: Mapping[int, ShownSkin], buffers: _Buffers) -> dict[str, Any]:
    """Header of all shapes; appends their vertices and indices, translucent pieces last."""
    entries = []
    positions: list[NDArray[Any]] = []
    normals: list[NDArray[Any]] = []
    coordinates: list[NDArray[Any]] = []
    slots: list[NDArray[Any]] = []
    indices: list[NDArray[Any]] = []
    vertices = triangles = 0
    turns = iter(_turns(np.array([piece.matrix[:3, :3] for shape in shapes for piece in shape.pieces])))
    for number, shape in enumerate(shapes):
        opaque: list[NDArray[np.uint32]] = []
        blended: list[NDArray[np.uint32]] = []
        first = 0
        for piece in shape.pieces:
            part, matrix = piece.mesh, piece.matrix
            turn, is_mirrored = next(turns)
            directions = part.normals @ turn
            directions /= np.maximum(np.linalg.norm(directions, axis=1, keepdims=True), 1e-12)
            corners = part.indices[:, [0, 2, 1]] if is_mirrored else part.indices
            positions.append(moved(part.positions_m, matrix))
            normals.append(np.rint(directions * 127).astype(np.int8))
            coordinates.append(piece.coordinates)
            slots.append(np.full(len(part.positions_m), min(piece.slot, 255), np.uint8))
            (blended if piece.is_blended else opaque).append(corners + np.uint32(first))
            first += len(part.positions_m)
        ordered = [*opaque, *blended]
        indices += ordered
        count, opaque_count = (sum(len(group) for group in groups) for groups in (ordered, opaque))
        entries.append(
            {
                "vertices": [vertices, first],
                "opaque": [3 * triangles, 3 * opaque_count],
                "blended": [3 * (triangles + opaque_count), 3 * (count - opaque_count)],
                "colliders": len(shape.colliders),
                "skin": number in skins and _skin(skins[number], buffers),
                "doubleSided": any(piece.mesh.double_sided for piece in shape.pieces),
                "lights": [
                    {
                        "kind": light.kind,
                        "matrix": light.matrix[:, :3].T.ravel().tolist(),
                        "size": [light.width_m, light.height_m],
                        "rgb": list(light.colour_rgb),
                        "candela": light.candela,
                    }
                    for light in shape.lights
                ],
            }
        )
        vertices, triangles = vertices + first, triangles + count
    return {
        "entries": entries,
        "positions": buffers.add(_joined(positions, np.float32, 3)),
        "normals": buffers.add(np.pad(_joined(normals, np.int8, 3), ((0, 0), (0, 1)))),
        "coordinates": buffers.add(_joined(coordinates, np.float32, 2)),
        "slots": buffers.add(_joined(slots, np.uint8)),
        "indices": buffers.add(_joined(indices, np.uint32, 3)),
    }


def _turns(matrices: NDArray[np.float64]) -> list[tuple[NDArray[np.float64], bool]]:
    """Return for each matrix, shape (matrices, 3, 3), what turns normals up to a factor; True where it mirrors.

    The cofactors are the transposed inverse times the determinant. Inverses one by one wait for threads of BLAS, for
    seconds on a busy machine.
    """
    if not len(matrices):
        return []
    x, y, z = matrices.transpose(1, 0, 2)
    cofactors = np.stack([np.cross(y, z), np.cross(z, x), np.cross(x, y)], axis=1)
    signs = np.sign((x * cofactors[:, 0]).sum(axis=1))
    cofactors[signs == 0] = np.eye(3)
    return [(cofactor * (sign or 1), bool(sign < 0)) for cofactor, sign in zip(cofactors, signs, strict=True)]


def _skin(skin: ShownSkin, buffers: _Buffers) -> dict[str, Any]:
    return {
        "joints": buffers.add(skin.joints),
        "weights": buffers.add(skin.weights),
        "rest": skin.rest_m.round(6).tolist(),
        "parents": list(PARENTS),
    }


def _joined(parts: Sequence[NDArray[Any]], kind: type, *shape: int) -> NDArray[Any]:
    return np.concatenate(parts).astype(kind) if parts else np.zeros((0, *shape), kind)


def _surfaces(scene: Scene) -> list[dict[str, Any]]:
    return [
        {
            "rgb": list(surface.colour_rgb),
            "emissive": list(surface.emissive_rgb),
            "roughness": surface.roughness,
            "metallic": surface.metallic,
            "opacity": surface.opacity,
            "opacityThreshold": surface.opacity_threshold,
            "clearcoat": surface.clearcoat,
            "colourTexture": surface.colour_texture,
            "roughnessTexture": surface.roughness_texture,
            "roughnessChannel": surface.roughness_channel,
            "metallicTexture": surface.metallic_texture,
            "metallicChannel": surface.metallic_channel,
            "hasAlpha": surface.has_alpha,
        }
        for surface in scene.surfaces
    ]


def _lanes(lanes: Lanes, buffers: _Buffers) -> dict[str, Any]:
    middles = [(node.position[0], node.height_m + GUIDE_LIFT_M, node.position[1]) for node in lanes.nodes]
    return {
        "nodes": buffers.add(np.array(middles, np.float32)),
        "kinds": [node.kind for node in lanes.nodes],
        "levels": [node.level for node in lanes.nodes],
        "edges": buffers.add(np.array([(edge.start, edge.end) for edge in lanes.edges], np.uint32)),
        "forward": [edge.one_way for edge in lanes.edges],
        "stalls": [_stall(stall) for stall in lanes.stalls],
        "parkingStalls": sum(stall.takes_cars for stall in lanes.stalls),
    }


def _stall(stall: Stall) -> dict[str, Any]:
    corners = np.round(np.array(stall.corners, np.float32), 4).tolist()
    own = {"id": stall.name, "use": stall.use, "accessNode": stall.access, "level": stall.level}
    return {**own, **dict(stall.facts), "corners": corners}
