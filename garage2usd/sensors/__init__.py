"""Sensors mounted on a car or a column: rigs of cameras and LiDARs, their lenses, calibration and recording formats."""
