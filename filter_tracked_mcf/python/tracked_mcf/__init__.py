# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooths triangle meshes in NumPy arrays by mean-curvature flow:

    import tracked_mcf
    smooth_vertices, report = tracked_mcf.smooth(vertices, faces, detail_size="1%", order=2)

help(tracked_mcf.smooth) explains the parameters.
"""

from ._core import default_detail_size as default_detail_size
from ._core import smooth as smooth
from ._core import version as __version__

__all__ = ["Cancelled", "Error", "FlowWarning", "InvalidMesh", "InvalidParameter", "NotEnoughMemory",
           "default_detail_size", "smooth"]


class Error(Exception):
    """Base class of the package's errors. The message says what is wrong and what to do."""


class InvalidMesh(Error, ValueError):
    """The mesh cannot flow, or an array has a wrong shape, type or index."""


class InvalidParameter(Error, ValueError):
    """A parameter is outside its range, or does not fit the mesh or another parameter."""


class NotEnoughMemory(Error, MemoryError):
    """The flow is expected to need more memory than is free."""


class Cancelled(Error):
    """The callback `progress` has returned False."""


class FlowWarning(UserWarning):
    """The result may not be what was asked for; the report has the same text under "warnings"."""
