# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Clusters beside rounded bodies: what their bulk does over the radius of their corners."""
import dataclasses
import math
import pathlib
import tempfile

from .. import annulus_scene, charts, dry, level_study, levels, measures, options, programs, runs, section, tables

ROUNDINGS = {"cube": (0.4, 0.3, 0.2, 0.15, 0.1), "disk": (0.6, 0.3, 0.15)}  # of smooth bodies beside those of the clusters
CLUSTERS = {"cube": (8, 27, 64, 125), "disk": (7, 19, 48, 80)}
STEP = 2.5e-5  # of dry scenes [s]; 0.2 of the smallest critical step of these bodies
COLOURS = {"cluster": charts.COLOURS[1], "smooth": charts.COLOURS[0]}
AXES = {"cube": "radius of the corners over half the edge", "disk": "radius of the rim over that of the disk"}
HEAPS = {"heap": 100, "heap-220": 220, "heap-1000": 1000}  # bodies


@dataclasses.dataclass(frozen=True)
class DryScene:
    """name: of SCENES; form: of dry.SCENES."""
    name: str
    form: str
    bodies: int

    def title(self):
        return f"{dry.SCENES[self.form][0]}, {self.bodies} bodies"

    def unit(self):
        return dry.SCENES[self.form][1]

    def job(self, build, level, seed, critical):
        return dry.dry_job(build, self.form, level, seed, self.bodies, STEP)

    def value(self, result):
        return result["value"]


SCENES = {name: DryScene(name, "heap", bodies) for name, bodies in HEAPS.items()}
SCENES |= {"drum": DryScene("drum", "drum", dry.SCENES["drum"][4]), "hopper": DryScene("hopper", "hopper", 140)}  # that of the case
SCENES |= {name: annulus_scene.AnnulusScene(name, 1.0) for name in ("annulus-40", "annulus-80")}  # of bodies that have their shape: no sphericity
QUICK = ("heap",)


