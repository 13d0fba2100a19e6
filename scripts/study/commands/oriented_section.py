# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The section of Tomren with forces of the sphere of equal volume and with those of the real shape, in mud with each form of eq (23): flux, bed,
attitude."""
import math
import re
import shutil
import statistics

from .. import charts, options, runs, section, tables, vtp
from ..programs import run

BINS = 9  # of the angle between a body's axis and the hole
QUANTITIES = {"flux": "solid flux [m3/s]", "gradient": "pressure gradient [Pa/m]", "height": "height of the solid's centre [m]"}


def axes_in(path):
    """The z axis of each body in the world, from a file of dump cluster/vtk."""
    arrays = vtp.arrays_of(path)
    return {int(body): (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))
            for body, (w, x, y, z) in zip(arrays["body"], arrays["orientation"].tolist())}


def attitude(case, share):
    """Angles [degrees] between the bodies' axes and the hole, over the last share of the pictures."""
    files = sorted((case / "postProcessing" / "eccentra").glob("grains_*.vtp"), key=lambda f: int(re.search(r"(\d+)\.vtp", f.name)[1]))
    angles = []
    for path in files[math.floor((1 - share) * len(files)):]:
        angles += [math.degrees(math.acos(min(1.0, abs(axis[2])))) for axis in axes_in(path).values()]
    return angles


def job(chosen, shape, forces, form, inclination, seed):
    words = {"shape": shape, "count": chosen.count, "inclination": inclination, "seed": seed, "seconds": chosen.seconds, "interval": chosen.interval,
             "effects": section.effects_of(forces, form), **({"tau0": f"{chosen.tau0:g}"} if chosen.tau0 else {})}

    def work(folder):
        case, cpu, _ = section.run_case(chosen.build, folder, words)
        run([chosen.build / "bin" / "annulusReport", case, "-o", folder, "--share", "0.5", "--no-pictures"], folder, folder / "report.txt")
        angles = attitude(case, 0.5)
        counts = [sum(1 for a in angles if min(BINS - 1, int(a / 90 * BINS)) == k) / len(angles) for k in range(BINS)]
        result = {"mean": section.read_summary(folder / "summary.csv"), "histogram": counts,
                  "across": statistics.fmean(math.cos(math.radians(a)) for a in angles), "cpu": cpu}
        shutil.rmtree(case)
        return result

    return runs.Job(f"{shape}, {forces}, {form}, {inclination:g} degrees, seed {seed}", {"what": "oriented section", "case": section.case_digest(),
                    **{key: str(value) for key, value in words.items()}}, work, section.estimate_of(words, 48))


