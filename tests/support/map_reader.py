"""Maps of nav2 read as its map server reads them (nav2_map_server/src/map_io.cpp), with numpy alone."""

from dataclasses import dataclass

import numpy as np
import yaml

OCCUPIED, FREE, UNKNOWN = 100, 0, -1


@dataclass
class ReadMap:
    """Values by row from the lowest y on, and column; the lower left corner of the first cell, and a cell's side."""

    cells: np.ndarray
    origin: tuple
    side: float

    def middles(self):
        """x of each column and y of each row."""
        rows, columns = self.cells.shape
        return self.origin[0] + (np.arange(columns) + 0.5) * self.side, self.origin[1] + (
            np.arange(rows) + 0.5
        ) * self.side

    def within(self, low, high, inset=0.0):
        """The cells whose squares lie wholly between two corners (x, y)."""
        x, y = self.middles()
        half = self.side / 2 + inset
        columns = (x - half >= low[0]) & (x + half <= high[0])
        rows = (y - half >= low[1]) & (y + half <= high[1])
        return self.cells[np.ix_(rows, columns)]


def read_map(path):
    """A map's values: 0 to 100, -1 for unknown."""
    said = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert said["negate"] == 0
    data = (path.parent / said["image"]).read_bytes()
    magic, size, most, pixels = data.split(b"\n", 3)
    columns, rows = map(int, size.split())
    assert (magic, most, len(pixels)) == (b"P5", b"255", rows * columns)
    shade = np.arange(256)
    if said["mode"] == "raw":
        values = np.where(shade <= OCCUPIED, shade, UNKNOWN)
    else:
        assert said["mode"] == "trinary"
        darkness = 1 - shade / 255
        is_free = darkness < said["free_thresh"]
        values = np.where(darkness > said["occupied_thresh"], OCCUPIED, np.where(is_free, FREE, UNKNOWN))
    cells = values.astype(np.int8)[np.frombuffer(pixels, np.uint8).reshape(rows, columns)]
    x, y, yaw = said["origin"]
    assert yaw == 0
    return ReadMap(cells[::-1], (x, y), said["resolution"])
