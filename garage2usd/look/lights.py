"""Lights of a look: drawn values, and the finish of the sky at doors."""

from dataclasses import replace

from garage2usd.assets import MATERIALS, Finish, Rgb
from garage2usd.config.look import Daylight, LampKind, LightsLook
from garage2usd.look.axes import Group

__all__ = ["drawn_lights", "light_finishes"]

_SKIES: dict[Daylight, tuple[Rgb, Rgb]] = {
    Daylight.SUN: ((10.5, 12.6, 16.8), (0.8, 0.85, 0.9)),
    Daylight.DUSK: ((0.62, 0.36, 0.40), (0.10, 0.09, 0.12)),
    Daylight.NIGHT: ((0.010, 0.011, 0.016), (0.004, 0.004, 0.005)),
}
"""Radiance and colour of the sky for clear, dusk and night skies; the clear one is four times the overcast one."""


def drawn_lights(axes: Group) -> LightsLook:
    """Draw lights: mostly cold tubes, a few of them dead."""
    return LightsLook(
        lamps=axes.one_of("lamps", {LampKind.TUBES: 0.75, LampKind.PANELS: 0.13, LampKind.ROUND: 0.12}),
        temperature_k=axes.one_of(
            "temperature_k",
            {3000.0: 0.05, 3500.0: 0.07, 4000.0: 0.3, 4500.0: 0.1, 5000.0: 0.2, 5700.0: 0.1, 6500.0: 0.18},
        ),
        spread_k=axes.one_of("spread_k", {0.0: 0.5, 100.0: 0.2, 300.0: 0.2, 800.0: 0.1}),
        dead_share=axes.one_of("dead_share", {0.0: 0.45, 0.05: 0.25, 0.15: 0.2, 0.4: 0.1}),
        emergency_only=axes.one_of("emergency_only", {False: 0.96, True: 0.04}),
        daylight=axes.one_of(
            "daylight", {Daylight.OVERCAST: 0.4, Daylight.SUN: 0.25, Daylight.DUSK: 0.1, Daylight.NIGHT: 0.25}
        ),
    )


def light_finishes(lights: LightsLook) -> dict[str, Finish]:
    """Finish of the sky at doors instead of an overcast one."""
    if lights.daylight not in _SKIES:
        return {}
    radiance_rgb, colour_rgb = _SKIES[lights.daylight]
    sky = replace(MATERIALS["daylight"], emissive_rgb=radiance_rgb, colour_rgb=colour_rgb)
    return {"daylight": Finish("daylight", sky)}
