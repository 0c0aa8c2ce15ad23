"""Tracks on plans: lines lie on the tracks of their level, each agent with its colour."""

import numpy as np
import pytest
import shapely
from support.hand_made_tracks import car, track_of, tracks_of, walker

from garage2usd.view.plan_tracks import track_lines


def test_lines_lie_on_the_tracks_of_each_level():
    times = np.arange(0, 20, 0.1)
    levels = np.where((times > 5) & (times < 12), 1, 0)
    drives = track_of(car("car_000"), times, x_m=8 * np.sin(times / 6), z_m=3 * times, level=levels)
    stands = track_of(car("car_001"), [0.0, 5.0], x_m=3.0)
    tracks = tracks_of(drives, stands, walker("person_000", (0, 0), (4, 0)))
    upper, lower = ([*track_lines(tracks, level)] for level in (0, 1))
    assert [line.kind for line in upper] == ["track car car_000", "track car car_000", "track person person_000"]
    assert [line.kind for line in lower] == ["track car car_000"]
    assert lower[0].colour == upper[0].colour != upper[2].colour
    on_lower = np.stack([drives.x_m, drives.z_m], axis=1)[levels == 1]
    assert shapely.LineString(lower[0].points).hausdorff_distance(shapely.LineString(on_lower)) < 0.021
    assert len(lower[0].points) < len(on_lower) / 2
    drawn_m = sum(shapely.LineString(line.points).length for line in (*upper[:2], *lower))
    assert drawn_m == pytest.approx(shapely.LineString(np.stack([drives.x_m, drives.z_m], axis=1)).length, abs=1.0)
