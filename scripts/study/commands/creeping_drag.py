# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Creeping drag of spheres and spheroids in Herschel-Bulkley fluid, computed with annulusFoam, beside the two terms of eq (23)."""
import math

from .. import charts, least_dissipation, options, runs, tables, wedge

BINGHAM, INDICES, ASPECTS = (0.0, 0.1, 1.0, 10.0, 100.0), (1.0, 0.8, 0.6, 0.4), (1.0, 2.0, 0.5)
COARSE, FINE = (48, 32), (108, 72)  # beside the mesh of wedge.Case, each 1.5 times as fine as the one before
ORDER = 1.5 ** 2 - 1  # what the change from mesh to mesh is divided by for the error that is left, at second order
CHECKED = (1.0, 0.6)  # indices of the further checks
OUTER = {20.0: 60, 100.0: 84, 200.0: 96}  # radii of the outer sphere, beside that of wedge.Case, with the radial cells
TRIAL = {"outer": 2000.0, "elements": 24, "modes": 4}  # of least_dissipation, which has the index of each point at Bn = 0
ANSLEY_SMITH = 7 * math.pi / 24
AT_REST = 1 / (18 * 0.143 / 3)  # C_s/Bn of Beris et al. 1985: (pi/6)/(0.143/3)/(3 pi)


def power_law_factor(n):
    """C_s at Bn = 0, Renaud, Mauret and Chhabra 2004."""
    return 6 ** ((n - 1) / 2) * (3 / (n * n + n + 1)) ** (n + 1)


def terms(case):
    """What a sum of the two exact limits gives."""
    return power_law_factor(case.index) + AT_REST * case.bingham


def without_outer_sphere(value, case):
    """A Newtonian drag over the factor of concentric spheres, the inner one as large as the sphere of this drag; mud that does not yield moves with
    the outer sphere."""
    if case.bingham or case.index != 1:
        return value
    alone = value
    for _ in range(50):
        p = (alone if case.aspect != 1 else 1) / case.outer
        alone = value * (1 - 9 / 4 * p + 5 / 2 * p ** 3 - 9 / 4 * p ** 5 + p ** 6) / (1 - p ** 5)
    return alone


def cross_coefficient(points):
    """c of C_s = X(n) + 1.1655 Bn + c sqrt(Bn) with the least squares of the relative error, and the largest of these errors. points: [(case, C_s)]."""
    rows = [(math.sqrt(case.bingham) / value, (value - terms(case)) / value) for case, value in points if case.bingham]
    c = sum(a * b for a, b in rows) / sum(a * a for a, _ in rows)
    return c, max(abs(c * a - b) for a, b in rows)


def checks(chosen):
    """{what: [(case, changed case)]}"""
    spheres = [wedge.Case(index=n, bingham=b) for n in CHECKED if n in chosen.indices for b in chosen.bingham if b >= 1]
    far = [wedge.Case(index=n, bingham=b) for n in chosen.indices for b in chosen.bingham if b == 0 or b <= 0.1 and n in CHECKED]
    power_law = [case for case in far if case.bingham == 0]
    return {
        "mesh of 108 x 72 cells": [(case, case._replace(radial=FINE[0], polar=FINE[1])) for case in power_law + spheres],
        "cap of 100": [(case, case._replace(cap=100.0)) for case in spheres],
        "cap of 1000": [(case, case._replace(cap=1000.0)) for case in power_law + spheres],
        **{f"outer radius of {outer:g}": [(case, case._replace(outer=outer, radial=radial)) for case in far] for outer, radial in OUTER.items()}}


def bound_job(n):
    """An upper bound of C_s at Bn = 0 that annulusFoam has no part in."""
    return runs.Job(f"least dissipation, n {n:g}", {"what": "least dissipation", "index": n, **TRIAL},
                    lambda folder: {"drag": least_dissipation.power_law_factor(n, **TRIAL)}, 3.0)


def name_of(case):
    return (f"aspect {case.aspect:g}, n {case.index:g}, Bn {case.bingham:g}, {case.radial} x {case.polar} cells, outer radius {case.outer:g}, "
            f"cap {case.cap:g}")


