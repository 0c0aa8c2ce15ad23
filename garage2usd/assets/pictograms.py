"""Outlines of pictograms."""

import shapely

__all__ = ["running_man"]

_GRID = 1e-3


def running_man() -> shapely.Geometry:
    """Running person in a doorway, as on signs of ISO 7010: height 1, above the origin, second coordinate upwards."""
    strokes = [
        shapely.Point(-0.18, 0.80).buffer(0.09, quad_segs=3),  # head, body, arms and legs, then the doorway
        shapely.LineString([(-0.22, 0.66), (-0.30, 0.40)]).buffer(0.07, cap_style="flat"),
        shapely.LineString([(-0.50, 0.46), (-0.42, 0.62), (-0.22, 0.62), (-0.06, 0.50)]).buffer(
            0.035, cap_style="flat"
        ),
        shapely.LineString([(-0.30, 0.42), (-0.12, 0.34), (-0.14, 0.12)]).buffer(0.045, cap_style="flat"),
        shapely.LineString([(-0.30, 0.42), (-0.36, 0.22), (-0.58, 0.20)]).buffer(0.045, cap_style="flat"),
        shapely.box(0.22, 0.10, 0.62, 0.90),
    ]
    return shapely.union_all(strokes, grid_size=_GRID)
