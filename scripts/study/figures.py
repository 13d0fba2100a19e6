# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's figures as our own results: points, charts, and what the paper says beside what we find."""
import dataclasses
import math

from . import charts, ladders, levels, tables
from .ladders import Point, larger, top_of_both

SAME_FILLING = 0.004  # fillings that are compared differ by less [of the volume]
SPHERICITY = {"cube": 0.85, "disk": 0.79}  # Table 1


@dataclasses.dataclass(frozen=True)
class Plan:
    """What a size of the study looks at."""
    inclinations: tuple
    velocities: tuple
    shape_velocities: tuple
    coarse_velocities: tuple
    friction_velocities: tuple
    rpms: tuple
    friction_inclinations: tuple
    estimates: tuple


def pairs(values, of, by):
    """Neighbours compared: (group, a, b, larger(b, a)) for values {key: Value}, sorted by `by` within the groups `of`."""
    told = []
    for group in dict.fromkeys(of(k) for k in values):
        keys = sorted((k for k in values if of(k) == group), key=by)
        for a, b in zip(keys, keys[1:]):
            told.append((group, a, b, larger(values[b], values[a])))
    return told


def count(told, wanted, what):
    """How often a trend holds."""
    judged = [t for t in told if t[3] is not None]
    holds = [t for t in judged if t[3] == wanted]
    against = [t for t in judged if t[3] == -wanted]
    if not judged:
        return f"{what}: nothing to compare."
    verdict = "holds" if len(holds) == len(judged) else "does not hold" if not holds else "holds in part"
    return f"{what}: {verdict} ({len(holds)} of {len(judged)} comparisons; {len(against)} the other way, " \
           f"{len(judged) - len(holds) - len(against)} not told apart)."


def flux_trend(told_of, what):
    """At each filling that both have: how often the flux of b is smaller than that of a, for (a, b) in pairs of values."""
    signs = {}  # {filling [%]: one sign for each pair}
    for a, b in told_of:
        for (filled, flux_a, error_a) in a.rungs:
            for _, flux_b, error_b in (rung for rung in b.rungs if abs(rung[0] - filled) < SAME_FILLING):
                signs.setdefault(round(100 * filled), []).append(ladders.told_apart(flux_b, flux_a, error_b, error_a))
    parts = [f"at {at} % it falls in {of.count(-1)}, rises in {of.count(1)} of {len(of)}" for at, of in sorted(signs.items())]
    return f"Flux carried at a filling, {what}: {'; '.join(parts)} comparisons." if parts else ""


class Figures:
    def __init__(self, plan, estimates, fine_file):
        self.plan = plan
        self.of = {body: {level.name: level for level in levels.levels_of(body, estimates[body], fine_file)} for body in ("cube", "disk")}
        self.mu = {body: [self.of[body][f"S1 mu {estimates[body][n]:.2f}"] for n in plan.estimates] for body in ("cube", "disk")}
        self.s1, self.s6 = self.of["cube"]["S1"], self.of["cube"]["S6"]
        self.reference = {"cube": self.of["cube"]["C64"], "disk": self.of["disk"]["D48"]}
        self.true = {body: levels.smooth(body, levels.ROUNDING[body]) for body in ("cube", "disk")}

    def sphere(self, body, level, inclination, velocity, rpm=50):
        """A sphere whose rolling friction stands for a shape has the drag of that shape."""
        return Point(level, inclination, velocity, rpm, SPHERICITY[body])

    def levels_needed(self, numbers):
        """Whose time step some figures ask for."""
        beds = {self.s1, *self.reference.values()} if 9 in numbers else set()
        return beds | {p.level for number in numbers if number != 9 for line in self.points(number).values() for _, p in line}

    def points(self, number):
        """{series name: [(x, Point)]}."""
        plan = self.plan
        if number == 7:
            return {f"{level.name}, {u} m/s": [(i, Point(level, i, u)) for i in plan.inclinations]
                    for level in (self.s1, self.s6) for u in plan.velocities}
        if number == 10:
            shapes = {"disk D48": self.reference["disk"], "cube C64": self.reference["cube"], "sphere S1": self.s1,
                      "true disk": self.true["disk"], "true cube": self.true["cube"]}
            return {name: [(u, Point(level, 80, u)) for u in plan.shape_velocities] for name, level in shapes.items()}
        if number == 11:
            names = (("cube", "C8"), ("cube", "C27"), ("cube", "C64"), ("disk", "D7"), ("disk", "D19"), ("disk", "D48"))
            found = {name: [(u, Point(self.of[body][name], 80, u)) for u in plan.coarse_velocities] for body, name in names}
            return found | {f"true {body}": [(u, Point(level, 80, u)) for u in plan.coarse_velocities] for body, level in self.true.items()}
        if number == 12:
            found = {}
            for body, cluster in (("cube", "C64"), ("disk", "D48")):
                for u in plan.friction_velocities:
                    found[f"{body}, {u} m/s"] = [(0.0, self.sphere(body, self.s1, 80, u))] + [
                        (level.mu, self.sphere(body, level, 80, u)) for level in self.mu[body]]
                    found[f"{cluster}, {u} m/s"] = [(math.nan, Point(self.reference[body], 80, u))]
                    found[f"true {body}, {u} m/s"] = [(math.nan, Point(self.true[body], 80, u))]
            return found
        if not plan.friction_velocities:
            return {}
        body = {13: "disk", 14: "cube"}[number]
        u = plan.friction_velocities[-1]
        chosen = [self.s1, self.mu[body][-1]]
        found = {f"mu {level.mu:.2f}, {plan.rpms[len(plan.rpms) // 2]} rpm":
                 [(i, self.sphere(body, level, i, u)) for i in plan.friction_inclinations] for level in chosen}
        found |= {f"mu {level.mu:.2f}, 80 deg, turning": [(rpm, self.sphere(body, level, 80, u, rpm)) for rpm in plan.rpms]
                  for level in chosen}
        return found


