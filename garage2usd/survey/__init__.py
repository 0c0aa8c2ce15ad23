"""Existing garages: surveys of layouts that others made, and their lanes and stalls in metres, without a grid."""
