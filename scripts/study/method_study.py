# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the methods of the coupling cost and change: mesh, fluid step, DEM step, void fraction, drag in the fluid, rheology."""
import dataclasses
import math

from . import charts, choice, measures, runs, section, tables

LENGTH, CONCENTRATION, VELOCITY = 0.15, 0.05, 0.58
TURBULENT = 1.165  # velocity at which the wide gap is turbulent (docs/turbulence.md) [m/s]
DEM_STEP = 5e-3 / 64
DISKS = {"shape": "disk 48", "interval": 192}  # DEM steps for clusters: 0.3 of what is critical while they collide
CUBES = {"shape": "cube 8", "interval": 128}
BED = (80,)  # inclinations at which bodies come to rest
PANELS = 5  # of a chart in a row
STEPS = ("mesh", "fluid step", "tolerance", "DEM step", "regularisation")  # families whose members are steps of one number: joined in the chart
BASE = {"velocity": VELOCITY, "length": LENGTH, "cells": "8 32 10", "fluid_step": 5e-3, "interval": 64, "safety": 2}
PERCENT = 2.0  # the accuracy that the plain words ask for
RESULTS = ("gradient", "flux", "height")  # of section.QUANTITIES
UNKNOWN = (math.nan, math.nan)  # the height in a vertical hole, which has no low side


@dataclasses.dataclass(frozen=True)
class Size:
    inclinations: tuple
    seeds: int
    seconds: float
    finest: bool
    clusters: bool = True  # whether the families of bodies that are no spheres are there


@dataclasses.dataclass(frozen=True)
class Family:
    """what: in words; variants: {name: options that differ from BASE}; reference: the name that the others are compared with."""
    what: str
    variants: dict
    reference: str
    velocity: float = VELOCITY
    inclinations: tuple = ()  # empty: all


def _fluid_steps(momentum):
    return {f"{step * 1e3:g} ms{'' if momentum == 'semiImplicit' else ' explicit'}":
            {"fluid_step": step, "interval": max(1, round(step / DEM_STEP)), "momentum": momentum,
             "report": max(1, round(section.REPORT * section.FLUID_STEP / step))}
            for step in (0.02, 0.01, 0.005, 0.002, 0.001)}


def families(size, inclination):
    """{name: Family} at an inclination."""
    finest = size.finest
    meshes = ("4 16 5", "6 24 8", "8 32 10", "12 48 15") + (("16 64 20",) if finest else ())
    explicit = _fluid_steps("explicit")
    if not finest:
        explicit = {name: explicit[name] for name in explicit if not name.startswith(("2 ", "1 "))}
    dem = {f"{5e-3 / n * 1e6:.0f} us": {"interval": n} for n in (20, 32, 64, 128) + ((256,) if finest else ())}
    viscosities = {f"{model} {most:g}": {"viscosity": f"{model} {most:g}", "tau0": 1}
                   for model, mosts in (("capped", (1, 10, 100, 1000)), ("regularised", (10, 100, 1000))) for most in mosts}
    tolerances = {", ".join(pair): {"tolerances": pair} for pair in (("1e-2", "1e-2"), ("1e-3", "1e-4"), ("1e-4", "0"), ("1e-7", "0"))}
    forms = {form: {"tau0": 1, "effects": f"drag chien pressure_gradient on yield_form {form}"} for form in section.FORMS}
    models = {model: {"turbulence": model} for model in ("laminar", "realizableKE", "kOmegaSST", "kEpsilon")}
    made = {
        "mesh": Family("cells (gap x around x along)", {m.replace(" ", "x"): {"cells": m} for m in meshes}, meshes[-1].replace(" ", "x")),
        "fluid step": Family("fluid step = coupling interval, drag semi-implicit or explicit in the fluid",
                             _fluid_steps("semiImplicit") | explicit, "1 ms"),
        "tolerance": Family("relTol of the last correction of pressure, velocity", tolerances, list(tolerances)[-1]),
        "DEM step": Family("DEM step", dem, list(dem)[-1]),
        "void fraction": Family("void-fraction method", {w: {"void-fraction": w} for w in ("centre", "divided", "gaussian", "diffusion")}, "diffusion"),
        "regularisation": Family("largest viscosity [Pa s] at tau0 = 1 Pa, and the model", viscosities, "capped 1000"),
        "yield form": Family("drag beside the yield stress at tau0 = 1 Pa: yield_form", forms, section.FORMS[-1]),
        "turbulence": Family("turbulence model", models, "kEpsilon", TURBULENT),
    }
    if size.clusters:
        made["forces"] = Family("forces on D48 as on the sphere of equal volume, or oriented, of the real shape",
                                {forces: {"effects": section.effects_of(forces), **DISKS} for forces in section.FORCES}, "oriented")
        made["sleep"] = Family("C8 at rest, awake or asleep (fix sleep/cluster)", {name: {"sleep": k, **CUBES} for k, name in enumerate(("awake", "asleep"))},
                               "awake", inclinations=BED)
    return {name: family for name, family in made.items() if not family.inclinations or inclination in family.inclinations}


