# SPDX-License-Identifier: GPL-3.0-or-later
"""Smoothers to compare with, each over its settings: MeshLab's in PyMeshLab, and a bilateral filter of normals."""

import numpy
from bilateral import BilateralFilter
from experiment import processor_seconds
from measures import angles, distance, measures
from scan import mesh_set

STEPS = [1, 2, 3, 4, 6, 8, 10, 14, 20, 30, 50]


def result(scan, noisy, vertices, seconds, pairs=None):
    """Returns the measures of a result, with its seconds and vertices."""
    return {**measures(scan, noisy, vertices, pairs), "seconds": seconds, "vertices": vertices}


def applied(scan, vertices, name, **parameters):
    """Returns the vertices after MeshLab's filter `name`, and its processor seconds."""
    meshes = mesh_set(scan, vertices)
    begin = processor_seconds()
    meshes.apply_filter(name, **parameters)
    return meshes.current_mesh().vertex_matrix(), processor_seconds() - begin


def taubin_families(scan, vertices):
    """Returns families of functions that smooth, by increasing strength; in all 22 settings."""
    return [[lambda count=count, lambda_=lambda_, mu=mu: applied(
        scan, vertices, "apply_coord_taubin_smoothing", stepsmoothnum=count, lambda_=lambda_, mu=mu)
        for count in STEPS] for lambda_, mu in ((0.5, -0.53), (0.33, -0.34))]


def two_step_families(scan, vertices):
    return [[lambda count=count, angle=angle: applied(
        scan, vertices, "apply_coord_two_steps_smoothing", stepsmoothnum=count, normalthr=angle)
        for count in STEPS[:5]] for angle in (60.0, 30.0)]


def bilateral_families(scan, vertices):
    return [bilateral_family(scan, vertices, width) for width in (0.25, 0.35, 0.5)]


def bilateral_family(scan, vertices, width):
    """Yields the functions of a width, whose steps follow each other."""
    bilateral, seconds, done = BilateralFilter(vertices, scan.faces, width), 0, 0

    def smooth():
        nonlocal seconds, done
        begin = processor_seconds()
        while done < step:
            bilateral.filter_normals()
            done += 1
        fitted = bilateral.fitted_vertices()
        seconds += processor_seconds() - begin
        return fitted, seconds

    for step in STEPS[:-1]:
        yield smooth


def best(scan, noisy, families, pairs=None):
    """Returns the result with the least RMS over families, and the least angle of all of them. Leaves a family once neither
    got better twice."""
    found, least_angle = (numpy.inf, None), numpy.inf
    for family in families:
        least, worse = (numpy.inf, numpy.inf), 0
        for smooth in family:
            vertices, seconds = smooth()
            now = distance(scan, vertices), float(angles(scan, vertices).mean())
            worse = 0 if now[0] < least[0] or now[1] < least[1] else worse + 1
            least = min(least[0], now[0]), min(least[1], now[1])
            least_angle = min(least_angle, now[1])
            if now[0] < found[0]:
                found = now[0], (vertices, seconds)
            if worse == 2:
                break
    return result(scan, noisy, *found[1], pairs), least_angle
