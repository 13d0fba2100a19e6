# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the drag laws against measured drag coefficients: bias, scatter and share within 25 % of each law on each set of bodies. With --falling
the bodies fall, with forces of their real shape, and their speed is held against the measured one."""
import pathlib

from .. import charts, drag_points, falling, options, runs, tables
from ..programs import Failure, digest_of

FALLING = drag_points.LAWS[:4]  # those that know a shape
MARKS = {"trusted": "🟩", "serves": "🟨", "not trusted": "🟥"}


def job(build, data, points, laws):
    def work(folder):
        return {"laws": drag_points.coefficients(build, points, laws, folder)}

    return runs.Job("drag laws at the measured points", {"what": "drag laws", "data": digest_of(data), "laws": list(laws),
                                                         "reader": digest_of(pathlib.Path(drag_points.__file__))}, work, 1.0)


def panel(law, ratios, points, label):
    """Ratios to measured against Re, a colour for each set that has no other set within it."""
    chosen = [name for name in drag_points.SETS if name != f"isometric, Re < {drag_points.CREEP:g}"]
    series = [charts.Series(name, [charts.Point(p.re, ratio) for p, ratio in zip(points, ratios) if drag_points.SETS[name](p)],
                            charts.COLOURS[k]) for k, name in enumerate(chosen)]
    ends = [p.x for s in series for p in s.points]
    for level in (1 - drag_points.NEAR, 1.0, 1 + drag_points.NEAR):
        series.append(charts.Series("", [charts.Point(x, level) for x in (min(ends), max(ends))], "#666666", True, False, level != 1.0))
    return charts.Panel(law, "Re", label, series, True, True)


def let_fall(chosen, points, laws):
    """Terminal speed over measured, and how the bodies lie."""
    bodies = [point for point in points if falling.body_of(point)]
    jobs = {(k, law): falling.job(chosen.build, point, law) for law in laws for k, point in enumerate(bodies)}
    found = chosen.store.run_all("falling bodies", jobs.values())
    if chosen.plan:
        return 0
    found = runs.needed(found, jobs)
    ratios = {law: [found[k, law]["speed"] / falling.speed_of(point) for k, point in enumerate(bodies)] for law in laws}
    rows, page = [], []
    for name, belongs in drag_points.SETS.items():
        inside = [k for k, point in enumerate(bodies) if belongs(point)]
        if not inside:
            continue
        line = [name, str(len(inside))]
        for law in laws:
            off = drag_points.off([ratios[law][k] for k in inside])
            lie = [falling.attitude(found[k, law]) for k in inside if falling.body_of(bodies[k]).turns]
            rows.append([name, law, off.count, f"{100 * off.bias:+.1f}", f"{100 * off.rms:.1f}", f"{100 * off.share:.0f}",
                         *(lie.count(word) for word in falling.ATTITUDES)])
            line.append(f"{100 * off.bias:+.1f}, {100 * off.rms:.1f}, {100 * off.share:.0f} %" + (f"; {lie.count('broadside')}" if lie else ""))
        page.append(line)
    tables.publish(chosen, "falling", "Terminal speed over measured [%], and number of bodies by attitude",
                   ["set", "law", "bodies", "bias", "rms", "within_25", *falling.ATTITUDES], rows)
    charts.write(chosen.out / "falling.svg", "Terminal speed of bodies with forces of their real shape over measured; dashed: 25 % either way",
                 [panel(law, ratios[law], bodies, "speed over measured") for law in laws])
    return tables.finish(chosen, ["Terminal speed over measured: bias, rms, share within 25 % as above; number of bodies that end broadside.",
                                  "", tables.markdown(["set", "bodies", *laws], page)], [], f"{len(bodies)} points of {chosen.data.name}")


def main():
    parser = options.Parser("drag-against-measurement", "Compares the drag laws of fix fluid/force with measured drag coefficients of bodies that fall "
                            "freely: geometric bias, logarithmic rms and share within 25 % of law over measured.", at_once=1)
    parser.add_argument("--data", type=pathlib.Path, default=drag_points.DEFAULT, metavar="CSV",
                        help="points with the columns " + ", ".join(drag_points.COLUMNS) +
                             " (default: ../shared/data/drag_test_points.csv, beside the checkout)")
    parser.add_argument("--laws", action=options.Words, metavar="LAW", help="default: " + " ".join(drag_points.LAWS) + "; with --falling the first four")
    parser.add_argument("--falling", action="store_true", help="lets the bodies fall in a still fluid, with forces of their real shape and from a tilted "
                        "start: terminal speed over measured, and how they lie. Films are left out")

    def check(words):
        words.points = [p for p in drag_points.read(words.data) if p.flag in (drag_points.GOOD, drag_points.COARSE)]
        if not any(belongs(p) for p in words.points for belongs in drag_points.SETS.values()):
            raise Failure(f"--data {words.data}: no point belongs to a set; the sets are {', '.join(drag_points.SETS)}")

    chosen = parser.settle(("dragLaw", "eccentra-dem"), check)
    points = chosen.points
    if chosen.falling:
        return let_fall(chosen, points, tuple(chosen.laws or FALLING))
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
                 [panel(law, [value / point.cd for value, point in zip(values[law], points)], points, "C_D of the law over measured") for law in laws])
    return tables.finish(chosen, page, [], f"{len(points)} points of {chosen.data.name}")
