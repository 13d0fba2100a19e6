# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of scripts/study: its statistics on closed forms, its store of runs, its charts, and what the scripts say of bad words."""
import csv
import inspect
import json
import math
import os
import pathlib
import random
import re
import statistics
import subprocess
import sys
import tempfile
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("ECCENTRA_BUILD", ROOT / "build"))
sys.path.insert(0, str(ROOT / "scripts"))
from study import (annulus_scene, charts, choice, cohesion, convergence, dry, figures, frames, grain_shapes, ladders, level_study, levels,  # noqa: E402
                   loop_data, measures, page_parts, patch_walls, power, programs, runs, scene_bed, scene_grains, section, shape_levels, tables, timing,
                   truth_chart, user_scene, user_study, wedge)
from study.commands import accuracy_cost, creeping_drag, paper  # noqa: E402


class Measures(unittest.TestCase):
    def test_standard_error_of_a_mean(self):
        mean, error = measures.mean_and_error([1.0, 2.0, 3.0, 4.0])
        self.assertAlmostEqual(mean, 2.5)
        self.assertAlmostEqual(error, math.sqrt(5 / 3) / 2)  # s^2 = sum (x - m)^2 / 3 = 5/3
        self.assertEqual(measures.mean_and_error([7.0])[0], 7.0)
        self.assertTrue(math.isnan(measures.mean_and_error([7.0])[1]))

    def test_drift(self):
        chance = random.Random(4)
        change, error = measures.drift([0.1 * k for k in range(100)])
        self.assertAlmostEqual(change, 5)  # of a ramp: half of its length times its slope
        self.assertAlmostEqual(error, math.hypot(*2 * [statistics.stdev([0.0, 1, 2, 3, 4]) / math.sqrt(5)]))  # blocks of ten rise by one
        steady = [measures.drift([chance.gauss(1, 0.2) for _ in range(200)]) for _ in range(200)]
        self.assertGreater(sum(abs(d) < 3 * e for d, e in steady), 190)  # Student's distribution with few blocks: 1.7 % lie beyond
        self.assertAlmostEqual(statistics.fmean(e for _, e in steady), 0.2 * math.sqrt(2 / 100), delta=0.002)
        self.assertTrue(all(math.isnan(v) for v in measures.drift([1.0] * 9)))
        self.assertEqual(measures.mean_of_measured([(1.0, 0.3), (3.0, 0.4)]), (2.0, 0.25))

    def test_deviation_and_its_error(self):
        off, error = measures.deviation(11.0, 0.3, 10.0, 0.4)
        self.assertAlmostEqual(off, 0.1)
        self.assertAlmostEqual(error, math.hypot(0.03, 11 * 0.4 / 100))
        self.assertTrue(math.isnan(measures.deviation(1.0, 0.1, 0.0, 0.1)[0]))

    def test_pareto_front(self):
        points = [(1, 10), (2, 11), (3, 4), (3, 5), (5, 4), (9, 1)]  # beaten: 1 by 0, 3 and 4 by 2
        self.assertEqual(measures.pareto_front(points), [0, 2, 5])
        self.assertEqual(measures.pareto_front([]), [])

    def test_knee(self):
        # error = 1/cost is a straight line in logarithms: no knee; one point below it is the knee, one above is not.
        self.assertIsNone(measures.knee([(1, 1), (10, 0.1), (100, 0.01)]))
        self.assertEqual(measures.knee([(1, 1), (10, 0.02), (100, 0.01)]), 1)
        self.assertIsNone(measures.knee([(1, 1), (10, 0.9), (100, 0.01)]))
        self.assertIsNone(measures.knee([(1, 1), (10, 0.5)]))

    def test_crossing_of_a_straight_ladder(self):
        # flux = 4 c - 1, wanted 1: c = 0.5; the error of the flux by its slope.
        at, error = measures.crossing([(0.25, 0.0, 0.1), (0.75, 2.0, 0.1)], 1.0)
        self.assertAlmostEqual(at, 0.5)
        self.assertAlmostEqual(error, math.hypot(0.05, 0.05) / 4)
        self.assertEqual(measures.crossing([(0, 0, 0), (1, 0.5, 0)], 1.0)[0], "above")
        self.assertEqual(measures.crossing([(0.1, 2, 0)], 1.0)[0], "below")

    def test_pairs_take_out_what_a_seed_does_to_both(self):
        noise = random.Random(5)
        references = [noise.gauss(10, 2) for _ in range(40)]
        # Twice the reference but for a little: the error is that of the rest, which both means alone do not know.
        pairs = [(2 * r + noise.gauss(0, 0.1), r) for r in references]
        off, error = measures.paired_deviation(pairs)
        self.assertAlmostEqual(off, 1.0, delta=0.01)
        self.assertAlmostEqual(error, 0.1 / 10 / math.sqrt(40), delta=0.0005)
        value, reference = (measures.mean_and_error(list(side)) for side in zip(*pairs))
        self.assertGreater(measures.deviation(*value, *reference)[1], 20 * error)
        # Independent sides: the same as by the errors of both means.
        pairs = [(noise.gauss(12, 1), noise.gauss(10, 1)) for _ in range(4000)]
        value, reference = (measures.mean_and_error(list(side)) for side in zip(*pairs))
        self.assertAlmostEqual(measures.paired_deviation(pairs)[1] / measures.deviation(*value, *reference)[1], 1, delta=0.05)
        self.assertTrue(math.isnan(measures.paired_deviation([(1.0, 0.0)])[0]))

    def test_runs_for_an_error(self):
        self.assertEqual(measures.runs_for(0.06, 4, 0.03), 16)  # a standard error falls as 1/sqrt(n)
        self.assertEqual(measures.runs_for(0.01, 4, 0.03), 4)
        self.assertEqual(measures.runs_for(math.nan, 1, 0.03), 1)

    def test_slope_of_a_cone(self):
        chance = random.Random(2)
        for degrees in (8, 30):
            slope, points = math.tan(math.radians(degrees)), []
            while len(points) < 1500:
                r, h = math.sqrt(chance.random()), chance.random() * slope
                if h < (1 - r) * slope:
                    points.append((r, h))
            self.assertAlmostEqual(measures.cone_angle(points) / degrees, 1, delta=0.04)  # mean height: 0.77/sqrt(1500) = 2 %
            runners = points + [(20.0, 0.0)] * 15  # 1 %, twenty radii away: moments of the distances would halve the angle
            self.assertAlmostEqual(measures.cone_angle(runners) / degrees, 1, delta=0.08)
        self.assertEqual(measures.cone_angle([(0.1 * k, 0.0) for k in range(1, 50)]), 0.0)


class Convergence(unittest.TestCase):
    SPHERES = (8, 27, 64, 125, 216, 512)

    def test_powers_are_found(self):
        fit = convergence.fit([(n, -2 * n**-0.5, 0.01) for n in self.SPHERES])
        self.assertAlmostEqual(fit.power, 0.5, places=6)
        self.assertAlmostEqual(fit.factor, -2, places=5)
        fit = convergence.fit([(n, 0.1 - 2 * n**-0.5, 0.01) for n in self.SPHERES], True)
        self.assertAlmostEqual(fit.power, 0.5, places=6)
        self.assertAlmostEqual(fit.rest, 0.1, places=5)
        self.assertIsNone(convergence.fit([(8, 0.1, 0.01), (27, 0.05, 0.01)]))
        self.assertIsNone(convergence.fit([(n, 0.1, math.nan) for n in self.SPHERES]))

    def test_errors_are_those_of_the_noise(self):
        chance, off, rest = random.Random(1), [], []
        for _ in range(60):
            points = [(n, chance.gauss(-2 * n**-0.4, 0.03), 0.03) for n in self.SPHERES]
            fit, free = convergence.fit(points), convergence.fit(points, True)
            off.append((fit.power - 0.4) / fit.power_error)
            rest.append(free.rest / free.rest_error)
        for scaled in (off, rest):  # 60 values of mean 0 and deviation 1, errors widened where chance fits badly
            self.assertLess(abs(statistics.fmean(scaled)), 0.5)
            self.assertGreater(statistics.stdev(scaled), 0.7)
            self.assertLess(statistics.stdev(scaled), 1.3)

    def test_words(self):
        words = convergence.words_of([(n, -2 * n**-0.5, 0.01) for n in self.SPHERES])
        self.assertIn("N^-p with p = 0.50 +- 0.01", words)
        self.assertIn("no rest can be told from zero", words)
        self.assertIn("more spheres do not remove it", convergence.words_of([(n, 0.3 + 2 * n**-1.0, 0.01) for n in self.SPHERES]))
        self.assertIn("None differs from zero", convergence.words_of([(n, 0.01, 0.02) for n in self.SPHERES]))
        self.assertEqual(convergence.words_of([(8, 0.1, 0.1)]), "")


