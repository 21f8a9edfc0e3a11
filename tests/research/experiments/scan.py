# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces in PyMeshLab, for the scripts that compare with MeshLab's filters."""

import pathlib
import sys

import numpy
from experiment import label, skip
from surface import Surface

try:
    import pymeshlab
except ImportError:
    skip(f"{pathlib.Path(sys.argv[0]).stem}: this Python has no PyMeshLab; external/pymeshlab.sh "
         "installs it")


class Scan(Surface):
    """The surface of a file, one half of it subdivided if `uneven`."""

    def __init__(self, path, uneven=False):
        meshes = loaded(path)
        if uneven:
            middle = numpy.median(meshes.current_mesh().vertex_matrix()[:, 0])
            meshes.compute_selection_by_condition_per_face(condselect=f"x0 > {middle:.17g}")
            meshes.meshing_surface_subdivision_midpoint(
                iterations=1, threshold=pymeshlab.PureValue(0), selected=True)
        mesh = meshes.current_mesh()
        super().__init__(label(path) + (", uneven" if uneven else ""), mesh.vertex_matrix(), mesh.face_matrix())


def mesh_set(surface, vertices):
    """Returns a MeshSet of a surface with these vertices."""
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(vertices, surface.faces))
    return meshes


def loaded(path):
    """Returns a MeshSet of a file. Its meshes live as long as it."""
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    return meshes
