# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the fits of scripts/study: roots of noisy results, predictions of errors; and of the script that calibrates spheres."""
import csv
import dataclasses
import math
import os
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("ECCENTRA_BUILD", ROOT / "build"))
sys.path.insert(0, str(ROOT / "scripts"))
from study import calibration, choice, forecast, least_squares, level_study, levels, method_study, prediction, timing  # noqa: E402
from study.commands import accuracy_cost  # noqa: E402


class LeastSquares(unittest.TestCase):
    def test_line_and_its_variance(self):
        x, errors = [0.0, 1.0, 2.0, 3.0], [0.1, 0.2, 0.1, 0.4]
        found, matrix = least_squares.fit([[1.0] * 4, x], [2 + 3 * v for v in x], [e**-2 for e in errors])
        self.assertAlmostEqual(found[0], 2)
        self.assertAlmostEqual(found[1], 3)
        # Closed form of a weighted line: var(slope) = 1 / sum w (x - mean)^2.
        w = [e**-2 for e in errors]
        mean = sum(a * b for a, b in zip(w, x)) / sum(w)
        self.assertAlmostEqual(least_squares.variances(matrix)[1], 1 / sum(a * (b - mean) ** 2 for a, b in zip(w, x)))
        self.assertIsNone(least_squares.fit([[1.0] * 4, [2.0] * 4], x, w)[0])


class Calibration(unittest.TestCase):
    def search(self, result, wanted, error, noise, chance):
        points = [(x, chance.gauss(result(x), noise), noise) for x in (0.0, 0.2, 0.8)]
        for _ in range(5):
            at = calibration.next_coefficient(points, wanted, error, 0.01)
            if at is None:
                break
            points.append((at, chance.gauss(result(at), noise), noise))
        return calibration.root(points, wanted, error)

    def test_root_of_a_noisy_curve_and_its_error(self):
        for sign in (1, -1):  # a heap grows with friction, a discharge falls
            chance, scaled = random.Random(4), []
            result = lambda mu: sign * 30 * (1 - math.exp(-4 * mu))
            for _ in range(100):
                found = self.search(result, chance.gauss(result(0.23), 0.4), 0.4, 0.6, chance)
                self.assertEqual(found.side, "")
                scaled.append((found.value - 0.23) / found.error)
            self.assertLess(abs(statistics.fmean(scaled)), 0.6)  # a straight line through a curve: half an error
            self.assertGreater(statistics.stdev(scaled), 0.7)
            self.assertLess(statistics.stdev(scaled), 1.6)

    def test_exact_line(self):
        points = [(0.0, 1.0, 0.1), (1.0, 3.0, 0.1)]
        found = calibration.root(points, 2.0, 0.3)
        self.assertAlmostEqual(found.value, 0.5)
        self.assertAlmostEqual(found.error, math.sqrt(0.1**2 / 2 + 0.3**2) / 2)  # at the middle of a line of slope 2

    def test_what_has_no_root(self):
        rising = [(0.0, 1.0, 0.1), (0.5, 3.0, 0.1), (1.0, 5.0, 0.1)]
        self.assertEqual(calibration.root(rising, 6.0, 0.1).side, "above")
        self.assertEqual(calibration.root(rising, 0.5, 0.1).side, "below")
        falling = [(x, -y, e) for x, y, e in rising]
        self.assertEqual(calibration.root(falling, -6.0, 0.1).side, "above")
        self.assertEqual(calibration.root(falling, -0.5, 0.1).side, "below")
        self.assertEqual(calibration.root([(0.0, 1.0, 0.1), (1.0, 1.1, 0.1)], 2.0, 0.1).side, "flat")
        self.assertIsNone(calibration.next_coefficient(rising, 6.0, 0.1, 0.01))
        self.assertEqual(calibration.root(rising, 6.0, 0.1).words(), "at least 1")


