# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Concentration in the annulus at a given solids flux: a ladder of fixed fillings, whose flux is measured, is inverted."""
import dataclasses
import math

from . import levels, measures, runs, section, tables

POURED_ABOVE = 0.05  # of the volume: what has no room at random is poured first; so is all in inclined holes, where a bed forms
POURING = 0.4  # [s]
SHARE = 0.4  # of a run, at its end, over which means are taken: the shock of the flow's start lasts for a second
NOT_RUN = "not run"
NARROW = 0.02  # fillings that enclose the injected flux are close enough [of the volume]
INSIDE = 0.25  # of their distance that a further filling keeps from both
ROOM = 3.0  # standard errors by which two values must differ to be told apart, squared sum
STEADY = 0.05  # change of a flux, over its value or the injected one, from the first to the second half of the time over which it is a mean


@dataclasses.dataclass(frozen=True)
class Size:
    rungs: tuple
    length: float
    cells: str
    seconds: float
    seeds: int
    turbulence: str = ""  # model of the flow; empty: laminar
    refine: int = 0  # further fillings between the two that enclose the injected flux


@dataclasses.dataclass(frozen=True)
class Point:
    """A condition: level of detail, inclination [deg], mean velocity [m/s], pipe's turns per minute; sphericity of a sphere that
    stands for a shape."""
    level: levels.Level
    inclination: int
    velocity: float
    rpm: int = 50
    sphericity: float = 1.0

    def name(self):
        return f"{self.level.name}, {self.inclination} deg, {self.velocity} m/s, {self.rpm} rpm"


@dataclasses.dataclass
class Value:
    """Concentration at the injected flux. bound +1: the ladder's top carries less, so it is larger than that (value: the top);
    then flux is that of the top. slides: solids move back down at some rung."""
    value: float
    error: float
    bound: int
    rungs: list
    slides: bool
    failed: str = ""
    partial: bool = False  # higher rungs were not run

    def words(self):
        if self.failed:
            return self.failed if self.failed == NOT_RUN else "failed"
        if self.bound:
            text = f"> {100 * self.value:.0f} %" + (", no higher filling run" if self.partial else "")
        else:
            text = f"{100 * self.value:.3g} +- {100 * self.error:.1g} %"
        return text + (" (slides back)" if self.slides else "")


def value_of(rungs, failed=""):
    """rungs: (concentration, flux, standard error of the flux), from the lowest."""
    if not rungs:
        return Value(math.nan, math.nan, 0, [], False, failed)
    at, error = measures.crossing([(0.0, 0.0, 0.0), *rungs], section.INJECTED)
    slides = any(flux < -2 * (0 if math.isnan(e) else e) and flux < -1e-3 * section.INJECTED for _, flux, e in rungs)
    if at == "above" and failed == NOT_RUN:
        return Value(rungs[-1][0], math.nan, 1, rungs, slides, partial=True)
    if at == "above":
        return Value(rungs[-1][0], math.nan, 0 if failed else 1, rungs, slides, failed)
    return Value(at, error, 0, rungs, slides, "")


def between(rungs):
    """The filling to run next between the two that enclose the injected flux: where the straight line between them reaches it, but not close to either,
    because the flux rises steeply where a bed begins to move. None where they are close, or where nothing lies below but the empty hole."""
    above = next((k for k, (_, flux, _) in enumerate(rungs) if flux >= section.INJECTED), 0)
    if not above:
        return None
    (low, below, _), (high, over, _) = rungs[above - 1], rungs[above]
    if high - low <= NARROW:
        return None
    share = (section.INJECTED - below) / (over - below)
    return low + (high - low) * min(1 - INSIDE, max(INSIDE, share))


def top_of_both(a, b):
    """The highest rung that both ladders have."""
    last = min(len(a.rungs), len(b.rungs)) - 1
    return a.rungs[last], b.rungs[last]


def told_apart(a, b, a_error, b_error):
    """+1: a is larger than b, -1: smaller, 0: the errors (nan: not known, counted as none) do not tell them apart."""
    spread = math.hypot(*(0 if math.isnan(e) else e for e in (a_error, b_error)))
    return 0 if abs(a - b) <= ROOM * spread else (1 if a > b else -1)


def larger(a, b):
    """+1: a is larger than b, -1: smaller, 0: the errors do not tell them apart; None: one failed, or nothing can be said. Where
    neither ladder reaches the injected flux, the one that carries less at the highest filling of both needs more solid."""
    if a is None or b is None or a.failed or b.failed or math.isnan(a.value) or math.isnan(b.value):
        return None
    if a.bound and b.bound:
        (_, x, ex), (_, y, ey) = top_of_both(a, b)
        return told_apart(y, x, ey, ex)
    elif a.bound or b.bound:  # the bound is larger, if it lies above the other value
        bound, value, sign = (a, b, 1) if a.bound else (b, a, -1)
        return sign if bound.value > value.value else None
    return told_apart(a.value, b.value, a.error, b.error)


