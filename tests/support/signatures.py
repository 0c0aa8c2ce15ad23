"""Prints each compiled function of the package that has several forms after garages of all kinds, as JSON.

Run it with an empty ``NUMBA_CACHE_DIR``: what comes from a cache is not seen.
"""

import json
import sys

from numba.core.dispatcher import Dispatcher

from garage2usd import GarageConfig, generate
from garage2usd.checks import check
from garage2usd.checks.layout_reader import layout_subject
from garage2usd.driving import prove_stalls

SITES = ({}, {"height_cells": 20, "width_cells": 30, "entrances": 2, "exits": 2})
PLANS = ({}, {"circulation": "allow"}, {"preset": "paper"}, {"dead_ends": "forbid", "loop_reward": 1.0})


def main():
    for site in SITES:
        for plan in PLANS:
            for is_dimensioned in (True, False):
                generate(
                    GarageConfig(seed=1, site=site, plan={"episodes": 20} | plan, bay={"dimensioned": is_dimensioned})
                )
    garage = generate(GarageConfig(seed=1, plan={"episodes": 20}))
    prove_stalls(garage.layout, garage.graph)
    check(layout_subject(garage.layout, garage.graph, source="a garage", kind="report"), garage.config.standard)
    forms = {
        f"{name}.{function}": [str(signature) for signature in value.signatures]
        for name, module in sys.modules.items()
        if name.startswith("garage2usd")
        for function, value in vars(module).items()
        if isinstance(value, Dispatcher) and value.__module__ == name
    }
    several = {function: signatures for function, signatures in forms.items() if len(signatures) > 1}
    json.dump({"compiled": sum(map(bool, forms.values())), "several": several}, sys.stdout)


if __name__ == "__main__":
    main()
