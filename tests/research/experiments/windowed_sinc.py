# SPDX-License-Identifier: GPL-3.0-or-later
"""VTK's windowed sinc smoother over its settings, to compare with."""

import pathlib
import sys

import numpy
from experiment import processor_seconds, skip

try:
    import pyvista
except ImportError:
    skip(f"{pathlib.Path(sys.argv[0]).stem}: this Python has no PyVista; pip install pyvista")

VTK_VERSION = ".".join(map(str, pyvista.vtk_version_info[:3]))
ITERATIONS = [20, 50, 100]
PASS_BANDS = [0.3, 0.1, 0.03, 0.01, 0.003, 0.001]


def smoothed(surface, vertices, **setting):
    """Returns the smoothed vertices and the processor seconds, with VTK's defaults or with a setting in normalised
    coordinates."""
    mesh = pyvista.PolyData.from_regular_faces(vertices, surface.faces)
    begin = processor_seconds()
    result = mesh.smooth_taubin(**setting)
    return numpy.array(result.points, float), processor_seconds() - begin


def sinc_families(surface, vertices):
    """Returns families of functions that smooth, by increasing strength. The first has only VTK's defaults."""
    return [[lambda: smoothed(surface, vertices)],
            *([lambda count=count, band=band: smoothed(surface, vertices, n_iter=count, pass_band=band,
                                                       normalize_coordinates=True) for band in PASS_BANDS]
              for count in ITERATIONS)]
