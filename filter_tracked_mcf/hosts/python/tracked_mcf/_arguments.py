# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts what users give to the arrays that the extension module takes."""

import copy
import os
import sys

import numpy

# An UnstructuredGrid of PyVista numbers its kinds of cells as VTK does.
_KINDS_OF_VTK = {1: "vertex", 3: "line", 5: "triangle", 9: "quad", 10: "tetra"}


def arrays_of(mesh, faces):
    """Returns vertices, faces, and a function that puts moved vertices into a mesh of the same kind.

    If `faces` is None, `mesh` is one of trimesh, PyVista, Open3D or meshio. Raises TypeError for anything else, and
    ValueError for a mesh with faces that are not triangles.
    """
    if faces is not None:
        return mesh, faces, lambda moved: moved
    if hasattr(mesh, "cells_dict"):  # meshio, or an UnstructuredGrid of PyVista
        is_grid = hasattr(mesh, "celltypes")
        cells = {_KINDS_OF_VTK.get(kind, f"cells of type {kind}") if is_grid else kind: rows
                 for kind, rows in mesh.cells_dict.items()}
        kinds = set(cells) - {"vertex", "line", "triangle"}
        if kinds or "triangle" not in cells:
            raise ValueError(f"The mesh has {', '.join(sorted(kinds)) or 'no triangles'}; give triangles only.")
        return mesh.points, cells["triangle"], lambda moved: (
            _with_points(mesh, moved) if is_grid else _with(mesh, "points", moved))
    if hasattr(mesh, "is_all_triangles"):  # PyVista
        if not mesh.is_all_triangles:
            raise ValueError("The mesh has faces that are not triangles; give mesh.triangulate().")
        return mesh.points, mesh.faces.reshape(-1, 4)[:, 1:], lambda moved: _with_points(mesh, moved)
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh
        return mesh.vertices, mesh.faces, lambda moved: _with(mesh, "vertices", moved)
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):  # Open3D
        return (numpy.asarray(mesh.vertices), numpy.asarray(mesh.triangles),
                lambda moved: _with_open3d_vertices(mesh, moved))
    if isinstance(mesh, (str, os.PathLike)):
        raise TypeError(f"{mesh!r} is the name of a file; load it first, such as by trimesh.load_mesh().")
    if isinstance(mesh, (numpy.ndarray, list)):
        raise TypeError("faces is missing: give arrays of vertices and faces.")
    raise TypeError(f"{type(mesh).__name__} is no mesh of trimesh, PyVista, Open3D or meshio; "
                    "give arrays of vertices and faces.")


def _with(mesh, name, moved):
    result = copy.deepcopy(mesh)
    setattr(result, name, moved)
    return result


def _with_points(mesh, moved):
    """The normals in a mesh of PyVista are arrays that would not follow the points."""
    result = mesh.copy()
    for data in result.point_data, result.cell_data:
        if "Normals" in data:
            del data["Normals"]
    result.points = moved
    return result


def _with_open3d_vertices(mesh, moved):
    result = copy.deepcopy(mesh)
    result.vertices = type(mesh.vertices)(numpy.asarray(moved, dtype=float))
    if mesh.has_vertex_normals():
        result.compute_vertex_normals()
    elif mesh.has_triangle_normals():
        result.compute_triangle_normals()
    return result


def flags_of(name, given, count):
    """Returns one bool for each of `count` faces or vertices, from a mask or from indices. Raises ValueError."""
    if given is None:
        return None
    array = numpy.asarray(given)
    if array.size == 0:
        array = array.astype(int)  # an empty list of indices
    if array.dtype.kind not in "iu" or array.ndim != 1:
        return array
    if len(array) == count > 2 and 0 <= array.min() and array.max() < 2:
        raise ValueError(f"{name} has {count} integers that are 0 or 1; give an array of bools, or indices.")
    if len(array) and not (array.min() >= 0 and array.max() < count):
        raise ValueError(f"{name} has an index outside 0 to {count - 1}.")
    flags = numpy.zeros(count, bool)
    flags[array] = True
    return flags


class Bar:
    """A progress bar on the error output: that of tqdm, or a line of text where tqdm is not installed."""

    def __init__(self):
        try:
            from tqdm.auto import tqdm
            self._bar = tqdm(total=100, bar_format="{l_bar}{bar}| {elapsed}, {remaining} left", leave=False)
        except ImportError:
            self._bar = None

    def __call__(self, fraction, phase):
        if self._bar is None:
            print(f"\r{fraction:4.0%} {phase[:60]:60}", end="", file=sys.stderr, flush=True)
        else:
            self._bar.set_description(phase, refresh=False)
            self._bar.update(100 * fraction - self._bar.n)

    def close(self):
        if self._bar is None:
            print(f"\r{'':65}\r", end="", file=sys.stderr, flush=True)
        else:
            self._bar.close()
