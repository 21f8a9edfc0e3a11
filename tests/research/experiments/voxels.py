# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids, and surfaces of their voxels. A solid is a function of points, ... x 3, which returns their signed distance from
its surface: exactly, or to first order near it."""

import itertools
import pathlib
import sys

import numpy
from experiment import skip

try:
    import pyvista
except ImportError:
    skip(f"{pathlib.Path(sys.argv[0]).stem}: this Python has no PyVista; pip install pyvista")


def rotation(a, b):
    turn = numpy.array([[numpy.cos(a), -numpy.sin(a), 0], [numpy.sin(a), numpy.cos(a), 0], [0, 0, 1]])
    return turn @ [[1, 0, 0], [0, numpy.cos(b), -numpy.sin(b)], [0, numpy.sin(b), numpy.cos(b)]]


def turned(solid, turn):
    return lambda points: solid(points @ turn)


def torus(turn, large=20, small=8):
    def distance_of(points):
        x, y, z = numpy.moveaxis(points @ turn, -1, 0)
        return numpy.hypot(numpy.hypot(x, y) - large, z) - small
    return distance_of


def box(turn, half=(15, 10, 7)):
    def distance_of(points):
        outside = abs(points @ turn) - half
        return numpy.linalg.norm(numpy.maximum(outside, 0), axis=-1) + numpy.minimum(outside.max(axis=-1), 0)
    return distance_of


def capsule(begin, end, radius):
    """Returns all points within a distance of a line."""
    along = numpy.subtract(end, begin)

    def distance_of(points):
        share = numpy.clip((points - begin) @ along / (along @ along), 0, 1)
        return numpy.linalg.norm(points - begin - share[..., None] * along, axis=-1) - radius
    return distance_of


def gradient(solid, points, step=1e-4):
    return numpy.stack([(solid(points + step * axis) - solid(points - step * axis)) / (2 * step) for axis in numpy.eye(3)], -1)


def normalised(function):
    """Returns a solid for a function that is negative inside, with a gradient of any length."""
    def distance_of(points):
        slope = numpy.linalg.norm(gradient(function, points), axis=-1)
        return function(points) / numpy.maximum(slope, 1e-3)
    return distance_of


def nearest(solid, points):
    """Returns the nearest points of a solid's surface."""
    return points - solid(points)[:, None] * gradient(solid, points)


def sampled(solid, sides, first, counts):
    """Returns which samples of a lattice are inside. `sides` are those of a cell, in rows."""
    index = numpy.stack(numpy.meshgrid(*map(numpy.arange, counts), indexing="ij"), -1)
    return solid(first + index @ numpy.asarray(sides, float)) < 0


def lattice_around(sides, reach, random):
    """Returns the first sample and the numbers of samples of a lattice that covers a ball around the origin, and begins
    anywhere."""
    half = numpy.ceil(reach * numpy.linalg.norm(numpy.linalg.inv(sides), axis=0)) + 3
    return (random.uniform(0, 1, 3) - half) @ sides, (2 * half).astype(int)


def isosurface(values, sides, level=0.5):
    """Returns the vertices and triangles where samples pass a level, by marching cubes. The first sample is at the origin."""
    image = pyvista.ImageData(dimensions=values.shape)
    image.point_data["values"] = values.ravel(order="F").astype(numpy.float32)
    surface = image.contour([level], method="flying_edges", compute_normals=False, compute_scalars=False)
    used, faces = numpy.unique(surface.regular_faces, return_inverse=True)
    return numpy.array(surface.points[used], float) @ numpy.asarray(sides, float), faces.reshape(-1, 3)


