"""Ceiling: beams, lamps and lighting, ducts, sprinkler pipes and cable trays, exit signs and mirrors."""
