import itertools

import numpy as np
import pytest
import shapely
from pxr import Usd, UsdGeom, UsdSemantics, UsdShade
from support.footprints import footprint
from support.sample_files import REPOSITORY, SAMPLES, SMALL_SAMPLES
from support.soak import soak_but

from garage2usd.config import GarageConfig
from garage2usd.layout import lay_out
from garage2usd.stage.prototypes import asset_of
from garage2usd.structure.grid import Cell, Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

OPEN = ".......\nE=====X\n......."
# the ground behind the exit is the garage's own, two squares on
POCKET = """
..........
E=====X#..
.......#..
.......#..
.......#..
"""


def laid_out(text, **fittings):
    config = GarageConfig(fittings=fittings)
    structure = Structure.from_arrays(cells_from_text(text, field="S"), 8.1, 8.1)
    return lay_out(structure, build_lane_graph(structure, config.bay), config)


def ground_of(layout):
    structure = layout.structure
    x, z = structure.column_edges_m, structure.row_edges_m
    return shapely.union_all(
        [shapely.box(x[c], z[r], x[c + 1], z[r + 1]) for r, c in np.argwhere(structure.cells != Cell.OBSTACLE).tolist()]
    )


@pytest.mark.parametrize("sample", soak_but(SMALL_SAMPLES, SAMPLES), ids=lambda path: path.stem)
def test_every_open_door_has_its_ramp_outside_the_garage(sample, builds):
    layout = builds(sample, "usdc").garage.layout
    doors = [place for place in layout.of_kind("portal") if place.spec.is_open]
    ramps, skies = layout.of_kind("ramp"), layout.of_kind("sky")
    assert len(doors) == len(ramps) == len(skies) == len(layout.of_kind("barrier"))
    for door, ramp, sky in zip(doors, ramps, skies, strict=True):
        assert (ramp.position_m, ramp.yaw_rad) == (door.position_m, door.yaw_rad) == (sky.position_m, sky.yaw_rad)
        assert footprint(ramp).intersection(ground_of(layout)).area < 1e-6
        assert footprint(ramp).distance(footprint(door)) < 1e-6


@pytest.mark.parametrize(("ceiling_m", "clear_m"), [(3.2, 2.2), (2.4, 2.2), (4.5, 2.4)])
def test_a_ramp_keeps_the_standard_s_slopes_and_the_clear_height(ceiling_m, clear_m):
    layout = laid_out(OPEN, ceiling_height_m=ceiling_m, clear_height_m=clear_m)
    spec = layout.of_kind("ramp")[0].spec
    slopes = [(r1 - r0, (y1 - y0) / (r1 - r0)) for (r0, y0), (r1, y1) in itertools.pairwise(spec.profile)]
    assert [slope for _, slope in slopes] == pytest.approx([0, 0.075, 0.15, 0.075, 0], abs=1e-6)
    assert min(slopes[1][0], slopes[3][0]) >= 3.6 - 1e-6
    assert spec.profile[-1][1] == pytest.approx(ceiling_m + 0.3)
    runs, heights = zip(*spec.profile, strict=True)
    assert spec.cover_height_m - np.interp(spec.cover_end_m, runs, heights) >= clear_m - 1e-6


def test_a_door_without_room_for_a_ramp_stays_closed():
    layout = laid_out(POCKET)
    closed = [place for place in layout.of_kind("portal") if not place.spec.is_open]
    assert [place.spec.is_entrance for place in closed] == [False]
    assert len(layout.of_kind("ramp")) == 1
    assert "Door" in {part.name for part in asset_of(closed[0].spec).parts}


def test_gates_stand_beside_the_opening_and_raised_arms_above_the_clear_height():
    layout = laid_out(OPEN, ceiling_height_m=2.4)
    gates = layout.of_kind("barrier")
    assert [gate.spec.is_raised for gate in gates] == [True, False]
    for gate, door in zip(gates, layout.of_kind("portal"), strict=True):
        half = door.spec.door_width_m / 2 - 0.08
        lane = shapely.box(-100, door.position_m[2] - half, 200, door.position_m[2] + half)
        assert footprint(gate).intersection(lane).area < 1e-6
        assert footprint(gate).within(ground_of(layout))
        # the driver keeps the gate on the left: entering to +X on the -Z side, leaving to +X as well
        assert gate.position_m[2] < door.position_m[2]
    points = np.concatenate([part.points for part in asset_of(gates[0].spec).parts if part.name.startswith("Red")])
    over_lane = points[points[:, 0] < -0.35]
    assert over_lane[:, 1].min() >= 2.2
    assert over_lane[:, 1].max() < 2.4


