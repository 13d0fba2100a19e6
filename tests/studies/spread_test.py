# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sizes of grains for the layout of a scene: mean grains in closed form, and sentences."""
import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
from study.programs import Failure  # noqa: E402
from study.spread import spread_of  # noqa: E402


def mean_cube(spread):
    """Mean of d3 by number [m3]."""
    return spread.volume * 6 / math.pi


class Spreads(unittest.TestCase):
    def test_uniform_by_mass(self):
        # One over the mean of d^-3 from 1 to 3 mm: 4/(1 - 1/9) mm3.
        self.assertAlmostEqual(mean_cube(spread_of("uniform 0.5", 2e-3)) / 4.5e-9, 1, places=6)

    def test_lognormal_by_mass(self):
        # The median d over exp(3 s2/2), less what lies beyond three deviations.
        spread = spread_of("lognormal 0.3", 4e-3)
        self.assertAlmostEqual(mean_cube(spread) ** (1 / 3) / (4e-3 * math.exp(-1.5 * 0.3**2)), 1, delta=0.01)
        self.assertEqual(spread.words, "lognormal mass 0.004 0.3")
        self.assertLess(spread.smallest, 4e-3 * math.exp(-1.5 * 0.3))
        self.assertGreater(spread.largest, 4e-3 * math.exp(1.5 * 0.3))

    def test_sieve(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a.txt"
            file.write_text("1e-3 0  # nothing\n2e-3 25\n4e-3 25\n8e-3 100\n")
            spread = spread_of(f"sieve {file}", 1.0)
            inverse = [(1 - 2**-3) / (3 * math.log(2)) * 1e9, (4**-3 - 8**-3) / (3 * math.log(2)) * 1e9]
            self.assertAlmostEqual(mean_cube(spread) * (0.25 * inverse[0] + 0.75 * inverse[1]), 1, places=9)
            self.assertAlmostEqual(spread.middle, 4e-3 * 2 ** (1 / 3), places=9)  # a third of what lies from 4 to 8 mm
            file.write_text("1e-3 5\n8e-3 100\n")
            with self.assertRaisesRegex(Failure, "sieve analysis"):
                spread_of(f"sieve {file}", 1.0)

    def test_each_wrong_word_is_refused(self):
        for text in ("", "lognormal", "lognormal 0", "lognormal x", "gaussian 0.4", "uniform 1", "beta 0.2", "sieve", "sieve /nowhere"):
            with self.subTest(text=text), self.assertRaisesRegex(Failure, "^--spread: "):
                spread_of(text, 1e-3)


if __name__ == "__main__":
    unittest.main()
