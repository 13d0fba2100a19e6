# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Friction of a sphere that fits the body with true faces in one cheap scene, and what it then gets wrong in others."""
import math
import pathlib

from .. import calibration, charts, dry, level_study, levels, measures, options, runs, shape_levels, tables, user_scene
from ..programs import Failure

SCENES = (*dry.SCENES, "mine")
RANGES = {"mu_shape": (0.0, 0.9), "mu_s": (0.05, 1.5), "rockingDamping": (0.0, 15.0)}
START = 0.3  # part of the range where the third point is set: most of the change is at small coefficients
FINEST = 0.01  # an interval below is not divided
MOST_POINTS = 8  # of one search
WORDS = {"mu_shape": "rolling friction mu_shape", "mu_s": "sliding friction mu_s", "rockingDamping": "damping (rockingDamping) of rolling_friction eccentric"}


class Place:
    """A scene in which levels of detail run with some seeds. script: user_scene.Scene, or None for a dry scene."""

    def __init__(self, words, name):
        self.words, self.name, self.script = words, name, words.script if name == "mine" else None
        self.what = f"{self.script.script.name}: {self.script.measure}" if self.script else dry.SCENES[name][0]
        self.unit = "" if self.script else dry.SCENES[name][1]
        self.values = {}  # of levels: {seed: value}
        self.failures = []

    def job(self, level, seed):
        if self.script:
            return self.script.job(self.words.build, level, seed)
        step, _ = levels.dividing_step(dry.FRAME, self.words.steps[level.shape if level.has_shape() else "sphere"])
        return dry.dry_job(self.words.build, self.name, level, seed, dry.SCENES[self.name][4], step)

    def run(self, chosen):
        """Runs levels that are not there yet; False where one has no result."""
        jobs = {(level, seed): self.job(level, seed) for level in chosen for seed in dry.SEEDS[: self.words.seeds]}
        found = self.words.store.run_all(self.name, jobs.values())
        for (level, seed), job in jobs.items():
            result = found[job.key()]
            if runs.good(result):
                self.values.setdefault(level, {})[seed] = result["value"]
            elif "failed" in result:
                self.failures.append(f"{job.name}: {result['failed']}")
        return all(len(self.values.get(level, {})) > 1 for level in chosen)

    def point(self, level):
        """(mean, standard error) of a level."""
        return measures.mean_and_error(list(self.values[level].values()))

    def miss(self, level, truth):
        """Deviation from the true body and its standard error, by pairs of seeds."""
        of = self.values[truth]
        return measures.paired_deviation([(value, of[seed]) for seed, value in self.values[level].items() if seed in of])


def sphere(words, coefficient):
    """The sphere with a coefficient; the other ones are those of the options. An eccentric sphere has the shape of the true body."""
    if words.vary == "rockingDamping":
        return levels.Level(f"S1 rockingDamping {coefficient:.4g}", "eccentric", words.ladder.levels[-1].shape, damping=round(coefficient, 4))
    mu = round(coefficient, 4) if words.vary == "mu_shape" else words.mu_shape
    return levels.Level(f"S1 {words.vary} {coefficient:.4g}", "friction", mu=mu, slide=round(coefficient, 4) if words.vary == "mu_s" else None)


def search(words, place):
    """(calibration.Root, points) of a place, or None where runs failed or are missing."""
    low, high = words.range
    truth = words.ladder.levels[-1]
    coefficients = [low, low + START * (high - low), high]
    if not place.run([truth, *(sphere(words, c) for c in coefficients)]):
        return None
    wanted = place.point(truth)
    points = [(c, *place.point(sphere(words, c))) for c in coefficients]
    while len(points) < MOST_POINTS and (at := calibration.next_coefficient(points, *wanted, FINEST)) is not None:
        at = round(at, 4)
        if not place.run([sphere(words, at)]):
            return None
        points.append((at, *place.point(sphere(words, at))))
    return calibration.root(points, *wanted), sorted(points)