class Reported:
    """A store in which every run has ended, with what the report of a vertical hole has: no height of the solids' centre."""
    RESULT = {"mean": {"flux": (2e-4, 1e-6), "gradient": (300.0, 1.0)}, "drift": {"flux": (-1e-5, 1e-6), "gradient": (1.0, 2.0)},
              "cpu": 2.0, "wall": 3.0, "critical": 1e-4, "contacts": 3, "parts": dict.fromkeys(timing.PARTS, 0.1)}

    def run_all(self, _, jobs):
        return {job.key(): self.RESULT for job in jobs}

    def result_of(self, _):
        return self.RESULT


class VerticalHole(unittest.TestCase):
    """The study of the annulus at 0 degrees, where solids have no height: its runs take minutes, so that none is made here."""

    def test_levels_and_methods_do_without_it(self):
        size = accuracy_cost.SIZES["quick"]
        with tempfile.TemporaryDirectory() as folder:
            study = level_study.Study(Reported(), BUILD, dataclasses.replace(size, points=((0, 0.58),)), ("cube",), ("section",), None, 2,
                                      pathlib.Path(folder))
            self.assertEqual(study.run(), [])
            self.assertEqual([(group.scene, group.judged) for group in study.groups],
                             [("section 0 0.58 flux", True), ("section 0 0.58 gradient", False)])
            self.assertEqual(study.groups[0].rows[0].value, 200)
            self.assertIn("annulus 0 deg, 0.58 m/s: solids flux at 5 %: S1 -5.0 +- 0.4 %, ", choice.not_steady(study.groups)[0])  # of two seeds
            self.assertNotIn("gradient", choice.not_steady(study.groups)[0])
            methods = method_study.Study(Reported(), BUILD, dataclasses.replace(size, methods=dataclasses.replace(size.methods, inclinations=(0,))),
                                         pathlib.Path(folder))
            self.assertEqual(methods.run(), [])
            self.assertTrue(all(math.isnan(row["value"][0]) == (row["quantity"] == "height") for row in methods.rows))
            self.assertNotIn("Not steady", "".join(methods.write()))  # 1 +- 2 of 300 Pa/m
            with unittest.mock.patch.dict(Reported.RESULT, drift={"gradient": (-30.0, 2.0)}):
                methods = method_study.Study(Reported(), BUILD, size, pathlib.Path(folder))
                methods.run()
                self.assertIn("the pressure gradient changed by more than 2 % and 3 standard errors: centre -10.0 +- 0.7 %, ", "".join(methods.write()))


