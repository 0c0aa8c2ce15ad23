"""Rays of pixels and lasers, and their intersections with the scene."""
