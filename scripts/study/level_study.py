# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Levels of detail of a body against the one with true faces: deviation beside time, in dry scenes and in the annulus."""
import dataclasses
import math
import statistics

from . import charts, choice, convergence, dry, forecast, levels, measures, power, runs, section, tables, timing, truth_chart

PERCENT = 5.0  # the accuracy that the plain words ask for
# What a point of the annulus is judged by: solids move at 0 and 40 degrees and form a bed at rest at 80.
JUDGED_BY = {0: "flux", 40: "flux", 80: "height"}
SECTION_RESULTS = {"flux": ("solids flux at 5 %", "1e-6 m3/s", 1e6), "height": ("height of the solids' centre", "mm", 1e3),
                   "gradient": ("pressure gradient", "Pa/m", 1.0)}
CONCENTRATION = 0.05
COLOUR = truth_chart.COLOUR
NO_FORM = truth_chart.NO_FORM
UNKNOWN_STEP = {"critical": math.nan, "contacts": 0}
COLUMNS = {4: 2, 7: 4, 8: 4}  # of a chart with so many panels; else 3
PARTS_SHOWN = ("drum", "section 80")
CENTRAL_VELOCITY = 0.58  # of the annulus in the first chart [m/s]
RESTITUTION_DRY, RESTITUTION_SECTION = 0.5, 0.9  # of the scenes


@dataclasses.dataclass(frozen=True)
class Size:
    """How large a study is. seeds: of each level in a dry scene, the pilot where most_seeds is larger; most_seeds: up to which seeds are added
    until the errors are those of power.py. dry_levels, section_levels: names, or those of estimates for the spheres with
    that mu_shape; empty: all. length, cells, seconds (by inclination) and points (inclination, velocity) are those of the annulus."""
    bodies: tuple
    few_bodies: bool
    seeds: int
    most_seeds: int
    dry_levels: tuple
    seeds_beside: int  # at most, at other velocities than CENTRAL_VELOCITY
    length: float
    cells: str
    seconds: dict
    points: tuple
    section_levels: tuple
    methods: object
    hopper_levels: tuple = ()  # those of dry_levels that run in the scene with most bodies, too; empty: all
    levels_beside: tuple = ()  # names as above, at other velocities than CENTRAL_VELOCITY; empty: section_levels


def short(name):
    return name.replace("S1 mu", "mu").replace("S1 eccentric", "eccentric")


def names_of(build, body):
    return [level.name for level in levels.levels_of(body, levels.eccentricities(build, body), "")
            + [levels.smooth(body, rounding) for rounding in levels.OTHER_ROUNDINGS[body]]]


@dataclasses.dataclass
class Row:
    level: levels.Level
    value: float
    error: float
    runs: int
    cpu: float
    wall: float
    parts: dict
    step: float
    critical: dict
    failed: str = ""
    deviation: float = math.nan
    deviation_error: float = math.nan
    values: dict = dataclasses.field(default_factory=dict)  # by seed
    drift: tuple = (math.nan, math.nan)  # in the time over which means were taken, with its standard error, over |value|

    def unsure(self):
        """The deviation as it can be told: not less than its standard error."""
        sizes = [abs(self.deviation), self.deviation_error]
        return max(s for s in sizes if not math.isnan(s)) if any(not math.isnan(s) for s in sizes) else math.nan


