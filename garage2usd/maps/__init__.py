"""Maps, scenarios, grids and scenes of a garage for programs that read no USD; one module for each format."""
