"""Proven drives into and out of the stalls as guide curves, in a layer over a garage's stage."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from pxr import Kind, Sdf, UsdGeom

from garage2usd.driving import Manoeuvre, StallProof, Waypoint
from garage2usd.stage.authoring import attribute, define, new_layer, numbers, words
from garage2usd.stage.curves import author_curves

__all__ = ["write_driving_layer"]

_LIFT_M = 0.06
_LINE_WIDTH_M = 0.06
_STEP_M = 0.25


def write_driving_layer(
    path: Path, proofs: Sequence[StallProof], *, floors_m: Mapping[str, float] | None = None
) -> None:
    """Write a layer ``over /Garage`` with the curves ``Ways/In`` and ``Ways/Out``.

    Notes
    -----
    A curve is the path of the rear axle's centre for one proven stall, 0.06 m above the floor, whose height under each
    stall `floors_m` has by name; without it all are at 0. Attributes with one
    value per curve: ``garage:way:stall``, ``garage:way:nose`` (``in`` or ``out``), ``garage:way:clearance`` (metres).
    Attributes with one value per point: ``garage:way:arc`` (metres driven), ``garage:way:yaw`` (radians, 0 along -Z),
    ``garage:way:gear`` (1 or -1) and ``garage:way:curvature`` (1/m, positive to the driver's left).
    """
    with new_layer(path, default_prim="Garage") as layer:
        garage = Sdf.CreatePrimInLayer(layer, "/Garage")
        garage.specifier = Sdf.SpecifierOver
        group = define(layer, garage.path.AppendChild("Ways"), "Xform", kind=Kind.Tokens.group)
        attribute(group, "purpose", Sdf.ValueTypeNames.Token, UsdGeom.Tokens.guide, uniform=True)
        for name in ("In", "Out"):
            ways = [
                (proof, way)
                for proof in proofs
                if (way := proof.way_in if name == "In" else proof.way_out) is not None and proof.is_proven
            ]
            _author_ways(layer, group.path.AppendChild(name), ways, floors_m or {})


def _author_ways(
    layer: Sdf.Layer,
    path: Sdf.Path,
    ways: Sequence[tuple[StallProof, Manoeuvre]],
    floors_m: Mapping[str, float],
) -> None:
    sampled: list[list[Waypoint]] = [list(way.waypoints(_STEP_M)) for _, way in ways]
    counts = np.array([len(samples) for samples in sampled], dtype=np.int32)
    every = [at for samples in sampled for at in samples]
    line_m = np.array([(at.pose.x_m, at.pose.z_m) for at in every]).reshape(-1, 2)
    lifts_m = np.repeat([_LIFT_M + floors_m.get(proof.stall, 0.0) for proof, _ in ways], counts)
    prim = author_curves(layer, path, line_m, counts, lift_m=lifts_m, width_m=_LINE_WIDTH_M)
    words(prim, "garage:way:stall", (proof.stall for proof, _ in ways))
    words(prim, "garage:way:nose", (proof.nose.value if proof.nose else "" for proof, _ in ways))
    columns = {
        "clearance": [way.clearance_m for _, way in ways],
        "arc": [at.arc_m for at in every],
        "yaw": [math.remainder(at.pose.yaw_rad, math.tau) for at in every],
        "curvature": [at.curvature_per_m for at in every],
    }
    for name, values in columns.items():
        numbers(prim, f"garage:way:{name}", np.array(values, dtype=np.float32))
    numbers(prim, "garage:way:gear", np.array([at.gear.sign for at in every], dtype=np.int32))