class Power(unittest.TestCase):
    def test_seeds_bring_errors_down(self):
        chance = random.Random(7)
        drawn = lambda n: {"C8": {k: chance.gauss(8, 0.6) for k in range(n)}, "true": {k: chance.gauss(10, 1) for k in range(n)}}
        for _ in range(5):
            pilot = drawn(30)
            wanted = power.seeds_wanted(pilot, "true", 1000, 0.01, 0.005)
            self.assertEqual(wanted["true"], max(wanted.values()))  # pairs need the reference
            more = drawn(wanted["true"])
            mean, error = measures.mean_and_error(list(more["true"].values()))
            self.assertLess(error / mean, 0.01 * 1.3)  # the pilot knows the spread to 13 %
            self.assertLess(measures.paired_deviation([(more["C8"][k], more["true"][k]) for k in range(wanted["C8"])])[1], 0.005 * 1.3)
            self.assertGreater(wanted["true"], 30)

    def test_few_runs_are_not_trusted(self):
        for number, student in ((3, 1.32), (4, 1.20), (6, 1.11), (12, 1.05)):  # quantiles of Student's distribution at one standard deviation
            self.assertAlmostEqual(power.widened(1.0, number), student, delta=0.03)

    def test_limits(self):
        values = {"a": {1: 1.0, 2: 9.0}, "true": {1: 10.0, 2: 11.0}}
        self.assertEqual(power.seeds_wanted(values, "true", 12), {"a": 12, "true": 12})
        self.assertEqual(power.seeds_wanted({"a": {1: 3.0}, "true": {1: 3.0}}, "true", 12), {"a": 1, "true": 1})
        self.assertEqual(power.seeds_wanted({"a": {1: 3.0, 2: 3.0}, "true": {1: 0.0, 2: 0.0}}, "true", 12), {"a": 2, "true": 2})

    def test_a_scene_is_run_until_the_errors_or_the_limit(self):
        self.assertEqual(len(set(dry.SEEDS)), 40)
        level = lambda name: types.SimpleNamespace(name=name)
        value = lambda name, seed: (0.8 if name == "C8" else 1) * (9 + 2 * (dry.SEEDS.index(seed) % 2))  # +-10 %: some 12 runs bring it to 3 %
        for most in (3, 7, 40):
            study, results = level_study.Study.__new__(level_study.Study), {}
            study.pilot, study.most = 3, most
            study.dry = lambda scene, level, seed: types.SimpleNamespace(key=lambda: (level.name, seed))
            study.store = types.SimpleNamespace(run_all=lambda title, jobs: {job.key(): {"value": value(*job.key())} for job in jobs})
            study.run_scene("cube", "heap", [level("C8"), level("true")], {}, results)
            found = [result["value"] for (name, _), result in results.items() if name == "true"]
            mean, error = measures.mean_and_error(found)
            if most < 40:
                self.assertEqual(len(found), most)
            else:
                self.assertTrue(7 < len(found) < 40 and error / mean < power.REFERENCE_ERROR, (len(found), error / mean))


def quad(a, b, c, d):
    """A quadrangle as two triangles."""
    return [(a, b, c), (a, c, d)]


class Walls(unittest.TestCase):
    """Walls from the triangles of patches."""

    @staticmethod
    def tube(parts, radius, low, high, turn=2 * math.pi):
        """A cylinder along y about x = 3, z = 2."""
        at = [(3 + radius * math.cos(turn * i / parts), 2 + radius * math.sin(turn * i / parts)) for i in range(parts + 1)]
        return [t for (x, z), (u, w) in zip(at, at[1:]) for t in quad((x, low, z), (u, low, w), (u, high, w), (x, high, z))]

    def test_box_is_planes_that_face_the_mesh(self):
        g = [(x, y, z) for z in (0, 1) for y in (0, 2) for x in (0, 3)]
        sides = patch_walls.Surface("sides", quad(g[0], g[1], g[5], g[4]) + quad(g[2], g[3], g[7], g[6]))
        floor = patch_walls.Surface("floor", quad(g[0], g[1], g[3], g[2]))
        planes = patch_walls.walls_of(sides, [sides, floor], patch_walls.size_of([sides, floor]))
        self.assertEqual(sorted(abs(p.normal[1]) for p in planes), [1, 1])
        self.assertEqual(sorted(p.point[1] for p in planes), [0, 2])

    def test_plane_with_mesh_behind_it_stays_a_mesh(self):
        step = patch_walls.Surface("step", quad((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)))
        rest = patch_walls.Surface("rest", quad((1, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0)) + quad((0, 0, 2), (2, 0, 2), (2, 1, 2), (0, 1, 2)))
        wall, = patch_walls.walls_of(step, [step, rest], 3.0)
        self.assertEqual(wall.triangles, step.triangles)

    def test_cylinder_over_the_whole_length(self):
        tube = patch_walls.Surface("tube", self.tube(24, 0.5, -1, 4))
        wall, = patch_walls.walls_of(tube, [tube], patch_walls.size_of([tube]))
        self.assertEqual(wall.direction, 1)
        self.assertAlmostEqual(wall.radius, 0.5)
        self.assertAlmostEqual(wall.centre[0], 2)  # in cyclic order behind y: z, x
        self.assertAlmostEqual(wall.centre[1], 3)

    def test_part_of_a_cylinder_stays_a_mesh(self):
        tube = patch_walls.Surface("tube", self.tube(24, 0.5, -1, 4))
        for part in (self.tube(24, 0.5, -1, 3), self.tube(24, 0.5, -1, 4, math.pi)):
            wall, = patch_walls.walls_of(patch_walls.Surface("part", part), [tube], 5.0)
            self.assertEqual(wall.triangles, part)
        cone = [tuple((x * (1 + 0.01 * y), y, z) for x, y, z in t) for t in self.tube(24, 0.5, -1, 4)]
        wall, = patch_walls.walls_of(patch_walls.Surface("cone", cone), [tube], 5.0)
        self.assertEqual(wall.triangles, cone)

    def test_stl_there_and_back(self):
        tube = patch_walls.Surface("tube", self.tube(5, 0.5, -1, 4))
        again, = patch_walls.read_stl(patch_walls.stl_text(tube))
        self.assertEqual(again.name, "tube")
        for a, b in zip(again.points(), tube.points()):
            for x, y in zip(a, b):
                self.assertAlmostEqual(x, y, places=11)


class Grains(unittest.TestCase):
    """The ten grains by name."""

    def test_each_is_closed_and_convex_and_has_its_volume(self):
        self.assertEqual(len(grain_shapes.GRAINS), 10)
        for name in grain_shapes.GRAINS:
            triangles = grain_shapes.triangles_of(name)
            place = lambda p: tuple(round(c, 6) for c in p)
            edges = [(place(a), place(b)) for _, t in triangles for a, b in zip(t, (*t[1:], t[0]))]
            self.assertEqual(sorted(edges), sorted((b, a) for a, b in edges), name)
            corners = {p for _, t in triangles for p in t}
            for n, t in triangles:
                level = sum(x * y for x, y in zip(n, t[0]))
                self.assertLess(max(sum(x * y for x, y in zip(n, p)) for p in corners) - level, 1e-6, name)
            surface, = patch_walls.read_stl(grain_shapes.stl_of(name, 5e-3))
            self.assertAlmostEqual(grain_shapes.volume_of([(None, t) for t in surface.triangles]) / (math.pi / 6 * 5e-3**3), 1, places=6, msg=name)

    def test_each_is_the_same_in_every_run(self):
        self.assertEqual(grain_shapes.stl_of("flake", 4e-3), grain_shapes.stl_of("flake", 4e-3))
        first, = patch_walls.read_stl(grain_shapes.stl_of("needle", 4e-3))
        long, short = (max(p[d] for p in first.points()) - min(p[d] for p in first.points()) for d in (0, 2))
        self.assertGreater(long, 2.5 * short)


