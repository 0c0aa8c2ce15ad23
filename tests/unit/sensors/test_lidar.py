"""Rays of LiDAR and what comes back, against values worked out by hand on small stages."""

import math

import numpy as np
import pytest
from PIL import Image
from pxr import Sdf, Usd, UsdGeom, UsdShade, Vt

from garage2usd.common.errors import ConfigError, StageError
from garage2usd.reading.labels import read_labels
from garage2usd.scenes.surfaces import SurfaceLook
from garage2usd.sensors.rays.lidar import beams_of, measure, raster_beams, rosette_beams, scan, spinning_beams
from garage2usd.sensors.rays.moved_scene import joined
from garage2usd.sensors.rays.point_cloud import CloudFormat, read_npz, write_cloud
from garage2usd.sensors.rays.ray_scene import read_ray_scene
from garage2usd.sensors.rays.reflectance import MaterialClass, material_class, returned
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping

ANY_M = (0.0, 1000.0)


def wall(stage, path, x, *, label="", size=4.0):
    """A square across the x axis, facing the origin, its textures' coordinates from one corner to the other."""
    mesh = UsdGeom.Mesh.Define(stage, path)
    half = size / 2
    mesh.CreatePointsAttr([(x, -half, -half), (x, -half, half), (x, half, half), (x, half, -half)])
    mesh.CreateFaceVertexCountsAttr([4])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
    mesh.CreateSubdivisionSchemeAttr("none")
    coordinates = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(
        "st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.vertex
    )
    coordinates.Set(Vt.Vec2fArray([(0, 0), (1, 0), (1, 1), (0, 1)]))
    if label:
        mesh.GetPrim().CreateAttribute("semantics:labels:class", Sdf.ValueTypeNames.TokenArray).Set([label])
    return mesh.GetPrim()


def paint(stage, prim, name, *, opacity=1.0, texture=None):
    material = UsdShade.Material.Define(stage, f"/Looks/{name}")
    shader = UsdShade.Shader.Define(stage, f"/Looks/{name}/Surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    if texture is None:
        shader.CreateInput("opacity", Sdf.ValueTypeNames.Float).Set(opacity)
    else:
        reader = UsdShade.Shader.Define(stage, f"/Looks/{name}/Texture")
        reader.CreateIdAttr("UsdUVTexture")
        reader.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(str(texture))
        for channel, target, kind in (
            ("rgb", "diffuseColor", Sdf.ValueTypeNames.Color3f),
            ("a", "opacity", Sdf.ValueTypeNames.Float),
        ):
            reader.CreateOutput(channel, kind)
            shader.CreateInput(target, kind).ConnectToSource(reader.ConnectableAPI(), channel)
    UsdShade.MaterialBindingAPI.Apply(prim).Bind(material)


def in_memory(up="Y", metres=1.0):
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, metres)
    return stage


def met(stage, directions=((1.0, 0.0, 0.0),), **options):
    labels = read_labels(stage, None)
    scene = read_ray_scene(stage, labels, **options)
    hits = scene.cast(np.zeros(3), np.array(directions, dtype=float))
    paths = {number: path for path, number in labels.ids.items()}
    met_paths = [paths[scene.instance[number]] if number >= 0 else None for number in hits.triangle.tolist()]
    return hits.range_m.tolist(), met_paths


def test_the_nearest_solid_thing_is_met_through_panes_skies_and_what_is_left_out():
    stage = in_memory()
    wall(stage, "/Near", 2, label="sky")
    paint(stage, wall(stage, "/Pane", 3, label="pane"), "Pane", opacity=0.4)
    wall(stage, "/Ego", 4, label="car")
    wall(stage, "/Wall", 5, label="wall")
    wall(stage, "/Back", -5, label="wall")
    assert met(stage) == ([4.0], ["/Ego"])
    # the back of a wall stops a ray too, and nothing stops the last
    ways = [(1, 0, 0), (-1, 0, 0), (0, 1, 0)]
    assert met(stage, ways, without=["/Ego"]) == ([5.0, 5.0, math.inf], ["/Wall", "/Back", None])