def mean_and_error(values):
    return statistics.fmean(values), statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def main():
    parser = options.Parser("oriented-section", "Runs cases/tomren-section with clusters, once with the drag and torque of the sphere of equal volume and once "
                            "with those of the real shape: solid flux, pressure gradient, height of the solids, and how the bodies lie, as means over seeds "
                            "with standard errors.", "one shape, one seed, 0.2 s")
    parser.add_argument("--shapes", action=options.Words, metavar="S", help="as disk:48 (default: disk:48 cube:64)")
    parser.add_argument("--inclinations", action=options.Words, metavar="DEG", help="from the vertical (default: 0 40 80)")
    parser.add_argument("--forces", action=options.Words, choices=tuple(section.FORCES), metavar="F",
                        help="of the sphere of equal volume, of the real shape (default: " + " ".join(section.FORCES) + ")")
    parser.add_argument("--tau0", type=float, default=0.0, metavar="PA", help="yield stress of the mud (default 0, as the paper)")
    parser.add_argument("--yield-forms", action=options.Words, choices=section.FORMS, metavar="FORM",
                        help="yield_form of fix fluid/force: additive (default), cross; needs --tau0")
    parser.add_argument("--seeds", type=options.at_least_one, metavar="N", help="starts of each (default 3)")
    parser.add_argument("--count", type=options.at_least_one, default=600, metavar="N", help="bodies (default 600)")

    def check(chosen):
        chosen.shapes = [shape.replace(":", " ") for shape in chosen.shapes or (["disk:48"] if chosen.quick else ["disk:48", "cube:64"])]
        try:
            chosen.inclinations = [float(word) for word in chosen.inclinations or (["80"] if chosen.quick else ["0", "40", "80"])]
        except ValueError as error:
            parser.error(f"--inclinations: {error}")
        chosen.forces, chosen.yield_forms = chosen.forces or list(section.FORCES), chosen.yield_forms or [section.FORMS[0]]
        if not 0 <= chosen.tau0 < math.inf:
            parser.error(f"--tau0: {chosen.tau0:g} is not a number from 0 on")
        if chosen.tau0 == 0 and chosen.yield_forms != [section.FORMS[0]]:
            parser.error("--yield-forms: without a yield stress the forms are the same; give --tau0")
        chosen.seeds = chosen.seeds or (1 if chosen.quick else 3)
        if chosen.seeds > len(section.SEEDS):
            parser.error(f"--seeds is {chosen.seeds}: give at most {len(section.SEEDS)}")
        chosen.seconds, chosen.interval = (0.2, 64) if chosen.quick else (2.0, 64)

    chosen = parser.settle(("annulusFoam", "annulusMesh", "annulusReport"), check)
    keys = [(shape, inclination, forces, form) for shape in chosen.shapes for inclination in chosen.inclinations for forces in chosen.forces
            for form in chosen.yield_forms]
    jobs = {(*key, seed): job(chosen, key[0], key[2], key[3], key[1], seed) for key in keys for seed in section.SEEDS[:chosen.seeds]}
    found = chosen.store.run_all("section", jobs.values())
    if chosen.plan:
        return 0
    found = runs.needed(found, jobs)
    rows, histograms = [], []
    for key in keys:
        shape, inclination, *named = key
        results = [found[(*key, seed)] for seed in section.SEEDS[:chosen.seeds]]
        row = [shape, f"{inclination:g}", *named]
        for name in QUANTITIES:
            if all(name in r["mean"] for r in results):  # bodies of an upright hole have no height
                value, error = mean_and_error([r["mean"][name][0] for r in results])
                row += [f"{value:.3e}", f"{error:.1e}"]
            else:
                row += ["", ""]
        value, error = mean_and_error([r["across"] for r in results])
        rows.append([*row, f"{value:.3f}", f"{error:.3f}"])
        histograms.append((shape, inclination, ", ".join(named[:1] if len(chosen.yield_forms) == 1 else named),
                           [statistics.fmean(column) for column in zip(*(r["histogram"] for r in results))]))
    header = ["shape", "degrees", "forces", "yield_form"] + [word for name in QUANTITIES for word in (name, f"{name}_error")]
    tables.publish(chosen, "section", "Section with forces of the sphere and of the real shape", header + ["cosine_to_hole", "cosine_error"], rows)
    panels = []
    for shape in chosen.shapes:
        for inclination in chosen.inclinations:
            series = [charts.Series(forces, [charts.Point((k + 0.5) * 90 / BINS, part * BINS) for k, part in enumerate(counts)], charts.COLOURS[n], True)
                      for n, (s, i, forces, counts) in enumerate(h for h in histograms if h[:2] == (shape, inclination))]
            even = [charts.Point((k + 0.5) * 90 / BINS, BINS * (math.cos(math.radians(k * 90 / BINS)) - math.cos(math.radians((k + 1) * 90 / BINS))))
                    for k in range(BINS)]
            panels.append(charts.Panel(f"{shape}, {inclination:g} degrees", "angle of the axis to the hole [degrees]", "density, mean 1",
                                       [*series, charts.Series("any direction alike", even, charts.COLOURS[7], True, False, True)]))
    charts.write(chosen.out / "attitude.svg", "How the bodies lie", panels)
    return 0