def panel(words, place, found, points):
    """Result over the coefficient, the true body as a line with its noise, the root as a ring."""
    value, error = place.point(words.ladder.levels[-1])
    ends = [points[0][0], points[-1][0]]
    line = lambda y, dashed: charts.Series("" if dashed else f"{words.ladder.levels[-1].name} (dashed: its error)", [charts.Point(x, y) for x in ends],
                                           charts.COLOURS[2], True, False, dashed)
    series = [charts.Series("spheres", [charts.Point(*point) for point in points], charts.COLOURS[4], True), line(value, False)]
    series += [line(value + side * error, True) for side in (1, -1)]
    if not found.side:
        series.append(charts.Series(f"best: {found.words()}", [charts.Point(found.value, value, ring=True)], charts.COLOURS[1]))
    return charts.Panel(place.what, WORDS[words.vary], place.unit or "result", series)


def parse():
    parser = options.Parser("calibrate-rolling", f"{__doc__} docs/calibrate-rolling.md describes it.", sizes=())
    parser.add_argument("--shape", default="cube", metavar="WORDS", help="the grain: cube, disk, 'stl FILE', or words of a shape (default: cube)")
    parser.add_argument("--rounding", type=float, help="of the corners of the true body (default: docs/accuracy-cost.md)")
    parser.add_argument("--scene", action=options.Words, choices=SCENES, default=["drum"], help="scenes in which the sphere is fitted (default: drum); "
                        "several make a map; mine: the script of --mine")
    parser.add_argument("--others", action=options.Words, choices=tuple(dry.SCENES), help="scenes in which it is judged (default: all of ours)")
    parser.add_argument("--mine", type=pathlib.Path, metavar="FILE", help="a LIGGGHTS script of your own (docs/howto-own-accuracy.md), judged, too")
    parser.add_argument("--measure", metavar="COLUMN", help="of --mine: f_x, v_x or another column of its thermo output")
    parser.add_argument("--share", type=float, default=0.5, help="of --mine: part of the rows of its last run whose mean is the result (default: 0.5)")
    parser.add_argument("--vary", choices=tuple(RANGES), default="mu_shape", help="what is fitted: rolling or sliding friction, or the damping "
                        "of a sphere with rolling_friction eccentric (default: mu_shape)")
    parser.add_argument("--mu-shape", type=float, default=0.0, help="rolling friction while mu_s is fitted (default: 0)")
    parser.add_argument("--range", nargs=2, type=float, metavar=("LOW", "HIGH"),
                        help="of the coefficient (default: 0 0.9; of mu_s 0.05 1.5; of rockingDamping 0 15)")
    parser.add_argument("--seeds", type=options.at_least_one, default=4, help=f"runs of each point, 2 to {len(dry.SEEDS)} (default: 4)")

    def check(words):
        if not 2 <= words.seeds <= len(dry.SEEDS):
            parser.error(f"--seeds is {words.seeds}: give 2 to {len(dry.SEEDS)}")
        words.range = words.range or RANGES[words.vary]
        if not 0 <= words.range[0] < words.range[1]:
            parser.error(f"--range is {words.range[0]:g} {words.range[1]:g}: give two rising numbers from 0 on")
        if not words.mu_shape >= 0 or words.mu_shape and words.vary == "mu_shape":
            parser.error(f"--mu-shape is {words.mu_shape:g}: give a number from 0 on, with --vary mu_s alone")
        if words.rounding is not None and not levels.MIN_ROUNDING <= words.rounding <= levels.MAX_ROUNDING:
            parser.error(f"--rounding is {words.rounding}: give {levels.MIN_ROUNDING} to {levels.MAX_ROUNDING:g}")
        if not 0 <= words.share <= 1:
            parser.error(f"--share is {words.share}: give 0 (the last row) to 1 (all rows)")
        if (words.mine is None) != (words.measure is None):
            parser.error("--mine FILE and --measure COLUMN belong together; expected both")
        if "mine" in words.scene and words.mine is None:
            parser.error("--scene mine needs --mine FILE and --measure COLUMN")
        if words.mine and words.vary == "rockingDamping":
            parser.error("--vary rockingDamping is there for our scenes alone; expected --mine left out")
        words.script = user_scene.read(words.mine.resolve(), words.measure, words.share) if words.mine else None
        needed = {"rolling", "mu_shape"} | ({"mu_s"} if words.vary == "mu_s" else set())
        if words.script and (left := sorted(needed - words.script.declared)):
            parser.error(f"--mine {words.mine}: no line 'variable {left[0]} index ...'; expected the index variables {', '.join(sorted(needed))}")
        words.ladder = shape_levels.read(words.build, words.shape, ["sphere", *(["hull"] if words.shape.split()[:1] == ["stl"] else [])], words.rounding)

    return parser.settle(("eccentra-dem", "clusterShape"), check)