class Prediction(unittest.TestCase):
    DEFECTS = {"S1": 1.0, "C8": 0.5, "C27": 0.3, "C64": 0.2, "C125": 0.1}

    def test_errors_that_follow_geometry_and_scene_are_predicted(self):
        chance = random.Random(3)
        scenes = {"heap": 2.0, "drum": 0.6, "hopper": 1.4, "annulus": 0.1}
        sizes = {s: {n: abs(chance.gauss(c * g, 0.01 * c)) for n, g in self.DEFECTS.items()} for s, c in scenes.items()}
        noises = {s: dict.fromkeys(self.DEFECTS, 0.01) for s in scenes}
        made = prediction.leave_one_out(sizes, noises, self.DEFECTS, scenes)
        self.assertEqual(len(made), 20)
        self.assertGreaterEqual(sum(f.holds() for f in made), 16)
        self.assertTrue(all(abs(f.predicted - f.measured) < 0.05 * scenes[f.scene] for f in made))
        self.assertNotIn("of no use", prediction.words_of(made))
        alike = prediction.leave_one_out(sizes, noises, self.DEFECTS, dict.fromkeys(scenes, 1.0))  # that all scenes ask for shape alike is wrong
        miss = lambda forecasts: sum((f.predicted - f.measured) ** 2 for f in forecasts)
        self.assertGreater(miss(alike), 25 * miss(made))

    def test_a_scene_is_predicted_without_its_own_results(self):
        scenes = {"a": 0.5, "b": 1.0, "c": 2.0}
        sizes = {s: {n: c * g for n, g in self.DEFECTS.items()} for s, c in scenes.items()}
        noises = {s: dict.fromkeys(self.DEFECTS, 0.0) for s in sizes}
        of_c = lambda: {f.level: f.predicted for f in prediction.leave_one_out(sizes, noises, self.DEFECTS, scenes) if f.scene == "c"}
        before = of_c()
        sizes["c"] = {n: 7.0 for n in self.DEFECTS}
        self.assertEqual(before, of_c())
        for level, value in before.items():
            self.assertAlmostEqual(value, 2 * self.DEFECTS[level])

    def test_errors_without_a_rule_are_of_no_use(self):
        chance = random.Random(8)
        sizes = {s: {n: chance.random() for n in self.DEFECTS} for s in ("a", "b", "c", "d")}
        noises = {s: dict.fromkeys(self.DEFECTS, 0.01) for s in sizes}
        made = prediction.leave_one_out(sizes, noises, self.DEFECTS, dict.fromkeys(sizes, 1.0))
        self.assertIn("of no use", prediction.words_of(made))
        self.assertGreater(statistics.fmean(f.error for f in made), 0.2)  # the prediction knows how far off it is
        self.assertEqual(prediction.leave_one_out({"a": {}, "b": {}}, {}, self.DEFECTS, {"a": 1, "b": 1}), [])
        # Scenes that do not react say nothing of others.
        self.assertEqual(prediction.leave_one_out(sizes, noises, self.DEFECTS, {"a": 1, "b": 1, "c": 0, "d": 0}), [])

    def test_what_is_learned_is_learned_from_other_scenes(self):
        # Each size is fitted by that of the other scene: a = 2 sum(v w) / sum(v^2 + w^2).
        one = {"S1": 0.9, "C8": 0.2, "C27": 0.6}
        other = {name: 1 - value for name, value in one.items()}
        a, b, _ = prediction.learn({"a": one, "b": other}, dict.fromkeys(one, 0.0))
        self.assertAlmostEqual(a, 2 * sum(v * (1 - v) for v in one.values()) / sum(v**2 + (1 - v) ** 2 for v in one.values()))
        self.assertEqual(b, 0.0)

    def test_sensitivity(self):
        self.assertAlmostEqual(prediction.sensitivity(1.0, 3.0), 1.0)
        self.assertAlmostEqual(prediction.sensitivity(-1.0, -3.0), 1.0)  # solids that slide back
        self.assertEqual((prediction.sensitivity(0.0, 5.0), prediction.sensitivity(2.0, 2.0), prediction.sensitivity(0.0, 0.0)), (2.0, 0.0, 0.0))

    def test_defect(self):
        self.assertEqual((prediction.defect(0.0, 0.5), prediction.defect(0.5, 0.5)), (1.0, 0.0))


class Forecast(unittest.TestCase):
    def group(self, title, deviations):
        ladder = [levels.Level("S1", "sphere"), levels.Level("S1 mu 0.20", "friction", mu=0.2), levels.Level("C8", "cluster", "cube 8"),
                  levels.smooth("cube", 0.15)]
        rows = [level_study.Row(level, 1.0 + (0 if math.isnan(off) else off), 0.02, 3, 1.0, 1.0, {}, 1e-5, {}, "", off, 0.03)
                for level, off in zip(ladder, [*deviations, math.nan])]
        return level_study.Group(title, "cube", title, "", rows, True)

    def test_page(self):
        groups = [self.group(name, [-factor, -0.6 * factor, -0.5 * factor]) for name, factor in (("a", 0.8), ("b", 0.9), ("c", 0.7))]
        asks = {name: 0.4 * factor / (1 - 0.8 * factor) for name, factor in (("a", 0.8), ("b", 0.9), ("c", 0.7))}  # S
        with tempfile.TemporaryDirectory() as folder:
            page = forecast.page_of(BUILD, groups, pathlib.Path(folder), "forecast")
            self.assertEqual(forecast.page_of(BUILD, groups[:2], pathlib.Path(folder), "none"), [])
            with open(pathlib.Path(folder) / "forecast.csv", newline="") as rows:
                table = {(row["level"], row["scene"]): row for row in csv.DictReader(rows)}
        self.assertEqual(len(table), 9)
        self.assertAlmostEqual(float(table["S1", "a"]["predicted"]), asks["a"] * (0.9 / asks["b"] + 0.7 / asks["c"]) / 2, delta=0.1)
        self.assertIn(f"| S |  | {asks['a']:.2f} | ", page[1])
        self.assertIn("| S1 | 1.00 | ", page[1])
        lacks = {line.split("|")[1].strip(): float(line.split("|")[2]) for line in page[1].splitlines()[3:]}
        self.assertLess(lacks["C8"], lacks["S1 mu 0.20"])  # 0.245 and 0.20 of the 0.55 of the cube with true faces
        self.assertLess(lacks["S1 mu 0.20"], 1)


