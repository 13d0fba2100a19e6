# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which level of detail a user's shape needs in a user's scene: a paragraph, a chart and a table."""
import math

from . import annulus_scene, charts, dry, forecast, level_study, levels, measures, power, runs, section, shape_levels, tables, truth_chart
from .programs import Failure


class UserStudy:
    """ladder: shape_levels.Ladder; scene: user_scene.Scene, or None for our scenes by name (dry.SCENES, annulus_scene.NAMES); seeds: (pilot,
    most)."""

    def __init__(self, store, build, ladder, scene, names, seeds, percent, few_bodies=True):
        self.store, self.build, self.ladder, self.scene = store, build, ladder, scene
        self.names, self.seeds, self.percent, self.few_bodies = names, seeds, percent, few_bodies
        self.groups, self.failures, self.steps = [], [], {}

    def run(self):
        """Runs what is not there yet; what failed, as sentences."""
        if self.scene is None:
            restitutions = {self.restitution(name) for name in self.names}
            jobs = {(level.name, e): levels.step_job(self.build, level, e) for level in self.ladder.levels for e in restitutions}
            found = self.store.run_all("time steps", jobs.values())
            for key, job in jobs.items():
                if "failed" in found[job.key()]:
                    raise Failure(f"the time step of {key[0]}: {found[job.key()]['failed']}")
                self.steps[key] = found[job.key()].get("critical", math.nan)
        for name in self.names:
            self.run_scene(name)
        return self.failures

    @staticmethod
    def restitution(name):
        return level_study.RESTITUTION_SECTION if name in annulus_scene.NAMES else level_study.RESTITUTION_DRY

    def annulus(self, name):
        """The scene of that name, or None where it is none of the annulus."""
        reference = self.ladder.levels[-1].name
        return annulus_scene.AnnulusScene(name, self.ladder.facts[reference]["sphericity"]) if name in annulus_scene.NAMES else None

    def job(self, name, level, seed):
        if self.scene:
            return self.scene.job(self.build, level, seed)
        critical = self.steps[level.name, self.restitution(name)]
        if name in annulus_scene.NAMES:
            return self.annulus(name).job(self.build, level, seed, critical)
        step, _ = levels.dividing_step(dry.FRAME, critical)
        return dry.dry_job(self.build, name, level, seed, dry.SCENES[name][4 if self.few_bodies else 3], step)

    def run_scene(self, name):
        of_scene = section.SEEDS if name in annulus_scene.NAMES else dry.SEEDS
        pilot, most = (min(number, len(of_scene)) for number in self.seeds)
        value_of = self.annulus(name).value if name in annulus_scene.NAMES else lambda result: result["value"]
        wanted, reference = {level.name: pilot for level in self.ladder.levels}, self.ladder.levels[-1].name
        # With --show, those of which a time step is known.
        known = [level for level in self.ladder.levels if self.scene or not math.isnan(self.steps[level.name, self.restitution(name)])]
        while True:
            jobs = {(level.name, seed): self.job(name, level, seed) for level in known for seed in of_scene[: wanted[level.name]]}
            found = self.store.run_all(name, jobs.values())
            of = {level.name: {seed: found[job.key()] for (at, seed), job in jobs.items() if at == level.name} for level in self.ladder.levels}
            values = {at: {seed: value_of(r) for seed, r in results.items() if runs.good(r)} for at, results in of.items()}
            more = power.seeds_wanted(values, reference, most)
            if all(more[at] <= wanted[at] for at in wanted):
                break
            wanted = {at: max(number, more[at]) for at, number in wanted.items()}
        self.groups.append(self.group(name, of, values))

    def group(self, name, of, values):
        rows = []
        for level in self.ladder.levels:
            failed = next((r["failed"] for r in of[level.name].values() if "failed" in r), "")
            if failed:
                self.failures.append(f"{name}, {level.name}: {failed}")
            good = [r for r in of[level.name].values() if runs.good(r)]
            value, error = measures.mean_and_error(list(values[level.name].values()))
            mean = lambda key: measures.mean_and_error([r[key] for r in good])[0]
            rows.append(level_study.Row(level, value, error, len(good), mean("cpu"), mean("wall"), {}, math.nan, {}, failed, values=values[level.name]))
        title, unit = (f"{self.scene.script.name}: {self.scene.measure}", "") if self.scene else dry.SCENES[name][:2] if name in dry.SCENES \
            else (self.annulus(name).title(), self.annulus(name).unit())
        group = level_study.Group(name, shape_levels.name_of(self.ladder.levels[-1].shape), title, unit, rows, True, percent=self.percent)
        group.compare()
        return group

    def write(self, output):
        """Tables, CSV and chart; the page."""
        page, cells = ["## Which level of detail\n"], []
        header = ["level", "result", "+-", "deviation %", "+-", "CPU s", "runs"]
        shown = [group for group in self.groups if group.candidates()]
        if shown:
            panels = ([truth_chart.overall([group.rows for group in shown])] if len(shown) > 1 else []) + [group.panel() for group in shown]
            charts.write(output / "answer.svg", f"What accuracy costs: {shown[0].body}", panels, min(2, len(panels)), (6.4, 4.2))
            page.append("![error over time](answer.svg)\n")
        for group in self.groups:
            words = group.plain_words()
            table = [[row.level.name, row.value, row.error, 100 * row.deviation, 100 * row.deviation_error, row.cpu, row.runs] for row in group.rows]
            title = f"{group.title}{f' [{group.unit}]' if group.unit else ''}"
            page += [f"{words[0].upper()}{words[1:]}\n", tables.markdown([title, *header[1:]], table)]
            print(f"{title}\n\n{tables.text(header, table)}\n{words}\n")
            cells += level_study.csv_cells(group)
        remarks = [*self.ladder.remarks, *([] if self.scene is None else [
            "All levels ran with the time step of the script; a level that bears a longer one costs less than shown. The sphere ran as a cluster "
            "of one sphere, which takes about 1.5 times as long as one of LIGGGHTS's own."])]
        if remarks:
            page.append(f"What is not known: {' '.join(remarks)}\n")
            print(f"What is not known: {' '.join(remarks)}\n")
        page.append("Another scene may need another level: these are results of these scenes alone.\n")
        page[-1:-1] = forecast.page_of(self.build, self.groups, output, "forecast")
        tables.write_csv(output / "levels.csv", level_study.CSV_COLUMNS, cells)
        return page
