"""Stages read: their files opened, their objects, lane graph and labels found. Whoever reads a stage does it here."""
