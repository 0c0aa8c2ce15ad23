"""Frames of slots without a renderer: lenses by trigonometry, and what rays through the meshes meet."""

import math
from types import SimpleNamespace

import numpy as np

from garage2usd.sensors.slots import SlotFrame


def pinhole(size_px, width_deg):
    """A lens as (from camera axes to pixels, from pixels to rays): both by the tangent, the axis in the middle."""
    width, height = size_px
    focal = width / 2 / math.tan(math.radians(width_deg) / 2)

    def place(right, down, forward):
        ahead = np.where(forward > 1e-9, forward, np.nan)
        return width / 2 + focal * right / ahead, height / 2 + focal * down / ahead

    def ray(column, row):
        return (column - width / 2) / focal, (row - height / 2) / focal, np.ones_like(column)

    return SimpleNamespace(place=place, ray=ray, size_px=size_px)


def equidistant(size_px, width_deg):
    """A fisheye whose pixels lie as far from the middle as their angle is from the axis."""
    width, height = size_px
    per_rad, widest = width / math.radians(width_deg), math.radians(width_deg) / 2

    def place(right, down, forward):
        angle = np.arctan2(np.hypot(right, down), forward)
        angle = np.where(angle <= widest, angle, np.nan)
        turn = np.arctan2(down, right)
        return width / 2 + per_rad * angle * np.cos(turn), height / 2 + per_rad * angle * np.sin(turn)

    def ray(column, row):
        x, y = column - width / 2, row - height / 2
        angle, turn = np.hypot(x, y) / per_rad, np.arctan2(y, x)
        angle = np.where(angle <= widest, angle, np.nan)
        return np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)

    return SimpleNamespace(place=place, ray=ray, size_px=size_px)


def shot_from(rays, lens, eye, *, yaw_deg, pitch_deg):
    """A frame of a camera that stands at `eye` in a stage with Y up, and the functions to judge it by."""
    yaw, pitch = math.radians(yaw_deg), math.radians(pitch_deg)
    forward = np.array([math.sin(yaw) * math.cos(pitch), math.sin(pitch), -math.cos(yaw) * math.cos(pitch)])
    right = np.array([math.cos(yaw), 0.0, math.sin(yaw)])
    down = np.cross(forward, right)

    def place_of(points):
        return np.stack(lens.place(*((points - eye) @ axis for axis in (right, down, forward))), axis=-1)

    def lens_rays(pixels):
        found = np.stack(lens.ray(*np.asarray(pixels, dtype=float).T), axis=-1) @ np.stack([right, down, forward])
        return found / np.linalg.norm(found, axis=1, keepdims=True)

    width, height = lens.size_px
    middles = np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), axis=-1).reshape(-1, 2)
    directions, seen = lens_rays(middles), np.full((width * height, 3), np.inf)
    there = np.isfinite(directions).all(axis=1)
    _, seen[there], _ = rays.cast(np.repeat(eye[None], there.sum(), axis=0), directions[there])
    frame = SlotFrame("frame", lens.size_px, place_of, seen.reshape(height, width, 3))
    return SimpleNamespace(frame=frame, eye=eye, place_of=place_of, lens_rays=lens_rays)


def from_above(rays, middle, *, size_px, metres_per_px, turn_deg, height_m=2.0):
    """A frame that looks straight down on `middle` from under the ceiling, each pixel along a ray of its own."""
    width, height = size_px
    turn = math.radians(turn_deg)
    right = np.array([math.cos(turn), 0.0, math.sin(turn)])
    down = np.array([-math.sin(turn), 0.0, math.cos(turn)])

    def place_of(points):
        away = np.asarray(points) - middle
        return np.stack([away @ right, away @ down], axis=-1) / metres_per_px + (width / 2, height / 2)

    places = np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), axis=-1).reshape(-1, 2)
    aside = (places - (width / 2, height / 2)) * metres_per_px
    origins = middle + aside[:, :1] * right + aside[:, 1:] * down + (0.0, height_m, 0.0)
    _, seen, _ = rays.cast(origins, np.repeat([[0.0, -1.0, 0.0]], len(origins), axis=0))
    frame = SlotFrame("above", size_px, place_of, seen.reshape(height, width, 3))
    return SimpleNamespace(frame=frame, place_of=place_of)
