# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Estimates of eccentra new: the Reynolds numbers are those that a run states."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
from study import annulus_flow  # noqa: E402
from study.annulus_flow import Annulus, Mud  # noqa: E402

PAPER = Annulus(0.0635, 0.02413, 0.5)


def number(mud, velocity):
    """Of the mean flow in the paper's annulus."""
    return annulus_flow.metzner_reed(mud, PAPER.hydraulic_diameter, velocity)


class MetznerReed(unittest.TestCase):
    def test_of_a_newtonian_fluid_is_that_of_the_hydraulic_diameter(self):
        self.assertAlmostEqual(number(Mud(0, 1e-3, 1, 1000), 1) / (4 * (0.0635 - 0.02413) / 2 / 1e-6), 1, places=6)

    def test_of_a_power_law_in_closed_form(self):
        # rho U^(2 - n) D^n / (12^(n - 1) k ((2n + 1)/(3n))^n)
        n, k, velocity, diameter = 0.6, 0.5, 0.8, PAPER.hydraulic_diameter
        expected = 1100 * velocity**(2 - n) * diameter**n / (12**(n - 1) * k * ((2 * n + 1) / (3 * n))**n)
        self.assertAlmostEqual(number(Mud(0, k, n, 1100), velocity) / expected, 1, places=9)

    def test_of_the_papers_muds_as_runs_state_it(self):
        # The table of tests/reported/flow_test.cpp, which holds the number of openfoam-coupling/rheology/slot_flow.h.
        for tau0, row in ((0, (703.2, 941.6, 1803.1)), (1, (567.3, 779.1, 1563.8)), (2, (477.4, 666.7, 1383.3))):
            for velocity, expected in zip((0.58, 0.72, 1.165), row):
                self.assertAlmostEqual(number(Mud(tau0, 0.28, 0.65, 1000), velocity), expected, delta=0.06)

    def test_of_the_wide_gap_as_runs_state_it(self):
        # The table of tests/rheology/regime_numbers_test.cpp.
        mud = Mud(1, 0.28, 0.65, 1000)
        for eccentricity, row in ((0.5, (1791.8, 2429.1, 4761.4)), (0.8, (1983.4, 2695.1, 5305.7))):
            annulus = Annulus(PAPER.hole, PAPER.pipe, eccentricity)
            for velocity, expected in zip((0.58, 0.72, 1.165), row):
                wide = annulus_flow.slot_speed(mud, annulus.widest, annulus_flow.pressure_gradient(mud, annulus, velocity))
                self.assertAlmostEqual(annulus_flow.metzner_reed(mud, 2 * annulus.widest, wide), expected, delta=0.5)

    def test_eccentricity_does_not_enter_that_of_the_mean_flow(self):
        for eccentricity in (0, 0.5, 0.9):
            annulus = Annulus(PAPER.hole, PAPER.pipe, eccentricity)
            self.assertEqual(annulus_flow.metzner_reed(Mud(1, 0.28, 0.65, 1000), annulus.hydraulic_diameter, 0.58), number(Mud(1, 0.28, 0.65, 1000), 0.58))


if __name__ == "__main__":
    unittest.main()