def faces_of_voxels(inside, sides=((1, 0, 0), (0, 1, 0), (0, 0, 1))):
    """Returns the boundary of voxels, the first around the origin."""
    quads = []
    padded = numpy.pad(inside, 1).astype(numpy.int8)
    for axis in range(3):
        changes = numpy.diff(padded, axis=axis)
        for sign in (1, -1):
            corner = numpy.argwhere(changes == sign)
            corner[:, axis] += 1
            u, v = numpy.eye(3, dtype=int)[[(axis + 1) % 3, (axis + 2) % 3]]
            quad = numpy.stack([corner, corner + u, corner + u + v, corner + v], 1)
            quads.append(quad if sign < 0 else quad[:, ::-1])
    vertices, index = numpy.unique(numpy.concatenate(quads).reshape(-1, 3), axis=0, return_inverse=True)
    return (vertices - 1.5) @ numpy.asarray(sides, float), index.reshape(-1, 4)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def surface_nets(inside, sides):
    """Returns the vertices and triangles of VTK's surface nets, which smooth near the cells, at PyVista's defaults."""
    image = pyvista.ImageData(dimensions=inside.shape)
    image.point_data["labels"] = inside.ravel(order="F").astype(numpy.int32)
    surface = image.contour_labels(scalars="labels", smoothing=True, output_mesh_type="triangles")
    return numpy.array(surface.points, float) @ numpy.asarray(sides, float), surface.regular_faces


def models_of_steps():
    """Yields names and voxels of models whose steps are their shape."""
    size = 36
    x, y, z = numpy.meshgrid(*[numpy.arange(size)] * 3, indexing="ij")
    middle = (size - 1) / 2
    across = numpy.maximum(abs(x - middle), abs(y - middle))
    within = (numpy.minimum.reduce([x, y, z]) >= 2) & (numpy.maximum.reduce([x, y, z]) < size - 2)
    for step in (1, 2, 3, 5):
        yield f"flight of stairs, {step}", within & (z // step <= x // step)
        yield f"pyramid, {step}", within & (z // step * step + across < size / 2)
        diagonal = (abs(x - middle) + abs(y - middle)) * 0.7071
        yield f"octagonal pyramid, {step}", within & (z // step * step + numpy.maximum(across, diagonal) < size / 2)
        yield f"round terraces, {step}", within & (z // step * step + numpy.hypot(x - middle, y - middle) < size / 2)
    for pitch in (4, 6, 9):
        studs = (x % pitch < pitch / 2) & (y % pitch < pitch / 2)
        yield f"brick with studs, {pitch}", within & ((z < 16) | ((z < 19) & studs))
        yield f"sponge, {pitch}", within & ((x % pitch < pitch / 2).astype(int) + (y % pitch < pitch / 2)
                                            + (z % pitch < pitch / 2) >= 2)
        yield f"brick wall, {pitch}", within & (y < 12) & ~((y > 9) & ((z % pitch == 0) | ((x + pitch // 2 * (z // pitch % 2))
                                                                                           % pitch == 0)))
        random = numpy.random.default_rng(pitch)
        heights = random.integers(4, 28, (size, size))[numpy.ix_(*[numpy.arange(size) // pitch] * 2)]
        yield f"city, {pitch}", within & (z < heights[x, y])
        raised = random.random((size, size))[numpy.ix_(*[numpy.arange(size) // (pitch // 3)] * 2)] < 0.5
        yield f"pixels raised, {pitch // 3}", within & (z < 16 + 2 * raised[x, y])
    yield "I-beam", within & ((abs(y - middle) > 12) | (abs(x - middle) < 3))
    yield "cross", within & ((abs(y - middle) < 5).astype(int) + (abs(x - middle) < 5) + (abs(z - middle) < 5) >= 2)
    for count, (a, b) in itertools.product((2, 5), ((1, 1), (2, 1))):
        random = numpy.random.default_rng(count)
        boxes = numpy.zeros_like(within)
        for _ in range(count):
            low = random.integers(2, 18, 3)
            high = low + random.integers(6, 16, 3)
            boxes[low[0]:high[0] * a // b, low[1]:high[1], low[2]:high[2]] = True
        yield f"{count} boxes, {a}:{b}", within & boxes
