# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes as vertices (n x 3) and triangles (m x 3). Edges are about 1 long."""

import itertools

import numpy
from matplotlib.tri import Triangulation


def grid_faces(n, m, around):
    """Returns the triangles of n by m quads. Columns close around if `around` is 1 or 2, and rows if it is 2."""
    i, j = (axis.ravel() for axis in numpy.meshgrid(numpy.arange(n), numpy.arange(m), indexing="ij"))
    columns, rows = n if around else n + 1, m if around == 2 else m + 1
    corner = lambda a, b: a % columns * rows + b % rows  # noqa: E731
    quads = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]
    return numpy.concatenate([numpy.stack([quads[k] for k in (0, 1, 2)], 1),
                              numpy.stack([quads[k] for k in (0, 2, 3)], 1)])


def sheet(n, m, height=lambda x, y: 0 * x):
    """Returns n by m quads over the plane, at their height."""
    x, y = (axis.ravel() for axis in numpy.meshgrid(numpy.arange(n + 1.0), numpy.arange(m + 1.0), indexing="ij"))
    return numpy.stack([x, y, height(x, y)], 1), grid_faces(n, m, 0)


def disc(rings, jitter, random):
    """Returns an irregular flat disc. `jitter` is the standard deviation of the vertices inside; the rim is a circle."""
    points = [numpy.zeros((1, 2))]
    for ring in range(1, rings + 1):
        angles = 2 * numpy.pi * (numpy.arange(6 * ring) + random.random()) / (6 * ring)
        points.append(ring * numpy.stack([numpy.cos(angles), numpy.sin(angles)], 1))
        if ring < rings:
            points[-1] += random.normal(0, jitter, points[-1].shape)
    points = numpy.concatenate(points)
    return numpy.pad(points, ((0, 0), (0, 1))), Triangulation(*points.T).triangles


def cap(rings, jitter, random, angle):
    """Returns the disc bent to a cap of a sphere around the origin, with its rim at an angle (radians) from the pole."""
    flat, faces = disc(rings, jitter, random)
    colatitude = numpy.hypot(*flat.T[:2]) * angle / rings
    return on_sphere(rings / angle, colatitude, numpy.arctan2(flat[:, 1], flat[:, 0])), faces


def on_sphere(radius, colatitude, longitude):
    """Returns the points of a sphere around the origin."""
    return radius * numpy.stack([numpy.sin(colatitude) * numpy.cos(longitude),
                                 numpy.sin(colatitude) * numpy.sin(longitude), numpy.cos(colatitude)], 1)


def torus_with_seam(n, m):
    """Returns a torus of n by m quads that is open along its largest circle, its normals, and the pairs of vertices that
    coincide there."""
    u, v = (axis.ravel() for axis in numpy.meshgrid(
        2 * numpy.pi * numpy.arange(n) / n, 2 * numpy.pi * (numpy.arange(m + 1) % m) / m, indexing="ij"))
    small = m / (2 * numpy.pi)
    large = n / (2 * numpy.pi)
    normals = numpy.stack([numpy.cos(v) * numpy.cos(u), numpy.cos(v) * numpy.sin(u), numpy.sin(v)], 1)
    circle = numpy.stack([numpy.cos(u), numpy.sin(u), 0 * u], 1)
    first = numpy.arange(n) * (m + 1)
    return large * circle + small * normals, grid_faces(n, m, 1), normals, numpy.stack([first, first + m], 1)


def box_of_quads(sizes):
    """Returns a box with so many quads along its edges."""
    index, quads = {}, []

    def vertex(axis, end, i, j):
        at = numpy.roll([end * sizes[axis], i, j], axis)
        return index.setdefault(tuple(at.tolist()), len(index))

    for axis, end in itertools.product(range(3), (0, 1)):
        for i, j in itertools.product(range(sizes[(axis + 1) % 3]), range(sizes[(axis + 2) % 3])):
            a, b, c, d = (vertex(axis, end, i + x, j + y) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
            quads.append((a, b, c, d) if end else (a, d, c, b))
    return numpy.array(list(index), float), numpy.array(quads)


def box(sizes):
    """Returns a box with so many times two triangles along its edges."""
    vertices, quads = box_of_quads(sizes)
    return vertices, quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def cube(n):
    """Returns a cube with n times two triangles along each of its edges."""
    return box((n, n, n))


def sphere(subdivisions):
    """Returns a sphere around the origin, an icosahedron with each triangle divided into four so many times."""
    golden = (1 + numpy.sqrt(5)) / 2
    corners = numpy.array([(0, a, b * golden) for a in (-1, 1) for b in (-1, 1)])
    vertices = numpy.concatenate([numpy.roll(corners, axis, axis=1) for axis in range(3)])
    apart = numpy.linalg.norm(vertices[:, None] - vertices, axis=2) > 2.1
    faces = numpy.array([face for face in itertools.combinations(range(12), 3) if not apart[numpy.ix_(face, face)].any()])
    inwards = numpy.linalg.det(vertices[faces]) < 0
    faces[inwards] = faces[inwards][:, ::-1]
    for _ in range(subdivisions):
        sides = numpy.sort(numpy.stack([faces, numpy.roll(faces, -1, axis=1)], -1), axis=-1)
        ends, middle = numpy.unique(sides.reshape(-1, 2), axis=0, return_inverse=True)
        middle = len(vertices) + middle.reshape(-1, 3)
        vertices = numpy.concatenate([vertices, vertices[ends].mean(axis=1)])
        vertices /= numpy.linalg.norm(vertices, axis=1)[:, None]
        faces = numpy.concatenate([middle, *(numpy.stack([faces[:, k], middle[:, k], middle[:, k - 1]], 1) for k in range(3))])
    return vertices / numpy.linalg.norm(vertices[faces[:, 0]] - vertices[faces[:, 1]], axis=1).mean(), faces


def oblique_block():
    """Returns a block of 12 triangles, two sides of which are rhomboids."""
    vertices, quads = box_of_quads((1, 1, 1))
    return vertices @ ((3, 0, 0), (6, 9, 0), (0, 0, 1)), quads[:, [0, 1, 3, 1, 2, 3]].reshape(-1, 3)


def cube_with_middles():
    """Returns a cube whose sides have four triangles each, around a vertex in the middle."""
    vertices, quads = box_of_quads((1, 1, 1))
    middles = numpy.repeat(len(vertices) + numpy.arange(len(quads)), 4)
    faces = numpy.stack([quads.ravel(), numpy.roll(quads, -1, axis=1).ravel(), middles], 1)
    return numpy.vstack([vertices, vertices[quads].mean(axis=1)]), faces


def notched_cube():
    """Returns a cube of 48 triangles that lacks an eighth."""
    vertices, faces = cube(2)
    vertices[(vertices == 2).all(axis=1)] = 1
    return vertices, faces


def prism(sides):
    """Returns a prism with as few triangles as possible."""
    angles = 2 * numpy.pi * numpy.arange(sides) / sides
    ring = numpy.stack([numpy.cos(angles), numpy.sin(angles)], 1)
    vertices = numpy.vstack([numpy.pad(ring, ((0, 0), (0, 1)), constant_values=z) for z in (0, 1)])
    fan = numpy.array([(0, k, k + 1) for k in range(1, sides - 1)])
    a = numpy.arange(sides)
    b = (a + 1) % sides
    return vertices, numpy.vstack([fan[:, ::-1], fan + sides, numpy.stack([a, b, b + sides], 1),
                                   numpy.stack([a, b + sides, a + sides], 1)])
