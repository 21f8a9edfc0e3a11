# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures what a smoother did to an input whose clean surface is known.

The input and the result have the vertices and faces of the clean surface, moved. Normals of vertices are the clean
surface's. All lengths are in its mean edges.

RMS, worst        distance from the clean vertices along the normals: RMS and largest
angle             mean angle between the normals of faces and those of the clean surface, in degrees
sideways RMS, max movement from the input without its part along the normals
moved             largest movement from the input
rim RMS, max      distance of the rim's vertices from their clean places without its part along the normals. Edges of only
                  one face are the rim
rim inwards       mean of this distance's part across the rim, towards the surface
raggedness        standard deviation of the same part
area, volume      change to those of the clean surface, in per cent; the volume if there is no rim
turned            faces whose normals turned by more than 90 degrees from the clean ones
newly turned      those among them that the input has not turned
folded            pairs of faces with a common edge whose normals differ by more than 150 degrees, but not on the clean surface
gap RMS, max      distance of pairs of vertices that coincide on the clean surface

A result that has no rim, no volume or no such pairs has no entries for them.
"""

import functools

import numpy
from bilateral import area_vectors, unit

FOLDED = numpy.cos(numpy.radians(150))


def measures(surface, noisy, vertices, pairs=None):
    """Returns all measures of a result as a dictionary."""
    return {"RMS": distance(surface, vertices), "angle": float(angles(surface, vertices).mean()),
            "worst": float(abs(heights(surface, vertices)).max()),
            **sideways(surface, noisy, vertices), **rim(surface, vertices), **sizes(surface, vertices),
            **turned(surface, noisy, vertices), **gap(surface, vertices, pairs)}


def heights(surface, vertices):
    """Returns the displacement from the clean vertices along the normals."""
    return along(surface, vertices - surface.vertices) / surface.edge


def distance(surface, vertices):
    return root_mean_square(heights(surface, vertices))


def angles(surface, vertices):
    """Returns the angle of each face's normal to that of the clean surface, in degrees."""
    return numpy.degrees(numpy.arccos(numpy.clip(cosines(surface, vertices), -1, 1)))


def sideways(surface, noisy, vertices):
    moved = vertices - noisy
    lengths = numpy.linalg.norm(across(surface, moved), axis=1) / surface.edge
    return {"sideways RMS": root_mean_square(lengths), "sideways max": float(lengths.max()),
            "moved": float(numpy.linalg.norm(moved, axis=1).max()) / surface.edge}


def rim(surface, vertices):
    topology = topology_of(surface)
    if topology.rim.size == 0:
        return {}
    offset = across(surface, vertices - surface.vertices)[topology.rim] / surface.edge
    lengths = numpy.linalg.norm(offset, axis=1)
    inwards = (offset * topology.inwards).sum(axis=1)
    return {"rim RMS": root_mean_square(lengths), "rim max": float(lengths.max()),
            "rim inwards": float(inwards.mean()), "raggedness": float(inwards.std())}


def sizes(surface, vertices):
    ratios = {"area": area(surface.faces, vertices) / area(surface.faces, surface.vertices)}
    if topology_of(surface).rim.size == 0:
        ratios["volume"] = volume(surface.faces, vertices) / volume(surface.faces, surface.vertices)
    return {name: 100 * (ratio - 1) for name, ratio in ratios.items()}


def turned(surface, noisy, vertices):
    now = cosines(surface, vertices) < 0
    pairs = topology_of(surface).pairs_of_faces
    folds, clean_folds = (pair_cosines(surface.faces, points, pairs) < FOLDED for points in (vertices, surface.vertices))
    return {"turned": int(now.sum()), "newly turned": int((now & (cosines(surface, noisy) >= 0)).sum()),
            "folded": int((folds & ~clean_folds).sum())}


def gap(surface, vertices, pairs):
    if pairs is None:
        return {}
    lengths = numpy.linalg.norm(vertices[pairs[:, 0]] - vertices[pairs[:, 1]], axis=1) / surface.edge
    return {"gap RMS": root_mean_square(lengths), "gap max": float(lengths.max())}


class Topology:
    """What the measures need to know of a surface's edges."""

    def __init__(self, surface):
        faces = surface.faces
        begin, end = faces.ravel(), numpy.roll(faces, -1, axis=1).ravel()  # directed edges, three for each face
        keys = numpy.minimum(begin, end).astype(numpy.int64) * len(surface.vertices) + numpy.maximum(begin, end)
        _, edge, count = numpy.unique(keys, return_inverse=True, return_counts=True)
        by_edge = numpy.argsort(edge, kind="stable")
        first, second = by_edge[count[edge[by_edge]] == 2].reshape(-1, 2).T
        opposite = begin[first] == end[second]  # else their normals are on different sides
        self.pairs_of_faces = numpy.stack([first, second], 1)[opposite] // 3
        single = numpy.flatnonzero(count[edge] == 1)
        self.rim = numpy.unique([begin[single], end[single]])
        self.inwards = self._inwards(surface, single // 3, begin[single], end[single])

    def _inwards(self, surface, face, begin, end):
        """Returns unit vectors at the rim's vertices that are normal to the rim and to the vertices' normals."""
        normals = unit(area_vectors(surface.vertices, surface.faces))[face]
        to_face = numpy.cross(normals, surface.vertices[end] - surface.vertices[begin])
        sums = numpy.zeros_like(surface.vertices)
        for ends in (begin, end):
            numpy.add.at(sums, ends, to_face)
        return unit(across(surface, sums))[self.rim]


topology_of = functools.lru_cache(maxsize=1)(Topology)


def along(surface, vectors):
    """Returns the vectors' components along the normals of the vertices."""
    return (vectors * surface.normals).sum(axis=1)


def across(surface, vectors):
    """Returns the vectors without their components along the normals of the vertices."""
    return vectors - along(surface, vectors)[:, None] * surface.normals


def cosines(surface, vertices):
    """Returns the cosine of the angle of each face's normal to that of the clean surface."""
    return (unit(area_vectors(surface.vertices, surface.faces)) * unit(area_vectors(vertices, surface.faces))).sum(axis=1)


def pair_cosines(faces, vertices, pairs):
    normals = unit(area_vectors(vertices, faces))
    return (normals[pairs[:, 0]] * normals[pairs[:, 1]]).sum(axis=1)


def area(faces, vertices):
    return float(numpy.linalg.norm(area_vectors(vertices, faces), axis=1).sum()) / 2


def volume(faces, vertices):
    vertices = vertices - vertices.mean(axis=0)
    return float((vertices[faces[:, 0]] * area_vectors(vertices, faces)).sum()) / 6


def root_mean_square(values):
    return float(numpy.sqrt((values ** 2).mean()))