class CalibrateRolling(unittest.TestCase):
    SCRIPT = ROOT / "cases" / "own-scene" / "in.collapse"

    def run_script(self, *words):
        return subprocess.run([ROOT / "scripts" / "calibrate-rolling", "--build", BUILD, *map(str, words)], capture_output=True, text=True)

    def test_a_small_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            words = ("--shape", "cube", "--rounding", "0.3", "--scene", "mine", "--mine", self.SCRIPT, "--measure", "v_height", "--share", "0",
                     "--others", "heap", "--seeds", "2", "--jobs", "1", "--out", folder)
            said = self.run_script(*words)
            self.assertEqual(said.returncode, 0, said.stderr + said.stdout)
            with open(pathlib.Path(folder) / "calibration.csv", newline="") as rows:
                table = {row["judged_in"]: row for row in csv.DictReader(rows)}
            self.assertEqual(set(table), {"mine", "heap"})
            # The sphere that was fitted has the height of the cubes; without friction it lies on the floor (-30 %).
            self.assertLess(abs(float(table["mine"]["deviation"])), 0.25)
            self.assertGreater(float(table["mine"]["mu_shape"]), 0.05)
            self.assertTrue((pathlib.Path(folder) / "calibration.svg").is_file())
            self.assertNotIn(" s of CPU |", self.run_script(*words).stderr)  # nothing is repeated

    def test_damping_of_an_eccentric_sphere(self):
        with tempfile.TemporaryDirectory() as folder:
            words = ("--shape", "cube", "--rounding", "0.3", "--scene", "drum", "--others", "drum", "--seeds", "2", "--jobs", "2", "--out", folder,
                     "--vary", "rockingDamping", "--range", "0", "10")
            said = self.run_script(*words)
            self.assertEqual(said.returncode, 0, said.stderr + said.stdout)
            with open(pathlib.Path(folder) / "points.csv", newline="") as rows:
                angle = {float(row["rockingDamping"]): float(row["mean"]) for row in csv.DictReader(rows)}
            self.assertGreater(angle[10] - angle[0], 2)  # degrees: without damping its spheres rock on, and the bed lies flatter

    def test_bad_words(self):
        for words, says in ((["--seeds", "1"], "--seeds is 1: give 2 to 40"), (["--scene", "mine"], "--scene mine needs --mine FILE"),
                            (["--scene", "ocean"], "invalid choice: 'ocean'"), (["--range", "0.5", "0.1"], "--range is 0.5 0.1: give two rising numbers"),
                            (["--mu-shape", "0.1"], "--mu-shape is 0.1: give a number from 0 on, with --vary mu_s alone"),
                            (["--mine", self.SCRIPT], "--mine FILE and --measure COLUMN belong together"),
                            (["--vary", "mu_s", "--mine", self.SCRIPT, "--measure", "v_height"], "no line 'variable mu_s index ...'"),
                            (["--vary", "rockingDamping", "--mine", self.SCRIPT, "--measure", "v_height"], "--vary rockingDamping is there for our scenes"),
                            (["--shape", "cube 9"], "clusterShape failed: ")):
            with self.subTest(" ".join(map(str, words))), tempfile.TemporaryDirectory() as folder:
                said = self.run_script("--out", pathlib.Path(folder) / "results", *words)
                self.assertNotEqual(said.returncode, 0)
                self.assertIn(says, said.stderr)
                self.assertNotIn("Traceback", said.stderr)
                self.assertEqual(list(pathlib.Path(folder).iterdir()), [])


if __name__ == "__main__":
    unittest.main()
