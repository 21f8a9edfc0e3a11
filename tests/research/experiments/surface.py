# SPDX-License-Identifier: GPL-3.0-or-later
"""A clean surface, and noise on it."""

import numpy

SEED = 1


class Surface:
    """A clean surface, which its measures compare with."""

    def __init__(self, name, vertices, faces):
        self.name, self.vertices, self.faces = name, vertices, faces
        corners = vertices[faces]
        edges = corners - numpy.roll(corners, 1, axis=1)
        self.edge = float(numpy.linalg.norm(edges, axis=2).mean())
        normals = numpy.zeros_like(vertices)
        areas = numpy.cross(edges[:, 1], edges[:, 2])
        for corner in range(3):
            numpy.add.at(normals, faces[:, corner], areas)
        self.normals = normals / numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-300)[:, None]

    def noisy(self, noise, seed=SEED):
        """Returns the vertices moved along the normals. `noise` is the standard deviation, in mean edge
        lengths."""
        heights = numpy.random.default_rng(seed).normal(0, noise * self.edge, len(self.vertices))
        return self.vertices + heights[:, None] * self.normals
