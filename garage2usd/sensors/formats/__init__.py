"""Formats of recordings and labels that other programs read."""
