"""A garage of twelve squares, for checks that break one thing at a time."""

PLAN = """
....
E==X
....
"""
SETTINGS = {
    "seed": 2,
    "site": {"structure": PLAN},
    "bay": {"dimensioned": False},
    "parking": {"accessible_share": 0.1, "occupancy": 0.5, "occupied_stalls": ["Stall_r00_c01_1", "Stall_r02_c02_3"]},
    "fittings": {"speed_bump_rate": 1.0, "cone_rate": 0.0},
    "stage": {"texture_quality": "low"},
}
