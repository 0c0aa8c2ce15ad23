"""Finishes in place of standard materials, tinted ones and the user's textures, and axes of a look with their draws."""

from collections.abc import Mapping
from dataclasses import replace
from typing import TypeVar

import numpy as np

from garage2usd.assets import MATERIALS, Finish, OwnTexture, finished
from garage2usd.assets.colours import linear_rgb, material_colour
from garage2usd.assets.own_textures import own_shape
from garage2usd.common.randomness import Step, named_generator
from garage2usd.config.look import AISLE, NATURAL, FloorLook, LookConfig
from garage2usd.config.map_names import Channel
from garage2usd.config.texture_sets import Role, TextureFolder, TextureSet, read_texture_sets
from garage2usd.native import elementary

_DARKEST = 1e-3
_KEYS = {
    Role.FLOOR: ("floor_concrete",),
    Role.STALL: ("stall_epoxy",),
    Role.WALL: ("wall_concrete",),
    Role.DADO: ("wall_band",),
    Role.CEILING: ("ceiling_concrete",),
    Role.COLUMN: ("column_concrete",),
    Role.PAINT: ("paint_stall", "paint_number", "paint_white"),
    Role.LANE_PAINT: ("paint_yellow",),
    Role.STEEL: ("steel_galvanised", "service_steel"),
}
"""Keys of the materials of each role."""
_ROUGHNESS = {Role.STALL: 0.4, Role.PAINT: 0.55, Role.LANE_PAINT: 0.55, Role.STEEL: 0.4}
"""Roughness without a map; that of concrete for other roles."""
_OF_CONCRETE = 0.75
_METALLIC = {Role.STEEL: 1.0}
Value = TypeVar("Value")
_BYTE = 255


def tinted(key: str, colour: str) -> Finish:
    """Tint a material to the mean colour ``#rrggbb``, limited by its texture's brightness; unchanged for 'natural'."""
    material = MATERIALS[key]
    if colour == NATURAL:
        return Finish(key, material)
    wanted = linear_rgb(colour)
    if material.colour_texture is None:
        return Finish(key, replace(material, colour_rgb=wanted))
    red, green, blue = (
        round(min(to / max(mean, _DARKEST), 1.0), 3) for to, mean in zip(wanted, material_colour(material), strict=True)
    )
    return Finish(key, replace(material, tint_rgb=(red, green, blue)))


def own_finishes(folder: TextureFolder, floor: FloorLook, finishes: Mapping[str, Finish]) -> dict[str, Finish]:
    """Make the finishes of the roles for which the user has textures.

    Parameters
    ----------
    folder
        The textures.
    floor
        Look of the floor; stalls with the aisle's floor use its textures, unless they have their own.
    finishes
        Finishes of the look, from which friction and non-visual properties are kept.

    Raises
    ------
    ConfigError
        If a file is invalid, or has changed since the settings were read.
    """
    _, sets = read_texture_sets(folder)
    if floor.bays == AISLE and Role.FLOOR in sets:
        sets = {Role.STALL: sets[Role.FLOOR], **sets}
    return {key: _finish(role, each, finished(key, finishes)) for role, each in sets.items() for key in _KEYS[role]}


def _finish(role: Role, maps: TextureSet, usual: Finish) -> Finish:
    of = dict(maps.maps)
    roughness, metallic = _ROUGHNESS.get(role, _OF_CONCRETE), _METALLIC.get(role, 0.0)
    packed = tuple((channel, file) for channel, file in maps.maps if channel not in {Channel.COLOUR, Channel.NORMAL})
    normal = of.get(Channel.NORMAL)
    along_m, up_m = maps.repeat_m
    if up_m is None:
        width, height = own_shape(of[Channel.COLOUR], role)
        up_m = round(along_m * height / width, 6)
    material = replace(
        usual.material,
        colour_texture=OwnTexture(role, ((Channel.COLOUR, of[Channel.COLOUR]),)),
        tint_rgb=(1.0, 1.0, 1.0),
        packed_texture=OwnTexture(role, packed, roughness, metallic) if packed else None,
        normal_texture=None if normal is None else OwnTexture(role, ((Channel.NORMAL, normal),)),
        roughness=roughness,
        metallic=metallic,
        repeat_m=along_m,
        repeat_up_m=up_m,
    )
    return Finish(usual.key, material)


class Axes:
    """Source of all axes of a look."""

    def __init__(self, look: LookConfig, seed: int) -> None:
        self._look, self._drawn, self._seed = look, frozenset(look.axes), seed

    def of(self, group: str) -> "Group":
        """Return the axes of one group."""
        section = getattr(self._look, group)
        given = {
            key: getattr(section, key) for key in type(section).model_fields if f"{group}.{key}" not in self._drawn
        }
        return Group(group, given, self._seed)


class Group:
    """Axes of one group: each method returns the value of an axis, drawn if it is not given."""

    def __init__(self, name: str, given: Mapping[str, object], seed: int) -> None:
        self._name, self._given, self._seed = name, given, seed

    def one_of(self, axis: str, weights: Mapping[Value, float]) -> Value:
        """Draw one of several values by relative weights."""
        if axis in self._given:
            return self._given[axis]  # type: ignore[return-value]
        return self._pick(self._generator(axis), weights)

    def colour(self, axis: str, weights: Mapping[str, float], *, tone: float = 0.0, hue: float = 0.0) -> str:
        """Draw one of several colours ``#rrggbb``, made darker or lighter.

        Parameters
        ----------
        axis, weights
            As for `one_of`; a value that is not a colour is returned unchanged.
        tone
            Standard deviation of the logarithm of a factor on all three channels.
        hue
            Standard deviation of the logarithm of a factor on each channel.
        """
        if axis in self._given:
            return str(self._given[axis])
        generator = self._generator(axis)
        colour = self._pick(generator, weights)
        factors = elementary.exp(generator.normal(0.0, tone) + generator.normal(0.0, hue, 3))
        if not colour.startswith("#"):
            return colour
        channels = np.array([int(colour[start : start + 2], 16) for start in (1, 3, 5)])
        red, green, blue = np.clip(np.rint(channels * factors), 0, _BYTE).astype(int).tolist()
        return f"#{red:02x}{green:02x}{blue:02x}"

    def between(self, axis: str, low: float, high: float, step: float) -> float:
        """Draw a multiple of `step` between two multiples of it, uniformly."""
        if axis in self._given:
            return float(self._given[axis])  # type: ignore[arg-type]
        steps = round((high - low) / step)
        return round(low + step * int(self._generator(axis).integers(steps + 1)), 6)

    def _generator(self, axis: str) -> np.random.Generator:
        return named_generator(self._seed, Step.LOOK, f"{self._name}.{axis}")

    @staticmethod
    def _pick(generator: np.random.Generator, weights: Mapping[Value, float]) -> Value:
        limits = np.cumsum(list(weights.values()))
        place = generator.random() * limits[-1]
        return list(weights)[int(np.searchsorted(limits, place, side="right"))]
