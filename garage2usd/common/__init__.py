"""Utilities for all packages: errors, atomic output, limits, progress, random numbers."""
