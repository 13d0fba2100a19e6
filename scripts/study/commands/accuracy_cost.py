# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What accuracy costs in time: levels of detail of the bodies, and the methods of the coupling, each error beside its time."""
import dataclasses

from .. import dry, level_study, levels, method_study, options, section, tables

ALL_POINTS = tuple((inclination, velocity) for inclination in (0, 40, 80) for velocity in (0.58, 0.72, 1.165))
SIZES = {
    # quick: cubes, two points; standard: within the hour on 2 idle cores; full: a cluster, or a night
    "quick": level_study.Size(
        bodies=("cube",), few_bodies=True, seeds=3, most_seeds=3, seeds_beside=3, length=0.15, cells="8 32 10", seconds={0: 1.0, 40: 2.0, 80: 2.5},
        points=((0, 0.58), (80, 0.58)), section_levels=("S1", "mean", "eccentric", "C8", "C64", "C216"),
        methods=method_study.Size(inclinations=(80,), seeds=1, seconds=1.0, finest=False)),
    "standard": level_study.Size(
        bodies=("cube", "disk"), few_bodies=True, seeds=4, most_seeds=12, seeds_beside=1, length=0.15, cells="8 32 10", seconds={0: 1.0, 40: 2.0, 80: 2.5},
        points=ALL_POINTS, section_levels=("S1", "mean", "eccentric", "C8", "C64", "C216", "D7", "D48", "D80"),
        methods=method_study.Size(inclinations=(0, 80), seeds=1, seconds=2.0, finest=False)),
    "full": level_study.Size(
        bodies=("cube", "disk"), few_bodies=False, seeds=10, most_seeds=20, seeds_beside=10, length=0.6, cells="8 32 40", seconds={0: 5, 40: 5, 80: 6},
        points=ALL_POINTS, section_levels=(), methods=method_study.Size(inclinations=(0, 80), seeds=5, seconds=4.0, finest=True)),
}
SCENES = (*dry.SCENES, "section")


def main():
    parser = options.Parser("accuracy-cost", __doc__ + " docs/accuracy-cost.md says what comes out.", sizes=("quick", "full"))
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true", help="cubes, two points of the annulus: within 10 minutes on 2 idle cores")
    size.add_argument("--full", action="store_true", help="ten seeds, 0.6 m of annulus: for a cluster")
    parser.add_argument("--parts", action=options.Words, choices=("levels", "methods"), default=("levels", "methods"),
                        help="levels of detail; methods of the coupling (default: both)")
    parser.add_argument("--bodies", action=options.Words, choices=("cube", "disk"), help="what the levels stand for")
    parser.add_argument("--scenes", action=options.Words, choices=SCENES, default=SCENES, help="of the levels (default: all)")
    parser.add_argument("--inclinations", nargs="+", type=int, choices=(0, 40, 80), help="of the annulus (default: all)")
    parser.add_argument("--velocities", nargs="+", type=float, choices=(0.58, 0.72, 1.165), help="in the annulus [m/s] (default: all)")
    parser.add_argument("--levels", nargs="+", metavar="NAME", help="of the levels' names, such as S1 C8 (the reference is always run)")
    parser.add_argument("--retime", action="store_true", help="repeat the first run of each level in each scene for its times, best on an idle "
                        "machine: tables and charts use these times then")
    parser.add_argument("--seeds", type=int, help=f"runs of each level in each scene, 1 to {len(section.SEEDS)} (default: by size; the standard "
                        "and the full size add seeds in dry scenes until the errors are small enough)")
    parser.add_argument("--rounding", type=float, help="of the body with true faces, the reference: radius of its corners over half its smallest "
                        f"extent (default: {levels.ROUNDING['cube']} of the cube, {levels.ROUNDING['disk']} of the disk)")

    def check(words):
        if words.seeds is not None and not 1 <= words.seeds <= len(section.SEEDS):
            parser.error(f"--seeds is {words.seeds}: give 1 to {len(section.SEEDS)}")
        if words.rounding is not None and not levels.MIN_ROUNDING <= words.rounding <= levels.MAX_ROUNDING:
            parser.error(f"--rounding is {words.rounding}: give {levels.MIN_ROUNDING} to {levels.MAX_ROUNDING:g}")
        words.size = SIZES["quick" if words.quick else "full" if words.full else "standard"]
        words.bodies = tuple(words.bodies or words.size.bodies)
        known = {n for body in words.bodies for n in level_study.names_of(words.build, body)} if words.levels else {}
        for level in words.levels or ():
            if level not in known:
                parser.error(f"--levels names '{level}': there are {', '.join(sorted(known))}")

    annulus = ("annulusMesh", "annulusFoam", "annulusReport")
    words = parser.settle(lambda w: ("eccentra-dem", "clusterShape") + (annulus if "section" in w.scenes or "methods" in w.parts else ()), check)
    chosen = words.size
    if words.inclinations:
        chosen = dataclasses.replace(chosen, points=tuple(p for p in chosen.points if p[0] in words.inclinations))
    if words.velocities:
        chosen = dataclasses.replace(chosen, points=tuple(p for p in chosen.points if p[1] in words.velocities))

    failed, page = [], []
    parts = []
    if "levels" in words.parts:
        parts.append(level_study.Study(words.store, words.build, chosen, words.bodies, words.scenes, words.levels, words.seeds,
                                       words.out, words.retime, words.rounding))
    if "methods" in words.parts:
        parts.append(method_study.Study(words.store, words.build, chosen, words.out))
    for study in parts:
        failed += study.run()
        page += study.write() if not words.plan else []
    if words.plan:
        return 1 if failed else 0
    if "methods" not in words.parts:
        page.append("Methods of the coupling: not part of this call (`--parts methods`).\n")
    return tables.finish(words, page, failed, f"{words.jobs} runs at a time, one core each", "times are CPU seconds of a run")
