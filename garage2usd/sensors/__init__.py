"""Sensors on a car or a column: rigs of them, what their lenses see, and how they are calibrated."""
