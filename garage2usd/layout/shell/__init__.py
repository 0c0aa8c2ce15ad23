"""Shell of the building: walls, columns, vehicle doors, ramps, and equipment mounted on walls and columns."""
