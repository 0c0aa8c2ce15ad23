"""Rigs of sensors: their kinds, mounting poses and motion."""
