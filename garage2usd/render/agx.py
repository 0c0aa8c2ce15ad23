"""The view transform AgX, from linear light to the pixels of a picture.

By Troy Sobotka and Eary Chow, as in Blender and three.js: linear light in the primaries of ITU-R BT.2020 is
desaturated, its stops follow a curve, and it is saturated again.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.scenes.pictures import stored

_TO_2020 = np.array([[0.6274, 0.3293, 0.0433], [0.0691, 0.9195, 0.0113], [0.0164, 0.0880, 0.8956]])
_INSET = np.array(
    [
        [0.856627153315983, 0.0951212405381588, 0.0482516061458583],
        [0.137318972929847, 0.761241990602591, 0.101439036467562],
        [0.11189821299995, 0.0767994186031903, 0.811302368396859],
    ]
)
_OUTSET = np.array(
    [
        [1.1271005818144368, -0.11060664309660323, -0.016493938717834573],
        [-0.1413297634984383, 1.157823702216272, -0.016493938717834257],
        [-0.1413297634984383, -0.11060664309660294, 1.2519364065950405],
    ]
)
_BEFORE = (_INSET @ _TO_2020).T.astype(np.float32)
_OUTSET_ROWS, _TO_709 = _OUTSET.T.astype(np.float32), np.linalg.inv(_TO_2020).T.astype(np.float32)
_LEAST_EV, _MOST_EV = -12.47393, 4.026069
_LEAST_LIGHT, _GAMMA = 1e-10, 2.2
_CURVE = (
    *(0.0, 0.0001, 0.0001, 0.0041, 0.0274, 0.0367, 0.0502, 0.0672, 0.0883, 0.1147, 0.1478, 0.1904, 0.2458, 0.3168),
    *(0.405, 0.5046, 0.5996, 0.684, 0.7568, 0.8174, 0.8673, 0.9088, 0.9445, 0.975, 1.0),
)
"""At equal steps of the stops; measured at greys that Blender 5.0 wrote."""


def developed(light: NDArray[np.floating[Any]]) -> NDArray[np.uint8]:
    """Return the pixels of linear light of ITU-R BT.709's colours, shape (..., 3); uint8, of the same shape."""
    stops = np.log2(np.maximum(light.astype(np.float32) @ _BEFORE, np.float32(_LEAST_LIGHT)))
    places = (stops - _LEAST_EV) / (_MOST_EV - _LEAST_EV) * (len(_CURVE) - 1)
    shown = np.interp(places, np.arange(len(_CURVE)), _CURVE).astype(np.float32) @ _OUTSET_ROWS
    linear: NDArray[np.float32] = np.maximum(shown, 0) ** np.float32(_GAMMA) @ _TO_709
    return stored(linear, is_srgb=True)