class Beds(unittest.TestCase):
    """Numbers that eccentra new prints."""

    def test_onset_is_where_ergun_carries_the_weight(self):
        bed = scene_bed.Packed(0.4, 2e-3, 0.9, 1e-3, 1000.0)
        onset = bed.onset(2600.0)
        self.assertAlmostEqual(bed.gradient(onset) / (0.6 * 1600 * 9.81), 1, places=9)
        # Kozeny's limit of a viscous fluid, and Burke's and Plummer's of inertia, in closed form.
        thick = scene_bed.Packed(0.4, 2e-3, 1.0, 10.0, 1000.0)
        self.assertAlmostEqual(thick.onset(2600.0) / (1600 * 9.81 * 0.4**3 * 4e-6 / (150 * 10 * 0.6)), 1, places=4)
        thin = scene_bed.Packed(0.4, 2e-3, 1.0, 1e-9, 1000.0)
        self.assertAlmostEqual(thin.onset(2600.0) / math.sqrt(1600 * 9.81 * 0.4**3 * 2e-3 / (1.75 * 1000)), 1, places=4)

    def test_step_is_rounded_down(self):
        for value, rounded in ((2.99e-5, 2.9e-5), (3e-5, 3e-5), (9.999e-4, 9.9e-4), (1.0, 1.0)):
            self.assertAlmostEqual(scene_grains.two_digits_down(value) / rounded, 1)


class Ladders(unittest.TestCase):
    def test_value_is_a_bound_where_the_top_carries_less(self):
        wanted = section.INJECTED
        reached = ladders.value_of([(0.1, wanted / 2, 0.0), (0.2, wanted * 1.5, 0.0)])
        self.assertAlmostEqual(reached.value, 0.15)
        bound = ladders.value_of([(0.1, -wanted, 0.0), (0.4, wanted / 2, 0.0)])
        self.assertEqual((bound.value, bound.bound, bound.slides), (0.4, 1, True))
        self.assertEqual(ladders.larger(bound, reached), 1)
        self.assertEqual(ladders.larger(reached, bound), -1)

    def test_of_two_bounds_the_one_that_carries_less_is_larger(self):
        a = ladders.value_of([(0.4, 1e-6, 1e-8)])
        b = ladders.value_of([(0.4, 2e-6, 1e-8)])
        self.assertEqual(ladders.larger(a, b), 1)
        self.assertEqual(ladders.larger(a, ladders.value_of([(0.4, 1.01e-6, 1e-8)])), 0)
        self.assertIsNone(ladders.larger(a, ladders.value_of([], "it failed")))

    def test_what_is_not_run_is_not_compared(self):
        unknown = ladders.value_of([], ladders.NOT_RUN)
        self.assertEqual(unknown.words(), "not run")
        self.assertIsNone(ladders.larger(unknown, ladders.value_of([(0.4, 1e-6, 1e-8)])))

    def test_further_fillings_find_where_a_bed_begins_to_move(self):
        begins, steep = 0.193, 3e-3  # filling, and rise of the flux above it [m3/s]
        flux = lambda filling: max(0.0, steep * (filling - begins))

        class Made(ladders.Ladders):
            def job(self, point, rung, seed):
                return runs.Job("", {"rung": rung, "seed": seed}, lambda folder: {})

        class Reported:
            plan, ran = False, []

            def run_all(self, _title, jobs):
                self.ran += [job.inputs["rung"] for job in jobs]
                return {job.key(): {"mean": {"flux": (flux(job.inputs["rung"]), 1e-9), "concentration": (job.inputs["rung"], 0)},
                                    "drift": {"flux": (changes * flux(job.inputs["rung"]), 1e-9)}} for job in jobs}

        point, changes = ladders.Point(levels.Level("S1", "sphere"), 80, 0.58), 0.0
        exact = begins + section.INJECTED / steep
        far = {}
        for refine in (0, 4):
            store = Reported()
            store.ran = []
            climbed = Made(store, None, ladders.Size(rungs=(0.02, 0.15, 0.25, 0.35), length=0.08, cells="", seconds=1, seeds=1, refine=refine), {})
            self.assertEqual(climbed.run([point]), [])
            found = climbed.values[point]
            far[refine] = abs(found.value - exact)
            self.assertEqual([filled for filled, *_ in found.rungs], sorted(store.ran))
            self.assertLessEqual(len(store.ran), 3 + refine)
            self.assertEqual(ladders.not_steady({"a": [(80, point)]}, climbed), "")
        self.assertLess(far[4], ladders.NARROW)
        self.assertLess(far[4], 0.4 * far[0])
        # A bed that comes to rest or begins to move: of the two fillings about the injected flux the upper one carries enough to be named.
        changes = -0.4
        climbed = Made(Reported(), None, ladders.Size(rungs=(0.02, 0.15, 0.25, 0.35), length=0.08, cells="", seconds=1, seeds=1), {})
        climbed.run([point])
        self.assertRegex(ladders.not_steady({"a": [(80, point)]}, climbed), r"changed by more than 5 % and 3 .*: a at 80, 25 %: 171 by -68[.]$")
        # Where the first filling carries the flux, nothing lies below it but the empty hole.
        self.assertIsNone(ladders.between([(0.02, 2 * section.INJECTED, 0.0)]))
        self.assertIsNone(ladders.between([(0.02, 0.0, 0.0), (0.35, 0.5 * section.INJECTED, 0.0)]))

    def test_fluxes_are_compared_at_the_same_filling(self):
        a = ladders.value_of([(0.02, 1e-6, 1e-8), (0.15, 2e-6, 1e-8)])
        b = ladders.value_of([(0.021, 2e-6, 1e-8), (0.09, 9e-6, 1e-8), (0.15, 1e-6, 1e-8)])
        said = figures.flux_trend([(a, b)], "x")
        self.assertEqual(said, "Flux carried at a filling, x: at 2 % it falls in 0, rises in 1 of 1; at 15 % it falls in 1, rises in 0 of 1 comparisons.")

    def test_filling(self):
        self.assertEqual(section.bodies_at(0.05, 0.3), 1213)  # 5 % of pi (0.0635^2 - 0.02413^2) 0.3 m3


class CreepingDrag(unittest.TestCase):
    def test_surfaces_are_the_body_and_a_sphere(self):
        for aspect in (1.0, 2.0, 0.5):
            at = wedge.surfaces(aspect, 50.0)
            along, across = at(0.0)
            self.assertAlmostEqual(along / across, aspect)
            self.assertAlmostEqual(along * across ** 2, 1)  # the volume of the sphere of radius 1
            self.assertAlmostEqual(at(1.0)[0] / 50, 1, delta=5e-4)
            self.assertAlmostEqual(at(1.0)[1] / 50, 1, delta=5e-4)

    def test_cross_coefficient(self):
        cases = [wedge.Case(index=0.8, bingham=b) for b in (0.0, 1.0, 10.0)]
        c, worst = creeping_drag.cross_coefficient([(case, creeping_drag.terms(case) + 1.3 * math.sqrt(case.bingham)) for case in cases])
        self.assertAlmostEqual(c, 1.3)
        self.assertAlmostEqual(worst, 0)
        self.assertAlmostEqual(creeping_drag.terms(wedge.Case(index=0.65, bingham=1.0)), 1.3454191712 + 4 / 3 / 24 * 3 / 0.143, delta=1e-9)

    def test_concentric_spheres(self):
        case = wedge.Case(outer=20.0)
        self.assertAlmostEqual(creeping_drag.without_outer_sphere(1.1264, case), 1, delta=1e-4)
        self.assertEqual(creeping_drag.without_outer_sphere(2.0, wedge.Case(bingham=1.0)), 2.0)

    def test_marching_ends_where_the_drag_is_steady(self):
        self.assertEqual(wedge.change_of([1.0, 1.0]), math.inf)
        self.assertAlmostEqual(wedge.change_of([9.0, 1.1, 1.0, 1.05, 1.0]), 0.05)
        starts, chunks = wedge.stages(wedge.Case(cap=100.0))
        self.assertEqual(([cap for _, cap in starts], chunks[0][1]), ([3.0, 30.0], 100.0))
        lasts = [last for last, _ in starts + chunks]
        self.assertEqual(lasts, sorted(set(lasts)))


class Timing(unittest.TestCase):
    LOG = ("Pair  time (%) = 2 (20)\nNeigh time (%) = 1 (1)\nOther time (%) = 0.5 (1)\nFix floor cluster/wall/gran time (%) = 3 (1)\n"
           "Fix move nve/cluster time (%) = 1.5 (1)\nFix flow fluid/couple time (%) = 9 (1)\n")

    def test_parts(self):
        parts = timing.parts_of(self.LOG + self.LOG)
        self.assertEqual(parts, {"contact": 10, "integration": 3, "neighbours": 2, "fluid": 0, "link": 0, "other": 1})
        self.assertAlmostEqual(sum(timing.scaled(parts, 4.0).values()), 4.0)


