"""Finishes in place of standard materials: tinted ones, and the user's textures."""

from collections.abc import Mapping
from dataclasses import replace

from garage2usd.assets import MATERIALS, Finish, OwnTexture, finished
from garage2usd.assets.colours import linear_rgb, material_colour
from garage2usd.assets.own_textures import own_shape
from garage2usd.config.look import AISLE, NATURAL, FloorLook
from garage2usd.config.map_names import Channel
from garage2usd.config.texture_sets import Role, TextureFolder, TextureSet, read_texture_sets

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
