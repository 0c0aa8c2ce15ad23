"""Binary format of a scene sent to the page: a JSON header, then arrays.

``G2UV``, the header's length in bytes as uint32 (little endian), the header padded with blanks to a multiple of four
bytes, and the arrays, each aligned to four bytes. The header refers to each array by ``{"at", "count"}`` in elements of
its type.
"""

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets import MATERIALS
from garage2usd.assets.colours import material_colour
from garage2usd.assets.light import EXPOSURE_EV
from garage2usd.driving.tracks import Tracks
from garage2usd.garage import Stall
from garage2usd.reading.lanes import GUIDE_LIFT_M, Lanes
from garage2usd.view.viewer.reading import collider_lines
from garage2usd.view.viewer.scene import Scene, Shape, moved

_MAGIC = b"G2UV"
_ALIGNMENT = 4


def encode_scene(scene: Scene, tracks: Tracks | None = None) -> bytes:
    """Encode a scene, and tracks to play in it, in the format that the page reads (``web/src/scene_file.ts``)."""
    buffers = _Buffers()
    shapes = _shapes(scene.shapes, buffers)
    labels = list(scene.counts())
    paths, squares = [placed.path for placed in scene.objects], sorted({placed.square for placed in scene.objects})
    square_of = {square: number for number, square in enumerate(squares)}
    label_of = {label: number for number, label in enumerate(labels)}
    matrices = np.array([placed.matrix for placed in scene.objects])
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
            "label": buffers.add(np.array([label_of[placed.label] for placed in scene.objects], np.uint32)),
            "square": buffers.add(np.array([square_of[placed.square] for placed in scene.objects], np.uint32)),
            "shape": buffers.add(np.array([placed.shape for placed in scene.objects], np.uint32)),
            "palette": buffers.add(np.array([placed.palette for placed in scene.objects], np.uint32)),
            # points are rows, so that the first three columns are the rows of the shader's matrix
            "matrix": buffers.add(matrices[:, :, :3].transpose(0, 2, 1).astype(np.float32)),
        },
        "lanes": _lanes(scene.lanes, buffers) if scene.lanes.nodes or scene.lanes.stalls else None,
        "tracks": None if tracks is None else _tracks(tracks, buffers),
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


def _tracks(tracks: Tracks, buffers: _Buffers) -> dict[str, Any]:
    """Header of tracks; appends times, poses and levels of all samples."""
    firsts = np.cumsum([0, *map(len, tracks)]).tolist()
    columns = ("time_s", "x_m", "y_m", "z_m", "yaw_rad", "pitch_rad")
    samples = np.concatenate(
        [
            np.empty((0, len(columns))),
            *(np.stack([getattr(track, name) for name in columns], axis=1) for track in tracks),
        ]
    ).astype(np.float32)
    levels = np.concatenate([np.empty(0, np.uint32), *(track.level.astype(np.uint32) for track in tracks)])
    return {
        "step": tracks.step_s,
        "duration": tracks.duration_s,
        "agents": [
            {
                "name": track.agent.name,
                "kind": track.agent.kind,
                "size": [track.agent.width_m, track.agent.height_m, track.agent.length_m],
                "rgb": material_colour(MATERIALS[f"car_paint_{track.agent.paint}"]) if track.agent.paint else None,
                "prim": track.agent.prim,
                "first": first,
                "count": len(track),
            }
            for track, first in zip(tracks, firsts[:-1], strict=True)
        ],
        "times": buffers.add(samples[:, 0]),
        "poses": buffers.add(samples[:, 1:]),
        "levels": buffers.add(levels),
    }


def _shapes(shapes: Sequence[Shape], buffers: _Buffers) -> dict[str, Any]:
    """Header of all shapes; appends their vertices and indices, translucent pieces last."""
    entries = []
    positions: list[NDArray[Any]] = []
    normals: list[NDArray[Any]] = []
    coordinates: list[NDArray[Any]] = []
    slots: list[NDArray[Any]] = []
    indices: list[NDArray[Any]] = []
    vertices = triangles = 0
    for shape in shapes:
        opaque: list[NDArray[np.uint32]] = []
        blended: list[NDArray[np.uint32]] = []
        first = 0
        for piece in shape.pieces:
            part, matrix = piece.mesh, piece.matrix
            turn = np.linalg.inv(matrix[:3, :3]).T if np.linalg.det(matrix[:3, :3]) else np.eye(3)
            directions = part.normals @ turn
            directions /= np.maximum(np.linalg.norm(directions, axis=1, keepdims=True), 1e-12)
            mirrored = np.linalg.det(matrix[:3, :3]) < 0
            corners = part.indices[:, [0, 2, 1]] if mirrored else part.indices
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