def test_ramps_and_gates_can_be_left_out():
    counts = laid_out(OPEN, barriers=False).counts()
    assert (counts["ramp"], counts["barrier"]) == (2, 0)
    counts = laid_out(OPEN, ramps=False).counts()
    assert (counts["ramp"], counts["sky"], counts["barrier"]) == (0, 0, 0)


def lit_faces(prim):
    """(colour, middle, way that it looks) of each lit sign of an object, by pxr alone; in metres."""
    for mesh in Usd.PrimRange(prim, Usd.TraverseInstanceProxies()):
        if not mesh.IsA(UsdGeom.Mesh):
            continue
        surface = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()[0].ComputeSurfaceSource()[0]
        red, green, _ = surface.GetInput("emissiveColor").Get() or (0.0, 0.0, 0.0)
        if max(red, green) < 2 * min(red, green) + 0.1:
            continue
        shape = UsdGeom.Mesh(mesh)
        to_world = np.array(UsdGeom.Xformable(mesh).ComputeLocalToWorldTransform(Usd.TimeCode.Default()))
        points = np.array(shape.GetPointsAttr().Get()) @ to_world[:3, :3] + to_world[3, :3]
        ends = np.cumsum(shape.GetFaceVertexCountsAttr().Get())[:-1]
        faces = [points[face] for face in np.split(np.array(shape.GetFaceVertexIndicesAttr().Get()), ends)]
        areas = [np.cross(face[1] - face[0], face[2] - face[0]) for face in faces]
        along = np.sum(areas, axis=0)
        yield "green" if green > red else "red", points.mean(axis=0), along / np.linalg.norm(along)


@pytest.mark.parametrize("sample", ["paper_7x9", "irregular"])
def test_lit_signs_are_green_for_those_who_may_pass_and_red_for_all_others(sample, builds):
    stage = Usd.Stage.Open(str(builds(REPOSITORY / "samples" / f"{sample}.toml", "usdc").stage))
    nodes = UsdGeom.BasisCurves(stage.GetPrimAtPath("/Garage/LaneGraph/Nodes"))
    ends = np.cumsum(nodes.GetCurveVertexCountsAttr().Get())[:-1]
    middles = np.array([ring.mean(axis=0) for ring in np.split(np.array(nodes.GetPointsAttr().Get()), ends)])
    kinds = np.array(nodes.GetPrim().GetAttribute("garage:lane:kind").Get())
    portals = np.isin(kinds, ["entrance", "exit"])
    seen = []
    for prim in Usd.PrimRange(stage.GetPrimAtPath("/Garage"), Usd.TraverseInstanceProxies()):
        labels = UsdSemantics.LabelsAPI(prim, "class").GetLabelsAttr().Get() or ()
        if "vehicle_door" not in labels:
            continue
        for colour, place, ahead in lit_faces(prim):
            nearest = np.linalg.norm(middles[portals] - place, axis=1).argmin()
            inwards = middles[portals][nearest] - place
            side = "inside" if inwards @ ahead > 0 else "outside"
            seen.append((str(kinds[portals][nearest]), side, colour))
    assert sorted(seen) == [
        ("entrance", "inside", "red"),
        ("entrance", "outside", "green"),
        ("exit", "inside", "green"),
        ("exit", "outside", "red"),
    ]


@pytest.mark.parametrize("side", [-1.0, 1.0], ids=["left", "right"])
def test_chevrons_of_kerbs_meet_at_the_edge_on_both_sides(side):
    ramp = laid_out(OPEN).of_kind("ramp")[0].spec
    kerb = next(part for part in asset_of(ramp).parts if part.name == ("LeftKerb" if side < 0 else "RightKerb"))
    corners, st = kerb.points[kerb.face_indices].astype(float), kerb.st[kerb.st_indices]
    face = np.repeat(np.arange(len(kerb.face_counts)), kerb.face_counts)
    ups = kerb.normals[kerb.normal_indices][:, 1]
    edge = np.abs(corners[:, 0]).min()
    for number in np.unique(face).tolist():
        own = face == number
        if kerb.normals[kerb.normal_indices][own][:, 2].max() > 0.99:
            continue  # the kerb's end
        run = -corners[own][:, 2]
        height = corners[own][:, 1] - np.interp(run, *zip(*ramp.profile, strict=True))
        # from the edge, where both faces meet, stripes run the same way over the top and down the side
        away = np.where(ups[own] > 0.5, np.abs(corners[own][:, 0]) - edge, height.max() - height)
        assert st[own] == pytest.approx(np.stack([run, away], axis=1) / 0.6, abs=1e-3)
