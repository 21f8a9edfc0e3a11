# SPDX-License-Identifier: GPL-3.0-or-later
"""Smoothers to compare with, each over its settings: MeshLab's in PyMeshLab, and a bilateral filter of normals."""

import numpy
from bilateral import BilateralFilter, area_vectors, unit
from experiment import processor_seconds

STEPS = [1, 2, 3, 4, 6, 8, 10, 14, 20, 30, 50]


def distance(scan, vertices):
    """Returns the RMS displacement from the clean vertices along the clean normals, in mean edge lengths."""
    along = ((vertices - scan.vertices) * scan.normals).sum(axis=1)
    return float(numpy.sqrt((along ** 2).mean())) / scan.edge


def angles(scan, vertices):
    """Returns the angle of each face's normal to that of the clean mesh, in degrees."""
    clean = unit(area_vectors(scan.vertices, scan.faces))
    cosines = (clean * unit(area_vectors(vertices, scan.faces))).sum(axis=1)
    return numpy.degrees(numpy.arccos(numpy.clip(cosines, -1, 1)))


def result(scan, vertices, seconds):
    return {"RMS": distance(scan, vertices), "angle": float(angles(scan, vertices).mean()), "seconds": seconds,
            "vertices": vertices}


def applied(scan, vertices, name, **parameters):
    """Returns the vertices after MeshLab's filter `name`, and its processor seconds."""
    meshes = scan.mesh_set(vertices)
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


def best(scan, families):
    """Returns the best result over families, for the distance and for the angle each. Leaves a family once neither
    got better twice."""
    found, angle = None, numpy.inf
    for family in families:
        least, worse = (numpy.inf, numpy.inf), 0
        for smooth in family:
            now = result(scan, *smooth())
            worse = 0 if now["RMS"] < least[0] or now["angle"] < least[1] else worse + 1
            least = min(least[0], now["RMS"]), min(least[1], now["angle"])
            angle = min(angle, now["angle"])
            if found is None or now["RMS"] < found["RMS"]:
                found = now
            if worse == 2:
                break
    return {**found, "angle": angle}
