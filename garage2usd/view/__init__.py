"""Drawings of plans and learning curves, and the viewer of stages."""