def test_a_texture_says_where_a_sheet_is_looked_through(tmp_path):
    alpha = np.zeros((8, 8, 4), dtype=np.uint8)
    alpha[:4, :, 3] = 255  # the upper half, where v > 0.5
    Image.fromarray(alpha).save(tmp_path / "half.png")
    stage = in_memory()
    paint(stage, wall(stage, "/Sheet", 2, label="sheet"), "Sheet", texture=tmp_path / "half.png")
    wall(stage, "/Wall", 4, label="wall")
    # v grows along Y, u along Z
    ways = np.array([(2, 1, 0.3), (2, -1, 0.3)]) / np.linalg.norm([2, 1, 0.3])
    ranges, paths = met(stage, ways)
    assert paths == ["/Sheet", "/Wall"]
    assert ranges == pytest.approx([math.hypot(2, 1, 0.3), 2 * math.hypot(2, 1, 0.3)])


def test_a_sheet_is_cut_out_where_its_own_threshold_says(tmp_path):
    alpha = np.full((8, 8, 4), 100, dtype=np.uint8)  # 0.39, less than half
    Image.fromarray(alpha).save(tmp_path / "dim.png")
    for threshold, path in ((0.3, "/Sheet"), (0.4, "/Wall")):
        stage = in_memory()
        paint(stage, wall(stage, "/Sheet", 2, label="sheet"), "Sheet", texture=tmp_path / "dim.png")
        surface = UsdShade.Shader(stage.GetPrimAtPath("/Looks/Sheet/Surface"))
        surface.CreateInput("opacityThreshold", Sdf.ValueTypeNames.Float).Set(threshold)
        wall(stage, "/Wall", 4, label="wall")
        assert met(stage)[1] == [path]


def test_rays_pass_the_corner_that_a_polygon_leaves_free():
    stage = in_memory()
    mesh = UsdGeom.Mesh.Define(stage, "/Sheet")
    mesh.CreatePointsAttr([(2, y, z) for y, z in ((3, 0.5), (0.5, 0.5), (0.5, 3), (-3, 3), (-3, -3), (3, -3))])
    mesh.CreateFaceVertexCountsAttr([6])
    mesh.CreateFaceVertexIndicesAttr(list(range(6)))
    mesh.GetPrim().CreateAttribute("semantics:labels:class", Sdf.ValueTypeNames.TokenArray).Set(["sheet"])
    wall(stage, "/Wall", 4, label="wall", size=20)
    ways = np.array([(2, 1, 1), (2, -1, 1), (2, 1, -1), (2, 2.5, 2.5), (2, -2, -2)], dtype=float)
    _, paths = met(stage, ways / np.linalg.norm(ways, axis=1, keepdims=True))
    assert paths == ["/Wall", "/Sheet", "/Sheet", "/Wall", "/Sheet"]


def test_units_instances_and_points_of_instancers_count():
    stage = in_memory(up="Z", metres=0.01)
    wall(stage, "/Prototypes/Thing", 0, size=100)
    instancer = UsdGeom.PointInstancer.Define(stage, "/Points")
    instancer.GetPrim().CreateAttribute("semantics:labels:class", Sdf.ValueTypeNames.TokenArray).Set(["cone"])
    instancer.CreatePrototypesRel().SetTargets(["/Prototypes/Thing"])
    instancer.CreateProtoIndicesAttr([0, 0])
    instancer.CreatePositionsAttr([(300, 0, 0), (-700, 0, 0)])
    stage.OverridePrim("/Prototypes").SetSpecifier(Sdf.SpecifierClass)
    assert met(stage, [(1, 0, 0), (-1, 0, 0)]) == ([3.0, 7.0], ["/Points[0]", "/Points[1]"])


