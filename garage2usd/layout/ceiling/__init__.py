"""The ceiling: beams, lamps and their light, ducts and pipes, signs and mirrors."""