SAYS = {
    7: "C rises with inclination and falls with velocity; S6 gives what S1 gives; deviation from Tomren's measurements below 25 % "
       "at 0.58 m/s.",
    10: "C falls with velocity; disk >= cube >= sphere.",
    11: "Fewer sub-spheres (C8, C27 for C64; D7, D19 for D48) give no growing deviation.",
    12: "Spheres approach the cluster result as the rolling coefficient grows.",
    13: "For disks C grows with mu_r at all inclinations; rotation of the pipe lowers it.",
    14: "For cubes C grows with mu_r, less than for disks; rotation of the pipe lowers it.",
}
TITLES = {7: "concentration against inclination, S1 and S6", 10: "concentration against velocity by shape, 80 degrees",
          11: "coarser clusters, 80 degrees", 12: "rolling coefficient against clusters, 80 degrees",
          13: "effect of mu_shape, disk", 14: "effect of mu_shape, cube"}
WANTED = "C at the injected flux [%]"
X = {7: "inclination [degrees]", 10: "velocity [m/s]", 11: "velocity [m/s]", 12: "mu_shape", 13: "inclination [degrees]",
     14: "inclination [degrees]"}


def finds(number, series, values):
    """What we find, from the values alone: sentences. series: {name: [(x, Point)]}."""
    keyed = {(name, x): values[p] for name, points in series.items() for x, p in points}
    told = []
    if number == 7:
        at = {(p.level.name, p.inclination, p.velocity): values[p] for points in series.values() for _, p in points}
        told.append(count(pairs(at, lambda k: (k[0], k[1]), lambda k: k[2]), -1, "C falls with velocity"))
        told.append(count(pairs(at, lambda k: (k[0], k[2]), lambda k: k[1]), 1, "C rises with inclination"))
        equal = [larger(at["S6", i, u], at["S1", i, u]) for (n, i, u) in at if n == "S1"]
        judged = [e for e in equal if e is not None]
        told.append(flux_trend([(at[a], at[b]) for _, a, b, _ in pairs(at, lambda k: (k[0], k[2]), lambda k: k[1])],
                               "from one inclination to the next larger"))
        told.append(f"S6 and S1 are not told apart in {sum(e == 0 for e in judged)} of {len(judged)} points.")
        told.append(vertical(at))
    elif number == 10:
        told.append(count(pairs(keyed, lambda k: k[0], lambda k: k[1]), -1, "C falls with velocity"))
        for what, names in (("clusters", ("sphere S1", "cube C64", "disk D48")), ("true bodies", ("sphere S1", "true cube", "true disk"))):
            shown = pairs({k: v for k, v in keyed.items() if k[0] in names}, lambda k: k[1], lambda k, names=names: names.index(k[0]))
            told.append(count(shown, 1, f"disk > cube > sphere, {what}"))
            told.append(flux_trend([(keyed[a], keyed[b]) for _, a, b, _ in shown], f"from sphere to cube to disk, {what}"))
    elif number == 11:
        for coarse, fine in (("C8", "C64"), ("C27", "C64"), ("C64", "true cube"), ("D7", "D48"), ("D19", "D48"), ("D48", "true disk")):
            for (name, u), value in keyed.items():
                if name == coarse:
                    told.append(f"{coarse} at {u} m/s: {against(value, keyed[fine, u])} {fine}.")
    elif number == 12:
        for name, points in series.items():
            if len(points) > 1:
                body, at = name.split(",")
                others = {other: values[series[f"{other},{at}"][0][1]] for other in ({"cube": "C64", "disk": "D48"}[body], f"true {body}")}
                told.append(count([(0, a[0], b[0], larger(values[b[1]], values[a[1]])) for a, b in zip(points, points[1:])], 1,
                                  f"{name}: C grows with mu_shape"))
                told.append(flux_trend([(values[a[1]], values[b[1]]) for a, b in zip(points, points[1:])], "as mu_shape grows"))
                for other, value in others.items():
                    compared = [f"mu {x:.2f} {against(values[p], value)}" for x, p in points if larger(values[p], value) is not None]
                    if compared:
                        told.append(f"Against {other}: " + "; ".join(compared) + ".")
        told.append("Above mu_s = 0.5 a sphere slides instead of rolling: more rolling friction changes nothing then (saturation).")
    else:
        names = list(series)
        for none, some in ((names[0], names[1]), (names[2], names[3])):
            for (x, a), (_, b) in zip(series[none], series[some]):
                where = f"{x:g} rpm" if "turning" in none else f"{x:g} degrees"
                told.append(f"With mu_shape at {where}: {against(values[b], values[a])} without.")
        told.append(flux_trend([(values[a], values[b]) for none, some in ((names[0], names[1]), (names[2], names[3]))
                                for (_, a), (_, b) in zip(series[none], series[some])], "with mu_shape against without"))
        turned = [(0, a, b, larger(values[b[1]], values[a[1]])) for name in names[2:] for a, b in zip(series[name], series[name][1:])]
        told.append(count(turned, -1, "Rotation lowers C"))
        told.append(flux_trend([(values[a[1]], values[b[1]]) for name in names[2:] for a, b in zip(series[name], series[name][1:])],
                               "as the pipe turns faster"))
    told = [t for t in told if "nothing to compare" not in t and "not compared with" not in t and "in 0 of 0 points" not in t]
    back = sorted({p.name() for points in series.values() for _, p in points if values[p].slides})
    if back:
        told.append(f"At some filling the solids slide back down the hole, which a periodic section lets go on for ever, at {len(back)} points: "
                    + "; ".join(back) + ".")
    return " ".join(t for t in told if t) or "nothing yet: too little is run."