def extents(path):
    """Outer half extents of a list of spheres and the radius of the smallest."""
    spheres = [tuple(map(float, line.split())) for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return [max(abs(s[k]) + s[3] for s in spheres) for k in range(3)], min(s[3] for s in spheres)


def cluster_shape(body, spheres, fine):
    return f"file {fine}" if body == "disk" and spheres == 80 else f"{body} {spheres}"


def smooth_twin(build, body, shape):
    """Words of the smooth body with the outer form and the corners of a cluster, and its place on AXES; the rim of a disk is round."""
    with tempfile.TemporaryDirectory() as folder:  # another call may write its own now
        clump = pathlib.Path(folder) / "twin.clump"
        levels.measured(build, shape, "--diameter", "6.35e-3", "-o", str(clump))
        half, radius = extents(clump)
    if body == "cube":
        rounding = radius / min(half)
        return f"smooth cube rounding {rounding:.3f}", rounding
    aspect = min(half) / max(half)
    return f"smooth disk aspect {aspect:.3f} rounding 1", aspect


def pairs(build, body, folder):
    """(place on AXES, levels.Level) of the clusters of a body, their smooth twins and further smooth bodies."""
    fine = folder / "disk80.clump"
    levels.fine_disk(fine)
    found = []
    for spheres in CLUSTERS[body]:
        shape = cluster_shape(body, spheres, fine)
        words, rounding = smooth_twin(build, body, shape)
        found.append((rounding, levels.Level(f"{body[0].upper()}{spheres}", "cluster", shape, spheres=spheres)))
        found.append((rounding, levels.Level(f"{body} {rounding:.3f}", "cluster", words, spheres=30)))
    form, of_whole = ("cube", 1.0) if body == "cube" else (f"disk aspect {levels.DISK_ASPECT:.4f}", levels.DISK_ASPECT)
    for rounding in ROUNDINGS[body]:
        found.append((rounding * of_whole, levels.Level(f"{body} {rounding * of_whole:.3f}", "cluster", f"smooth {form} rounding {rounding:g}", spheres=30)))
    return found


def is_coupled(name):
    return name in annulus_scene.NAMES


def seeds_of(name):
    return section.SEEDS if is_coupled(name) else dry.SEEDS


def critical_steps(words, shapes):
    """{(body, name of a level): critical step [s], or not a number where it is not known yet}."""
    steps = {(body, level.name): levels.step_job(words.build, level, level_study.RESTITUTION_SECTION) for body in shapes for _, level in shapes[body]}
    found = words.store.run_all("time steps", steps.values())
    for key, job in steps.items():
        if "failed" in found[job.key()]:
            raise programs.Failure(f"the time step of {key[1]}: {found[job.key()]['failed']}")
    return {key: found[job.key()].get("critical", math.nan) for key, job in steps.items()}


def kind_of(level):
    return "smooth" if level.shape.startswith("smooth") else "cluster"


def main():
    parser = options.Parser("rounding", __doc__ + " docs/rounded-bodies.md says what comes out.",
                            quick="heaps of cubes, three seeds, where --scenes, --bodies or --seeds do not say more")
    parser.add_argument("--scenes", action=options.Words, choices=tuple(SCENES), help="default: all")
    parser.add_argument("--bodies", action=options.Words, choices=tuple(CLUSTERS), help="what the shapes stand for (default: both)")
    parser.add_argument("--seeds", type=options.at_least_one,
                        help=f"runs of each shape in each scene, up to {len(dry.SEEDS)}, in the annulus {len(section.SEEDS)} (default: 6)")

    chosen_of = lambda words: words.scenes or (QUICK if words.quick else tuple(SCENES))

    def check(words):
        words.scenes = chosen_of(words)
        words.bodies = words.bodies or (("cube",) if words.quick else tuple(CLUSTERS))
        words.seeds = words.seeds or (3 if words.quick else 6)
        if words.seeds > len(dry.SEEDS):
            parser.error(f"--seeds is {words.seeds}: give 1 to {len(dry.SEEDS)}")

    coupled = ("annulusFoam", "annulusMesh", "annulusReport")
    words = parser.settle(lambda words: ("eccentra-dem", "clusterShape") + (coupled if any(map(is_coupled, chosen_of(words))) else ()), check)
    shapes = {body: pairs(words.build, body, words.out) for body in words.bodies}
    critical = critical_steps(words, shapes) if any(map(is_coupled, words.scenes)) else {}
    jobs = {(scene, body, level.name, seed): SCENES[scene].job(words.build, level, seed, critical.get((body, level.name)))
            for scene in words.scenes for body in words.bodies for _, level in shapes[body] for seed in seeds_of(scene)[: words.seeds]
            if not is_coupled(scene) or not math.isnan(critical[body, level.name])}
    results = {}
    for scene in words.scenes:
        results |= words.store.run_all(scene, [job for key, job in jobs.items() if key[0] == scene])
    if words.plan:
        return 0
    panels, page, failed = [], ["# Clusters and rounded bodies\n"], []
    for name in words.scenes:
        scene = SCENES[name]
        for body in words.bodies:
            rows, series = [], {kind: charts.Series(f"{kind} {body}s", [], COLOURS[kind]) for kind in COLOURS}
            for place, level in shapes[body]:
                every = [results[jobs[key].key()] for key in ((name, body, level.name, seed) for seed in seeds_of(name)) if key in jobs]
                failed += [f"{name}, {level.name}: {r['failed']}" for r in every if "failed" in r]
                good = [r for r in every if runs.good(r)]
                value, error = measures.mean_and_error([scene.value(r) for r in good])
                cpu, _ = measures.mean_and_error([r["cpu"] for r in good])
                rows.append([level.name, kind_of(level), place, value, error, len(good), cpu])
                if not math.isnan(value):
                    series[kind_of(level)].points.append(charts.Point(place, value, error, level.name if kind_of(level) == "cluster" else ""))
            rows.sort(key=lambda row: (-row[2], row[1]))
            header = ["shape", "kind", "rounding", scene.unit(), "+-", "runs", "CPU s"]
            page.append(tables.publish(words, f"{name}-{body}", f"{scene.title()} ({body})", header, rows))
            if any(s.points for s in series.values()):
                panels.append(charts.Panel(f"{scene.title()} ({body})", AXES[body], scene.unit(), list(series.values())))
    if panels:
        charts.write(words.out / "rounding.svg", "Clusters and smooth bodies of the same corners", panels, 2)
        page.insert(1, "![bulk over the radius of corners](rounding.svg)\n")
    return tables.finish(words, page, failed, f"steps of {STEP:g} s, {words.seeds} seeds")