def _remark(row):
    return "failed" if row["failed"] else "not run" if math.isnan(row["cpu"]) else "reference" if row["reference"] else ""


def _percent(row):
    return [100 * value for value in row["deviation"]]


def _plain_words(rows):
    """The cheapest within PERCENT of the reference, from the numbers alone."""
    reference = next(row for row in rows if row["reference"])
    near = [row for row in rows if abs(row["deviation"][0]) * 100 <= PERCENT]
    if not near:
        return ""
    best, worst = min(near, key=lambda row: row["cpu"]), max(near, key=lambda row: row["deviation"][1])
    return (f"Within {PERCENT:g} % of {reference['name']} in the pressure gradient, the cheapest is {best['name']} "
            f"({100 * best['deviation'][0]:+.1f} %), which is {tables.number(reference['cpu'] / best['cpu'], 2)} times as fast. "
            f"A deviation is known to {100 * worst['deviation'][1]:.1f} % here.\n")


def _not_steady(rows):
    """What still changed while means were taken, as a sentence; empty where all are steady."""
    moving = [f"{row['name']} {100 * change:+.1f} +- {100 * error:.1f} %" for row in rows for change, error in (row["drift"],)
              if abs(change) > max(choice.DRIFT, choice.SURE * error)]
    return (f"Not steady: from the first to the second half of the time over which means were taken, the pressure gradient changed by more than "
            f"{100 * choice.DRIFT:g} % and {choice.SURE:g} standard errors: {', '.join(moving)}.\n") if moving else ""


