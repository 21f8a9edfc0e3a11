#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the measures on results whose error is known."""

import unittest

import numpy
import shapes
from measures import measures
from surface import Surface

SHEET = Surface("sheet", *shapes.sheet(10, 8))
CUBE = Surface("cube", *shapes.cube(4))


def moved(surface, vertex, offset):
    vertices = surface.vertices.copy()
    vertices[vertex] += numpy.multiply(offset, surface.edge)
    return vertices


class MeasuresTest(unittest.TestCase):
    def check(self, surface, vertices, noisy=None, pairs=None, **expected):
        found = measures(surface, surface.vertices if noisy is None else noisy, vertices, pairs)
        for name, value in expected.items():
            with self.subTest(name):
                self.assertAlmostEqual(found[name.replace("_", " ")], value)

    def test_the_clean_surface_has_no_error(self):
        for surface in SHEET, CUBE:
            for name, value in measures(surface, surface.vertices, surface.vertices).items():
                with self.subTest(f"{surface.name}, {name}"):
                    self.assertAlmostEqual(value, 0, places=5)

    def test_a_movement_has_a_part_along_the_normal_and_one_across(self):
        middle = 40
        self.check(SHEET, moved(SHEET, middle, (0.3, 0.4, 0.2)), worst=0.2, RMS=0.2 / len(SHEET.vertices) ** 0.5,
                   sideways_max=0.5, moved=0.29 ** 0.5, rim_max=0)

    def test_sideways_movement_is_from_the_input(self):
        noisy = moved(SHEET, 40, (0.3, 0, 0.2))
        self.check(SHEET, noisy, noisy, worst=0.2, sideways_max=0, moved=0)

    def test_a_smaller_sheet_has_its_rim_inwards(self):
        middle = SHEET.vertices.mean(axis=0)
        vertices = middle + 0.9 * (SHEET.vertices - middle)
        found = measures(SHEET, SHEET.vertices, vertices)
        self.assertAlmostEqual(found["area"], -19)
        self.assertAlmostEqual(found["rim max"], 0.1 * numpy.hypot(5, 4) / SHEET.edge)
        self.assertGreater(found["rim inwards"], 0.4 / SHEET.edge)
        self.assertNotIn("volume", found)

    def test_a_larger_cube_has_a_larger_volume_and_no_rim(self):
        found = measures(CUBE, CUBE.vertices, 1.1 * CUBE.vertices)
        self.assertAlmostEqual(found["area"], 21)
        self.assertAlmostEqual(found["volume"], 33.1)
        self.assertNotIn("rim max", found)

    def test_a_vertex_beyond_its_neighbours_turns_and_folds_faces(self):
        vertices = moved(SHEET, 40, (1.5, 0, 0))
        found = measures(SHEET, SHEET.vertices, vertices)
        self.assertGreater(found["turned"], 0)
        self.assertEqual(found["newly turned"], found["turned"])
        self.assertGreater(found["folded"], 0)
        self.check(SHEET, vertices, vertices, turned=found["turned"], newly_turned=0, folded=found["folded"])

    def test_a_gap_is_the_distance_of_pairs(self):
        _, faces, _, pairs = shapes.torus_with_seam(12, 8)
        torus = Surface("torus", shapes.torus_with_seam(12, 8)[0], faces)
        self.check(torus, moved(torus, pairs[0, 1], (0, 0, 0.5)), pairs=pairs, gap_max=0.5,
                   gap_RMS=0.5 / len(pairs) ** 0.5)


if __name__ == "__main__":
    unittest.main()
