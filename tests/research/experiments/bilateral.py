# SPDX-License-Identifier: GPL-3.0-or-later
"""The bilateral filter of face normals, as a peer that keeps edges.

Normals are averaged over faces that share a vertex, with Gaussian weights of the distance of their
centroids and of the difference of their normals (Zheng, Fu, Au and Tai 2011, local scheme); vertices then
move to fit them (Sun, Rosin, Martin and Langbein 2007).
"""

import numpy
from scipy.sparse import csr_matrix

VERTEX_STEPS = 20


def unit(vectors):
    return vectors / numpy.maximum(numpy.linalg.norm(vectors, axis=-1), 1e-300)[..., None]


def area_vectors(vertices, faces):
    """Returns twice the area of each face times its normal."""
    a, b, c = vertices[faces].transpose(1, 0, 2)
    return numpy.cross(b - a, c - a)


class BilateralFilter:
    """Filters the normals of a noisy mesh, and fits its vertices to them."""

    def __init__(self, vertices, faces, width):
        """`width` is the standard deviation of the weights of normals, whose difference is 0 to 2."""
        self._vertices, self._faces, self._width = vertices, faces, width
        areas = area_vectors(vertices, faces)
        self._normals = unit(areas)
        self._from, self._to = pairs_of_faces(faces)
        centroids = vertices[faces].mean(axis=1)
        distances = numpy.linalg.norm(centroids[self._from] - centroids[self._to], axis=1)
        self._weights = (numpy.linalg.norm(areas, axis=1)[self._to]
                         * gaussian(distances, distances.mean()))

    def filter_normals(self):
        """Averages the normals once more."""
        normals = self._normals
        difference = numpy.linalg.norm(normals[self._from] - normals[self._to], axis=1)
        weights = self._weights * gaussian(difference, self._width)
        self._normals = unit(sums(self._from, weights[:, None] * normals[self._to], len(normals)))

    def fitted_vertices(self):
        """Returns the vertices moved from the noisy mesh to fit the normals."""
        faces, vertices = self._faces, self._vertices
        corners = faces.ravel()
        count = numpy.maximum(numpy.bincount(corners, minlength=len(vertices)), 1)[:, None]
        normals = numpy.repeat(self._normals, 3, axis=0)
        for _ in range(VERTEX_STEPS):
            centroids = numpy.repeat(vertices[faces].mean(axis=1), 3, axis=0)
            heights = (normals * (centroids - vertices[corners])).sum(axis=1)
            vertices = vertices + sums(corners, heights[:, None] * normals, len(vertices)) / count
        return vertices


def pairs_of_faces(faces):
    """Returns all pairs of faces that share a vertex, each face with itself included."""
    of_faces = csr_matrix((numpy.ones(faces.size, numpy.int32), faces.ravel(), numpy.arange(0, faces.size + 1, 3)))
    return (of_faces @ of_faces.T).sorted_indices().nonzero()


def gaussian(x, width):
    return numpy.exp(-(x / width) ** 2 / 2)


def sums(index, vectors, count):
    """Returns the sum of the vectors of each index."""
    return numpy.stack([numpy.bincount(index, vectors[:, axis], count) for axis in range(3)], axis=1)