def main():
    parser = options.Parser("creeping-drag", "Drag of a sphere and of spheroids that creep along their axis through Herschel-Bulkley fluid: annulusFoam "
                            "on a wedge between the body and a sphere of 50 radii, marched until the drag is steady. C_s = F/(3 pi k (U/d)^n d^2), "
                            "Bn = (tau0/k)(d/U)^n.", "n 1, Bn 0 and 1, spheres, no checks")
    number = lambda text: float(text)
    parser.add_argument("--indices", action=options.Words, metavar="N", help="default: " + " ".join(f"{v:g}" for v in INDICES))
    parser.add_argument("--bingham", action=options.Words, metavar="BN", help="default: " + " ".join(f"{v:g}" for v in BINGHAM))
    parser.add_argument("--aspects", action=options.Words, metavar="B", help="axis over diameter across (default: 1 2 0.5)")
    parser.add_argument("--checks", choices=("yes", "no"), help="finer mesh, cap, outer radius (default: yes)")

    def check(chosen):
        for word, default, quick, low in (("indices", INDICES, (1.0,), 0), ("bingham", BINGHAM, (0.0, 1.0), -1), ("aspects", ASPECTS, (1.0,), 0)):
            try:
                found = [number(text) for text in getattr(chosen, word) or (quick if chosen.quick else default)]
            except ValueError as error:
                parser.error(f"--{word}: {error}")
            for value in found:
                if not low < value < 1e6 or value < 0:
                    parser.error(f"--{word}: {value:g} is not {'a positive number' if low == 0 else 'a number from 0 on'}")
            setattr(chosen, word, found)
        chosen.checks = chosen.checks or ("no" if chosen.quick else "yes")

    chosen = parser.settle(("annulusFoam",), check)
    main_cases = [wedge.Case(aspect, n, b) for aspect in chosen.aspects for n in chosen.indices for b in chosen.bingham]
    checked = checks(chosen) if chosen.checks == "yes" and 1.0 in chosen.aspects else {}
    wanted = {case: None for case in main_cases}
    wanted.update({case._replace(radial=COARSE[0], polar=COARSE[1]): None for case in main_cases})
    wanted.update({changed: None for pairs in checked.values() for _, changed in pairs})
    jobs = {case: wedge.job(chosen.build, case, name_of(case)) for case in wanted}
    bounds = {n: bound_job(n) for n in chosen.indices} if 0 in chosen.bingham else {}
    found = chosen.store.run_all("creeping drag", [*jobs.values(), *bounds.values()])
    if chosen.plan:
        return 0
    failed = [f"{job.name}: {found[job.key()]['failed']}" for job in jobs.values() if "failed" in found[job.key()]]
    results = {case: found[job.key()] for case, job in jobs.items() if runs.good(found[job.key()])}
    drag = {case: without_outer_sphere(result["drag"], case) for case, result in results.items()}

    page, rows = [], []
    for case in main_cases:
        coarse = case._replace(radial=COARSE[0], polar=COARSE[1])
        if case in drag and coarse in drag:
            value = drag[case]
            rows.append([case.aspect, case.index, case.bingham, f"{value:.4f}", f"{100 * (drag[coarse] / value - 1) / ORDER:+.2f}",
                         f"{100 * results[case]['change']:.2f}", results[case]["steps"], f"{100 * ((1 + ANSLEY_SMITH * case.bingham) / value - 1):+.1f}",
                         f"{100 * (1.25 * (1 + ANSLEY_SMITH * case.bingham) / value - 1):+.1f}", f"{100 * (terms(case) / value - 1):+.1f}"])
    page.append(tables.publish(chosen, "creeping-drag", "Creeping drag (error of mesh and of iteration, and the laws' deviation, in %)",
                               ["aspect", "n", "Bn", "C_s", "mesh", "iteration", "steps", "eq_23_with_24", "eq_23_with_30", "sum_of_limits"], rows))
    changes = [[what, case.index, case.bingham, f"{drag[case]:.4f}", f"{drag[changed]:.4f}", f"{100 * (drag[changed] / drag[case] - 1):+.2f}"]
               for what, pairs in checked.items() for case, changed in pairs if case in drag and changed in drag]
    page.append(tables.publish(chosen, "checks", "What a change of the computation does", ["change", "n", "Bn", "C_s", "changed", "percent"], changes))
    fits = []
    for aspect in chosen.aspects:
        for n in chosen.indices:
            points = [(case, drag[case]) for case in main_cases if case in drag and (case.aspect, case.index) == (aspect, n)]
            if aspect == 1 and len([1 for case, _ in points if case.bingham]) > 1:
                c, worst = cross_coefficient(points)
                fits.append([n, f"{c:.3f}", f"{100 * worst:.1f}"])
    page.append(tables.publish(chosen, "cross", "c of C_s = X(n) + 1.1655 Bn + c sqrt(Bn), and its largest deviation in %", ["n", "c", "deviation"], fits))
    limits = [[n, f"{found[job.key()]['drag']:.4f}", f"{power_law_factor(n):.4f}", f"{100 * (power_law_factor(n) / found[job.key()]['drag'] - 1):+.1f}"]
              for n, job in bounds.items() if runs.good(found[job.key()])]
    page.append(tables.publish(chosen, "power-law", f"C_s at Bn = 0 by least dissipation, outer radius {TRIAL['outer']:g}, and X(n) of Renaud et al. with its "
                               "deviation in %", ["n", "C_s", "X", "percent"], limits))
    yielding = lambda n: sorted((case.bingham, value) for case, value in drag.items() if case in main_cases and case.aspect == 1 and case.index == n
                                and case.bingham)
    series = [charts.Series(f"n = {n:g}, computed", [charts.Point(b, value / terms(wedge.Case(index=n, bingham=b))) for b, value in yielding(n)],
                            charts.COLOURS[k % len(charts.COLOURS)], True) for k, n in enumerate(chosen.indices) if yielding(n)]
    if series:
        ends = [point.x for point in series[0].points]
        series.append(charts.Series("eq (23), 24/Re, n = 1", [charts.Point(b, (1 + ANSLEY_SMITH * b) / (1 + AT_REST * b)) for b in ends],
                                    "#999999", True, False, True))
        charts.write(chosen.out / "creeping-drag.svg", "Creeping drag of a sphere over the sum of its limits X(n) + 1.1655 Bn",
                     [charts.Panel("", "Bingham number", "drag over the sum of the limits", series, True)], 1, (6.0, 4.0))
    return tables.finish(chosen, page, failed, "C_s = F/(3 pi k (U/d)^n d^2)")