class Section(unittest.TestCase):
    def test_tolerances_reach_the_solver(self):
        words = {"seconds": 0.02, "length": 0.1, "cells": "4 16 5", "count": 20, "inclination": 0, "velocity": 0.58, "seed": section.SEEDS[0],
                 "report": 1, "interval": 64}
        with tempfile.TemporaryDirectory() as folder:
            job = section.section_job(BUILD, "short", words, keep="ran", tolerances=("0.25", "0.125"))
            self.assertGreater(job.work(pathlib.Path(folder))["mean"]["gradient"][0], 0)
            text = (pathlib.Path(folder) / "ran" / "system" / "fvSolution").read_text()
        self.assertIn("pFinal  { $p; relTol 0.25; }", text)
        self.assertIn("UFinal  { $U; relTol 0.125; }", text)
        self.assertNotEqual(job.key(), section.section_job(BUILD, "short", words, keep="ran").key())

    def test_means_are_over_enough_rows_to_tell_a_drift(self):
        times = [ladders.SHARE * size.seconds for size, _ in paper.SIZES.values()]
        times += [0.5 * seconds for size in accuracy_cost.SIZES.values() for seconds in size.seconds.values()]
        self.assertGreaterEqual(round(min(times) / (section.REPORT * section.FLUID_STEP)), 2 * measures.BLOCKS)


