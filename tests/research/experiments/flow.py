# SPDX-License-Identifier: GPL-3.0-or-later
"""What waves ideally keep of their height under the program's flow."""

import numpy

STEPS = 3  # the program's default


def step_size(detail_size, order):
    """Returns δ in squared units of the detail size."""
    h = (1 - 2 ** (-1 / STEPS)) ** (1 / order)
    return h / (1 - h) * (detail_size / (2 * numpy.pi)) ** 2


def kept(wave, detail_size, order):
    """Returns the share of its height that a plane wave ideally keeps."""
    waves = step_size(detail_size, order) * (2 * numpy.pi / wave) ** 2  # δk²
    return (1 - (waves / (1 + waves)) ** order) ** STEPS


def kept_on_sphere(degree, radius, detail_size, order):
    """Returns the share of its height that a small spherical harmonic ideally keeps, and the radius at the end.

    Y n, with the normal n, and the gradient R ∇Y span a space that the Laplacian of the sphere maps into itself, and R n is an
    eigenvector. Heights ε Y change the Laplacian of R n by 4 ε Y n / R². All this follows from Δ X = -2 H n."""
    degree_squared = degree * (degree + 1)
    stiffness = numpy.array([[degree_squared + 2, -2 * degree_squared], [-2, degree_squared]])  # -R² Δ
    share = 1
    for _ in range(STEPS):
        delta = step_size(detail_size, order) / radius ** 2
        of_radius = 2 * delta / (1 + 2 * delta)  # the share h of the radius
        moved = numpy.array([1.0, 0.0])  # multiples of Y n and of R ∇Y
        for power in range(order):
            moved = delta * stiffness @ moved
            moved[0] -= 4 * delta * of_radius ** power * (1 - of_radius)
            moved = numpy.linalg.solve(numpy.eye(2) + delta * stiffness, moved)
        share *= 1 - moved[0]
        radius *= 1 - of_radius ** order
    return share, radius