def test_a_stage_without_anything_solid_is_refused():
    with pytest.raises(StageError, match="nothing in it is solid"):
        met(in_memory())


def test_spinning_lasers_fire_from_ahead_to_the_left_the_highest_first():
    beams = spinning_beams([-10, 20], 4)
    assert beams.ring.tolist() == [0, 1] * 4
    up, down = math.radians(20), math.radians(-10)
    expected = [
        (math.cos(elevation) * ahead, math.cos(elevation) * left, math.sin(elevation))
        for ahead, left in ((1, 0), (0, 1), (-1, 0), (0, -1))
        for elevation in (up, down)
    ]
    assert beams.directions == pytest.approx(np.array(expected))


def test_a_raster_begins_at_the_top_left_half_a_cell_from_the_edge():
    beams = raster_beams(60, 20, 3, 2)
    azimuth = np.degrees(np.arctan2(beams.directions[:, 1], beams.directions[:, 0]))
    elevation = np.degrees(np.arcsin(beams.directions[:, 2]))
    assert azimuth == pytest.approx([20, 0, -20] * 2)
    assert elevation == pytest.approx([5] * 3 + [-5] * 3)
    assert beams.ring.tolist() == [0, 0, 0, 1, 1, 1]


def test_a_rosette_goes_on_where_the_last_sweep_ended():
    whole = rosette_beams(70, 50, 200, begins_s=0.0, lasts_s=0.2)
    second = rosette_beams(70, 50, 100, begins_s=0.1, lasts_s=0.1)
    assert second.directions == pytest.approx(whole.directions[100:])
    assert not np.allclose(second.directions, whole.directions[:100], atol=0.05)


def test_ranges_are_cut_and_noise_goes_along_the_ray_by_seed():
    stage = in_memory()
    wall(stage, "/Wall", 5, label="wall", size=100)
    scene = read_ray_scene(stage, read_labels(stage, None))
    place = np.eye(4)
    place[:3, 3] = -5, 1, 2
    beams = raster_beams(100, 80, 60, 50)
    exact = scan(scene, beams, place, range_m=ANY_M)
    assert exact.points_m[:, 0] == pytest.approx(np.full(3000, 10.0), rel=1e-6)
    near = scan(scene, beams, place, range_m=(11.0, 12.0))
    reach = np.linalg.norm(near.points_m.astype(float), axis=1)
    assert 0 < len(near) < 3000
    assert 11 <= reach.min() < reach.max() <= 12 + 1e-6
    assert (exact.points_m[near.beam] == near.points_m).all()
    noisy = [
        scan(scene, beams, place, range_m=ANY_M, range_noise_m=0.02, seed=seed, sensor=sensor, sweep=sweep)
        for seed, sensor, sweep in ((1, "a", 0), (1, "a", 0), (2, "a", 0), (1, "b", 0), (1, "a", 1))
    ]
    assert (noisy[0].points_m == noisy[1].points_m).all()
    assert all(not np.allclose(noisy[0].points_m, other.points_m, atol=1e-4) for other in noisy[2:])
    off_m = np.linalg.norm(noisy[0].points_m.astype(float), axis=1) - np.linalg.norm(exact.points_m, axis=1)
    assert off_m.std() == pytest.approx(0.02, rel=0.05)
    assert abs(off_m.mean()) < 0.002
    assert np.cross(noisy[0].points_m, exact.points_m).ptp() < 1e-3
    # what is cut away does not move the noise of the others
    cut = scan(scene, beams, place, range_m=(11.0, 12.0), range_noise_m=0.02, seed=1, sensor="a")
    assert (cut.points_m == noisy[0].points_m[cut.beam]).all()