def against(a, b):
    """How a compares with b, with figures where both are known."""
    sign = larger(a, b)
    if sign is None:
        return "not compared with"
    if a.bound and b.bound:
        relation = {1: "carries less than", -1: "carries more than", 0: "carries what is not told apart from"}[sign]
        x, y = (tables.number(1e6 * flux, 2) for _, flux, _ in top_of_both(a, b))
        return f"{relation} (flux of the highest filling of both {x} against {y} e-6 m3/s)"
    relation = {1: "more than", -1: "less than", 0: "not told apart from"}[sign]
    return f"{relation} ({a.words()} against {b.words()})"


def vertical(at):
    """At 0 degrees the concentration is known: Qs / (A v_s), v_s = U/(1 - C) - slip, with the closures' terminal speed."""
    known = {0.58: 0.01670, 0.72: 0.01173, 1.165: 0.00596}  # of spheres, rho_f 1000 kg/m3
    found = [(u, value, known[u]) for (name, i, u), value in at.items() if name == "S1" and i == 0 and u in known and not value.bound and not value.failed]
    if not found:
        return ""
    return "At 0 degrees, against the closed form of uniform flow: " + "; ".join(
        f"{u} m/s {100 * v.value:.2f} % against {100 * k:.2f} %" for u, v, k in found) + "."


def panel(number, series, values):
    shown = []
    if number == 11:  # levels side by side
        for k, u in enumerate(dict.fromkeys(x for points in series.values() for x, _ in points)):
            made = [charts.Point(place, 100 * values[p].value, 100 * values[p].error, name, bound=values[p].bound)
                    for place, (name, points) in enumerate(series.items()) for x, p in points if x == u]
            shown.append(charts.Series(f"{u} m/s", made, charts.COLOURS[k]))
        return charts.Panel(f"Figure {number}: {TITLES[number]}", "level of detail, from C8 to the true disk", WANTED, shown, floor=0, numbered=False)
    for k, (name, points) in enumerate(series.items()):
        if number in (13, 14) and "turning" in name:
            continue
        made = [charts.Point(x, 100 * values[p].value, 100 * values[p].error, bound=values[p].bound)
                for x, p in points if not math.isnan(x)]
        colour = charts.COLOURS[k % len(charts.COLOURS)]
        shown.append(charts.Series(name, made, colour, True))
        for x, p in points:  # a cluster beside spheres of any coefficient: a level line
            if math.isnan(x):
                ends = [q for other in series.values() for q, _ in other if not math.isnan(q)]
                level = 100 * values[p].value
                shown[-1] = charts.Series(name + (" (lower bound)" if values[p].bound else ""),
                                          [charts.Point(min(ends), level), charts.Point(max(ends), level)], colour, True, False, True)
    return charts.Panel(f"Figure {number}: {TITLES[number]}", X[number], WANTED, shown, floor=0)


def flux_panel(number, series, values):
    """The ladders themselves: where the injected flux is not reached, this is what there is."""
    shown = []
    for k, (name, points) in enumerate(series.items()):
        for x, p in points:
            rungs = [charts.Point(100 * c, 1e6 * flux, 1e6 * error) for c, flux, error in values[p].rungs]
            named = name if x == points[0][0] or math.isnan(x) else ""
            shown.append(charts.Series(named, rungs, charts.COLOURS[k % len(charts.COLOURS)], True, dashed=not named))
    return charts.Panel(f"Figure {number}: flux carried by a filling", "solid concentration [%]", "solids flux [1e-6 m3/s]", shown)
