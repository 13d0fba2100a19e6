# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured along the hole, on closed forms."""
import argparse
import math
import pathlib
import sys
import unittest

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from study import full_pictures, full_report, full_run, hole, section  # noqa: E402


class Along(unittest.TestCase):
    def test_layers_make_up_the_annulus(self):
        self.assertAlmostEqual(sum(hole.layer_areas()) / section.AREA, 1, places=12)
        self.assertAlmostEqual(hole.below(hole.HOLE, 0.0), math.pi * hole.HOLE**2 / 2)

    def test_concentration_is_the_volume_of_the_bodies(self):
        points = numpy.array([[0.0, -0.06, 0.05], [0.01, 0.02, 0.07], [0.0, -0.06, 0.95]])
        rows = hole.along(points, 1.0)
        self.assertEqual(len(rows), 10)
        solid = [c * section.AREA * 0.1 / section.BODY_VOLUME for _, c, _ in rows]
        self.assertAlmostEqual(solid[0], 2)
        self.assertAlmostEqual(solid[9], 1)
        self.assertAlmostEqual(sum(solid), 3)

    def test_height_of_a_bed_with_a_flat_top(self):
        # Bodies at random places below a height, as dense as a packed bed, in one bin.
        random, top = numpy.random.default_rng(1), -0.04
        points = []
        area = hole.below(hole.HOLE, top) - hole.below(hole.PIPE, top + hole.OFFSET)
        while len(points) < 0.55 * area * 0.1 / section.BODY_VOLUME:
            x, y, z = random.uniform((-hole.HOLE, -hole.HOLE, 0), (hole.HOLE, top, 0.1))
            if math.hypot(x, y) < hole.HOLE and math.hypot(x, y + hole.OFFSET) > hole.PIPE:
                points.append((x, y, z))
        (_, _, height), = hole.along(numpy.array(points), 0.1)
        self.assertAlmostEqual(height, top + hole.HOLE, delta=2e-3)
        self.assertEqual(hole.bed_height([0.1] * hole.LAYERS), 0)
        self.assertEqual(hole.bed_height([0.5] * hole.LAYERS), 2 * hole.HOLE)

    def test_front_and_its_speed(self):
        points = numpy.zeros((200, 3))
        points[:, 2] = numpy.arange(200) / 100
        self.assertAlmostEqual(hole.front_of(points), 1.98)
        self.assertEqual(hole.front_of(numpy.zeros((0, 3))), 0)
        rows = [{"time": float(t), "front": max(5.0, 0.3 * t) if t < 3 else 0.1 + 0.3 * t} for t in range(11)]
        self.assertAlmostEqual(hole.front_speed(rows, 12), 0.3)
        leaves = [{"time": float(t), "front": min(0.6 * t, 9 + 0.1 * t, 11.9)} for t in range(61)]  # what leaves is missing behind it
        self.assertAlmostEqual(hole.front_speed(leaves, 12), 0.6)

    def test_a_picture_shows_as_much_as_the_front_has_reached(self):
        self.assertAlmostEqual(hole.reached([{"front": 0.4}, {"front": 1.0}], 12), 1.4)
        self.assertEqual(hole.reached([{"front": 9.5}], 12), 12)
        self.assertEqual(hole.reached([], 12), 12)


class Run(unittest.TestCase):
    def test_cells_of_the_paper(self):
        self.assertEqual(full_run.cells_of(12), "12 48 243")
        self.assertIn(f"nCellsInCoarsestLevel   {16 * 243};", full_run.solvers_of(12, "loose"))

    def test_interval_is_the_one_chosen_or_that_of_the_rule(self):
        chosen = argparse.Namespace(interval=None, fluid_step=0.02)
        self.assertEqual(full_run.interval_of(chosen, 182e-6), math.ceil(0.02 / (0.3 * 182e-6)))
        chosen.interval = 200
        self.assertEqual(full_run.interval_of(chosen, 182e-6), 200)

    def test_developed_bed_leaves_out_entry_and_front(self):
        picture = {"front": 1.2, "along": [(z / 10 + 0.05, z, 0) for z in range(20)]}
        self.assertEqual(full_report.developed(picture), [3, 4, 5])

    def test_balance(self):
        row = {"inserted_mass": 2.0, "inserted": 10, "mass": 1.4, "left": 3}
        self.assertEqual(full_report.balance_of(row)[:3], (2.0, 1.4, 3 * 0.2))
        self.assertLess(full_report.balance_of(row)[3], 1e-15)
        self.assertAlmostEqual(full_report.balance_of(row | {"left": 2})[3], 0.1)

    def test_outline_of_a_turned_square(self):
        s = math.sqrt(0.5)
        cube = numpy.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
        turned = full_pictures.turned((math.cos(math.pi / 8), 0, 0, math.sin(math.pi / 8)), cube)  # by 45 degrees about z
        corners = full_pictures.outline(numpy.round(turned[:, :2], 12))
        self.assertEqual(len(corners), 4)
        self.assertAlmostEqual(max(x for x, _ in corners), 2 * s)


if __name__ == "__main__":
    unittest.main()
