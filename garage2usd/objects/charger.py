"""Charging posts for electric cars, with their cables and the guards before them."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces, tube_faces
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, TilePart, rectangle

KIND = Kind("charger", number=22, label="charger", cityscapes="static", part=TilePart.PARKING)

_HALF_M, CHARGER_BACK_M = 0.14, 0.045
"""Half the width of the post, and half its depth."""
_TUBE_M, _GUARD_HALF_M, _GUARD_TOP_M = 0.03, 0.2, 0.68
"""Radius of the guard's tube, and half the width and the height of its middle line."""
_GUARD_Z_M = 0.105
CHARGER_FRONT_M = _GUARD_Z_M + _TUBE_M
"""Distance from the middle of the post to the front of its guard."""
_BEND_M = 0.06
_CABLE_M, _CABLE_Z_M = 0.012, 0.058
_PLUG_X_M = 0.08


@dataclass(frozen=True)
class ChargerSpec(Spec, kind=KIND):
    """A slim charging post facing +Z behind a tubular guard; origin in the middle of the post's foot."""

    def asset(self) -> Asset:
        """Make the meshes of a charging post: body, lit screen, connector in its holster, cable, and guard."""
        x, front = _HALF_M, CHARGER_BACK_M
        body = box_faces((-x, 0.0, -front), (x, 1.45, front))
        band = box_faces((-x, 1.25, front), (x, 1.38, front + 0.003), without="n")
        screen = box_faces((-0.09, 1.02, front), (0.09, 1.18, front + 0.003), without="n")
        holster = box_faces((_PLUG_X_M - 0.04, 0.84, front), (_PLUG_X_M + 0.04, 0.95, front + 0.03), without="n")
        plug = box_faces((_PLUG_X_M - 0.025, 0.79, front + 0.002), (_PLUG_X_M + 0.025, 0.9, front + 0.05))
        # from the body's gland in a loop to the connector
        loop = [(-0.08, 0.56), (-0.08, 0.4), (-0.055, 0.31), (0.0, 0.28), (0.055, 0.31), (0.08, 0.4), (0.08, 0.8)]
        cable = tube_faces([(across, up, _CABLE_Z_M) for across, up in loop], _CABLE_M, segments=6)
        gland = box_faces((-0.1, 0.53, front), (-0.06, 0.59, front + 0.028), without="n")
        return Asset(
            (
                make_part("Body", body, "housing_white", collider=Collider.BOX),
                make_part("Band", band, "sign_green"),
                make_part("Screen", screen, "screen_glow"),
                make_part("Holster", holster, "steel_dark"),
                make_part("Connector", plug, "rubber_black"),
                make_part("Cable", [*gland, *cable], "rubber_black"),
                make_part("Guard", _guard(), "machine_yellow", collider=Collider.CONVEX_HULL),
            ),
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the charging post with its guard."""
        half = _GUARD_HALF_M + _TUBE_M
        return (rectangle(-half, -CHARGER_BACK_M, half, CHARGER_FRONT_M),)


def _guard() -> list[Face]:
    """Return the faces of a hoop of steel tube with a bar between its legs."""
    x, top, bend = _GUARD_HALF_M, _GUARD_TOP_M, _BEND_M
    hoop = [(-x, 0.0), (-x, top - bend), (bend - x, top), (x - bend, top), (x, top - bend), (x, 0.0)]
    bar = tube_faces([(-x, top / 2, _GUARD_Z_M), (x, top / 2, _GUARD_Z_M)], 0.7 * _TUBE_M, segments=6)
    return [*tube_faces([(across, up, _GUARD_Z_M) for across, up in hoop], _TUBE_M, segments=8), *bar]
