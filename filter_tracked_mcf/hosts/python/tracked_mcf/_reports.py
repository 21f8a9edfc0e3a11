# SPDX-License-Identifier: GPL-3.0-or-later
"""The types of the reports. Lengths are in units of the mesh, areas and volumes in their squares and cubes."""

from typing import Any, Dict, List, Optional, TypedDict

from numpy import float64
from numpy.typing import NDArray


class Report(TypedDict):
    """What each function reports."""

    version: str
    parameters: Dict[str, Any]  # as given, or their defaults
    vertices: int  # of the faces that could move, coincident ones once
    triangles: int  # that could move
    degenerate_triangles: int  # of these, with zero area
    boundary_edges: int
    joined_vertices: int  # that count as one with another across a crack
    open_pairs: int  # of vertices at cracks that are too wide for that
    constrained_vertices: int  # that kept their bits
    detail_size: float  # waves of this length kept half of their height, shorter ones less
    area_before: float
    area_after: float
    volume_before: Optional[float]  # enclosed; None unless the surface is closed, and all of it could move
    volume_after: Optional[float]
    volume_change: Optional[float]  # swept along the normals; None unless faces are oriented consistently
    largest_displacement: float
    rms_displacement: float
    warnings: List[str]
    peak_memory_bytes: int  # of the whole process


class _Quality(TypedDict, total=False):
    quality: NDArray[float64]  # one for each vertex, if the parameter `quality` asks for it


class NoiseReport(Report, _Quality):
    """What remove_noise() reports."""

    stop: str  # why no noise was removed, or "none"
    noise: float  # standard deviation along the normals
    noise_size: float  # how wide what counts as noise is
    outliers: int  # vertices with so much more noise that they hardly counted
    stairs: float  # height of stairs; 0 if there are none
    lump_width: float  # where no noise was removed: of what may be noise in lumps or waves
    lump_height: float
    crease_share: float  # share of the area in triangles that a crease crosses
    median_turn: Optional[float]  # by which half of the area turns in a triangle, degrees; None unless creases are too many
    steps: int
    sharpenings: int  # iterations of the bilateral filter after the steps
    iterations: int  # of conjugate gradients, in all steps
    bounded_vertices: int  # that stopped at largest_movement
    shrunken_parts: int  # that have lost more than 3 % of their area or volume
    lost_area: float  # the largest share that a part has lost
    lost_volume: float
    seconds: float


class StepReport(TypedDict):
    """What smooth() reports of each step."""

    assemble_seconds: float
    solve_seconds: float
    residual_before: float  # 2-norm
    residual_after: float
    solver_iterations: int
    error_estimate: Optional[float]  # relative, in the energy norm; None with method "paper"
    reached_tolerance: Optional[bool]
    area: float  # before the step
    collapsed_samples: int  # quadrature points whose area has collapsed


class FlowReport(Report, _Quality):
    """What smooth() reports."""

    step_size: float  # the time step
    depth: int  # of the octree
    cell_size: float
    cells: int
    elements: int
    unknowns: int
    constrained_unknowns: int
    fragments: int  # of triangles in cells
    split_triangles: int
    samples: int  # quadrature points
    setup_seconds: float
    steps: List[StepReport]
    converged: bool  # whether all steps reached the tolerance
    stop: str  # why the flow ended early, or "none"
    estimated_memory_bytes: int


class FairReport(_Quality):
    """What fair() reports."""

    version: str
    parameters: Dict[str, Any]
    vertices: int  # that could move, coincident ones once
    triangles: int  # that were selected
    joined_vertices: int  # that count as one with another across a crack
    open_pairs: int  # of vertices at cracks that are too wide for that
    patches: int
    flatter_patches: int  # that have less continuity than was asked for
    rough_patches: int  # whose surroundings turn so much that chance may have raised them
    seam_curvature: float  # RMS of the mean curvature around the seams
    patch_curvature: float  # the same in the patches
    height: float  # largest distance from the membrane, relative to the size of the hole
    iterations: int  # solves in a new metric, of the patch that took most
    area_before: float
    area_after: float
    largest_displacement: float
    rms_displacement: float
    seconds: float
    warnings: List[str]
    peak_memory_bytes: int  # of the whole process
