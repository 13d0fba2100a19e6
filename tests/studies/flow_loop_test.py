# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The case flow-loop: which bed a feed leads to, and what its numbers say."""
import argparse
import importlib.machinery
import importlib.util
import math
import pathlib
import re
import tempfile
import unittest

CASE = pathlib.Path(__file__).resolve().parent.parent.parent / "cases" / "flow-loop"
loader = importlib.machinery.SourceFileLoader("flow_loop", str(CASE / "loop"))
loop = importlib.util.module_from_spec(importlib.util.spec_from_loader("flow_loop", loader))
loader.exec_module(loop)


class Feed(unittest.TestCase):
    def test_exponential_flux_is_met_exactly(self):
        # flux = feed exp((bed - 0.2)/0.05): the bed at the feed is 0.2, whatever the two beds that enclose it.
        points = [(bed, loop.FEED * math.exp((bed - 0.2) / 0.05), bed) for bed in (0.05, 0.13, 0.31)]
        sign, bed = loop.at_feed(points)
        self.assertEqual(sign, "")
        self.assertAlmostEqual(bed, 0.2)
        self.assertEqual(loop.at_feed(points[::-1]), (sign, bed))

    def test_bounds_where_no_two_amounts_enclose_the_feed(self):
        self.assertEqual(loop.at_feed([(0.02, 2 * loop.FEED, 0.01), (0.1, 9 * loop.FEED, 0.1)]), ("<", 0.01))
        self.assertEqual(loop.at_feed([(0.02, 0.1 * loop.FEED, 0.01), (0.1, 0.9 * loop.FEED, 0.1)]), (">", 0.1))
        self.assertEqual(loop.at_feed([(0.02, -1e-9, 0.01), (0.1, 2 * loop.FEED, 0.1)]), ("<", 0.1))


class Ratios(unittest.TestCase):
    def test_bounds_go_the_right_way(self):
        found = {1: ("", 0.1), 2: ("", 0.4), 3: ("<", 0.1), 4: (">", 0.4), 5: ("<", 0.0)}
        self.assertEqual(loop.ratio_of(found, 1, 2), ("", 0.25))
        self.assertEqual(loop.ratio_of(found, 3, 2), ("<", 0.25))
        self.assertEqual(loop.ratio_of(found, 1, 4), ("<", 0.25))  # over more than 0.4
        self.assertTrue(math.isnan(loop.ratio_of(found, 1, 5)[1]))

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is missing")
    def test_chart(self):
        with tempfile.TemporaryDirectory() as folder:
            loop.chart(pathlib.Path(folder) / "loop.svg", loop.tests(), {13: ("", 0.35), 14: ("", 0.01), 43: (">", 0.2)})
            text = (pathlib.Path(folder) / "loop.svg").read_text()
        for words in ("80 rpm, 14/13", "67 for 90 degrees, 43/13", "ratios of pairs"):
            self.assertIn(words, text)


class Numbers(unittest.TestCase):
    def test_scene_and_loop_have_one_geometry(self):
        scene = dict(re.findall(r"^(\w+)\s+([-\d.]+);", (CASE / "scene").read_text(), re.MULTILINE))
        self.assertEqual((float(scene["holeRadius"]), float(scene["pipeRadius"])), loop.RADII)
        self.assertEqual(float(scene["length"]), loop.LENGTH)
        self.assertAlmostEqual(math.pi / 6 * float(scene["diameter"])**3, loop.GRAIN)
        self.assertEqual(int(scene["count"]), loop.count_of(0.16, loop.LENGTH))

    def test_feed_is_the_rate_of_penetration_over_the_section_of_the_hole(self):
        hole = 30 * 0.3048 / 3600 * math.pi * loop.RADII[0]**2  # 30 ft/h
        self.assertAlmostEqual(loop.FEED / hole, 1, places=3)

    def test_index_and_consistency_follow_from_plastic_viscosity_and_yield_point(self):
        for pv, yp, numbers in ((20, 40, (13, 14, 15, 17, 18, 19, 43, 44)), (10, 20, (1, 3))):
            n = math.log2((2 * pv + yp) / (pv + yp))
            k = 0.511 * (pv + yp) / 511**n
            self.assertAlmostEqual(n, 0.415, places=3)
            for number in numbers:
                self.assertAlmostEqual(loop.tests()[number]["k"], k, places=3)

    def test_steps_of_all_tests_are_whole_and_follow_the_modulus(self):
        for modulus, steps in ((5e6, 208), (5e5, 66)):  # a soft grain's step is longer by the root
            words = argparse.Namespace(seconds=1, length=0.3, modulus=modulus, scene=[])
            for test in loop.tests().values():
                given = loop.arguments(test, 0.08, words)
                value = dict(zip(given[::2], given[1::2]))
                self.assertAlmostEqual(float(value["--fluid_step"]) / int(value["--interval"]), 0.005 / steps)
                self.assertLess(test["velocity"] * float(value["--fluid_step"]), 0.6 * 0.005 + 1e-9)

    def test_a_shorter_section_keeps_cells_and_amount(self):
        words = argparse.Namespace(seconds=1, length=0.1, modulus=5e6, scene=["--rolling", "0.1"])
        given = loop.arguments(loop.tests()[13], 0.08, words)
        value = dict(zip(given[::2], given[1::2]))
        self.assertEqual((value["--cellsAlong"], value["--rolling"]), ("7", "0.1"))
        self.assertAlmostEqual(int(value["--count"]) / (0.08 * loop.AREA * 0.1 / loop.GRAIN), 1, places=3)


class Means(unittest.TestCase):
    def test_second_half_counts_and_its_drift_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            table = pathlib.Path(folder) / "postProcessing/eccentra/coupling.csv"
            table.parent.mkdir(parents=True)
            # The second half begins at 4: 1, 1, then 3, 3, 3.
            rows = [f"{time},{flux},{0.25 * loop.AREA}" for time, flux in zip(range(1, 9), (5, 5, 5, 1, 1, 3, 3, 3))]
            table.write_text("time,solids_flux,bed_area\n" + "\n".join(rows) + "\n")
            found = loop.measured(pathlib.Path(folder))
        self.assertAlmostEqual(found["flux"], (1 + 1 + 3 + 3 + 3) / 5)
        self.assertAlmostEqual(found["drift"], (3 - 1) / 2)
        self.assertAlmostEqual(found["bed"], 0.25)


if __name__ == "__main__":
    unittest.main()
