# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies that scripts/drag-against-measurement --falling lets go: their terminal speed is the root of the balance of weight and drag of the real
shape, written out from the printed formulas, and pitching turns them broadside from a tilted start."""
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent.parent
BUILD = pathlib.Path(os.environ.get("ECCENTRA_BUILD", ROOT / "build"))
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "closures")]
import drag_oracle  # noqa: E402
from study import drag_points, falling  # noqa: E402

DATA = pathlib.Path(os.environ.get("ECCENTRA_DRAG_POINTS", drag_points.DEFAULT))
TOLERANCE = 1e-4  # clusterShape prints six digits of K; the terminal speed does not depend on the step
YIELD = 7 * math.pi / 24


def measures_of(shape, folder):
    """Sphericity, and K along x, y, z, as clusterShape prints them."""
    said = subprocess.run([BUILD / "bin" / "clusterShape", *shape.split(), "--diameter", str(falling.DIAMETER)], cwd=folder, capture_output=True,
                          text=True, check=True).stdout
    return float(re.search(r"^ +sphericity +(\S+)", said, re.M)[1]), [float(v) for v in re.search(r"K, of the sphere's drag +(.*)", said)[1].split()]


def coefficient(law, phi, k, re):
    """G = C_D Re along an axis of resistance k: the creeping part of the real shape, the inertial part of the law."""
    of = getattr(drag_oracle, law)
    at = lambda sphericity, re: of(sphericity, re, sphericity) * re
    least = 1e-12
    return k * at(1.0, least) + at(phi, re) - at(phi, least)


def speed_of(law, phi, k, mud):
    """Root of the balance; mud: tau0, k, n."""
    d, density = falling.DIAMETER, falling.FLUID_DENSITY

    def excess(u):
        x = mud[1] * (u / d) ** mud[2] + YIELD * mud[0]
        return math.pi / 8 * d * d * x * coefficient(law, phi, k, density * u * u / x) - falling.WEIGHT

    low, high = 1e-9, 10.0
    for _ in range(200):
        middle = math.sqrt(low * high)
        low, high = (low, middle) if excess(middle) > 0 else (middle, high)
    return low


class Falling(unittest.TestCase):
    def let_fall(self, shape, mud, law, axes=None, torques=falling.TORQUES):
        """Falls, and compares the speed with the root; the outcome."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            if axes:
                falling.write_ellipsoid(axes, folder / "body.stl")
            phi, k = measures_of(shape, folder)
            expected = speed_of(law, phi, k[2], mud)
            fluid = f"herschel_bulkley {mud[0]} {mud[1]} {mud[2]} density {falling.FLUID_DENSITY}"
            result = falling.fall(BUILD, folder, falling.Body(shape, axes, True), fluid, f"drag {law} {torques}", expected, 200.0)
        self.assertAlmostEqual(result["speed"] / expected, 1, delta=TOLERANCE, msg=f"{shape}, {mud}, {law}")
        return result

    def test_disks_fall_broadside_at_the_speed_of_the_balance(self):
        """Newtonian, power-law and Herschel-Bulkley fluid, Re 1 to 20."""
        for mud, law in (((0, 0.05, 1), "schiller_naumann"), ((0, 0.2, 0.6), "haider_levenspiel"), ((0.2, 0.1, 0.65), "ganser"), ((0.2, 0.1, 0.65), "chien")):
            result = self.let_fall("disk 48", mud, law)
            self.assertLess(result["thinnest"][1], 0.1)
            self.assertLess(result["path"][1], 0.1)

    def test_a_rod_falls_crosswise(self):
        result = self.let_fall("smooth box 4 1 1 rounding 0.5", (0, 0.05, 1), "haider_levenspiel")
        self.assertGreater(result["longest"][0], 89.9)

    def test_a_cube_keeps_its_attitude(self):
        result = self.let_fall("smooth cube rounding 0.05", (0, 0.05, 1), "haider_levenspiel")
        for k in (0, 1):
            self.assertAlmostEqual(result["thinnest"][k], math.degrees(math.acos(math.cos(math.radians(50)) * math.cos(math.radians(20)))), delta=1e-4)
        self.assertLess(result["path"][1], 1e-4)

    def test_without_pitching_a_disk_keeps_its_tilt(self):
        """The twin that must fail: it drifts, and is faster than broadside."""
        with self.assertRaises(AssertionError):
            self.let_fall("disk 48", (0, 0.05, 1), "schiller_naumann", torques="oriented on drag_torque dennis")


class Scene(unittest.TestCase):
    def test_a_point_keeps_its_drag_and_reynolds_number(self):
        """The body of the scene has the weight that holds C_D at Re."""
        point = drag_points.Point(0.8, 37.0, 2.5, "", 0, "fragment in water; axes 4 2 1 mm", 0.7)
        speed, d = falling.speed_of(point), falling.DIAMETER
        self.assertAlmostEqual(math.pi / 8 * falling.FLUID_DENSITY * d * d * speed ** 2 * point.cd / falling.WEIGHT, 1, delta=1e-12)
        self.assertAlmostEqual(falling.FLUID_DENSITY * speed * d / falling.viscosity_of(point) / point.re, 1, delta=1e-12)
        self.assertEqual(falling.body_of(point).axes, (4.0, 2.0, 1.0))
        self.assertIsNone(falling.body_of(point._replace(shape="film in water; axes 4 2 0.01 mm")))

    def test_attitudes(self):
        for least, largest, name in ((0, 1, "broadside"), (1, 30, "flutters"), (52, 53, "inclined")):
            self.assertEqual(falling.attitude({"thinnest": (least, largest)}), name)


class Measured(unittest.TestCase):
    def test_rows(self):
        """A row of each set that pitching turns: its speed is the root with the resistance that the run has put into the cache."""
        points = [p for p in drag_points.read(DATA) if p.flag == drag_points.GOOD]
        for start in ("fragment in water; axes 4.196 2.330", "fiber in water; axes 4.233 0.900"):
            point = next(p for p in points if p.shape.startswith(start))
            body = falling.body_of(point)
            with tempfile.TemporaryDirectory() as name, unittest.mock.patch.dict(os.environ, ECCENTRA_CACHE=name):
                folder = pathlib.Path(name)
                result = falling.fall(BUILD, folder, body, falling.newtonian(point), f"drag schiller_naumann {falling.TORQUES}", falling.speed_of(point),
                                      falling.lengths_of(point, body))
                across = float(next(folder.glob("resistance-*.txt")).read_text().splitlines()[3].split()[8])
            expected = speed_of("schiller_naumann", 1.0, across, (0, falling.viscosity_of(point), 1))
            self.assertAlmostEqual(result["speed"] / expected, 1, delta=TOLERANCE, msg=start)
            self.assertEqual(falling.attitude(result), "broadside", start)


if __name__ == "__main__":
    if "Measured" in sys.argv and not DATA.is_file():
        print(f"there is no {DATA}: name the file of measured points in ECCENTRA_DRAG_POINTS")
        sys.exit(77)
    unittest.main()
