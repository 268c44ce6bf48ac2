"""Slow, plain truths of registration. They follow the text, not the code."""

import cmath
import math

import numpy as np
from shapely.geometry import LineString, Point


def distance_to_segment(point, segment):
    return LineString([segment[:2], segment[2:]]).distance(Point(point))


def nearest_segment(point, segments):
    """Index and distance of the nearest segment, the first of equals."""
    distances = [distance_to_segment(point, segment) for segment in segments]
    return int(np.argmin(distances)), min(distances)


def place(pose, point):
    """Carry a point by a pose (x, y, theta), by complex numbers."""
    moved = complex(*point) * cmath.rect(1.0, pose[2]) + complex(*pose[:2])
    return moved.real, moved.imag


def robust_cost(points, field, pose, width, overhang):
    """The cost of Geman and McClure of all points within three widths of the line of their nearest segment.

    It is what the weights 1 / (1 + (e / width)^2)^2 descend on: the sum of e^2 / (1 + (e / width)^2) / 2.
    """
    cost = 0.0
    for point in points:
        x, y = place(pose, point)
        row, column = math.floor((y - field.bottom) / field.cell), math.floor((x - field.left) / field.cell)
        k = field.nearest[row, column]
        if k < 0:
            continue
        ax, ay, bx, by = field.segments[k]
        along = complex(bx - ax, by - ay)
        relative = complex(x - ax, y - ay) / (along / abs(along))
        if not -overhang <= relative.real <= abs(along) + overhang or abs(relative.imag) > 3.0 * width:
            continue
        cost += relative.imag**2 / (1.0 + (relative.imag / width) ** 2) / 2.0
    return cost


def place_score(samples, field, pose, *, width, min_cosine):
    """Sum the weights of the points near a segment that runs their way."""
    score = 0.0
    for point, direction, weight in zip(*samples, strict=True):
        x, y = place(pose, point)
        row, column = math.floor((y - field.bottom) / field.cell), math.floor((x - field.left) / field.cell)
        if not (0 <= row < field.nearest.shape[0] and 0 <= column < field.nearest.shape[1]):
            continue
        k = field.nearest[row, column]
        if k < 0 or np.dot(place((0.0, 0.0, pose[2]), direction), field.directions[k]) < min_cosine:
            continue
        score += weight / (1.0 + (field.distance[row, column] / width) ** 2)
    return score