def test_a_turned_sensor_measures_in_its_own_axes():
    stage = in_memory()
    wall(stage, "/Wall", 5, label="wall", size=100)
    scene = read_ray_scene(stage, read_labels(stage, None))
    place = np.eye(4)
    # the sensor looks along -Z, the wall is at its right
    place[:3, :3] = np.array([[0, -1, 0], [0, 0, 1], [-1, 0, 0]])
    cloud = scan(scene, spinning_beams([0], 4), place, range_m=ANY_M)
    assert cloud.points_m == pytest.approx(np.array([(0, -5, 0)]), abs=1e-6)
    assert cloud.beam.tolist() == [3]


@pytest.mark.parametrize(
    ("look", "kind", "squarely", "at_60_deg"),
    [
        (SurfaceLook(name="WallConcrete"), "concrete", 0.35, 0.35 / 2),
        (SurfaceLook(name="FloorAsphaltPatched", colour_texture="a.jpg"), "asphalt", 0.17, 0.17 / 2),
        (SurfaceLook(name="CeilingInsulation", colour_texture="a.jpg"), "other", 0.425, 0.425 / 2),
        (SurfaceLook(name="NumberPlate"), "retroreflector", 1.0, 1.0),
        (SurfaceLook(name="Tyre", colour_rgb=(0.0, 0.0, 0.0)), "rubber", 0.04, 0.02),
        (SurfaceLook(name="SteelGalvanised", colour_texture="a.png"), "metal", 0.5, 0.5 * 0.4 / 2),
        (SurfaceLook(name="CarPaintWhite", colour_rgb=(1.0, 1.0, 1.0)), "lacquer", 0.8, 0.8 * 0.7 / 2),
        (SurfaceLook(name="Foreign", metallic=1.0), "metal", 0.5, 0.5 * 0.4 / 2),
        (SurfaceLook(name="Foreign", opacity=0.8), "glass", 0.1, 0.1 * 0.2 / 2),
        (SurfaceLook(colour_rgb=(0.0, 0.0, 0.0)), "other", 0.05, 0.025),
    ],
)
def test_intensity_follows_the_material_and_the_angle(look, kind, squarely, at_60_deg):
    assert material_class(look) == kind
    # the mirrored ray is 2 x 60 degrees away, where there is no lobe
    assert returned(look, np.cos(np.radians([0.0, 60.0]))) == pytest.approx([squarely, at_60_deg])


def test_every_class_of_material_is_used():
    from garage2usd.assets import MATERIALS, pascal_case

    used = {material_class(SurfaceLook(name=pascal_case(key))) for key in MATERIALS}
    assert used | {MaterialClass.OTHER} == set(MaterialClass)


def test_materials_that_look_alike_keep_their_classes():
    stage = in_memory()
    paint(stage, wall(stage, "/A", 5, label="wall"), "Tyre")
    paint(stage, wall(stage, "/B", -5, label="wall"), "NumberPlate")
    scene = read_ray_scene(stage, read_labels(stage, None))
    cloud = scan(scene, spinning_beams([0], 2), np.eye(4), range_m=ANY_M)
    assert cloud.intensity.tolist() == pytest.approx([0.04 + 0.46 * 0.18, 1.0])


def test_kitti_and_npz_hold_every_point(tmp_path):
    stage = in_memory()
    wall(stage, "/Wall", 5, label="wall", size=100)
    scene = read_ray_scene(stage, read_labels(stage, None))
    cloud = scan(scene, raster_beams(100, 80, 60, 50), np.eye(4), range_m=ANY_M, range_noise_m=0.02)
    for kind in CloudFormat:
        write_cloud(cloud, tmp_path / f"a.{kind}", kind)
        write_cloud(cloud, tmp_path / f"b.{kind}", kind)
        assert (tmp_path / f"a.{kind}").read_bytes() == (tmp_path / f"b.{kind}").read_bytes()
    rows = np.fromfile(tmp_path / "a.bin", dtype=np.float32).reshape(-1, 4)
    assert (rows[:, :3] == cloud.points_m).all()
    assert (rows[:, 3] == cloud.intensity).all()
    again = read_npz(tmp_path / "a.npz")
    assert cloud.time_s is None is again.time_s
    for name, values in vars(cloud).items():
        if values is None:
            continue
        found = getattr(again, name)
        assert found.dtype == values.dtype
        assert (found == values).all()


