# SPDX-License-Identifier: GPL-3.0-or-later
"""A scan, and noise on it, for the scripts that compare with MeshLab's filters in PyMeshLab."""

import pathlib
import sys

import numpy
from experiment import label, skip

try:
    import pymeshlab
except ImportError:
    skip(f"{pathlib.Path(sys.argv[0]).stem}: this Python has no PyMeshLab; external/pymeshlab.sh "
         "installs it")

SEED = 1


class Scan:
    """A clean surface, one half of it subdivided if `uneven`."""

    def __init__(self, path, uneven=False):
        meshes = loaded(path)
        if uneven:
            middle = numpy.median(meshes.current_mesh().vertex_matrix()[:, 0])
            meshes.compute_selection_by_condition_per_face(condselect=f"x0 > {middle:.17g}")
            meshes.meshing_surface_subdivision_midpoint(
                iterations=1, threshold=pymeshlab.PureValue(0), selected=True)
        self.name = label(path) + (", uneven" if uneven else "")
        self.vertices = meshes.current_mesh().vertex_matrix()
        self.faces = meshes.current_mesh().face_matrix()
        corners = self.vertices[self.faces]
        edges = corners - numpy.roll(corners, 1, axis=1)
        lengths = numpy.linalg.norm(edges, axis=2)
        self.edge = float(lengths.mean())
        self.mean_squared_edge = float((lengths ** 2).mean())
        normals = numpy.zeros_like(self.vertices)
        areas = numpy.cross(edges[:, 1], edges[:, 2])
        for corner in range(3):
            numpy.add.at(normals, self.faces[:, corner], areas)
        self.normals = normals / numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-300)[:, None]

    def noisy(self, noise):
        """Returns the vertices moved along the normals. `noise` is the standard deviation, in mean edge
        lengths."""
        heights = numpy.random.default_rng(SEED).normal(0, noise * self.edge, len(self.vertices))
        return self.vertices + heights[:, None] * self.normals

    def mesh_set(self, vertices):
        """Returns a MeshSet of the scan with these vertices."""
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(vertices, self.faces))
        return meshes


def loaded(path):
    """Returns a MeshSet of a file. Its meshes live as long as it."""
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    return meshes