def steps_of(words):
    """Critical steps of the sphere and of the true body in dry scenes."""
    jobs = {"sphere" if not level.has_shape() else level.shape: levels.step_job(words.build, level, level_study.RESTITUTION_DRY)
            for level in words.ladder.levels}
    return {name: result["critical"] for name, result in runs.needed(words.store.run_all("time steps", jobs.values()), jobs).items()}


def main():
    words = parse()
    places = {name: Place(words, name) for name in dict.fromkeys([*words.scene, *(words.others or dry.SCENES), *(["mine"] if words.script else [])])}
    words.steps = steps_of(words) if set(places) - {"mine"} else {}
    truth = words.ladder.levels[-1]
    found = {name: result for name in words.scene if (result := search(words, places[name])) is not None}
    if words.plan:
        return 0
    if not found and not any(place.failures for place in places.values()):
        raise Failure("no scene has all of its runs: leave out --show")
    rows, cells, page = [], [], [f"## {WORDS[words.vary][0].upper()}{WORDS[words.vary][1:]} of a sphere that stands for {shape_levels.name_of(truth.shape)}\n"]
    for name, (best, points) in found.items():
        row = [places[name].what, best.words()]
        for other, place in places.items():
            miss = (math.nan, math.nan)
            if not math.isnan(best.value) and place.run([truth, sphere(words, best.value)]):
                miss = place.miss(sphere(words, best.value), truth)
            row.append("-" if math.isnan(miss[0]) else f"{100 * miss[0]:+.0f} +- {100 * miss[1]:.0f} %")
            cells.append([name, best.value, best.error, best.side, other, *miss])
        rows.append(row)
    header = ["fitted in", words.vary, *(place.what for place in places.values())]
    title = f"Best coefficient by scene, and how far the sphere with it is off {truth.name} in each scene"
    print(f"{title}\n\n{tables.text(header, rows)}")
    page += [f"{title}\n", tables.markdown(header, rows), *summary(words, found)]
    tables.write_csv(words.out / "calibration.csv", ["fitted_in", words.vary, "standard_error", "side", "judged_in", "deviation", "deviation_error"], cells)
    tables.write_csv(words.out / "points.csv", ["scene", words.vary, "mean", "standard_error"],
                     [[name, *point] for name, (_, points) in found.items() for point in points])
    if found:
        panels = [panel(words, places[name], *result) for name, result in found.items()]
        known = {name: best for name, (best, _) in found.items() if not best.side}
        if len(known) > 1:
            panels.insert(0, charts.Bars(f"best {words.vary} by scene", WORDS[words.vary], list(known), {"": [(b.value, b.error) for b in known.values()]}))
        charts.write(words.out / "calibration.svg", f"Spheres fitted to {shape_levels.name_of(truth.shape)}", panels, 2)
        page.insert(1, "![fit](calibration.svg)\n")
    return tables.finish(words, page, [sentence for place in places.values() for sentence in place.failures], f"{words.seeds} seeds")


def summary(words, found):
    """Whether one coefficient fits all scenes, in words."""
    known = {name: best for name, (best, _) in found.items() if not best.side}
    text = [f"{name}: {words.vary} is {best.words()}." for name, (best, _) in found.items() if best.side]
    if len(known) > 1:
        least, most = min(known, key=lambda n: known[n].value), max(known, key=lambda n: known[n].value)
        apart = known[most].value - known[least].value
        error = math.hypot(known[most].error, known[least].error)
        text.append(f"The best coefficients lie from {known[least].value:.2f} ({least}) to {known[most].value:.2f} ({most}): "
                    + ("no single coefficient fits these scenes." if apart > calibration.SURE * error else "their errors do not tell them apart."))
    return [f"{' '.join(text)}\n"] if text else []
