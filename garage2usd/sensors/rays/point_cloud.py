"""Point clouds of LiDAR sweeps, and their files: PCD, KITTI's ``.bin`` and NumPy's ``.npz``."""

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class PointCloud:
    """The point cloud of a LiDAR sweep.

    Attributes
    ----------
    points_m
        Points in the sensor's axes: x forward, y left, z up; float32, shape (n, 3).
    intensity
        Returned light relative to a white diffuse surface at normal incidence, independent of range; float32, 0 to 1,
        shape (n,).
    instance
        Id of the object, as in the table of labels, 0 for none; uint32, shape (n,).
    class_id
        Id of its class, 0 for none; uint8, shape (n,).
    ring
        Index of the laser or row; uint16, shape (n,).
    beam
        Index of the ray within the sweep; uint32, shape (n,).
    time_s
        Time of the ray from that of the sweep, in traffic; float32, shape (n,). None for rays of one time.
    """

    points_m: NDArray[np.float32]
    intensity: NDArray[np.float32]
    instance: NDArray[np.uint32]
    class_id: NDArray[np.uint8]
    ring: NDArray[np.uint16]
    beam: NDArray[np.uint32]
    time_s: NDArray[np.float32] | None = None

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.points_m)


class CloudFormat(StrEnum):
    """File formats of point clouds."""

    PCD = "pcd"
    """Binary PCD of the Point Cloud Library: x, y, z, intensity, instance, class, ring."""
    KITTI = "bin"
    """Rows of x, y, z, intensity, as in KITTI; without instances and classes."""
    NPZ = "npz"
    """The arrays of a `PointCloud` by their names."""


POINT_ROW = np.dtype(
    [
        ("x", "<f4"),
        ("y", "<f4"),
        ("z", "<f4"),
        ("intensity", "<f4"),
        ("instance", "<u4"),
        ("class", "u1"),
        ("ring", "<u2"),
    ]
)
"""Record of a point with all its attributes, without padding."""

_ARRAYS = ("points_m", "intensity", "instance", "class_id", "ring", "beam", "time_s")


def write_cloud(cloud: PointCloud, path: Path, kind: CloudFormat) -> None:
    """Write a point cloud to a file, in the sensor's axes: x forward, y left, z up, in metres.

    Parameters
    ----------
    cloud
        The points.
    path
        The file, in an existing folder.
    kind
        Its format.
    """
    _WRITERS[kind](cloud, path)


def read_npz(path: Path) -> PointCloud:
    """Read a point cloud that was written as `CloudFormat.NPZ`."""
    with np.load(path) as arrays:
        return PointCloud(**{name: arrays[name] for name in _ARRAYS if name in arrays})


def point_rows(cloud: PointCloud) -> NDArray[np.void]:
    """Return a point cloud as rows of `POINT_ROW`, shape (n,)."""
    rows = np.empty(len(cloud), dtype=POINT_ROW)
    for axis, name in enumerate("xyz"):
        rows[name] = cloud.points_m[:, axis]
    rows["intensity"], rows["instance"] = cloud.intensity, cloud.instance
    rows["class"], rows["ring"] = cloud.class_id, cloud.ring
    return rows


def _write_pcd(cloud: PointCloud, path: Path) -> None:
    write_pcd(point_rows(cloud), path)


def write_pcd(rows: NDArray[np.void], path: Path) -> None:
    """Write records of points as a binary PCD file of the Point Cloud Library, with their fields."""
    fields = [(name, *_pcd_type(rows.dtype[name])) for name in rows.dtype.names or ()]
    names, sizes, types = (" ".join(column) for column in zip(*fields, strict=True))
    header = (
        f"# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {names}\nSIZE {sizes}\nTYPE {types}\n"
        f"COUNT {' '.join('1' * len(fields))}\nWIDTH {len(rows)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
        f"POINTS {len(rows)}\nDATA binary\n"
    )
    path.write_bytes(header.encode("ascii") + rows.tobytes())


def _pcd_type(dtype: np.dtype[Any]) -> tuple[str, str]:
    return str(dtype.itemsize), "F" if dtype.kind == "f" else "U"


def _write_kitti(cloud: PointCloud, path: Path) -> None:
    rows = np.column_stack([cloud.points_m, cloud.intensity]).astype("<f4")
    path.write_bytes(rows.tobytes())


def _write_npz(cloud: PointCloud, path: Path) -> None:
    with path.open("wb") as file:
        arrays = ((name, getattr(cloud, name)) for name in _ARRAYS)
        np.savez_compressed(file, **{name: array for name, array in arrays if array is not None})


_WRITERS = {CloudFormat.PCD: _write_pcd, CloudFormat.KITTI: _write_kitti, CloudFormat.NPZ: _write_npz}
