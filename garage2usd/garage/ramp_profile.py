"""The heights along a ramp between two levels."""

__all__ = ["ramp_profile"]


def ramp_profile(
    length_m: float, rise_m: float, gentle_m: float, ends_m: tuple[float, float]
) -> list[tuple[float, float]]:
    """Return (distance, height) pairs from the foot on: level end, half slope, slope, half slope, level end.

    Parameters
    ----------
    length_m, rise_m
        Length of the ramp as seen from above, and height from foot to head.
    gentle_m
        Length of each of the parts of half the slope.
    ends_m
        Lengths of the level ends at the foot and at the head.
    """
    sloped_m = length_m - sum(ends_m)
    slope = rise_m / (sloped_m - gentle_m)
    run, height = 0.0, 0.0
    profile = [(run, height)]
    for part_m, grade in (
        (ends_m[0], 0.0),
        (gentle_m, slope / 2),
        (sloped_m - 2 * gentle_m, slope),
        (gentle_m, slope / 2),
        (ends_m[1], 0.0),
    ):
        run, height = run + part_m, height + part_m * grade
        profile.append((run, height))
    return profile
