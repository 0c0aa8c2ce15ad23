"""The building's shell: walls, columns, doors and ramps, and what hangs on them."""
