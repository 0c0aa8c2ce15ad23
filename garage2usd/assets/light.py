"""Light: the colour of lamps by their temperature, and the view transform from light to pictures."""

from functools import lru_cache

import numpy as np

from garage2usd.assets.materials import Rgb

USUAL_TEMPERATURE_K = 5200.0
USUAL_LAMP_RGB: Rgb = (1.0, 0.97, 0.92)
"""Linear colour of a lamp at `USUAL_TEMPERATURE_K`, seen by a camera balanced for such lamps."""
_PLACES = 4
_XYZ_TO_RGB = np.array([(3.2406, -1.5372, -0.4986), (-0.9689, 1.8758, 0.0415), (0.0557, -0.2040, 1.0570)])
"""Conversion from XYZ to linear sRGB, IEC 61966-2-1."""
VIEW_TRANSFORM = "AgX"
"""Its name in Blender; in three.js it is ``AgXToneMapping``."""
EXPOSURE_EV = 0.0
"""Exposure in stops of pictures that `garage2usd render` draws and of the viewer's."""


@lru_cache(maxsize=64)
def lamp_colour(temperature_k: float) -> Rgb:
    """Linear red, green and blue of a lamp, scaled to a maximum of 1.

    Parameters
    ----------
    temperature_k
        Colour temperature in kelvins, 1000 to 15000.

    Notes
    -----
    The colour of a black body by M. Krystek's formula (1985) in CIE 1960 u, v, with an error of at most 6e-5, as linear
    sRGB relative to `USUAL_TEMPERATURE_K`: the white balance of the camera is fixed.
    """
    ratio = _black_body(temperature_k) / _black_body(USUAL_TEMPERATURE_K) * USUAL_LAMP_RGB
    red, green, blue = (round(float(channel), _PLACES) for channel in ratio / ratio.max())
    return red, green, blue


def _black_body(temperature_k: float) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """Linear sRGB of a black body with a luminance of 1, clipped to the gamut."""
    t = temperature_k
    u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t**2) / (1 + 8.42420235e-4 * t + 7.08145163e-7 * t**2)
    v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t**2) / (1 - 2.89741816e-5 * t + 1.61456053e-7 * t**2)
    # u = 4 x / (12 y - 2 x + 3), v = 6 y / (12 y - 2 x + 3)
    x, y = 3 * u / (2 * u - 8 * v + 4), 2 * v / (2 * u - 8 * v + 4)
    return np.maximum(_XYZ_TO_RGB @ (x / y, 1.0, (1 - x - y) / y), 0.0)
