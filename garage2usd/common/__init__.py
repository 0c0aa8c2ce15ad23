"""Tools of every room: errors, output that is whole or absent, limits, progress, random numbers."""
