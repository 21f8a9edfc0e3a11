#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the cotangent flow of a sphere by Gravo MG's geometric multigrid.

error_over_time.py runs this script, which takes arguments and prints CSV as tests/research/benchmark does. Each
step solves the benchmark's system, (M + δS) d = -δ S x with the full mass matrix M, for the displacement d.

- "setup": Gravo MG makes its levels once, from the first surface, as its authors do.
- "assemble": NumPy and SciPy make the matrix and the right-hand side. C++ would be faster, so neither
  "setup" nor "step" includes this.
- "step": Gravo MG reduces the matrix to its levels and makes V-cycles, until the residual's 2-norm is at
  most the tolerance times the right-hand side's, in each coordinate.

Gravo MG takes no initial guess. The step therefore solves for the difference from the last displacement.
Its tolerance is relative to the smaller right-hand side of this system, so that the same residual ends it.

Needs Gravo MG: external/gravomg.sh build/gravomg, then build/gravomg/bin/python gravo_mg.py.
"""

import argparse
import sys
import time

import numpy
from gravomg import MultigridSolver
from gravomg.util import neighbors_from_faces
from scipy.sparse import csr_matrix

RADIUS = 0.5
TWO_NORM = 0  # Gravo MG's number of this stopping criterion

# The icosahedron of tests/support/shapes.cpp. The coordinates of a corner are ONES + GOLDENS g with the
# golden ratio g.
ONES = numpy.array([(-1, 0, 0), (1, 0, 0), (-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, -1, 0),
                    (0, 1, 0), (0, 0, -1), (0, 0, 1), (0, 0, -1), (0, 0, 1)])
GOLDENS = numpy.array([(0, 1, 0), (0, 1, 0), (0, -1, 0), (0, -1, 0), (0, 0, 1), (0, 0, 1), (0, 0, -1),
                       (0, 0, -1), (1, 0, 0), (1, 0, 0), (-1, 0, 0), (-1, 0, 0)])
FACES = numpy.array([(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
                     (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
                     (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)])


def sphere(frequency):
    """Returns the vertices and triangles of the benchmark's sphere:FREQUENCY, in the same order."""
    corners = []  # of a face's triangles: steps from the face's first corner to its second and third
    for i in range(frequency):
        for j in range(frequency - i):
            corners += [(i, j), (i + 1, j), (i, j + 1)]
            if i + j + 1 < frequency:
                corners += [(i + 1, j), (i + 1, j + 1), (i, j + 1)]
    i, j = numpy.array(corners).T
    weights = numpy.column_stack([frequency - i - j, i, j])
    points = (weights @ numpy.concatenate([ONES, GOLDENS], axis=1)[FACES]).reshape(-1, 6)
    # A vertex that faces share has the same integers in each, and so the same key.
    keys = (points + frequency) @ (2 * frequency + 1) ** numpy.arange(6)
    _, first, vertex = numpy.unique(keys, return_index=True, return_inverse=True)
    order = numpy.argsort(first)
    vertices = points[first[order], :3] + (1 + 5**0.5) / 2 * points[first[order], 3:]
    vertices *= RADIUS / numpy.linalg.norm(vertices, axis=1, keepdims=True)
    return vertices, numpy.argsort(order)[vertex].reshape(-1, 3)


def matrices(vertices, triangles):
    """Returns the mass and the stiffness."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    edges = numpy.stack([c - b, a - c, b - a], axis=1)
    areas = numpy.linalg.norm(numpy.cross(edges[:, 0], edges[:, 1]), axis=1)[:, None, None] / 2
    rows, columns = numpy.repeat(triangles, 3, axis=1).ravel(), numpy.tile(triangles, 3).ravel()

    def assembled(entries):
        return csr_matrix((entries.ravel(), (rows, columns)))

    return (assembled(areas / 12 * (numpy.ones((3, 3)) + numpy.eye(3))),
            assembled(edges @ edges.transpose(0, 2, 1) / (4 * areas)))


def make_levels(vertices, triangles):
    """Returns the prolongations."""
    mass, _ = matrices(vertices, triangles)
    neighbours = neighbors_from_faces(triangles)
    levels = timed("setup", 0, lambda: MultigridSolver(vertices, neighbours, mass).prolongation_matrices)
    if not levels:  # solve() would crash
        sys.exit("gravo_mg: Gravo MG makes no levels of so few vertices; choose a greater frequency")
    return levels


def solve(levels, matrix, right_side, tolerance):
    # Only a solver's constructor takes a tolerance. A mesh of one vertex keeps it from making levels.
    solver = MultigridSolver(numpy.zeros((1, 3)), numpy.array([[-1]]), csr_matrix([[1.0]]),
                             tolerance=tolerance, stopping_criteria=TWO_NORM)
    solver.set_prolongation_matrices(levels)
    return solver.solve(matrix, right_side)


def flow(vertices, triangles, options):
    """Returns the vertices after all steps."""
    levels = make_levels(vertices, triangles)
    displacement = numpy.zeros_like(vertices)

    def assemble():
        mass, stiffness = matrices(vertices, triangles)
        return mass + options.step_size * stiffness, -options.step_size * (stiffness @ vertices)

    def displace():
        residual = right_side - matrix @ displacement
        tolerance = options.tolerance * numpy.min(norms(right_side) / norms(residual))
        return displacement + solve(levels, matrix, residual, tolerance)

    for step in range(1, options.steps + 1):
        matrix, right_side = timed("assemble", step, assemble)
        displacement = timed("step", step, displace)
        residual = norms(right_side - matrix @ displacement) / norms(right_side)
        print_row("relative_residual", step, numpy.max(residual))
        vertices = vertices + displacement
    return vertices


def norms(vectors):
    return numpy.linalg.norm(vectors, axis=0)


def timed(name, step, work):
    """Prints the seconds that `work` takes, and returns its result."""
    wall, cpu = time.perf_counter(), time.process_time()
    result = work()
    print_row(f"{name}_seconds", step, time.perf_counter() - wall)
    print_row(f"{name}_cpu_seconds", step, time.process_time() - cpu)
    return result


def print_row(quantity, step, value):
    print(f"{quantity},{step},{value:.8g}")


def print_errors(vertices, options):
    exact = RADIUS
    for _ in range(options.steps):
        exact = exact**3 / (exact**2 + 2 * options.step_size)
    errors = numpy.linalg.norm(vertices, axis=1) - exact
    print_row("mean_radius_error", options.steps, numpy.mean(errors))
    print_row("rms_radius_error", options.steps, numpy.sqrt(numpy.mean(errors**2)))
    print_row("worst_radius_error", options.steps, numpy.max(numpy.abs(errors)))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", help="sphere:FREQUENCY, which has 10 FREQUENCY² + 2 vertices")
    parser.add_argument("--step-size", type=float, default=5e-4)
    parser.add_argument("--steps", type=int, default=4)
    parser.add_argument("--tolerance", type=float, default=1e-6)
    options = parser.parse_args()
    print("quantity,step,value")
    vertices, triangles = sphere(int(options.mesh.removeprefix("sphere:")))
    print_errors(flow(vertices, triangles, options), options)


if __name__ == "__main__":
    main()
