# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Creeping drag in power-law fluid by least dissipation: Stokes between concentric spheres, its exact slope in the index, bounds from above."""
import math
import pathlib
import sys
import unittest

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
from study import least_dissipation, wedge  # noqa: E402
from study.commands import creeping_drag  # noqa: E402

SMALL = {"elements": 14, "modes": 2}


class LeastDissipation(unittest.TestCase):
    def test_newtonian_drag_between_concentric_spheres(self):
        for outer in (3.0, 50.0):
            case = wedge.Case(outer=outer)
            value = creeping_drag.without_outer_sphere(least_dissipation.power_law_factor(1.0, outer, **SMALL), case)
            self.assertAlmostEqual(value, 1, delta=1e-5, msg=outer)
            self.assertGreater(value, 1 - 1e-10)

    def test_slope_at_the_newtonian_fluid(self):
        """d ln C_s/dn = ln 2 + the mean of ln(rate) with the weight rate^2 over the Newtonian flow, exactly, because that flow is a minimum."""
        sphere = least_dissipation.Sphere(200.0, **SMALL)
        flow = sphere.flow(1.0)
        square = sphere.squared(flow)
        exact = math.log(2) + float((sphere.weight * square * numpy.log(square) / 2).sum() / (sphere.weight * square).sum())
        step = 1e-3
        low, high = (sphere.drag(n, sphere.least(n, flow)) for n in (1 - step, 1 + step))
        self.assertAlmostEqual(math.log(high / low) / (2 * step), exact, delta=1e-4)
        # The formula of Renaud et al. is not as steep, whatever the outer sphere.
        of_formula = math.log(creeping_drag.power_law_factor(1 + step) / creeping_drag.power_law_factor(1 - step)) / (2 * step)
        self.assertAlmostEqual(of_formula, -1.104, delta=1e-3)
        self.assertLess(exact, of_formula - 0.2)

    def test_more_trial_flows_lower_the_bound(self):
        values = [least_dissipation.power_law_factor(0.6, 50.0, elements=14, modes=modes) for modes in (1, 2, 3)]
        self.assertGreater(values[0], values[1])
        self.assertGreater(values[1], values[2])
        self.assertLess(values[1] / values[2] - 1, 1e-3)
        self.assertAlmostEqual(values[2], 1.4295, delta=1.5e-3)  # annulusFoam, 108 x 72 cells


if __name__ == "__main__":
    unittest.main()
