"""Number plates as USDA text: one asset for all cars of a body, of which each car chooses its texture coordinates."""

from functools import lru_cache

from garage2usd.assets.number_plates import plate_coordinates
from garage2usd.reading.number_plates import CAR_OF_PLATE, PLATE_TEXT

__all__ = ["plate_text"]


def plate_text(text: str, car: str) -> str:
    """What the prim of a car's plates says beside its place.

    Parameters
    ----------
    text
        To be read on them.
    car
        Name of the car's prim, which stands beside it.
    """
    return f'custom string {PLATE_TEXT} = "{text}"\ncustom rel {CAR_OF_PLATE} = <../{car}>\n{_letters(text)}'


@lru_cache(maxsize=1 << 12)
def _letters(text: str) -> str:
    corners = ", ".join(f"({u}, {v})" for u, v in plate_coordinates(text).astype(str).tolist())
    return f'over "Geom"\n{{\nover "Plates"\n{{\ntexCoord2f[] primvars:st = [{corners}]\n}}\n}}\n'
