# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Clusters beside rounded bodies: what their bulk does over the radius of their corners."""
import math
import pathlib
import tempfile

from .. import charts, dry, levels, measures, options, runs, tables

ROUNDINGS = {"cube": (0.4, 0.3, 0.2, 0.15, 0.1), "disk": ()}  # of smooth bodies beside those of the clusters
CLUSTERS = {"cube": (8, 27, 64, 125), "disk": (7, 19, 48, 80)}
STEP = 2.5e-5  # [s]; 0.2 of the smallest critical step of these bodies
COLOURS = {"cluster": charts.COLOURS[1], "smooth": charts.COLOURS[0]}


def extents(path):
    """Outer half extents of a list of spheres and the radius of the smallest."""
    spheres = [tuple(map(float, line.split())) for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return [max(abs(s[k]) + s[3] for s in spheres) for k in range(3)], min(s[3] for s in spheres)


def cluster_shape(body, spheres, fine):
    return f"file {fine}" if body == "disk" and spheres == 80 else f"{body} {spheres}"


def smooth_twin(build, body, shape):
    """Words of the smooth body with the outer form and the corners of a cluster, and its rounding: radius over half the smallest extent of
    a cube; of a disk, thickness over diameter, since its rim is round."""
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
    """(rounding, levels.Level) of the clusters of a body, their smooth twins and further smooth bodies."""
    fine = folder / "disk80.clump"
    levels.fine_disk(fine)
    found = []
    for spheres in CLUSTERS[body]:
        shape = cluster_shape(body, spheres, fine)
        words, rounding = smooth_twin(build, body, shape)
        found.append((rounding, levels.Level(f"{body[0].upper()}{spheres}", "cluster", shape, spheres=spheres)))
        found.append((rounding, levels.Level(f"{body} {rounding:.3f}", "cluster", words, spheres=30)))
    for rounding in ROUNDINGS[body]:
        found.append((rounding, levels.Level(f"{body} {rounding:.3f}", "cluster", f"smooth {body} rounding {rounding:g}", spheres=30)))
    return found


def kind_of(level):
    return "smooth" if level.shape.startswith("smooth") else "cluster"


def main():
    parser = options.Parser("rounding", __doc__ + " docs/rounded-bodies.md says what comes out.",
                            quick="heaps of cubes, three seeds, where --scenes, --bodies or --seeds do not say more")
    parser.add_argument("--scenes", action=options.Words, choices=tuple(dry.SCENES), help="default: all")
    parser.add_argument("--bodies", action=options.Words, choices=tuple(CLUSTERS), help="what the shapes stand for (default: both)")
    parser.add_argument("--seeds", type=options.at_least_one, help=f"runs of each shape in each scene, up to {len(dry.SEEDS)} (default: 6)")

    def check(words):
        words.scenes = words.scenes or (("heap",) if words.quick else tuple(dry.SCENES))
        words.bodies = words.bodies or (("cube",) if words.quick else tuple(CLUSTERS))
        words.seeds = words.seeds or (3 if words.quick else 6)
        if words.seeds > len(dry.SEEDS):
            parser.error(f"--seeds is {words.seeds}: give 1 to {len(dry.SEEDS)}")

    words = parser.settle(("eccentra-dem", "clusterShape"), check)
    shapes = {body: pairs(words.build, body, words.out) for body in words.bodies}
    jobs = {(scene, body, level.name, seed): dry.dry_job(words.build, scene, level, seed, dry.SCENES[scene][4], STEP)
            for scene in words.scenes for body in words.bodies for _, level in shapes[body] for seed in dry.SEEDS[: words.seeds]}
    results = {}
    for scene in words.scenes:
        results |= words.store.run_all(scene, [job for key, job in jobs.items() if key[0] == scene])
    if words.plan:
        return 0
    panels, page, failed = [], ["# Clusters and rounded bodies\n"], []
    for scene in words.scenes:
        what, unit, *_ = dry.SCENES[scene]
        for body in words.bodies:
            rows, series = [], {kind: charts.Series(f"{kind} {body}s", [], COLOURS[kind]) for kind in COLOURS}
            for rounding, level in shapes[body]:
                every = [results[jobs[scene, body, level.name, seed].key()] for seed in dry.SEEDS[: words.seeds]]
                failed += [f"{scene}, {level.name}: {r['failed']}" for r in every if "failed" in r]
                good = [r for r in every if runs.good(r)]
                value, error = measures.mean_and_error([r["value"] for r in good])
                cpu, _ = measures.mean_and_error([r["cpu"] for r in good])
                rows.append([level.name, kind_of(level), rounding, value, error, len(good), cpu])
                if not math.isnan(value):
                    series[kind_of(level)].points.append(charts.Point(rounding, value, error, level.name))
            rows.sort(key=lambda row: (-row[2], row[1]))
            header = ["shape", "kind", "rounding", unit, "+-", "runs", "CPU s"]
            page.append(tables.publish(words, f"{scene}-{body}", f"{what}, {dry.SCENES[scene][4]} bodies ({body})", header, rows))
            if any(s.points for s in series.values()):
                of = "radius of the corners over half the edge" if body == "cube" else "thickness over diameter, rim round"
                panels.append(charts.Panel(f"{what} ({body})", of, unit, list(series.values())))
    if panels:
        charts.write(words.out / "rounding.svg", "Clusters and smooth bodies of the same corners", panels, 2)
        page.insert(1, "![bulk over the radius of corners](rounding.svg)\n")
    return tables.finish(words, page, failed, f"steps of {STEP:g} s, {words.seeds} seeds")