def solid_state(**settings):
    sensor = {"kind": "solid_state_lidar", "name": "a", "position_m": (0, 0, 1), "range_m": (0.1, 50.0)}
    size = {"horizontal_deg": 70.0, "vertical_deg": 50.0, "columns": 40, "rows": 30}
    return rig_from_mapping({"name": "own", "sensors": [{**sensor, **size, **settings}]}).lidars[0]


def test_lidars_of_rigs_send_the_rays_that_they_say():
    (spinning,) = read_rig("lidar_32").lidars
    beams = beams_of(spinning)
    assert len(beams.directions) == 32 * 2048
    elevations = np.degrees(np.arcsin(beams.directions[:32, 2]))
    assert elevations == pytest.approx(np.linspace(10.67, -30.67, 32))
    assert (beams_of(solid_state()).directions == raster_beams(70, 50, 40, 30).directions).all()
    third = beams_of(solid_state(pattern="rosette", rate_hz=5.0), sweep=2)
    assert (third.directions == rosette_beams(70, 50, 1200, begins_s=0.4, lasts_s=0.2).directions).all()


def test_a_scan_of_too_many_shots_is_refused():
    with pytest.raises(ConfigError, match="at most 4194304 shots"):
        solid_state(columns=8192, rows=8192)


def test_what_a_lidar_measures_is_a_scan_with_its_range_and_noise():
    stage = in_memory()
    wall(stage, "/Wall", 5, label="wall", size=100)
    scene = read_ray_scene(stage, read_labels(stage, None))
    sensor = solid_state(range_m=(5.5, 6.0), range_noise_m=0.1, name="front")
    cloud = measure(scene, sensor, np.eye(4), seed=3, sweep=4)
    options = {"range_m": (5.5, 6.0), "range_noise_m": 0.1, "seed": 3, "sensor": "front", "sweep": 4}
    expected = scan(scene, beams_of(sensor), np.eye(4), **options)
    assert 0 < len(cloud) < 1200
    assert (cloud.points_m == expected.points_m).all()


def test_what_moves_is_met_where_it_is():
    stage = in_memory()
    paint(stage, wall(stage, "/Wall", 5, label="wall", size=100), "WallConcrete")
    paint(stage, wall(stage, "/Ego/Body", 0, label="car", size=1), "NumberPlate")
    labels = read_labels(stage, None)
    scene = joined(read_ray_scene(stage, labels, without=["/Ego"]), read_ray_scene(stage, labels, only=["/Ego"]))
    away, turned = np.eye(4), np.eye(4)
    away[:3, 3] = 50, 0, 0
    # about Y by 90 degrees: the square lies along x, then stands at z = -3
    turned[:3, :3] = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]])
    turned[:3, 3] = 0.2, 0, -3
    looking = [(1, 0, 0), (0, 0, -1)]
    hits = scene.at(away).cast(np.zeros(3), np.array(looking, dtype=float))
    assert hits.range_m.tolist() == [5.0, math.inf]
    hits = scene.at(turned).cast(np.zeros(3), np.array(looking, dtype=float))
    assert hits.range_m.tolist() == [5.0, 3.0]
    assert [labels.classes[number].name for number in scene.class_id[hits.triangle].tolist()] == ["wall", "car"]
    place = np.eye(4)
    place[:3, :3] = np.array([[0, -1, 0], [0, 0, 1], [-1, 0, 0]])  # the sensor looks along -Z
    cloud = scan(scene.at(turned), spinning_beams([0], 4), place, range_m=ANY_M)
    assert cloud.instance.tolist() == [labels.ids["/Ego/Body"], labels.ids["/Wall"]]
    assert cloud.intensity.tolist() == pytest.approx([1.0, 0.35])
