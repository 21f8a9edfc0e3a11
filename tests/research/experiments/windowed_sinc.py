# SPDX-License-Identifier: GPL-3.0-or-later
"""VTK's windowed sinc smoother over its settings, to compare with, and its surfaces of voxels."""

import pathlib
import sys

import numpy
from experiment import processor_seconds, skip

try:
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints, vtkVersion
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkWindowedSincPolyDataFilter
except ImportError:
    skip(f"{pathlib.Path(sys.argv[0]).stem}: this Python has no VTK; pip install vtk")

VTK_VERSION = vtkVersion.GetVTKVersion()
ITERATIONS = [20, 50, 100]
PASS_BANDS = [0.3, 0.1, 0.03, 0.01, 0.003, 0.001]


def poly_data(vertices, faces):
    points, polygons, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(vertices, deep=True))
    corners = numpy.insert(faces, 0, 3, axis=1).astype(numpy.int64)
    polygons.SetCells(len(faces), numpy_to_vtkIdTypeArray(corners.ravel(), deep=True))
    data.SetPoints(points)
    data.SetPolys(polygons)
    return data


def smoothed(surface, vertices, iterations=None, pass_band=None):
    """Returns the smoothed vertices and the processor seconds, with VTK's defaults or with a setting in normalised
    coordinates."""
    smoother = vtkWindowedSincPolyDataFilter()
    smoother.SetInputData(poly_data(vertices, surface.faces))
    if iterations:
        smoother.SetNumberOfIterations(iterations)
        smoother.SetPassBand(pass_band)
        smoother.NormalizeCoordinatesOn()
    begin = processor_seconds()
    smoother.Update()
    return vtk_to_numpy(smoother.GetOutput().GetPoints().GetData()).astype(float), processor_seconds() - begin


def sinc_families(surface, vertices):
    """Returns families of functions that smooth, by increasing strength. The first has only VTK's defaults."""
    return [[lambda: smoothed(surface, vertices)],
            *([lambda count=count, band=band: smoothed(surface, vertices, count, band) for band in PASS_BANDS]
              for count in ITERATIONS)]


def isosurface(inside, spacing):
    """Returns the vertices and triangles between the samples inside and outside, by marching cubes. The first sample is at
    the origin."""
    image, edges = vtkImageData(), vtkFlyingEdges3D()
    image.SetDimensions(*inside.shape)
    image.SetSpacing(*spacing)
    image.GetPointData().SetScalars(numpy_to_vtk(inside.ravel(order="F").astype(numpy.float32), deep=True))
    edges.SetInputData(image)
    edges.SetValue(0, 0.5)
    edges.ComputeNormalsOff()
    edges.Update()
    surface = edges.GetOutput()
    vertices = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    faces = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(int)
    used, faces = numpy.unique(faces, return_inverse=True)
    return vertices[used], faces.reshape(-1, 3)
