# SPDX-License-Identifier: GPL-3.0-or-later
"""Linear elements on a mesh in SciPy: eigenfunctions of the Laplacian, and the flow by direct solves."""

import numpy
from flow import STEPS, step_size
from scipy import sparse
from scipy.sparse.linalg import eigsh, splu

EIGENFUNCTIONS = 8


def matrices(vertices, faces):
    """Returns the stiffness and the mass. The mass is the mean of the lumped and the consistent one, whose errors at waves of
    a few edges cancel on a regular mesh."""
    corners = vertices[faces]
    sides = numpy.roll(corners, -1, axis=1) - corners
    area = numpy.linalg.norm(numpy.cross(sides[:, 0], sides[:, 1]), axis=1) / 2
    shape = (len(vertices), len(vertices))
    stiffness, mass = sparse.csr_matrix(shape), sparse.csr_matrix(shape)
    for k in range(3):
        i, j, opposite = faces[:, k], faces[:, (k + 1) % 3], (k + 2) % 3
        half_cotangent = -(sides[:, (k + 1) % 3] * sides[:, opposite]).sum(axis=1) / (4 * area)
        places = numpy.concatenate([i, j, i, j]), numpy.concatenate([i, j, j, i])
        stiffness += sparse.csr_matrix((numpy.outer([1, 1, -1, -1], half_cotangent).ravel(), places), shape)
        mass += sparse.csr_matrix((numpy.outer([1 / 8, 1 / 8, 1 / 24, 1 / 24], area).ravel(), places), shape)
    return stiffness, mass


def random_waves(surface, wave, random):
    """Returns heights with a standard deviation of 1: a sum of eigenfunctions with eigenvalues next to (2 π / wave)²."""
    stiffness, mass = matrices(surface.vertices, surface.faces)
    start = random.normal(size=len(surface.vertices))
    _, functions = eigsh(stiffness, k=EIGENFUNCTIONS, M=mass, sigma=(2 * numpy.pi / wave) ** 2, v0=start)
    heights = functions @ random.normal(size=EIGENFUNCTIONS)
    return heights / numpy.sqrt(heights @ (mass @ heights) / mass.sum())


def flow_by_direct_solves(vertices, faces, fixed, detail_size, order):
    """Returns the vertices after the flow, by the equations of the program, but in double precision and exactly solved."""
    delta, free = step_size(detail_size, order), ~fixed
    for _ in range(STEPS):
        stiffness, mass = matrices(vertices, faces)
        system = splu((mass + delta * stiffness)[free][:, free].tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0,
                      options={"SymmetricMode": True})
        moved = vertices
        for _ in range(order):
            right = delta * stiffness @ moved
            moved = numpy.zeros_like(vertices)
            moved[free] = system.solve(right[free])
        vertices = vertices - moved
    return vertices
