# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The drag laws of the closures beside measured points: dragLaw against the printed formulas, statistics against closed forms, and the table
of docs/drag-measured.md on the points themselves, where they are (ECCENTRA_DRAG_POINTS, or ../shared/data beside the checkout)."""
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

import drag_oracle

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("ECCENTRA_BUILD", ROOT / "build"))
sys.path.insert(0, str(ROOT / "scripts"))
from study import drag_points  # noqa: E402
from study.programs import Failure  # noqa: E402

DATA = pathlib.Path(os.environ.get("ECCENTRA_DRAG_POINTS", drag_points.DEFAULT))
# Bias, rms and share within 25 % of each law of drag_oracle.LAWS, in per cent, by the formulas of drag_oracle.
TABLE = {
    "isometric, Re < 20": (48, (7.1, 19.8, 79), (-2.9, 16.9, 94), (2.4, 16.8, 94), (3.1, 16.2, 94), (-8.4, 18.6, 90), (-6.4, 18.3, 94)),
    "isometric, Re < 0.1": (24, (14.7, 18.1, 79), (-6.4, 13.1, 100), (-0.3, 10.4, 100), (3.4, 11.0, 100), (-7.7, 13.4, 100), (-9.9, 15.9, 100)),
    "fragments, phi >= 0.5": (29, (-19.4, 49.1, 48), (-41.5, 81.3, 10), (-33.4, 58.1, 24), (-18.3, 31.4, 66), (-65.3, 195.8, 0), (-61.0, 164.8, 0)),
    "fragments, phi < 0.5": (31, (35.2, 62.2, 42), (-24.8, 52.5, 55), (-19.1, 39.3, 58), (-11.8, 34.6, 55), (-76.8, 343.0, 0), (-74.2, 298.3, 0)),
    "films": (30, (-12.4, 36.8, 50), (-11.3, 20.2, 90), (-18.2, 27.8, 73), (-17.9, 26.7, 73), (-86.8, 676.1, 0), (-85.4, 603.3, 0)),
    "fibres": (15, (-15.6, 56.1, 73), (-51.6, 126.6, 13), (-48.9, 109.4, 13), (-47.5, 105.4, 13), (-87.0, 679.9, 0), (-85.5, 602.2, 0)),
    "spheres in air": (2, (5.4, 5.4, 100), (10.1, 10.4, 100), (9.0, 9.2, 100), (5.9, 6.0, 100), (5.0, 5.0, 100), (5.9, 5.9, 100)),
}
TOLERANCE = 1.0  # points


def tool(*words, text=""):
    return subprocess.run([BUILD / "bin" / "dragLaw", *words], input=text, capture_output=True, text=True, check=False)


class Tool(unittest.TestCase):
    def test_is_the_printed_formulas(self):
        draw = random.Random(1)
        rows = [(draw.uniform(0.05, 1), 10 ** draw.uniform(-4, 4), 10 ** draw.uniform(-1, 0.3)) for _ in range(200)] + [(1.0, 57.0, 1.0)]
        done = tool(",".join(drag_oracle.LAWS), "--points", "-", text="".join(f"{a!r} {b!r} {c!r}\n" for a, b, c in rows))
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        self.assertEqual(lines[0], "sphericity,reynolds,crosswise," + ",".join(drag_oracle.LAWS))
        self.assertEqual(len(lines), len(rows) + 1)
        for row, line in zip(rows, lines[1:]):
            for (name, law), value in zip(drag_oracle.LAWS.items(), line.split(",")[3:]):
                self.assertAlmostEqual(float(value) / law(*row), 1, delta=1e-9, msg=f"{name} at {row}")

    def test_one_point(self):
        self.assertIn("5.8918534", tool("chien", "--sphericity", "0.806", "--reynolds", "6.35").stdout)
        # The crosswise sphericity is the sphericity where it is not given.
        given, taken = (tool("holzer_sommerfeld", "--sphericity", "0.5", "--reynolds", "9", *more).stdout for more in (("--crosswise", "0.5"), ()))
        self.assertEqual(given, taken)

    def test_what_it_refuses(self):
        for words, text, says in ((["stokes", "--reynolds", "1"], "", "'stokes' is no drag law; expected chien|"),
                                  (["chien"], "", "Reynolds number"),
                                  (["chien", "--reynolds", "-1"], "", "--reynolds"),
                                  (["chien", "--reynolds", "1", "--sphericity", "1.2"], "", "sphericity '1.2'"),
                                  (["chien", "--reynolds", "1", "--fraction", "2"], "", "--fraction: '2'"),
                                  (["chien", "--reynold", "1"], "", "--reynold"),
                                  (["chien", "--reynolds", "1", "--points", "-"], "1 1", "expected one of the two"),
                                  (["chien", "--points", "/nowhere"], "", "'/nowhere' cannot be read"),
                                  (["chien", "--points", "-"], "1 1\n0.5 2 x\n", "line 2: 'x' is not a number"),
                                  (["chien", "--points", "-"], "1\n", "line 1: 1 values"),
                                  (["chien", "--points", "-"], "1 nan\n", "line 1: 'nan'")):
            done = tool(*words, text=text)
            self.assertEqual(done.returncode, 1, words)
            self.assertRegex(done.stderr, r"^dragLaw: error: [^\n]*\n$")
            self.assertIn(says, done.stderr)


class Statistics(unittest.TestCase):
    def test_off(self):
        off = drag_points.off([2.0, 0.5])
        self.assertEqual(off.count, 2)
        self.assertAlmostEqual(off.bias, 0)
        self.assertAlmostEqual(off.rms, 1)  # exp(ln 2) - 1
        self.assertEqual(off.share, 0)
        off = drag_points.off([1.2, 1.2, 0.76, 1.3])
        self.assertAlmostEqual(off.bias, (1.2 * 1.2 * 0.76 * 1.3) ** 0.25 - 1)
        self.assertEqual(off.share, 0.75)

    def test_trust(self):
        for (bias, rms), trust in (((0.1, 0.2), "trusted"), ((-0.1, 0.1), "trusted"), ((0.11, 0.2), "serves"), ((0.0, 0.35), "serves"),
                                   ((-0.21, 0.3), "not trusted"), ((0.0, 0.36), "not trusted")):
            self.assertEqual(drag_points.Off(1, bias, rms, 0.0).trust(), trust)

    def test_bad_files(self):
        head = "sphericity,Re,Cd,source,flag,shape,crosswise\n"
        for text, says in (("a,b\n1,2\n", "no column 'sphericity'"), (head + "1,x,1,s,0,film,\n", "line 2: Re 'x'"),
                           (head + "# note\n1.2,1,1,s,0,film,\n", "line 3: sphericity, Re and Cd")):
            with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
                file.write(text)
                file.flush()
                with self.assertRaises(Failure) as refusal:
                    drag_points.read(file.name)
                self.assertIn(says, str(refusal.exception))


class Measured(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        points = [p for p in drag_points.read(DATA) if p.flag in (drag_points.GOOD, drag_points.COARSE)]
        with tempfile.TemporaryDirectory() as folder:
            values = drag_points.coefficients(BUILD, points, tuple(drag_oracle.LAWS), pathlib.Path(folder))
        inside = {name: [k for k, p in enumerate(points) if belongs(p)] for name, belongs in drag_points.SETS.items()}
        cls.off = {(name, law): drag_points.off([values[law][k] / points[k].cd for k in chosen]) for name, chosen in inside.items() for law in values}

    def test_table(self):
        self.assertEqual(set(TABLE), set(drag_points.SETS))
        for name, (count, *expected) in TABLE.items():
            for law, row in zip(drag_oracle.LAWS, expected):
                off = self.off[name, law]
                self.assertEqual(off.count, count, name)
                for what, value, wanted in zip(("bias", "rms", "share"), off[1:], row):
                    self.assertAlmostEqual(100 * value, wanted, delta=TOLERANCE, msg=f"{what} of {law} on {name}")

    def test_bands(self):
        """Isometric bodies at Re < 20 by any law for shapes; flat ones by holzer_sommerfeld; fibres by none."""
        for law in ("chien", "haider_levenspiel", "ganser", "holzer_sommerfeld"):
            self.assertEqual(self.off["isometric, Re < 20", law].trust(), "trusted", law)
            self.assertEqual(self.off["fibres", law].trust(), "not trusted", law)
        for name in ("fragments, phi < 0.5", "films"):
            self.assertEqual(self.off[name, "holzer_sommerfeld"].trust(), "serves", name)


if __name__ == "__main__":
    if "Measured" in sys.argv and not DATA.is_file():
        print(f"there is no {DATA}: name the file of measured points in ECCENTRA_DRAG_POINTS")
        sys.exit(77)
    unittest.main()
