"""The view transform AgX, from linear light to the pixels of a picture.

By Troy Sobotka, as Blender has it; its curve is B. Wrensch's polynomial, which differs from it by less than 1e-3.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

_INSET = np.array(
    [
        [0.842479062253094, 0.0784335999999992, 0.0792237451477643],
        [0.0423282422610123, 0.878468636469772, 0.0791661274605434],
        [0.0423756549057051, 0.0784336, 0.879142973793104],
    ],
    dtype=np.float32,
)
_OUTSET = np.linalg.inv(_INSET).astype(np.float32)
_LEAST_EV, _MOST_EV = -12.47393, 4.026069
_CURVE = 15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232
"""From the sixth power down."""


def developed(light: NDArray[np.floating[Any]]) -> NDArray[np.uint8]:
    """The pixels of linear light of ITU-R BT.709's colours, shape (..., 3); uint8, of the same shape."""
    bent = np.maximum(light.astype(np.float32) @ _INSET.T, np.float32(1e-10))
    stops = np.clip((np.log2(bent) - np.float32(_LEAST_EV)) / np.float32(_MOST_EV - _LEAST_EV), 0, 1)
    shown = np.clip(np.polyval(np.array(_CURVE, np.float32), stops) @ _OUTSET.T, 0, 1)
    pixels: NDArray[np.uint8] = np.rint(shown * 255).astype(np.uint8)
    return pixels
