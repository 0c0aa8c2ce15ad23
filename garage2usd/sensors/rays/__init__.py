"""Rays: where a pixel or a laser looks, and what is hit."""
