# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the drag laws against measured drag coefficients: bias, scatter and share within 25 % of each law on each set of bodies."""
import pathlib

from .. import charts, drag_points, options, runs, tables
from ..programs import Failure, digest_of

MARKS = {"trusted": "🟩", "serves": "🟨", "not trusted": "🟥"}


def job(build, data, points, laws):
    def work(folder):
        return {"laws": drag_points.coefficients(build, points, laws, folder)}

    return runs.Job("drag laws at the measured points", {"what": "drag laws", "data": digest_of(data), "laws": list(laws),
                                                         "reader": digest_of(pathlib.Path(drag_points.__file__))}, work, 1.0)


def panel(law, values, points):
    """Law over measured against Re, a colour for each set that has no other set within it."""
    chosen = [name for name in drag_points.SETS if name != f"isometric, Re < {drag_points.CREEP:g}"]
    series = [charts.Series(name, [charts.Point(p.re, value / p.cd) for p, value in zip(points, values) if drag_points.SETS[name](p)],
                            charts.COLOURS[k]) for k, name in enumerate(chosen)]
    ends = [p.x for s in series for p in s.points]
    for level in (1 - drag_points.NEAR, 1.0, 1 + drag_points.NEAR):
        series.append(charts.Series("", [charts.Point(x, level) for x in (min(ends), max(ends))], "#666666", True, False, level != 1.0))
    return charts.Panel(law, "Re", "C_D of the law over measured", series, True, True)


def main():
    parser = options.Parser("drag-against-measurement", "Compares the drag laws of fix fluid/force with measured drag coefficients of bodies that fall "
                            "freely: geometric bias, logarithmic rms and share within 25 % of law over measured.", at_once=1)
    parser.add_argument("--data", type=pathlib.Path, default=drag_points.DEFAULT, metavar="CSV",
                        help="points with the columns " + ", ".join(drag_points.COLUMNS) +
                             " (default: ../shared/data/drag_test_points.csv, beside the checkout)")
    parser.add_argument("--laws", action=options.Words, metavar="LAW", help="default: " + " ".join(drag_points.LAWS))

    def check(words):
        words.points = [p for p in drag_points.read(words.data) if p.flag in (drag_points.GOOD, drag_points.COARSE)]
        if not any(belongs(p) for p in words.points for belongs in drag_points.SETS.values()):
            raise Failure(f"--data {words.data}: no point belongs to a set; the sets are {', '.join(drag_points.SETS)}")

    chosen = parser.settle(("dragLaw",), check)
    points = chosen.points
    laws = tuple(chosen.laws or drag_points.LAWS)
    jobs = {"": job(chosen.build, chosen.data, points, laws)}
    found = chosen.store.run_all("drag laws", jobs.values())
    if chosen.plan:
        return 0
    values = runs.needed(found, jobs)[""]["laws"]
    rows, marked = [], []
    for name, belongs in drag_points.SETS.items():
        inside = [k for k, p in enumerate(points) if belongs(p)]
        if not inside:
            continue
        line = [name, str(len(inside))]
        for law in laws:
            off = drag_points.off([values[law][k] / points[k].cd for k in inside])
            rows.append([name, law, off.count, f"{100 * off.bias:+.1f}", f"{100 * off.rms:.1f}", f"{100 * off.share:.0f}", off.trust()])
            line.append(f"{MARKS[off.trust()]} {100 * off.bias:+.1f}, {100 * off.rms:.1f}, {100 * off.share:.0f} %")
        marked.append(line)
    tables.publish(chosen, "drag-laws", "Law over measured [%]", ["set", "law", "points", "bias", "rms", "within_25", "trust"], rows)
    page = ["Law over measured: geometric bias [%], logarithmic rms [%], share within 25 %.", "",
            tables.markdown(["set", "points", *laws], marked)]
    words = [f"{MARKS[name]} {name} (bias to {100 * bias:g} %, rms to {100 * rms:g} %)"
             for name, (bias, rms) in (("trusted", drag_points.TRUSTED), ("serves", drag_points.SERVES))]
    page += [", ".join(words) + f", {MARKS['not trusted']} not trusted", ""]
    charts.write(chosen.out / "drag-laws.svg", "Drag laws over measured drag coefficients; dashed: 25 % either way",
                 [panel(law, values[law], points) for law in laws])
    return tables.finish(chosen, page, [], f"{len(points)} points of {chosen.data.name}")
