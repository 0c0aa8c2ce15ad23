"""Axes of sensors, written out."""

import math

import numpy as np


def blender_world(sensor):
    """From the camera, as Blender has it, to the vehicle's axes, which are the world here, written out."""
    yaw, pitch, roll = (math.radians(value) for value in (sensor.yaw_deg, sensor.pitch_deg, sensor.roll_deg))
    about_z = np.array([[math.cos(yaw), -math.sin(yaw), 0], [math.sin(yaw), math.cos(yaw), 0], [0, 0, 1]])
    about_y = np.array([[math.cos(pitch), 0, math.sin(pitch)], [0, 1, 0], [-math.sin(pitch), 0, math.cos(pitch)]])
    about_x = np.array([[1, 0, 0], [0, math.cos(roll), -math.sin(roll)], [0, math.sin(roll), math.cos(roll)]])
    matrix = np.eye(4)
    # Blender's camera looks along -Z, with X to the right and Y up
    matrix[:3, :3] = about_z @ about_y @ about_x @ [[0, 0, -1], [-1, 0, 0], [0, 1, 0]]
    matrix[:3, 3] = sensor.position_m
    return matrix
