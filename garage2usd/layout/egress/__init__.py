"""Egress on foot: stair cores, exits and fire compartments."""
