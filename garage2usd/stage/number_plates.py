"""Number plates as USDA text: one asset for each body, with texture coordinates for each car."""

from functools import lru_cache

from garage2usd.assets.countries import Country
from garage2usd.assets.number_plates import PLATE_STYLES, plate_coordinates
from garage2usd.reading.number_plates import CAR_OF_PLATE, PLATE_TEXT

__all__ = ["plate_text"]


def plate_text(text: str, car: str, country: Country = Country.NONE) -> str:
    """Text of the prim of a car's plates, without its place.

    Parameters
    ----------
    text
        Text on the plates.
    car
        Name of the car's prim, a sibling.
    country
        Country whose plate format is used.
    """
    return f'custom string {PLATE_TEXT} = "{text}"\ncustom rel {CAR_OF_PLATE} = <../{car}>\n{_letters(text, country)}'


@lru_cache(maxsize=1 << 12)
def _letters(text: str, country: Country) -> str:
    corners = ",".join(f"({u:.7g},{v:.7g})" for u, v in plate_coordinates(text, country).tolist())
    meshes = "".join(
        f'over "{name}"\n{{\ntexCoord2f[] primvars:st = [{corners}]\n}}\n' for name, _ in PLATE_STYLES[country].meshes
    )
    return f'over "Geom"\n{{\n{meshes}}}\n'
