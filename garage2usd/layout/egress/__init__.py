"""Egress of pedestrians: fire compartments, stair cores and their placement."""
