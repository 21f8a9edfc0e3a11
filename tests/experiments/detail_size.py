#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how much of a wave is left after a flow, over wavelengths, steps and orders.

A plate carries six waves of small amplitude at once, a quarter to eight times as long as the detail size.
The script flows it with tracked_mcf and fits the waves to the middle of the result. It prints what is
left of each wave, beside the prediction T = (1 - h^m)^n, where h = δk² / (1 + δk²) and k = 2π/wavelength.
Targets: within 5 % of 0.5 at the detail size, within 0.06 of the prediction at a quarter of it, and
within 0.02 at all other wavelengths; at three scales, and on a plate that is turned.
"""

import math
import pathlib
import tempfile

import numpy
from experiment import Experiment
from ply import read_vertices, write_ply

WAVELENGTHS = [0.25, 0.5, 1, 2, 4, 8]  # in detail sizes
LENGTH, WIDTH = 24, 4  # of the plate, in detail sizes
MIDDLE = (4, 20)  # where waves are measured: twice the longest one, away from the locked boundary
EDGES = 24  # along a detail size: six along the shortest wave
AMPLITUDE = 1e-3  # of each wave, in wavelengths
DEPTH = 10  # ten cells along the shortest wave
SCALES = [1e-3, 1, 1e3]
AT_DETAIL_SIZE = 0.05
FROM_PREDICTION = 0.02
# Six edges and ten cells along the shortest wave cannot follow it closely: kinks remain.
FROM_PREDICTION_OF_SHORTEST = 0.06


def plate():
    """Returns the vertices of the plate, in detail sizes, and its triangles."""
    columns, rows = LENGTH * EDGES + 1, WIDTH * EDGES + 1
    x, y = numpy.meshgrid(numpy.linspace(0, LENGTH, columns), numpy.linspace(0, WIDTH, rows))
    z = sum(AMPLITUDE * w * numpy.sin(2 * math.pi * x / w) for w in WAVELENGTHS)
    index = numpy.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1])
    triangles = numpy.concatenate([numpy.stack([a, b, c], -1).reshape(-1, 3),
                                   numpy.stack([a, c, d], -1).reshape(-1, 3)])
    return numpy.stack([x, y, z], -1).reshape(-1, 3), triangles


def rotation():
    """Returns a rotation by 0.5 about an axis in no coordinate plane."""
    x, y, z = numpy.array([1, 2, 3]) / math.sqrt(14)
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + math.sin(0.5) * cross + (1 - math.cos(0.5)) * cross @ cross


def amplitudes(vertices, initial):
    """Returns how much is left of each wave of the plate."""
    middle = (initial[:, 0] > MIDDLE[0]) & (initial[:, 0] < MIDDLE[1])
    middle &= (initial[:, 1] > WIDTH / 2 - 0.5) & (initial[:, 1] < WIDTH / 2 + 0.5)
    x = initial[middle, 0]
    waves = [f(2 * math.pi * x / w) for w in WAVELENGTHS for f in (numpy.sin, numpy.cos)]
    basis = numpy.stack([*waves, numpy.ones_like(x), x], -1)
    fit = numpy.linalg.lstsq(basis, vertices[middle, 2], rcond=None)[0]
    return [fit[2 * i] / (AMPLITUDE * w) for i, w in enumerate(WAVELENGTHS)]


def predictions(steps, order):
    h_of_detail_size = (1 - 2 ** (-1 / steps)) ** (1 / order)
    delta = h_of_detail_size / (1 - h_of_detail_size)  # for k = 1 at the detail size
    squares = [delta / w ** 2 for w in WAVELENGTHS]
    return [(1 - (square / (1 + square)) ** order) ** steps for square in squares]


def main():
    experiment = Experiment("detail_size", __doc__)
    initial, triangles = plate()
    turn = rotation()
    cases = [(scale, False) for scale in SCALES] + [(1, True)]
    steps_and_orders = [(n, m) for n in (1, 3, 10) for m in (1, 2, 3, 4)]
    if experiment.options.quick:
        cases, steps_and_orders = [(1, True)], [(3, 1), (2, 2)]
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for scale, turned in cases:
            placed = scale * (initial @ turn.T if turned else initial)
            write_ply(folder / "in.ply", placed, triangles)
            for steps, order in steps_and_orders:
                experiment.smooth(folder / "in.ply", folder / "out.ply", "--detail-size",
                                  repr(float(scale)), "--iterations", steps, "--order", order,
                                  "--depth", DEPTH)
                after = read_vertices(folder / "out.ply", len(initial)) / scale
                measured = amplitudes(after @ turn if turned else after, initial)
                predicted = predictions(steps, order)
                rows.append((scale, turned, steps, order, measured, predicted))
    experiment.table(
        ["scale", "turned", "steps", "order", *(f"{w:g} ℓ" for w in WAVELENGTHS)],
        [row for scale, turned, steps, order, measured, predicted in rows
         for row in ([scale, "yes" if turned else "no", steps, order, *map(float, measured)],
                     ["", "", "", "predicted", *map(float, predicted)])])
    figure, axes = experiment.figure()
    lines = {}
    for _, _, steps, order, measured, predicted in rows:
        lines.setdefault((steps, order), (measured, predicted))
    for (steps, order), (measured, predicted) in lines.items():
        colour = f"C{order - 1}"
        axes[0][0].semilogx(WAVELENGTHS, predicted, "-", color=colour, linewidth=0.8)
        axes[0][0].semilogx(WAVELENGTHS, measured, "o", color=colour, markersize=3,
                            label=f"order {order}" if steps == 3 else None)
    axes[0][0].set(xlabel="wavelength in detail sizes", ylabel="amplitude left")
    axes[0][0].legend()
    experiment.save(figure)
    measured, predicted = (numpy.array([row[column] for row in rows]) for column in (-2, -1))
    differences = abs(measured - predicted).max(axis=0)
    experiment.check("amplitude at the detail size, relative difference from 0.5",
                     float(abs(measured[:, WAVELENGTHS.index(1)] / 0.5 - 1).max()),
                     at_most=AT_DETAIL_SIZE)
    experiment.check("difference from the prediction at the shortest wavelength",
                     float(differences[0]), at_most=FROM_PREDICTION_OF_SHORTEST)
    experiment.check("at all others", float(differences[1:].max()), at_most=FROM_PREDICTION)
    experiment.finish()


if __name__ == "__main__":
    main()