class Levels(unittest.TestCase):
    def test_step_divides_the_period_and_keeps_the_margin(self):
        step, parts = levels.dividing_step(5e-3, 1e-4)
        self.assertEqual(parts, 167)
        self.assertAlmostEqual(step * parts, 5e-3)
        self.assertLessEqual(step, levels.SAFETY * 1e-4)

    def test_fine_disk(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "disk.clump"
            levels.fine_disk(file)
            rows = [[float(w) for w in line.split()] for line in file.read_text().splitlines()]
        self.assertEqual(len(rows), 80)
        self.assertAlmostEqual(max(math.hypot(x, y) for x, y, _, _ in rows), 1.0)

    def test_ladders_end_at_the_true_body_of_equal_volume(self):
        volume = {}
        with tempfile.TemporaryDirectory() as folder:
            fine = levels.fine_disks(pathlib.Path(folder))
            for body in levels.ROUNDING:
                for level in levels.ladder_of(body, {}, fine):
                    if level.has_shape():
                        volume[level.name] = levels.measured(BUILD, level.shape, "--diameter", "6.35e-3")["volume"]
                self.assertEqual(level, levels.smooth(body, levels.ROUNDING[body]))
        for finest in ("C512", "D224", "smooth 0.15", "smooth 0.3"):
            self.assertIn(finest, volume)
        for name, found in volume.items():
            self.assertAlmostEqual(found / (math.pi * 6.35e-3**3 / 6), 1, delta=1e-6, msg=name)
        self.assertEqual(levels.ladder_of("cube", {}, fine, 0.5)[-1].name, "smooth 0.5")
        self.assertEqual(len({level.name for level in levels.ladder_of("cube", {}, fine, 0.5)}), len(levels.ladder_of("cube", {}, fine, 0.5)))

    def test_plain_words(self):
        row = lambda name, value, cpu: level_study.Row(levels.Level(name, "cluster"), value, 0.01, 3, cpu, cpu, {}, 1e-5, {})
        group = level_study.Group("scene", "cube", "slope", "degrees", [row("C8", 12.0, 1.0), row("C27", 10.2, 2.0), row("C64", 10.0, 8.0)], True)
        group.compare()
        words = group.plain_words()
        self.assertIn("Within 5 % of it, the cheapest is C27 (+2.0 +-", words)
        self.assertIn("it is 4.0 times as fast", words)

    def test_a_row_says_which_level_to_take(self):
        row = lambda name, kind, value, cpu: level_study.Row(levels.Level(name, kind), value, 0.01, 3, cpu, cpu, {}, 1e-5, {})
        group = level_study.Group("scene", "cube", "slope", "degrees", [row("S1", "sphere", 5.0, 0.5), row("C8", "cluster", 12.0, 1.0),
                                                                        row("C27", "cluster", 10.2, 2.0), row("C64", "cluster", 10.1, 4.0),
                                                                        row("smooth 0.15", "smooth", 10.0, 8.0)], True)
        group.compare()
        table = choice.page_of([group])[1].splitlines()
        self.assertEqual(table[2].split(" | ")[1:8], ["10.0 +- 0.010 degrees", "8.00", "C27", "+2.0 +- 0.1", "4.0", "-50", "0.062"])
        self.assertEqual(choice.page_of([level_study.Group("scene", "cube", "slope", "degrees", group.rows[-1:], True)]), [])

    def test_a_body_with_other_corners_is_no_model(self):
        row = lambda name, kind, value, cpu: level_study.Row(levels.Level(name, kind), value, 0.01, 3, cpu, cpu, {}, 1e-5, {})
        group = level_study.Group("scene", "cube", "slope", "degrees", [row("C8", "cluster", 12.0, 1.0), row("smooth 0.3", "rounding", 10.1, 0.5),
                                                                        row("smooth 0.15", "smooth", 10.0, 8.0)], True)
        group.compare()
        self.assertIn("the nearest is C8", group.plain_words())
        self.assertEqual([cells[4] for cells in level_study.csv_cells(group)], ["C8", "smooth 0.15"])


class TruthChart(unittest.TestCase):
    def rows(self, deviations):
        row = lambda name, kind, cpu, off: level_study.Row(levels.Level(name, kind), 1.0, 0.02, 3, cpu, cpu, {}, 1e-5, {}, "", off, 0.01)
        return [row(name, "cluster", cpu, off) for name, cpu, off in deviations] + [row("smooth 0.15", "smooth", 10.0, math.nan)]

    def test_true_body_at_zero_and_what_is_far_off_at_the_edge(self):
        panel = truth_chart.signed("a heap", self.rows([("C8", 1.0, -0.4), ("C27", 3.0, 1.8)]))
        points = [point for series in panel.series for point in series.points]
        self.assertEqual([(p.x, p.y) for p in points[:2]], [(1.0, -40.0), (3.0, 100.0)])
        self.assertEqual((points[1].label, points[1].bound), ("C27 +180 %", 1))
        self.assertEqual((panel.noise, panel.truth), (2.0, (10.0, "smooth 0.15")))
        whole = truth_chart.overall([self.rows([("C8", 1.0, -0.4), ("C27", 3.0, 0.1)]), self.rows([("C8", 3.0, 0.2)])])
        self.assertEqual([(round(p.x, 9), round(p.y, 9), p.label) for p in whole.series[0].points], [(0.2, 30.0, "C8")])
        words, _ = Charts.drawn(self, panel, whole)
        self.assertTrue(any("the true body, smooth 0.15" in word for word in words), words)
        self.assertTrue(any("its noise, +- 2.0 %" in word for word in words), words)


def write_brick(path, a, b, c):
    """A box as STL."""
    corners = [(x * a, y * b, z * c) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    facet = lambda *of: "facet normal 0 0 0\nouter loop\n" + "".join("vertex {:g} {:g} {:g}\n".format(*corners[k]) for k in of) + "endloop\nendfacet\n"
    path.write_text("solid brick\n" + "".join(facet(i, j, k) + facet(i, k, l) for i, j, k, l in faces) + "endsolid brick\n")


class UserScene(unittest.TestCase):
    """A shape and a script of the user."""
    SCRIPT = ROOT / "cases" / "own-scene" / "in.collapse"
    THERMO = ("Step Atoms x[1]\n 0 3 9\nLoop time of 1\n    Step    Atoms   x[1]   KinEng\n 1 3 0.25 1e-3\ninsertion: proc 0 at 0 %\n 2 3 0.5 1e-4\n"
              "Loop time of 2 on 1 procs\n")

    def test_the_last_table_of_thermo_output(self):
        self.assertEqual(user_scene.column_of(self.THERMO, "f_x[1]"), [0.25, 0.5])
        self.assertEqual(user_scene.column_of(self.THERMO, "KinEng"), [1e-3, 1e-4])
        with self.assertRaisesRegex(runs.RunFailed, "'v_y' is no column of the last 'run'; expected one of Step, Atoms, "):
            user_scene.column_of(self.THERMO, "v_y")
        with self.assertRaisesRegex(runs.RunFailed, "prints no table"):
            user_scene.column_of("nothing\n", "v_y")

    def test_inputs_are_what_the_script_names_and_does_not_write(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "in.x").write_text("include part.in # and not.this\ndump d all custom 10 old.dump id\nfix r all mesh/surface &\n file ring.stl\n")
            (folder / "part.in").write_text("read_data bodies.txt\n")
            for name in ("not.this", "old.dump", "ring.stl", "bodies.txt"):
                (folder / name).write_text("")
            self.assertEqual([file.name for file in user_scene.files_of(folder / "in.x")], ["bodies.txt", "part.in", "ring.stl"])

    def test_scripts_without_the_lines_are_refused(self):
        text = self.SCRIPT.read_text()
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder) / "in.x"
            for change, measure, says in (
                    (("variable        seed ", "variable        sed "), "v_height", "no line 'variable seed index ...'"),
                    (("seed ${seed}", "seed 15485863"), "v_height", "the variable 'seed' is declared and not used"),
                    (("1 ${mu_shape}", "1 0"), "v_height", "need 'variable mu_shape index 0'"),
                    (("", ""), "v_depth", "'v_depth' is in no thermo_style of")):
                script.write_text(text.replace(*change) if change[0] else text)
                with self.assertRaisesRegex(programs.Failure, re.escape(says)):
                    user_scene.read(script, measure, 0.5)
            self.assertTrue(user_scene.read(self.SCRIPT, "v_height", 0.5).takes_friction())

    def test_levels_of_a_stone(self):
        with tempfile.TemporaryDirectory() as folder:
            stone = pathlib.Path(folder) / "stone.stl"
            write_brick(stone, 1, 1.5, 2)
            ladder = shape_levels.read(BUILD, f"stl {stone}", ["sphere", "mu", "spheres 8 4", "hull"], 0.2)
            self.assertEqual([level.name for level in ladder.levels][-1], "hull 0.2")
            mu = ladder.facts["hull 0.2"]["mu_shape"]
            self.assertEqual([(level.name, level.kind) for level in ladder.levels[:-1]],
                             [("sphere", "sphere"), ("8 spheres", "cluster"), ("4 spheres", "cluster"), (f"mu {round(mu, 4):g}", "friction")])
            self.assertIn("spheres 8", ladder.levels[1].shape)
            without = shape_levels.read(BUILD, f"stl {stone}", ["spheres 4 8"])
            self.assertEqual(without.levels[-1].name, "8 spheres")
            self.assertIn("how far that one is off is not known", " ".join(without.remarks))

    def test_a_stone_in_a_script(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            write_brick(folder / "stone.stl", 1, 1.5, 2)
            words = ("--shape", f"stl {folder / 'stone.stl'}", "--levels", "sphere", "spheres 4", "hull", "--scene", self.SCRIPT, "--measure", "v_height",
                     "--share", "0", "--seeds", "2", "--jobs", "1", "--out", folder / "answer")
            said = run("accuracy-cost", *words)
            self.assertEqual(said.returncode, 0, said.stderr + said.stdout)
            with open(folder / "answer" / "levels.csv", newline="") as rows:
                table = {row["level"]: row for row in csv.DictReader(rows)}
            self.assertEqual(list(table), ["sphere", "4 spheres", "hull 0.15"])
            # Without resistance to rolling all spheres end on the floor, the stones on each other.
            self.assertAlmostEqual(float(table["sphere"]["mean"]) / 3.175e-3, 1, delta=0.1)
            self.assertGreater(float(table["hull 0.15"]["mean"]), 1.1 * float(table["sphere"]["mean"]))
            page = (folder / "answer" / "results.md").read_text()
            self.assertIn("the reference hull 0.15 gives", page)
            self.assertIn("What is not known: ", page)
            self.assertTrue((folder / "answer" / "answer.svg").is_file())
            self.assertNotIn(" s of CPU |", run("accuracy-cost", *words).stderr)  # nothing is repeated
            advice = subprocess.run([BUILD / "bin" / "clusterShape", "advise", "hull stone.stl rounding 0.15", "--error", "5", "--data",
                                     folder / "answer" / "levels.csv", "--json"], capture_output=True, text=True)
            self.assertEqual(json.loads(advice.stdout)["advice"][0]["level"], "sphere", advice.stderr)  # the cheapest


class UserStudy(unittest.TestCase):
    """The study itself, with results that are made up."""
    class Store:
        plan = False

        def __init__(self, spread):
            self.spread, self.ran = spread, set()

        def run_all(self, title, jobs):
            made = {}
            for job in jobs:
                self.ran.add(job.name)
                value = (8.0 if "cube 8" in job.name else 10.0) + random.Random(job.name).gauss(0, self.spread)
                made[job.key()] = {"critical": 1e-4, "contacts": 3} if "time step" in job.name else {
                    "value": value, "mean": {"flux": (value * 1e-6, 0), "height": (value * 1e-3, 0)}, "cpu": 2.0 if "cube 8" in job.name else 5.0, "wall": 9.0}
            return made

    def study(self, spread, names):
        ladder = shape_levels.Ladder([levels.Level("cube 8", "cluster", "cube 8", spheres=8), levels.smooth("cube", 0.15)],
                                     {"smooth 0.15": {"sphericity": 0.85}}, [])
        store = self.Store(spread)
        study = user_study.UserStudy(store, BUILD, ladder, None, names, (3, 12), 5.0)
        self.assertEqual(study.run(), [])
        return study, store

    def test_seeds_are_added_until_the_errors_are_small(self):
        for spread, least, most in ((0.01, 3, 3), (0.6, 3, 12), (5.0, 12, 12)):
            study, store = self.study(spread, ["drum"])
            group, = study.groups
            self.assertGreaterEqual(group.rows[-1].runs, least)
            self.assertLessEqual(group.rows[-1].runs, most)
            small = group.rows[-1].error < 0.03 * group.rows[-1].value and group.rows[0].deviation_error < 0.05
            self.assertTrue(small or group.rows[-1].runs == 12, spread)
            self.assertEqual("More seeds are needed" in group.plain_words(), not small)
        self.assertEqual(len([name for name in store.ran if name.startswith("drum ")]), 24)

    def test_annulus(self):
        study, store = self.study(0.01, ["annulus-40", "annulus-80"])
        flux, height = study.groups
        self.assertAlmostEqual(flux.rows[-1].value, 10.0, delta=0.1)
        self.assertEqual((flux.unit, height.unit), ("1e-6 m3/s", "mm"))
        self.assertAlmostEqual(height.rows[0].deviation, -0.2, delta=0.01)
        self.assertIn("annulus-40 cube 8 seed 49979687", store.ran)


class AnnulusScene(unittest.TestCase):
    def test_spheres_that_stand_for_a_shape_have_its_drag(self):
        scene = annulus_scene.AnnulusScene("annulus-80", 0.854)
        level = lambda kind, shape="sphere 1": levels.Level("x", kind, shape, mu=0.2)
        words = lambda one: scene.job(BUILD, one, section.SEEDS[0], 1e-4).inputs
        self.assertEqual(words(level("friction"))["sphericity"], "0.854")
        self.assertNotIn("sphericity", words(level("smooth", "smooth cube rounding 0.15")))
        self.assertEqual(words(level("smooth", "smooth cube rounding 0.15"))["shape"], "smooth cube rounding 0.15")
        self.assertEqual((scene.unit(), scene.value({"mean": {"height": (0.011, 0), "flux": (1e-6, 0)}})), ("mm", 11.0))
        flux = annulus_scene.AnnulusScene("annulus-0", 0.854)
        self.assertAlmostEqual(flux.value({"mean": {"height": (0.011, 0), "flux": (2e-6, 0)}}), 2.0)


class Overall(unittest.TestCase):
    def test_medians_over_scenes(self):
        def group(values):  # {level: (value, CPU seconds)}, the reference last
            rows = [level_study.Row(levels.Level(n, "cluster"), v, 0.0, 3, c, c, {}, 1e-5, {}) for n, (v, c) in values.items()]
            made = level_study.Group("scene", "cube", "slope", "degrees", rows, True)
            made.compare()
            return made

        groups = [group({"C8": (12.0, 1.0), "C27": (11.0, 3.0), "C64": (10.0, 10.0)}), group({"C8": (16.0, 2.0), "C64": (10.0, 10.0)}),
                  group({"C8": (13.0, 4.0), "C27": (11.0, 3.0), "C64": (10.0, 10.0)})]
        points, front, bend = level_study.Study.overall_points(None, groups)
        self.assertEqual([level.name for level in points], ["C8"])  # C27 is not in all scenes
        (share, error), = points.values()
        self.assertAlmostEqual(share, 0.2)  # median of .1, .2, .4
        self.assertAlmostEqual(error, 30.0)  # median of 20, 60, 30
        self.assertEqual(([level.name for level in front], bend), (["C8"], None))


class Measured(unittest.TestCase):
    HEAD = "Flow rate,Pipe rotation,Inclination,Concentration\n"

    def test_effect(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "loop.csv"
            file.write_text(self.HEAD + "100,0,90,0.4\n200,0,90,0.1\n100,80,90,0.2\n")
            rows = loop_data.read(file)
            self.assertEqual(loop_data.effect(rows, "Flow rate"), (1, 1, 0, 0.25))
            self.assertEqual(loop_data.effect(rows, "Pipe rotation"), (1, 1, 0, 0.5))
            file.write_text(self.HEAD + "100,none,90,0.4\n")
            with self.assertRaisesRegex(ValueError, "line 2, column 'Pipe rotation': 'none' is no number"):
                loop_data.read(file)


class HardCases(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        sys.path.insert(0, str(ROOT / "tests" / "stability"))
        from harness import case
        cls.groups = case.read_all(BUILD, False)

    def test_every_criterion_finds_its_values(self):
        for case in (case for group in self.groups for case in group.cases):
            for check in case.checks:
                for name, parameter in inspect.signature(check.measure).parameters.items():
                    given = name in case.values or name in check.fixed or name in ("run", "runs") or parameter.default is not parameter.empty
                    self.assertTrue(given, f"{case.id}: {check.measure.__name__} asks for {name}")
                self.assertLessEqual(set(check.fixed), set(inspect.signature(check.measure).parameters), case.id)

    def test_names_are_unique_and_each_family_is_seen_failing(self):
        cases = [case for group in self.groups for case in group.cases]
        self.assertEqual(len({case.id for case in cases}), len(cases))
        for group in self.groups:
            for name in {case.name for case in group.cases}:
                kinds = {case.failing for case in group.cases if case.name == name}
                self.assertIn(False, kinds)
            self.assertTrue(any(case.failing for case in group.cases), group.name)
            self.assertTrue(all(entry["fails"] for entry in group.entries), group.name)

    def test_the_same_texts_each_time(self):
        from harness import case
        again = case.read_all(BUILD, False)
        texts = lambda groups: [[run.files for run in one.runs] for group in groups for one in group.cases]
        self.assertEqual(texts(self.groups), texts(again))

    def test_a_number_that_is_none_never_passes(self):
        from harness.case import Check
        for relation in ("below", "above", "equals"):
            check = Check("what", lambda run: math.nan, **{relation: 0})
            self.assertFalse(check.holds(check.value({"run": None}), 0))


class Frames(unittest.TestCase):
    def test_discharge_is_the_slope_while_bodies_flow_freely(self):
        # 500 bodies/s from the fourth frame on, until 350 of 1000 stay.
        inside = [1000] * 3 + [max(350, 1000 - 5 * k) for k in range(200)]
        frame = lambda n: {k: (0, 0, 0.1 if k < n else -0.1, 0, 0, 0) for k in range(1000)}
        self.assertAlmostEqual(frames.steady_discharge([frame(n) for n in inside], 1000)[0], 500)
        # Too quick for a fit: from 90 to 50 % in one frame.
        self.assertAlmostEqual(frames.steady_discharge([frame(n) for n in (1000, 895, 500, 400)], 1000)[0], 395 / frames.FRAME)


class Charts(unittest.TestCase):
    def drawn(self, *panels):
        import xml.etree.ElementTree
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "c.svg"
            charts.write(file, "A & B", list(panels))
            text = file.read_text()
            charts.write(file, "A & B", list(panels))
            self.assertEqual(text, file.read_text())  # the same data, the same file
        root = xml.etree.ElementTree.fromstring(text)
        return [element.text for element in root.iter("{http://www.w3.org/2000/svg}text")], text

    def test_points_errors_and_labels(self):
        points = [charts.Point(1, 2, 0.1, "a < b"), charts.Point(10, 0.5, ring=True), charts.Point(3, 0, math.nan), charts.Point(5, 4, bound=1)]
        panel = charts.Panel("p", "x", "y", [charts.Series("s", points, line=True)], True, True, (1, "noise"))
        words, text = self.drawn(panel)
        for word in ("A & B", "p", "x", "y", "s", "noise", "a < b"):
            self.assertIn(word, words)
        without = self.drawn(charts.Panel("p", "x", "y", [charts.Series("s", [charts.Point(q.x, q.y, math.nan, q.label, q.ring, q.bound) for q in points],
                                                                       line=True)], True, True, (1, "noise")))[1]
        self.assertGreater(len(text), len(without))  # an error is drawn

    def test_small_numbers_keep_their_digits(self):
        words, text = self.drawn(charts.Panel("p", "x", "y", [charts.Series("s", [charts.Point(k, 0.0441 + 0.0002 * k) for k in range(9)], line=True)]))
        ticks = [word for word in words if word.startswith("0.04")]
        self.assertGreater(len(ticks), 2)
        self.assertEqual(len(ticks), len(set(ticks)), ticks)
        self.assertNotRegex(text, r'="\d+\.\d{3}')  # places, of which a hundredth of a point is enough

    def test_bars_and_bodies(self):
        words, _ = self.drawn(charts.Bars("b", "ratio", ["one", "two"], {"first": [(1, 0.1), (2, math.nan)], "second": [(3, 0), (math.nan, 0)]}, True))
        self.assertEqual({"one", "two", "first", "second", "ratio"} & set(words), {"one", "two", "first", "second", "ratio"})
        _, text = self.drawn(charts.Bodies("view", [(0, 0, 0), (0.5, 0.5, 0.5)], 0.1, (-1, 1, -1, 1), 2, [(0, 0, 1), [(-1, 1), (0, 0)]]))
        self.assertEqual(text.count("<use"), 2)


def run(script, *words):
    return subprocess.run([ROOT / "scripts" / script, "--build", BUILD, *words], capture_output=True, text=True)


class Runs(unittest.TestCase):
    def test_failed_runs_are_not_kept_and_finished_ones_are(self):
        with tempfile.TemporaryDirectory() as folder:
            store, calls = runs.Store(folder, 1, pathlib.Path(folder)), []

            def work(job_folder):
                calls.append(job_folder)
                if len(calls) == 1:
                    raise runs.RunFailed("it broke")
                return {"value": 3}

            job = runs.Job("a run", {"x": 1}, work)
            said = []
            self.assertEqual(store.run_all("t", [job], said.append), {job.key(): {"failed": "it broke"}})
            for _ in range(2):
                self.assertEqual(store.run_all("t", [job], said.append), {job.key(): {"value": 3}})
            self.assertEqual(len(calls), 2)
            self.assertIn("a run: FAILED: it broke", said[1])

    def test_what_a_failed_program_said_is_no_line_of_progress(self):
        with tempfile.TemporaryDirectory() as folder:
            log = pathlib.Path(folder) / "out.txt"
            log.write_text("t 0 s    0 %  left 0 s | 0 particles | errors: volume 0.0e+00\nt 1 of 2 s  dt 1 s  error 1\n"
                           "annulusFoam: error: in the DEM script: too long\nerrorcode 1\n")
            self.assertEqual(programs.sentence_of(log, 1), "annulusFoam: error: in the DEM script: too long")
            log.write_text("t 0 s    0 % | errors: volume 0.0e+00\n")
            self.assertIn("ended with status 3", programs.sentence_of(log, 3))

    def test_results_of_another_build_are_repeated_unless_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            build = pathlib.Path(folder) / "build"
            (build / "bin").mkdir(parents=True)
            (build / "bin" / "program").write_text("first")
            calls = []
            job = runs.Job("a run", {"x": 1}, lambda _: calls.append(1) or {"value": len(calls), "cpu": 60.0})
            result = lambda **words: next(iter(runs.Store(folder, 1, build, **words).run_all("t", [job], lambda _: None).values()))
            self.assertEqual(result(only_kept=True), {"missing": True})
            self.assertEqual(result()["value"], 1)
            (build / "bin" / "program").write_text("second")
            self.assertEqual(result(only_kept=True), {"missing": True})
            self.assertEqual(result(any_build=True)["value"], 1)
            self.assertEqual(result()["value"], 2)
            store = runs.Store(folder, 1, build)
            store.run_all("t", [job])
            self.assertIn("1 runs of 1.0 minutes of CPU in all, made from", store.account())
            self.assertNotIn("another build", store.account())


class Scripts(unittest.TestCase):
    def test_a_tiny_study(self):
        with tempfile.TemporaryDirectory() as folder:
            words = ("--quick", "--parts", "levels", "--scenes", "heap", "--levels", "S1", "--seeds", "1", "--jobs", "1", "--output", folder)
            first = run("accuracy-cost", *words)
            self.assertEqual(first.returncode, 0, first.stderr + first.stdout)
            with open(pathlib.Path(folder) / "levels.csv", newline="") as rows:
                table = {row["level"]: row for row in csv.DictReader(rows)}
            self.assertEqual(list(table), ["S1", "smooth 0.15"])  # the body with true faces is the reference
            for row in table.values():
                parts = sum(float(row[f"{part}_s"]) for part in timing.PARTS)
                self.assertAlmostEqual(parts / float(row["cpu_s"]), 1.0, places=6)
                self.assertLessEqual(float(row["step_s"]), levels.SAFETY * float(row["critical_step_s"]) * (1 + 1e-9))
            # Frictionless in rolling, spheres spread over the floor; cubes stand.
            self.assertLess(float(table["S1"]["mean"]), 1.0)
            self.assertGreater(float(table["smooth 0.15"]["mean"]), 4.0)  # 6.1, from seed to seed 0.7
            self.assertAlmostEqual(float(table["S1"]["deviation"]), -1, delta=0.2)
            self.assertTrue((pathlib.Path(folder) / "truth-cube.svg").is_file())
            self.assertRegex((pathlib.Path(folder) / "results.md").read_text(), r"\| slope of a heap \| [\d.]+ degrees \|")
            self.assertIn("the reference smooth 0.15 gives", (pathlib.Path(folder) / "levels.txt").read_text())
            page = pathlib.Path(folder) / "results.md"
            page.write_text(page.read_text() + "\n<!-- accuracy-cost: methods -->\n\nOf another call.\n")
            again = run("accuracy-cost", *words)
            self.assertNotIn(" s of CPU |", again.stderr)  # nothing is repeated
            self.assertEqual(again.returncode, 0)
            self.assertRegex(page.read_text(), r"(?s)^<!-- accuracy-cost: levels -->.*slope of a heap.*"
                             r"<!-- accuracy-cost: methods -->\n\nOf another call[.]\n$")
            timed = run("accuracy-cost", *words, "--retime")
            self.assertEqual(timed.stderr.count(", for its time: "), 2, timed.stderr)  # a run for each level, and no other
            self.assertEqual(timed.stderr.count(" s of CPU |"), 2)
            more = run("accuracy-cost", *words[:-6], "C8", *words[-6:], "--show")  # S1 C8
            self.assertEqual((more.returncode, " s of CPU |" in more.stderr), (0, False), more.stderr)
            self.assertRegex((pathlib.Path(folder) / "results.md").read_text(), r"(?s)\| S1 \| -\S+ \+- \S+ %; \S+ s \(1\) \|.*\| C8 \| not run \|")

    def test_small_versions_of_what_measures(self):
        for script, words, table, needs in (
                ("cluster-speed", ["--quick", "--bodies", "20", "--scenes", "settled", "--shapes", "cube:8"], "cluster-speed.csv", "bin/eccentra-dem"),
                ("compare-peers", ["--quick", "--codes", "ours,stock", "--scenes", "drop", "--shapes", "cube 8"], "compare-peers.csv", "bin/eccentra-dem"),
                ("closure-cost", ["--quick"], "closure-cost.csv", "tests/closures_benchmark"),
                ("solver-cost", ["--quick", "--viscosity", "strainRate", "--pressure", "gamg,pcgGamg", "--turbulence", "laminar,kEpsilon"],
                 "cost.csv", "tests/openfoam_coupled_cost"),
                ("link-cost", ["--quick", "--parts", "cost"], "coupled.csv", "tests/exchange_benchmark")):
            if not (BUILD / needs).is_file():
                continue
            with self.subTest(script), tempfile.TemporaryDirectory() as folder:
                said = run(script, *words, "--out", folder)
                self.assertEqual(said.returncode, 0, said.stderr + said.stdout)
                with open(pathlib.Path(folder) / table, newline="") as rows:
                    found = list(csv.DictReader(rows))
                self.assertTrue(found)
                if script == "compare-peers":  # restitution: shared contacts deliver 0.9, parallel ones of a cube's face e^sqrt(4)
                    ours, stock = (float(row["restitution_of_0.9"]) for row in found)
                    self.assertAlmostEqual(ours, 0.9, delta=0.01)
                    self.assertAlmostEqual(stock, 0.9 ** 2, delta=0.01)
                if script == "cluster-speed":
                    with open(pathlib.Path(folder) / "rounded-speed.csv", newline="") as rows:
                        (row,) = csv.DictReader(rows)
                    self.assertEqual((row["scene"], row["rounded"]), ("settled", "cube 0.15"))
                    self.assertTrue(math.isfinite(float(row["times_as_long"])))  # of so few steps it is noise
                    self.assertIn("memory per rounded cube of 0.15: ", said.stdout)
                if script == "solver-cost":
                    self.assertEqual([(row["pressure"], row["model"]) for row in found],
                                     [(pressure, model) for pressure in ("gamg", "pcgGamg") for model in ("laminar", "kEpsilon")])
                    self.assertTrue(all(float(row["iterations"]) >= 1 for row in found))

    def test_disks_in_an_upright_hole_have_no_height(self):
        if not (BUILD / "bin" / "annulusFoam").is_file():
            self.skipTest("annulusFoam is not built")
        with tempfile.TemporaryDirectory() as folder:
            said = run("oriented-section", "--quick", "--shapes", "disk:7", "--inclinations", "0", "--forces", "oriented", "--count", "20", "--out", folder)
            self.assertEqual(said.returncode, 0, said.stderr + said.stdout)
            with open(pathlib.Path(folder) / "section.csv", newline="") as rows:
                (row,) = csv.DictReader(rows)
            self.assertEqual(row["height"], "")
            self.assertGreater(float(row["gradient"]), 0)

    def test_clusters_that_stick_form_a_steeper_heap(self):
        if not (BUILD / "bin" / "annulusReport").is_file():
            self.skipTest("annulusReport is not built")
        with tempfile.TemporaryDirectory() as folder:
            said = run("compare-rolling", "--cohesion", "--quick", "--scenes", "heap", "--models", "dry", "sjkr", "--seeds", "1", "--shape", "cube 8",
                       "--out", folder)
            self.assertEqual(said.returncode, 0, said.stderr + said.stdout)
            with open(pathlib.Path(folder) / "cohesion.csv", newline="") as rows:
                dry, sticky = csv.DictReader(rows)
            self.assertEqual((dry["cohesion"], sticky["cohesion"]), ("dry", "sjkr"))
            self.assertGreater(float(sticky["angle_degrees"]), 1.5 * float(dry["angle_degrees"]))
            self.assertAlmostEqual(float(sticky["more_than_dry"]), float(sticky["angle_degrees"]) - float(dry["angle_degrees"]), places=9)
            self.assertGreater((pathlib.Path(folder) / "cohesion-heap.png").stat().st_size, 20000)

    def test_cohesion_compares_what_one_seed_gives(self):
        results = {("heap", name, seed): {"angle": angle, "cpu": 2.0 if name == "dry" else 5.0}
                   for name, angles in (("dry", (10, 14)), ("sjkr", (30, 34, 90))) for seed, angle in enumerate(angles)}
        dry, sticky = cohesion.rows_of(results, "heap")
        self.assertEqual(dry, ["heap", "dry", 12, 2.0, 2, 0, 0, 1])
        self.assertEqual((sticky[4], sticky[5:]), (3, [20, 0, 2.5]))  # of both seeds 20 more; the third has no dry one

    def test_bad_words(self):
        for script, words, says in (
                ("accuracy-cost", ["--seeds", "0"], "--seeds is 0: give 1 to 10"),
                ("accuracy-cost", ["--most-seeds", "2"], "--most-seeds is 2: give 3 to 40"),
                ("accuracy-cost", ["--most-seeds", "9", "--full"], "--most-seeds is 9: give 10 to 40"),
                ("accuracy-cost", ["--most-seeds", "5", "--seeds", "5"], "--seeds and --most-seeds exclude each other"),
                ("accuracy-cost", ["--most-seeds", "5", "--quick"], "--most-seeds is not for --quick"),
                ("accuracy-cost", ["--shape", "cube", "--quick"], "--quick belongs to the study of cubes and disks"),
                ("accuracy-cost", ["--shape", "cube", "--scene", "in.x"], "--scene needs --measure: a column of the thermo output"),
                ("accuracy-cost", ["--shape", "cube", "--scene", "/nowhere", "--measure", "v_x"], "--scene /nowhere: No such file"),
                ("accuracy-cost", ["--shape", "cube", "--scenes", "section"], "--scenes section is not there for --shape"),
                ("accuracy-cost", ["--scenes", "annulus-40"], "--scenes annulus-40 belongs to --shape; expected section"),
                ("accuracy-cost", ["--shape", "stl /nowhere.stl"], "clusterShape failed: "),
                ("accuracy-cost", ["--shape", "stl a.stl spheres 4"], "give the numbers of spheres as --levels"),
                ("accuracy-cost", ["--shape", "cube", "--levels", "spheres x"], "--levels: 'x' after 'spheres' is not a whole number"),
                ("accuracy-cost", ["--shape", "cube", "--levels", "hull"], "--levels: 'hull' is unknown for the shape 'cube'"),
                ("accuracy-cost", ["--shape", "cube", "--levels", "spheres 9"], "clusterShape failed: "),
                ("accuracy-cost", ["--shape", "cube", "--share", "2"], "--share is 2.0: give 0"),
                ("accuracy-cost", ["--measure", "v_x"], "--measure belongs to --shape"),
                ("accuracy-cost", ["--rounding", "0"], "--rounding is 0.0: give 0.01 to 1"),
                ("accuracy-cost", ["--levels", "C9"], "--levels names 'C9': there are"),
                ("accuracy-cost", ["--build", "/nowhere"], "there is no /nowhere/bin/eccentra-dem: build it with"),
                ("accuracy-cost", ["--scenes", "ocean"], "invalid choice: 'ocean'"),
                ("paper", ["--jobs", "0"], "--jobs is 0: give 1 or more"),
                ("paper", ["--rungs", "0.3", "0.1"], "--rungs is 0.3 0.1: give rising shares"),
                ("paper", ["--figures", "8"], "invalid choice: '8'"),
                ("paper", ["--seeds", "0"], "--seeds is 0: give 1 to 10"),
                ("paper", ["--length", "0.01"], "--length is 0.01: give 0.04 to 2"),
                ("paper", ["--refine", "7"], "--refine is 7: give 0 to 6"),
                ("paper", ["--measured", "/nowhere.csv"], "--measured /nowhere.csv: "),
                ("paper", ["--build", "/nowhere"], "there is no /nowhere/bin/eccentra-dem: build it with"),
                ("full-scene", ["--build", "/nowhere"], "there is no /nowhere/bin/eccentra-dem: build it with"),
                ("full-scene", ["--levels", "C9"], "--levels names 'C9': there are"),
                ("full-scene", ["--run", "C9"], "invalid choice: 'C9'"),
                ("full-scene", ["--run", "S1", "--end", "-1"], "'-1' is not above 0"),
                ("full-scene", ["--run", "S1", "--ranks", "1", "2"], "--ranks of a run is one number from 1 on"),
                ("compare-rolling", ["--seeds", "9"], "--seeds is 9: give 1 to 8"),
                ("compare-rolling", ["--mu", "-1"], "--mu is -1.0: give a number >= 0"),
                ("compare-rolling", ["--scenes", "slope,ocean"], "invalid choice: 'ocean'"),
                ("compare-rolling", ["--cohesion", "--scenes", "hopper"], "--scenes: hopper is not there with --cohesion; expected heap, drum"),
                ("compare-rolling", ["--cohesion", "--models", "cdt"], "--models: cdt is not there with --cohesion; expected dry, sjkr, washino, easo"),
                ("compare-rolling", ["--models", "sjkr"], "--models: sjkr is there only with --cohesion; expected cluster, "),
                ("compare-rolling", ["--cohesion", "--mu", "0.1"], "--mu is not read with --cohesion"),
                ("compare-rolling", ["--cohesion", "--cost"], "argument --cost: not allowed with argument --cohesion"),
                ("effects", ["--steps", "10"], "--steps is 10: a whole number of at least 1000 is needed"),
                ("effects", ["--gradient", "1,5"], "--gradient is '1,5': a number in 1/s is needed"),
                ("closure-cost", ["--repetitions", "x"], "'x' is not a whole number of at least 1"),
                ("rheology-accuracy", ["--ratios", "a"], "--ratios: could not convert string to float: 'a'"),
                ("creeping-drag", ["--indices", "0"], "--indices: 0 is not a positive number"),
                ("creeping-drag", ["--bingham", "x"], "--bingham: could not convert string to float: 'x'"),
                ("drag-against-measurement", ["--data", "/nowhere.csv"], "--data /nowhere.csv: No such file"),
                ("solver-cost", ["--cells", "1 2"], "'1 2' is not three whole numbers such as"),
                ("cluster-speed", ["--shapes", "cube"], "--shapes has 'cube': give FAMILY:N"),
                ("cluster-speed", ["--rounded", "cube:2"], "--rounded has 'cube:2': give cube:R or disk:R with a rounding R of 0.01 to 1"),
                ("cluster-speed", ["--rounded", "hull:0.2"], "--rounded has 'hull:0.2': give cube:R or disk:R"),
                ("cluster-speed", ["--rounded", "none,cube:0.15"], "--rounded has 'none' beside bodies: give one or the other"),
                ("compare-peers", ["--codes", "ours", "--bodies", "100000"], "--bodies is 100000, which do not fit the scene: give"),
                ("demo", ["--scenes", "moon"], "invalid choice: 'moon'")):
            with self.subTest(f"{script} {' '.join(words)}"):
                with tempfile.TemporaryDirectory() as folder:
                    said = run(script, "--out", pathlib.Path(folder) / "results", *words)
                    self.assertEqual(list(pathlib.Path(folder).iterdir()), [], "a refused call writes nothing")
                self.assertNotEqual(said.returncode, 0)
                self.assertIn(says, said.stderr)
                self.assertNotIn("Traceback", said.stderr)


class Page(unittest.TestCase):
    def test_a_call_is_told_without_folders(self):
        self.assertEqual(tables.called("scripts/x", ["--quick", "--build", "/a", "--output=/b", "--shape", "cube 8"]), 'scripts/x --quick --shape "cube 8"')

    def test_results_page_takes_the_largest_study_and_its_charts(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "docs").mkdir()
            script = [ROOT / "scripts" / "results", "--results", root, "--docs", root / "docs"]
            empty = subprocess.run(script, capture_output=True, text=True)
            self.assertNotEqual(empty.returncode, 0)
            self.assertIn("run scripts/accuracy-cost --quick first", empty.stderr)
            for name in ("accuracy-cost", "accuracy-cost-quick"):
                (root / name).mkdir()
                (root / name / "results.md").write_text(f"from {name}\n![c](truth-cube.svg)\n")
                (root / name / "truth-cube.svg").write_text("<svg/>")
            self.assertEqual(subprocess.run(script, capture_output=True).returncode, 0)
            page = (root / "docs" / "results.md").read_text()
            self.assertIn("from accuracy-cost\n![c](results-levels-cube.svg)", page)
            self.assertIn("Not run yet: `scripts/paper --quick`", page)
            self.assertTrue((root / "docs" / "results-levels-cube.svg").is_file())
            # What another study wrote before stays when its results are gone, however often the page is made.
            (root / "paper").mkdir()
            (root / "paper" / "results.md").write_text("## Figures\n\nfrom paper\n")
            self.assertEqual(subprocess.run(script, capture_output=True).returncode, 0)
            (root / "paper" / "results.md").unlink()
            both = (root / "docs" / "results.md").read_text()
            for text in ("from a later call", "from the last call"):
                (root / "accuracy-cost" / "results.md").write_text(f"{text}\n")
                self.assertEqual(subprocess.run(script, capture_output=True).returncode, 0)
                later = (root / "docs" / "results.md").read_text()
                self.assertEqual(later, both.replace("from accuracy-cost\n![c](results-levels-cube.svg)", text))
            # So does a part of a study of which only another part is there.
            (root / "full-scene").mkdir()
            for part in ("run S1", "cost"):
                (root / "full-scene" / "results.md").write_text(page_parts.page_of("full-scene", {part: f"from {part}"}))
                self.assertEqual(subprocess.run(script, capture_output=True).returncode, 0)
            both_parts = page_parts.page_of("full-scene", {"run S1": "from run S1", "cost": "from cost"})
            self.assertTrue((root / "docs" / "results.md").read_text().endswith(both_parts))


if __name__ == "__main__":
    unittest.main()
