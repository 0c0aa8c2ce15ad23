"""The floor: its panels, painted markings, drains and wear."""
