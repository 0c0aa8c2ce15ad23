"""Rigs: which sensors there are, where they are mounted, and how they move."""
