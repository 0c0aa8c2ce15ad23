"""Hostile inputs for the commands."""
