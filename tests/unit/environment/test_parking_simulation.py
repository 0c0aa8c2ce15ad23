"""The simulator of cars against shapely: contact, LiDAR and occupancy at random, and exact arcs."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from garage2usd.driving import DesignCar, Obstacles, Pose
from garage2usd.environment import ParkingTask
from garage2usd.environment.simulation import Simulation

CARS = (DesignCar(), DesignCar(4.69, 1.94, 2.8, 0.93, 1.6, 4.5))
AWAY = 1e-6


def ground(x, z, width, length):
    return shapely.box(x - width / 2, z - length / 2, x + width / 2, z + length / 2)


def scene(seed, count=40):
    """Random boxes, triangles, walls without a width and points around a car, and agents."""
    random = np.random.default_rng(seed)
    places, sizes = random.uniform(-14, 14, (count, 2)), random.uniform(0.1, 4.0, (count, 2))
    shapes = []
    for number, ((x, z), (length, width)) in enumerate(zip(places, sizes, strict=True)):
        corners = [(x, z), (x + length, z), (x + length, z + width), (x, z + width)]
        kind = (
            shapely.Polygon(corners),
            shapely.Polygon(corners[:3]),
            shapely.LineString(corners[::2]),
            shapely.Point(x, z),
        )
        shapes.append(shapely.affinity.rotate(kind[number % 4], random.uniform(0, 360)))
    start = Pose(*random.uniform(-6, 6, 2), random.uniform(-9, 9))
    moving = np.concatenate([random.uniform(-14, 14, (1, 5, 2)), random.uniform(-9, 9, (1, 5, 1))], axis=2)
    moving[0, 4] = np.nan
    named = ((str(number), shape) for number, shape in enumerate(shapes))
    task = ParkingTask(
        "random",
        CARS[seed % 2],
        start,
        Pose(*random.uniform(-6, 6, 3)),
        Obstacles.of(named),
        moving=moving,
        sizes_m=random.uniform(0.5, 4.0, (5, 2)),
    )
    agents = [
        shapely.affinity.rotate(ground(x, z, width, length), -np.degrees(yaw), origin=(x, z))
        for (x, z, yaw), (length, width) in zip(moving[0, :4], task.sizes_m[:4], strict=True)
    ]
    return task, shapely.union_all([*shapes, *agents]), [*shapes, *agents]


def begun(*tasks):
    simulation = Simulation(len(tasks))
    for number, task in enumerate(tasks):
        simulation.place(number, task)
    return simulation


def middle_of(task):
    x, z = np.mean(task.car.corners(task.start), axis=0)
    return shapely.Point(x, z)


def test_a_car_touches_what_shapely_says_it_touches():
    random, told = np.random.default_rng(0), []
    for seed in range(60):
        task, _, shapes = scene(seed, count=16)
        poses = [Pose(*random.uniform(-15, 15, 2), random.uniform(-4, 4)) for _ in range(20)]
        found = begun(*(replace(task, start=pose) for pose in poses)).touching()
        bodies = shapely.polygons([task.car.corners(pose) for pose in poses])
        apart_m = np.array([[shapely.distance(body, shape) for shape in shapes] for body in bodies]).min(axis=1)
        assert (found == (apart_m == 0)).all()
        told += found.tolist()
    assert 200 < sum(told) < 1000


def test_rays_end_where_shapely_says_they_end():
    hits = 0
    for seed in range(25):
        task, _, shapes = scene(seed)
        edges = shapely.union_all([shape if shape.geom_type != "Polygon" else shape.exterior for shape in shapes])
        origin, rays = middle_of(task), 72
        (found,) = begun(task).ranges_m(rays, 12.0)
        for ray, metres in enumerate(found.tolist()):
            yaw = task.start.yaw_rad + 2 * np.pi * ray / rays
            far = origin.x - 12 * np.sin(yaw), origin.y - 12 * np.cos(yaw)
            met = shapely.intersection(shapely.LineString([(origin.x, origin.y), far]), edges)
            expected = 12.0 if met.is_empty else origin.distance(met)
            assert metres == pytest.approx(expected, abs=AWAY), (seed, ray)
            hits += not met.is_empty
    assert hits > 500


def test_cells_are_filled_that_shapely_says_meet_an_obstacle():
    filled = 0
    for seed in range(12):
        task, everything, _ = scene(seed)
        (grids,) = begun(task).occupancy(20, 0.7)
        car = Pose(middle_of(task).x, middle_of(task).y, task.start.yaw_rad)
        sin, cos = np.sin(car.yaw_rad), np.cos(car.yaw_rad)
        goal = shapely.Polygon(task.car.corners(task.goal))
        for row in range(20):
            for column in range(20):
                ring = []
                for down, right in ((0, 0), (0, 1), (1, 1), (1, 0)):
                    ahead, left = 0.7 * (10 - row - down), 0.7 * (10 - column - right)
                    ring.append((car.x_m - sin * ahead - cos * left, car.z_m - cos * ahead + sin * left))
                cell = shapely.Polygon(ring)
                for grid, ground in zip(grids, (everything, goal), strict=True):
                    if cell.buffer(-AWAY).intersects(ground) == cell.buffer(AWAY).intersects(ground):
                        assert (grid[row, column] == 255) == cell.intersects(ground), (seed, row, column)
                        filled += int(grid[row, column] == 255)
    assert filled > 1000


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(st.floats(-2, 2), st.floats(-0.2, 0.2)), min_size=1, max_size=20),
    st.floats(-3, 3),
)
def test_cars_drive_exact_arcs(orders, yaw):
    open_ground = Obstacles.of([("far", shapely.Point(500, 500))])
    task = ParkingTask("open", CARS[0], Pose(1.0, 2.0, yaw), Pose(0, 0, 0), open_ground)
    simulation = begun(task, task)
    x, z, speed = 1.0, 2.0, 0.0
    for acceleration, curvature in orders:
        before = simulation.lot.poses[1].copy()
        crashed = simulation.drive(np.array([(acceleration, curvature)] * 2), np.array([True, False]))
        assert not crashed.any()
        assert (simulation.lot.poses[1] == before).all()  # it was not driven
        for _ in range(5):
            after = min(max(speed + acceleration * 0.04, -3.0), 3.0)
            length = (speed + after) / 2 * 0.04
            half = length * curvature / 2
            chord, way = length * np.sinc(half / np.pi), yaw + half
            x, z, yaw, speed = x - chord * np.sin(way), z - chord * np.cos(way), yaw + 2 * half, after
        assert simulation.lot.poses[0] == pytest.approx([x, z, yaw, speed], abs=1e-9)


def test_a_car_that_touches_stays_there():
    wall = Obstacles.of([("wall", shapely.box(-10, -14, 10, -13))])
    task = ParkingTask("wall", CARS[0], Pose(0, -8.9, 0), Pose(0, 0, 0), wall)
    simulation = begun(task)
    crashed = [bool(simulation.drive(np.array([(2.0, 0.0)]), np.ones(1, bool))[0]) for _ in range(4)]
    assert crashed == [False, False, False, True]
    _, z, _, speed = simulation.lot.poses[0]
    assert 9.4 <= -z < 9.4 + speed * 0.04