@dataclasses.dataclass
class Group:
    """All levels of one body in one scene, by one result; the last row is the reference."""
    scene: str
    body: str
    title: str
    unit: str
    rows: list
    judged: bool
    central: bool = True  # stands in the first chart
    percent: float = PERCENT  # the accuracy that the plain words ask for

    def compare(self):
        """Deviations, by pairs of runs that one seed gave; of fewer than two pairs, by the errors of both means."""
        reference = self.rows[-1]
        for row in self.rows[:-1]:
            pairs = [(value, reference.values[seed]) for seed, value in row.values.items() if seed in reference.values]
            if len(pairs) > 1:
                row.deviation, row.deviation_error = measures.paired_deviation(pairs)
            else:
                row.deviation, row.deviation_error = measures.deviation(row.value, row.error, reference.value, reference.error)

    def ladder(self):
        """The clusters of the body as (N, deviation, standard error), for convergence.py."""
        return [(row.level.spheres, row.deviation, row.deviation_error) for row in self.candidates()
                if row.level.kind == "cluster" and row.level.name not in NO_FORM]

    def candidates(self):
        return [row for row in self.rows[:-1] if not math.isnan(row.deviation) and row.unsure() > 0]

    def models(self):
        """Levels that may stand for the reference: a body with other corners is another body."""
        return [row for row in self.candidates() if row.level.kind != "rounding"]

    def front(self):
        """Rows that no other row beats in time and deviation, and the knee among them (or None)."""
        rows = self.models()
        points = [(row.cpu, row.unsure()) for row in rows]
        front = measures.pareto_front(points)
        bend = measures.knee([points[i] for i in front])
        return [rows[i] for i in front], None if bend is None else rows[front[bend]]

    def plain_words(self):
        """One paragraph, from the numbers alone."""
        reference, rows = self.rows[-1], self.models()
        if math.isnan(reference.value) or not rows:
            ended = "failed" if any(row.failed for row in self.rows) else "were not run"
            return f"{self.title} ({self.body}): no comparison, because the reference or all other levels {ended}."
        text = [f"{self.title} ({self.body}): the reference {reference.level.name} gives {tables.number(reference.value)} +- "
                f"{tables.number(reference.error, 2)}{f' {self.unit}' if self.unit else ''} in {tables.number(reference.cpu)} s."]
        near = sorted((row for row in rows if abs(row.deviation) * 100 <= self.percent), key=lambda row: row.cpu)
        if near:
            best = near[0]
            ratio = reference.cpu / best.cpu
            text.append(f"Within {self.percent:g} % of it, the cheapest is {best.level.name} ({100 * best.deviation:+.1f} +- "
                        f"{100 * best.deviation_error:.1f} %); it is {tables.number(ratio, 2)} times as fast.")
            if best.deviation_error * 100 > self.percent:
                text.append("The standard error is larger, so that more seeds are needed to be sure.")
        else:
            best = min(rows, key=lambda row: abs(row.deviation))
            text.append(f"No other level is within {self.percent:g} % of it; the nearest is {best.level.name} ({100 * best.deviation:+.1f} +- "
                        f"{100 * best.deviation_error:.1f} %), at {tables.number(best.cpu / reference.cpu, 2)} of the time.")
        if best.cpu >= reference.cpu:
            text.append(f"{reference.level.name} costs no more than that: take it.")
        plain = next((row for row in rows if row.level.kind == "sphere"), None)
        if plain and plain is not best:
            ratio = tables.number(plain.cpu / reference.cpu, 2)
            text.append(f"The plain sphere deviates by {100 * plain.deviation:+.0f} % at {ratio} of the time.")
        front, bend = self.front()
        if bend:
            text.append(f"The knee of the Pareto front is {bend.level.name}.")
        text += [power.reached(self.rows, reference), convergence.words_of(self.ladder())]
        return " ".join(sentence for sentence in text if sentence)

    def panel(self):
        """Error against time, the reference at zero with its noise as a band."""
        return truth_chart.signed(self.title, self.rows)


CSV_COLUMNS = ["scene", "body", "result", "unit", "level", "mean", "standard_error", "runs", "deviation", "deviation_error", "cpu_s",
               "wall_s", *(f"{part}_s" for part in timing.PARTS), "step_s", "critical_step_s", "contacts_at_critical", "failed"]


def csv_cells(group):
    """Rows of levels.csv, which clusterShape advise reads: the last row of a scene is the reference. Of other bodies it would take the cheapest."""
    return [cells_of(group, row) for row in group.rows if row.level.kind != "rounding"]


def cells_of(group, row):
    """A row of levels.csv."""
    return [group.scene, group.body, group.title, group.unit, row.level.name, row.value, row.error, row.runs, row.deviation, row.deviation_error,
            row.cpu, row.wall, *(row.parts.get(part, math.nan) for part in timing.PARTS), row.step, row.critical.get("critical", math.nan),
            row.critical.get("contacts", 0), row.failed]


