"""Variant sets of a garage: parked cars, lights, and the ceiling with its services."""

from collections.abc import Mapping
from typing import NamedTuple

from garage2usd.objects import KINDS
from garage2usd.objects.kind import VariantSet

POWER_SET = "power"
"""Variant set of every light's asset: ``on`` or ``off``."""
OCCUPIED = "garage:stall:occupied"
"""Attribute of a stall: whether a car is parked in it."""
BLOCKED_BY = "garage:stall:blockedBy"
"""Attribute of a stall: id of the stall whose misparked car blocks this one."""
OCCUPIED_STALL = "OccupiedStall"
"""Name of the class of all stalls with a car, while cars are shown."""


class Switch(NamedTuple):
    """Effect of a variant set of the garage on objects.

    Attributes
    ----------
    variant_set
        Name of the variant set.
    usual, other
        Its variants; the first is the default.
    metadata, attribute
        Opinions of the second variant on each object, as USDA text.
    class_name
        Name of the class from which the affected objects inherit.
    """

    variant_set: str
    usual: str
    other: str
    metadata: str
    attribute: str
    class_name: str


_SWITCHES = {
    VariantSet.OCCUPANCY: Switch("occupancy", "parked", "empty", "active = false\n", "", "Car"),
    VariantSet.LIGHTS: Switch("lights", "on", "off", f'variants = {{\nstring {POWER_SET} = "off"\n}}\n', "", "Light"),
    VariantSet.CEILING: Switch("ceiling", "shown", "hidden", "", 'token visibility = "invisible"\n', "Overhead"),
}
SWITCHES: Mapping[str, Switch] = {
    kind.name: switch for variant_set, switch in _SWITCHES.items() for kind in KINDS if kind.follows is variant_set
}
"""Variant set of each kind of object; all other kinds have none."""


class VariantTexts(NamedTuple):
    """USDA text of the variant sets of a prim: a part for its metadata and a part for its body."""

    metadata: str
    body: str


def variant_texts(
    classes: str, *, outlines: tuple[str, ...], stalls: int, are_blocked: bool, selected: bool
) -> VariantTexts:
    """Make the variant sets ``occupancy`` (parked, empty), ``lights`` (on, off) and ``ceiling`` (shown, hidden).

    Parameters
    ----------
    classes
        Name of the child prim with the class of each switch.
    outlines
        Names of the prims on the path from the child to the outlines of all stalls.
    stalls
        Number of stalls.
    are_blocked
        True if misparked cars block stalls; without cars, none is blocked.
    selected
        True to select the first variant of each. The first variants have no opinions, so that leaving the selection out
        gives the same objects; each selection slows the composition of every prim below, a fifth of the opening time of
        tens of thousands of prims.
    """
    switches = _SWITCHES.values()
    bodies = []
    for switch in switches:
        usual, other, beside = "", _over(switch.class_name, switch.metadata, switch.attribute), ""
        if switch.variant_set == VariantSet.OCCUPANCY:
            usual = _over(classes, "", _over(OCCUPIED_STALL, "", occupied_text(is_occupied=True)))
            other += _over(OCCUPIED_STALL, "", occupied_text(is_occupied=False))
            beside = f"custom int[] {OCCUPIED} = [{', '.join('0' * stalls)}]\n"
            beside += f"custom token[] {BLOCKED_BY} = []\n" if are_blocked else ""
            for name in reversed(outlines):
                beside = _over(name, "", beside)
        choices = f'"{switch.usual}" {{\n{usual}}}\n"{switch.other}" {{\n{_over(classes, "", other)}{beside}}}\n'
        bodies.append(f'variantSet "{switch.variant_set}" = {{\n{choices}}}\n')
    names = ", ".join(f'"{switch.variant_set}"' for switch in switches)
    metadata = f"prepend variantSets = [{names}]\n"
    if selected:
        selections = "".join(f'string {switch.variant_set} = "{switch.usual}"\n' for switch in switches)
        metadata = f"variants = {{\n{selections}}}\n{metadata}"
    return VariantTexts(metadata, "".join(bodies))


def occupied_text(*, is_occupied: bool) -> str:
    """Text of a stall's attribute for its occupancy."""
    return f"custom bool {OCCUPIED} = {str(is_occupied).lower()}\n"


def _over(name: str, metadata: str, body: str) -> str:
    return f'over "{name}" (\n{metadata})\n{{\n{body}}}\n'