class Ladders:
    def __init__(self, store, build, size, critical):
        """critical: {level name: critical step}."""
        self.store, self.build, self.size, self.critical = store, build, size, critical
        self.values = {}
        self.drifts = {}  # {(point, concentration): (change of the flux within the time over which it is a mean, its standard error)}

    def job(self, point, rung, seed):
        words = {"inclination": point.inclination, "velocity": point.velocity, "rpm": point.rpm, "seconds": self.size.seconds,
                 "length": self.size.length, "cells": self.size.cells, "count": section.bodies_at(rung, self.size.length), "seed": seed,
                 "interval": section.steps_per_fluid_step(self.critical[point.level.name]), "snapshots": self.size.seconds,
                 **section.level_words(point.level)}
        if rung > POURED_ABOVE or point.inclination > 0:
            words["pouring"] = POURING
        if self.size.turbulence:
            words["turbulence"] = self.size.turbulence
        if point.sphericity != 1:
            words["sphericity"] = point.sphericity
        return section.section_job(self.build, f"{point.name()}, {100 * rung:g} %, seed {seed}", words, SHARE, point.level.spheres)

    def run(self, points):
        """All ladders, a rung at a time: what carries the injected flux needs no higher rung. Returns failed runs as sentences."""
        points = [p for p in dict.fromkeys(points) if p not in self.values]
        climbing, rungs, failed, sentences = list(points), {p: [] for p in points}, {}, []
        for rung in self.size.rungs:
            ended = self.climb({point: rung for point in climbing}, f"rung of {100 * rung:g} %", rungs, failed, sentences)
            climbing = [point for point in climbing if (point not in ended or self.store.plan)
                        and not (rungs[point] and rungs[point][-1][1] >= section.INJECTED)]
        for turn in range(self.size.refine):
            chosen = {point: rung for point in points if point not in failed and (rung := between(rungs[point]))}
            self.climb(chosen, f"between the rungs, {turn + 1} of {self.size.refine}", rungs, failed, sentences)
        for point in points:
            self.values[point] = value_of(rungs[point], failed.get(point, ""))
        return sentences

    def climb(self, at, title, rungs, failed, sentences):
        """Runs each point at its filling, {point: filling}, and adds what came out to rungs, in order; the points without a run."""
        seeds = section.SEEDS[: self.size.seeds]
        jobs = {(p, s): self.job(p, rung, s) for p, rung in at.items() for s in seeds}
        results = self.store.run_all(title, jobs.values())
        ended = set()
        for point, rung in at.items():
            every = [results[jobs[point, s].key()] for s in seeds]
            good = [r for r in every if runs.good(r)]
            if any("failed" in r for r in every):
                failed[point] = next(r["failed"] for r in every if "failed" in r)
                sentences.append(f"{point.name()}, {100 * rung:.3g} %: {failed[point]}")
            if not good:
                failed.setdefault(point, NOT_RUN)
                ended.add(point)
                continue
            flux, error = measures.mean_and_error([r["mean"]["flux"][0] for r in good])
            if len(good) == 1:
                error = good[0]["mean"]["flux"][1]
            filled = measures.mean_and_error([r["mean"]["concentration"][0] for r in good])[0]
            rungs[point] = sorted([*rungs[point], (filled, flux, error)])
            self.drifts[point, filled] = measures.mean_of_measured([r["drift"]["flux"] for r in good])
        return ended

    def rows(self, points):
        """For CSV: all that is known of some points."""
        rows = []
        for p in points:
            v = self.values[p]
            start = [p.level.name, p.inclination, p.velocity, p.rpm, p.level.mu, v.value, v.error, v.bound, int(v.slides), v.failed]
            rows += [start + [c, flux, error] for c, flux, error in v.rungs] or [start + ["", "", ""]]
        return rows


HEADER = ["level", "inclination_deg", "velocity_m_per_s", "rpm", "mu_shape", "concentration_at_injected_flux", "standard_error",
          "is_lower_bound", "slides_back", "failed", "rung_concentration", "rung_flux_m3_per_s", "rung_flux_standard_error"]


def long_table(series, values, x):
    """One row per point, with the flux of each rung. series: {name: [(x, Point)]}."""
    rows = []
    for name, points in series.items():
        for at, p in points:
            if values[p].failed == NOT_RUN:
                continue
            fluxes = ", ".join(f"{100 * c:.0f} %: {tables.number(1e6 * flux, 2)}" for c, flux, _ in values[p].rungs)
            rows.append([name, "cluster" if math.isnan(at) else f"{at:.4g}", values[p].words(), fluxes])
    return ["", x, "C at the injected flux", "flux at a filling [1e-6 m3/s]"], rows


def enclosing(rungs):
    """The two fillings between which the injected flux lies, or the highest one."""
    above = next((k for k, (_, flux, _) in enumerate(rungs) if flux >= section.INJECTED), len(rungs))
    return rungs[max(0, above - 1):above + 1]


def not_steady(series, climbed):
    """Fluxes from which C was taken and which still changed, as a sentence; empty if none did."""
    moving = []
    for name, points in series.items():
        for at, p in points:
            for filled, flux, _ in enclosing(climbed.values[p].rungs):
                change, error = climbed.drifts.get((p, filled), (math.nan, math.nan))
                if abs(change) > max(STEADY * max(abs(flux), section.INJECTED), ROOM * (0 if math.isnan(error) else error)):
                    of = "" if math.isnan(at) else f" at {at:.4g}"
                    moving.append(f"{name}{of}, {100 * filled:.0f} %: {tables.number(1e6 * flux, 2)} by {1e6 * change:+.0f}")
    return (f"Not steady: from the first to the second half of the time over which means were taken, these fluxes [1e-6 m3/s] changed by more than "
            f"{100 * STEADY:g} % and {ROOM:g} standard errors: {'; '.join(moving)}.") if moving else ""


def not_run(series, values, x):
    """What of a figure is not run, as a sentence; empty if all is."""
    left = {name: [f"{at:g}" for at, p in points if values[p].failed == NOT_RUN] for name, points in series.items()}
    named = [name if left[name] == ["nan"] else f"{name}: {', '.join(left[name])}" for name in left if left[name]]
    return f"Not run (at {x}): {'; '.join(named)}." if named else ""