class Study:
    def __init__(self, store, build, size, output):
        self.store, self.build, self.size, self.output = store, build, size.methods, output
        self.rows, self.failures = [], []

    def run(self):
        jobs = {}
        for inclination, name, family in self.every():
            for variant, change in family.variants.items():
                for seed in section.SEEDS[: self.size.seeds]:
                    words = {**BASE, "velocity": family.velocity, "inclination": inclination, "seconds": self.size.seconds, "seed": seed,
                             "count": section.bodies_at(CONCENTRATION, LENGTH), **change}
                    tolerances = words.pop("tolerances", None)
                    spheres = int(words["shape"].split()[1]) if "shape" in words else 1
                    jobs[inclination, name, variant, seed] = section.section_job(
                        self.build, f"{name} {variant}, {inclination} deg, seed {seed}", words, spheres=spheres, tolerances=tolerances)
        found = self.store.run_all("methods", jobs.values())
        for inclination, name, family in self.every():
            self.compare(inclination, name, family, {key[2:]: found[job.key()] for key, job in jobs.items() if key[:2] == (inclination, name)})
        return self.failures

    def every(self):
        """(inclination, name, Family) of all tables."""
        return [(inclination, name, family) for inclination in self.size.inclinations for name, family in families(self.size, inclination).items()]

    def compare(self, inclination, family, of, results):
        variants, reference = of.variants, of.reference
        means = {}
        for name in variants:
            every = [r for (n, _), r in results.items() if n == name]
            good = [r for r in every if runs.good(r)]
            failed = next((r["failed"] for r in every if "failed" in r), "")
            if failed:
                self.failures.append(f"{family} {name}, {inclination} deg: {failed}")
            values, drifts = {}, {}
            for quantity in RESULTS:
                found = [r["mean"].get(quantity, UNKNOWN) for r in good]
                mean, error = measures.mean_and_error([value for value, _ in found])
                if len(found) == 1:  # one seed: its error in time
                    error = found[0][1]
                values[quantity] = (mean, error)
                drift = measures.mean_of_measured([r["drift"].get(quantity, UNKNOWN) for r in good]) if good and mean else UNKNOWN
                drifts[quantity] = tuple(value / abs(mean) for value in drift)
            means[name] = (values, drifts, measures.mean_and_error([r["cpu"] for r in good])[0], failed)
        for name, (values, drifts, cpu, failed) in means.items():
            for quantity in RESULTS:
                off, error = measures.deviation(*values[quantity], *means[reference][0][quantity])
                self.rows.append({"inclination": inclination, "family": family, "name": name, "quantity": quantity, "value": values[quantity],
                                  "drift": drifts[quantity], "deviation": (math.nan, math.nan) if name == reference else (off, error),
                                  "reference": name == reference, "cpu": cpu, "failed": failed})

    def of(self, inclination, family, quantity):
        return [row for row in self.rows if (row["inclination"], row["family"], row["quantity"]) == (inclination, family, quantity)]

    def write(self):
        lines, page, panels = [], ["## Methods of the coupling\n", "![methods](methods.svg)\n"], []
        missing = []
        header = ["method", "Pa/m", "+-", "off %", "+-", "flux cm3/s", "off %", "+-", "centre mm", "off %", "CPU s", ""]
        for inclination, name, family in self.every():
            gradient, flux, height = (self.of(inclination, name, q) for q in RESULTS)
            if all(math.isnan(g["cpu"]) and not g["failed"] for g in gradient):
                missing.append(f"{name} at {inclination} degrees")
                continue
            table = [[g["name"], *g["value"], *_percent(g), 1e6 * f["value"][0], *_percent(f), 1e3 * h["value"][0], _percent(h)[0], g["cpu"], _remark(g)]
                     for g, f, h in zip(gradient, flux, height)]
            title = f"{inclination} degrees, {family.velocity:g} m/s: {family.what}"
            lines += [title, "", tables.text(header, table)]
            page += [f"### {title}\n", tables.markdown(header, table), _plain_words(gradient), _not_steady(gradient)]
            panels.append(self.panel(inclination, name, gradient, family.reference))
        if missing:
            page.append(f"Not run: {'; '.join(missing)}.\n")
        text = "\n".join(lines)
        (self.output / "methods.txt").write_text(text)
        print(text)
        columns = ["inclination", "family", "method", "quantity", "mean_si", "standard_error", "deviation", "deviation_error", "cpu_s", "failed"]
        tables.write_csv(self.output / "methods.csv", columns,
                         [[r["inclination"], r["family"], r["name"], r["quantity"], *r["value"], *r["deviation"], r["cpu"], r["failed"]]
                          for r in self.rows])
        if not panels:
            return ["## Methods of the coupling\n", "Not run.\n"]
        charts.write(self.output / "methods.svg", "What the methods of the coupling cost and change "
                     f"({', '.join(f'{i} degrees' for i in self.size.inclinations)}, 5 % solid)", panels, min(PANELS, len(panels)))
        return page

    def panel(self, inclination, family, rows, reference):
        """Signed deviations: most are smaller than their errors."""
        kinds = {}
        for row in rows:
            off, error = (0.0, math.nan) if row["reference"] else row["deviation"]
            if math.isnan(off) or math.isnan(row["cpu"]):
                continue
            kind = "explicit" if "explicit" in row["name"] else row["name"].split(" ")[0] if family == "regularisation" else ""
            label = row["name"].replace(" explicit", "").replace(f"{kind} ", "") if kind else row["name"]
            kinds.setdefault(kind, []).append(charts.Point(row["cpu"], 100 * off, 100 * error, label))
        series = [charts.Series(kind or "semi-implicit" * (family == "fluid step"), sorted(points, key=lambda p: p.x), charts.COLOURS[k],
                                family in STEPS) for k, (kind, points) in enumerate(kinds.items())]
        return charts.Panel(f"{family}, {inclination} degrees", "CPU seconds of a run", f"pressure gradient: off {reference} [%]", series, True)