class Study:
    """`retime`: the first run of each cell is repeated, for its times alone, after all that is to be run has been run; such times
    are preferred to those of the study wherever they are there."""

    def __init__(self, store, build, size, bodies, scenes, names, seeds, output, retime=False, rounding=None):
        """seeds: of each level, or None for those of the size. rounding: of the reference, or None for that of the body."""
        self.retime, self.rounding = retime, rounding
        self.pilot, self.most = (min(len(dry.SEEDS), number) for number in (seeds or size.seeds, seeds or size.most_seeds))
        self.store, self.build, self.size, self.output = store, build, size, output
        self.bodies, self.scenes, self.names, self.seeds = bodies, scenes, names, seeds or size.seeds
        self.groups, self.failures = [], []

    def wanted(self, body):
        """Levels of a body in heap and drum, in the hopper, in the annulus, and there at other velocities than the central one; the reference last in
        each."""
        estimates = levels.eccentricities(self.build, body)
        everything = levels.ladder_of(body, estimates, levels.fine_disks(self.output), self.rounding)
        reference = everything[-1]
        named = {f"S1 mu {mu:.2f}": name for name, mu in estimates.items()} | {"S1 eccentric": "eccentric"}
        of = lambda wanted: [one for one in everything if not wanted or one is reference or named.get(one.name, one.name) in wanted]
        chosen = [one for one in everything if one.name in self.names or one is reference] if self.names else of(self.size.dry_levels)
        wet, beside = ([one for one in of(names) if not self.names or one.name in self.names or one is reference]
                       for names in (self.size.section_levels, self.size.levels_beside or self.size.section_levels))
        hopper = chosen if self.names else [one for one in chosen if one in of(self.size.hopper_levels)]
        return {"hopper": hopper}, chosen, wet, beside

    def run(self):
        """Runs what is not there yet; returns what failed, as sentences."""
        plan = {body: self.wanted(body) for body in self.bodies}
        step_jobs = {(level.name, e): levels.step_job(self.build, level, e) for _, *lists in plan.values() for one in lists for level in one
                     for e in (RESTITUTION_DRY, RESTITUTION_SECTION)}
        found = self.store.run_all("time steps", step_jobs.values())
        self.critical = {key: found[job.key()] for key, job in step_jobs.items()}
        for (name, _), result in self.critical.items():
            if "failed" in result:
                return [f"the time step of {name}: {result['failed']}"]
        self.critical = {key: result if runs.good(result) else UNKNOWN_STEP for key, result in self.critical.items()}
        jobs, results = {}, {}
        for scene in (scene for scene in dry.SCENES if scene in self.scenes):
            for body, (own, dry_levels, *_) in plan.items():
                self.run_scene(body, scene, self.with_step(own.get(scene, dry_levels), RESTITUTION_DRY), jobs, results)
        for point in self.size.points if "section" in self.scenes else ():
            central = point[1] == CENTRAL_VELOCITY
            for body, (*_, wet_levels, beside) in plan.items():
                for level in self.with_step(wet_levels if central else beside, RESTITUTION_SECTION):
                    for seed in section.SEEDS[: self.seeds if central else min(self.seeds, self.size.seeds_beside)]:
                        jobs[body, point, level.name, seed] = self.wet(body, point, level, seed)
            results |= self.store.run_all(f"annulus {point[0]} degrees, {point[1]} m/s",
                                          [job for (_, at, _, _), job in jobs.items() if at == point])
        of = {key: results[job.key()] for key, job in jobs.items()}
        first = {}
        for (body, place, name, _), job in jobs.items():
            again = dataclasses.replace(job, name=f"{job.name}, for its time", inputs=job.inputs | {"again": "for its time"})
            first.setdefault((body, place, name), again)
        times = self.store.run_all("times", first.values()) if self.retime else {job.key(): self.store.result_of(job) for job in first.values()}
        self.again = {key: times[job.key()] for key, job in first.items() if times[job.key()] and runs.good(times[job.key()])}
        for body, (own, dry_levels, wet_levels, beside) in plan.items():
            for scene, (what, unit, *_) in dry.SCENES.items():
                if scene in self.scenes:
                    self.group(scene, body, what, unit, own.get(scene, dry_levels), of, scene, lambda r: r["value"], RESTITUTION_DRY, True)
            for point in self.size.points if "section" in self.scenes else ():
                for quantity, (what, unit, scale) in SECTION_RESULTS.items():
                    if quantity == "height" and point[0] == 0:  # a vertical hole has no low side
                        continue
                    title = f"annulus {point[0]} deg, {point[1]} m/s: {what}"
                    at = wet_levels if point[1] == CENTRAL_VELOCITY else beside
                    self.group(f"section {point[0]} {point[1]} {quantity}", body, title, unit, at, of, point,
                               lambda r, q=quantity, s=scale: r["mean"][q][0] * s, RESTITUTION_SECTION, JUDGED_BY[point[0]] == quantity,
                               lambda r, q=quantity, s=scale: r["mean"][q][1] * s,
                               lambda r, q=quantity, s=scale: [value * s for value in r["drift"][q]])
        return self.failures

    def run_scene(self, body, scene, chosen, jobs, results):
        """Runs the levels of a body in a dry scene: the pilot, then seeds until the errors are small enough, to the most allowed."""
        most = self.most
        wanted = dict.fromkeys((level.name for level in chosen), self.pilot)
        while chosen:
            for level in chosen:
                for seed in dry.SEEDS[: wanted[level.name]]:
                    if (body, scene, level.name, seed) not in jobs:
                        jobs[body, scene, level.name, seed] = self.dry(scene, level, seed)
            of = {key: job for key, job in jobs.items() if key[:2] == (body, scene)}
            found = self.store.run_all(f"{scene}, {body}", of.values())
            results |= found
            values = {name: {seed: result["value"] for (*_, at, seed), job in of.items() if at == name and runs.good(result := found[job.key()])}
                      for name in wanted}
            more = power.seeds_wanted(values, chosen[-1].name, most)
            if all(more[name] <= wanted[name] for name in wanted):
                return
            wanted = {name: max(n, more[name]) for name, n in wanted.items()}

    def with_step(self, chosen, restitution):
        """Those whose time step is known: all, unless only kept results are shown."""
        return [level for level in chosen if not math.isnan(self.critical[level.name, restitution]["critical"])]

    def dry(self, scene, level, seed):
        bodies = dry.SCENES[scene][4 if self.size.few_bodies else 3]
        step, _ = levels.dividing_step(dry.FRAME, self.critical[level.name, RESTITUTION_DRY]["critical"])
        return dry.dry_job(self.build, scene, level, seed, bodies, step)

    def wet(self, body, point, level, seed):
        inclination, velocity = point
        words = {"inclination": inclination, "velocity": velocity, "seconds": self.size.seconds[inclination], "length": self.size.length,
                 "cells": self.size.cells, "count": section.bodies_at(CONCENTRATION, self.size.length), "seed": seed,
                 "interval": section.steps_per_fluid_step(self.critical[level.name, RESTITUTION_SECTION]["critical"]),
                 **section.level_words(level)}
        if level.kind in ("friction", "eccentric"):
            words["sphericity"] = {"cube": 0.85, "disk": 0.79}[body]  # of the shape they stand for, Table 1 of the paper
        return section.section_job(self.build, f"annulus {inclination} deg {velocity} m/s {level.name} seed {seed}", words,
                                   spheres=level.spheres)

    def group(self, scene, body, title, unit, chosen, results, place, value_of, restitution, judged, error_in_time=None, drift_of=None):
        """`error_in_time` of a run's mean stands where there is one run alone; `drift_of` a run: (drift, error), in the unit of its value."""
        rows = []
        for level in chosen:
            by_seed = {seed: r for (b, p, name, seed), r in results.items() if (b, p, name) == (body, place, level.name)}
            every = list(by_seed.values())
            good = [r for r in every if runs.good(r)]
            failed = next((r["failed"] for r in every if "failed" in r), "")
            if failed:
                self.failures.append(f"{title.split(':')[0]}, {level.name}: {failed}")
            value, error = measures.mean_and_error([value_of(r) for r in good])
            if len(good) == 1 and error_in_time:
                error = error_in_time(good[0])
            timed = [self.again[body, place, level.name]] if (body, place, level.name) in self.again else good
            mean = lambda of: measures.mean_and_error([of(r) for r in timed])[0]
            critical = self.critical[level.name, restitution]
            period = dry.FRAME if place in dry.SCENES else section.FLUID_STEP
            drifts = [drift_of(r) for r in good] if drift_of and value else []
            rows.append(Row(level, value, error, len(good), mean(lambda r: r["cpu"]), mean(lambda r: r["wall"]),
                            {part: mean(lambda r, part=part: r["parts"][part]) for part in timing.PARTS},
                            levels.dividing_step(period, critical["critical"])[0] if self.with_step([level], restitution) else math.nan, critical, failed,
                            values={seed: value_of(r) for seed, r in by_seed.items() if runs.good(r)},
                            drift=tuple(v / abs(value) for v in measures.mean_of_measured(drifts)) if drifts else (math.nan, math.nan)))
        group = Group(scene, body, title, unit, rows, judged, place in dry.SCENES or place[1] == CENTRAL_VELOCITY)
        group.compare()
        self.groups.append(group)

    def write(self):
        """Table, CSV and charts; returns paragraphs of the page."""
        header = ["level", "result", "+-", "deviation %", "+-", "CPU s", "contact", "integr.", "neighb.", "fluid", "link", "other",
                  "step 1e-5 s"]
        lines, cells, page = [], [], ["## Levels of detail\n"]
        for group in self.groups:
            table = [[row.level.name, row.value, row.error, 100 * row.deviation, 100 * row.deviation_error, row.cpu,
                      *(row.parts[part] for part in timing.PARTS), row.step * 1e5] for row in group.rows]
            words = group.plain_words()
            if group.judged:
                lines += [f"{group.title} [{group.unit}], {group.body}: {min((row.runs for row in group.rows if row.runs), default=0)} seed(s) or more", "",
                          tables.text(header, table), words, ""]
                if failed := [row for row in group.rows if row.failed]:
                    page += [f"- {group.title} ({group.body}): {', '.join(f'{row.level.name} failed: {row.failed}' for row in failed)}\n"]
            cells += csv_cells(group)
        steps = []
        for (name, restitution), result in sorted(self.critical.items(), key=lambda item: item[0][1]):
            if name.startswith("S1 ") or result is UNKNOWN_STEP:  # a sphere's step is that of S1
                continue
            steps.append([name, restitution, result["critical"], str(result["contacts"]), levels.SAFETY * result["critical"]])
        step_header = ["level", "restitution", "critical step s", "contacts then", f"{levels.SAFETY} of it s"]
        lines += ["Time steps: the largest that divides a frame (dry) or a fluid step (annulus) and is at most "
                  f"{levels.SAFETY} of the smallest critical step", "that fix timestep/limit met while bodies fell and came to rest", "",
                  tables.text(step_header, steps)]
        text = "\n".join(lines)
        (self.output / "levels.txt").write_text(text)
        print(text)
        tables.write_csv(self.output / "levels.csv", CSV_COLUMNS, cells)
        tables.write_csv(self.output / "roundings.csv", CSV_COLUMNS, [cells_of(group, row) for group in self.groups for row in group.rows
                                                                      if row.level.kind == "rounding" or row is group.rows[-1]])
        first = []
        for body in self.bodies:
            shown = [group for group in self.groups if group.body == body and group.judged and group.candidates()]
            if shown:
                first.append(f"![error of the {body} over time](truth-{body}.svg)\n")
                charts.write(self.output / f"truth-{body}.svg", f"What accuracy costs: a {body} with true faces, and what stands for it",
                             [truth_chart.overall([group.rows for group in shown if group.central] or [group.rows for group in shown])], 1, (6.4, 4.2))
            central = [group for group in shown if group.central]
            panels = ([self.overall(central)] if len(central) > 1 else []) + [group.panel() for group in central]
            beside = [group.panel() for group in shown if not group.central]
            what = f"What a level of detail of the {body} costs and what it gets wrong"
            for name, chosen, more in ((f"levels-{body}", panels, ""), (f"levels-{body}-faster", beside, ", faster flow")):
                if chosen:
                    charts.write(self.output / f"{name}.svg", f"{what}{more}", chosen,
                                 COLUMNS.get(len(chosen), 3))
                    first += [f"![levels of the {body}{more}]({name}.svg)\n"]
            if len(central) > 1:
                first.append(self.overall_words(body, central))
            first += choice.page_of(shown) + choice.not_steady(shown)
        page[1:1] = first
        page += self.summary()
        for body in self.bodies:
            page += forecast.page_of(self.build, [group for group in self.groups if group.body == body and group.judged and group.central],
                                     self.output, f"forecast-{body}")
        page += self.times()
        page += ["Time steps: the largest that divides a frame (dry) or a fluid step (annulus) and is at most "
                 f"{levels.SAFETY} of the smallest critical step that `fix timestep/limit` met while bodies fell and came to rest:\n",
                 tables.markdown(step_header, steps)]
        return page

    def times(self):
        """Tables: where the time of a run went, in a dry scene and in the annulus with a bed."""
        page = []
        for group in self.groups:
            if group.judged and group.central and group.scene.startswith(PARTS_SHOWN) and any(row.runs for row in group.rows):
                page.append(f"Where the CPU seconds of a run go, {group.title.split(':')[0]} ({group.body}):\n")
                page.append(tables.markdown(["level", "CPU s", *timing.PARTS, "step 1e-5 s"],
                                            [[row.level.name, row.cpu, *(row.parts[part] for part in timing.PARTS), row.step * 1e5]
                                             for row in group.rows if row.runs]))
        return page

    def overall_points(self, groups):
        """{level: (median of the time as a share of the reference's, median deviation [%])} of levels that all scenes have, the front
        and its knee (or None)."""
        points = {}
        for level in {row.level for group in groups for row in group.rows[:-1]}:
            rows = [(row, group.rows[-1]) for group in groups for row in group.candidates() if row.level == level]
            if len(rows) == len(groups):
                points[level] = (statistics.median(row.cpu / reference.cpu for row, reference in rows),
                                 100 * statistics.median(row.unsure() for row, _ in rows))
        points = dict(sorted(points.items(), key=lambda item: item[1]))
        names = list(points)
        front = [names[i] for i in measures.pareto_front(list(points.values()))]
        bend = measures.knee([points[n] for n in front])
        return points, front, None if bend is None else front[bend]

    def overall_words(self, body, groups):
        points, _, bend = self.overall_points(groups)
        reference = groups[0].rows[-1].level.name
        told = "; ".join(f"{level.name} {error:.0f} % at {share:.2f} of the time" for level, (share, error) in points.items())
        return (f"**{body.capitalize()}.** Median over {len(groups)} scenes of the deviation from {reference}, or of its standard error where that is "
                f"larger: {told}." + (f" The knee of the Pareto front is {bend.name}." if bend else "") + "\n")

    def overall(self, groups):
        """The one picture: cost and deviation over all scenes."""
        points, front, bend = self.overall_points(groups)
        series = [charts.Series("", [charts.Point(*points[level]) for level in front], "#000000", True, False, True)]
        series += [charts.Series("", [charts.Point(*at, label=short(level.name), ring=level == bend) for level, at in points.items()
                                      if level.kind == kind], charts.COLOURS[COLOUR[kind]]) for kind in COLOUR]
        reference = groups[0].rows[-1].level.name
        return charts.Panel(f"median of these {len(groups)} scenes (dashed: front; ring: knee)", f"CPU time over that of {reference}",
                            f"deviation from {reference} [%]", series, True, True, legend=False)

    def cells(self, header, groups):
        """Rows of a table: a scene each; deviation of each level, its error and time."""
        rows = []
        for group in groups:
            row = [group.title]
            for name in header:
                of = next((r for r in group.rows if r.level.name == name), None)
                if of is None or (not of.runs and not of.failed):
                    row.append("not run")
                elif not of.runs:
                    row.append("failed")
                elif of is group.rows[-1]:
                    row.append(f"{tables.number(of.value)} +- {tables.number(of.error, 2)} {group.unit}; {tables.number(of.cpu, 2)} s ({of.runs})")
                elif math.isnan(of.deviation):
                    row.append(f"{tables.number(of.value)} {group.unit}; {tables.number(of.cpu, 2)} s ({of.runs})")
                else:
                    row.append(f"{100 * of.deviation:+.0f} +- {100 * of.deviation_error:.0f} %; {tables.number(of.cpu, 2)} s ({of.runs})")
            rows.append(row)
        return rows

    def summary(self):
        """Tables of all cells of the matrix, run or not."""
        page = []
        for body in self.bodies:
            judged = [group for group in self.groups if group.body == body and group.judged]
            if judged:
                page.append(f"Deviation from the {body} with true faces with its standard error (over the seeds; of one run: in time), CPU seconds of a run, "
                            "and the number of runs (seeds):\n")
            dry_ones = [group for group in judged if group.scene in dry.SCENES]
            for groups in (dry_ones, [group for group in judged if group not in dry_ones]):
                names = list(dict.fromkeys(row.level.name for group in groups for row in group.rows))
                table = [["", *names], *self.cells(names, groups)]
                if groups is dry_ones:  # fewer scenes than levels
                    table = [list(column) for column in zip(*table)]
                if groups:
                    page.append(tables.markdown(table[0], table[1:]))
        return page
