"""Drawings, settings and profiles with one thing wrong, and the rule meant for it."""

DRAWN = {
    "no exit": ("exit-missing", "...\nE==\n..."),
    "no entrance": ("entrance-missing", "...\n==X\n..."),
    "a portal inside": ("portal-inside", ".......\n.=====X\n.=.E.=.\n.=====.\n.=...=.\nE=====."),
    "an exit beside no lane": ("portal-cut-off", "....\nE==X\n....\n....\nX..."),
    "stalls that no lane leads to": ("stall-route", "......\nE====X\n......\n..==..\n......"),
    "an entrance that leads nowhere": ("portal-route", "E=######\n########\n........\nE======X\n........"),
    "an exit that looks at another part of the garage": ("portal-shut", "....#...\nE==X#.=.\n..=.#.=.\n..=====."),
    "a dead end with branches that are short": (
        "dead-end-depth",
        ".......\nE=====X\n...=...\n..===..\n..=.=..",
    ),
    "many stalls without a loop": ("loop", "......X......\nE===========X\n............."),
    "lanes side by side": ("lane-field", "......\nE====X\n..==..\n......"),
    "portals side by side": ("portal-distance", "......\n.=====\n.=...=\nE=...=\nX=====\n......"),
}
LONG_AISLE = "..........\nE========X\n.........."
"""Without a junction, which only a client's profile asks for."""
SETTINGS_BROKEN = {
    "stalls as narrow as the user wants": ("stall-width", {"bay": {"stall_width_m": 2.3}}),
    "stalls as short as the user wants": ("stall-length", {"bay": {"stall_length_m": 5.2}}),
    "a low clear height": ("headroom", {"fittings": {"clear_height_m": 2.1}}),
    "a steep ramp": ("ramp-slope", {"fittings": {"ramp_slope_percent": 18.0}}),
    "a ramp with short transitions": ("ramp-transition", {"fittings": {"ramp_transition_m": 2.4}}),
    "dark lanes and stalls told so": (
        "lane-illuminance",
        {"fittings": {"tubes_per_cell": 2, "lane_lux": 45.0, "stall_lux": 1.0}},
    ),
}
M = {"unit": "m"}
CLIENTS = {
    "wider doors": ("portal-width", {"portal_width": {"value": 6.0, **M}}),
    "portals farther apart": ("portal-distance", {"portal_distance": {"value": 40, **M}}),
    "more portals": ("portal-count", {"portals": {"steps": [[10, 2]], "above": 3, "unit": "count"}}),
    "brighter lanes": ("lane-illuminance", {"lane_illuminance": {"value": 75, "unit": "lx"}}),
    "brighter stalls": ("stall-illuminance", {"stall_illuminance": {"value": 75, "unit": "lx"}}),
    "more accessible stalls": (
        "accessible-count",
        {"accessible_stalls": {"steps": [[50, 2]], "above_percent": 2, "unit": "count"}},
    ),
    "wider accessible stalls": ("accessible-width", {"accessible_stall_width": {"value": 3.5, **M}}),
    "a wider access aisle": ("access-aisle", {"access_aisle_width": {"value": 2.5, **M}}),
    "stalls for vans": (
        "van-count",
        {"stalls_per_van_stall": {"value": 6, "unit": "count"}, "van_stall_width": {"value": 132, "unit": "in"}},
    ),
    "headroom for vans": ("van-headroom", {"van_clear_height": {"value": 98, "unit": "in"}}),
    "a smaller fire compartment": (
        "fire-compartment-sprinklered",
        {"fire_compartment_area_sprinklered": {"value": 500}},
    ),
    "other columns": ("column-spacing", {"column_spacing": {"least": 7.5, "most": 8.0}}),
}
KINDS = {
    "wider aisles for angled stalls": (
        "angled-aisle-width",
        {"kinds": {"angled": 1}},
        {"angled_aisle_widths": {"angles_deg": [60], "values": [9], **M}},
    ),
    "wider aisles for parallel stalls": (
        "parallel-aisle-width",
        {"kinds": {"parallel": 1}},
        {"parallel_aisle_width": {"value": 9, **M}},
    ),
    "longer parallel stalls": (
        "parallel-stall-length",
        {"kinds": {"parallel": 1}},
        {"parallel_stall_length": {"value": 6.5, **M}},
    ),
    "wider parallel stalls": (
        "parallel-stall-width",
        {"kinds": {"parallel": 1}},
        {"parallel_stall_width": {"value": 2.6, **M}},
    ),
    "wider stalls for compact cars": (
        "compact-stall-width",
        {"sizes": {"compact": 1}},
        {"compact_stall_width": {"value": 2.5, **M}},
    ),
    "longer stalls for compact cars": (
        "compact-stall-length",
        {"sizes": {"compact": 1}},
        {"compact_stall_length": {"value": 5.0, **M}},
    ),
    "wider stalls for motorcycles": (
        "motorcycle-stall-width",
        {"sizes": {"standard": 0.6, "motorcycle": 0.4}, "sizes_m": {"motorcycle": (1.1, 2.5)}},
        {"motorcycle_stall_width": {"value": 1.2, **M}},
    ),
    "longer stalls for motorcycles": (
        "motorcycle-stall-length",
        {"sizes": {"standard": 0.6, "motorcycle": 0.4}},
        {"motorcycle_stall_length": {"value": 2.6, **M}},
    ),
    "fewer stalls for compact cars": (
        "compact-share",
        {"sizes": {"compact": 1}},
        {"compact_share": {"value": 50, "unit": "%"}},
    ),
}
"""Rule, settings of the stalls, and the client's clauses."""
