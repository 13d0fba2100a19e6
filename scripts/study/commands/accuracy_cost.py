# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What accuracy costs in time: levels of detail of the bodies, and the methods of the coupling, each error beside its time."""
import dataclasses
import pathlib

from .. import annulus_scene, dry, level_study, levels, method_study, options, section, shape_levels, tables, user_scene, user_study

ALL_POINTS = tuple((inclination, velocity) for inclination in (0, 40, 80) for velocity in (0.58, 0.72, 1.165))
# Of dry scenes with --quick, and of the standard size; --levels names any, --full has all.
FEW = ("S1", "mean", "eccentric", "C8", "C27", "C64", "C216", "D7", "D48", "D224", "smooth 0.3", "smooth 1")
MORE = ("S1", "25 %", "mean", "eccentric", "C8", "C27", "C64", "C216", "C512", "D7", "D19", "D48", "D80", "D224", "smooth 0.3", "smooth 0.6", "smooth 1")
HOPPER = ("S1", "25 %", "mean", "eccentric", "C8", "C27", "C64", "C216", "D7", "D19", "D48", "D80")
SIZES = {
    "quick": level_study.Size(
        bodies=("cube",), few_bodies=True, seeds=3, most_seeds=3, dry_levels=FEW,
        hopper_levels=HOPPER, seeds_beside=3, length=0.15, cells="8 32 10", seconds={0: 1.0, 40: 2.0, 80: 2.5},
        points=((0, 0.58), (80, 0.58)), section_levels=("S1", "mean", "eccentric", "C8", "C64", "C216"),
        methods=method_study.Size(inclinations=(80,), seeds=1, seconds=1.0, finest=False, clusters=False)),
    "standard": level_study.Size(
        bodies=("cube", "disk"), few_bodies=True, seeds=3, most_seeds=10, dry_levels=MORE,
        seeds_beside=3, length=0.15, cells="8 32 10", seconds={0: 1.0, 40: 2.0, 80: 2.5},
        points=ALL_POINTS, section_levels=("S1", "mean", "eccentric", "C8", "C64", "C216", "D7", "D48", "D80"),
        hopper_levels=HOPPER, levels_beside=("S1", "mean", "C64", "D48"),
        methods=method_study.Size(inclinations=(0, 80), seeds=1, seconds=2.0, finest=False)),
    "full": level_study.Size(
        bodies=("cube", "disk"), few_bodies=False, seeds=10, most_seeds=20, dry_levels=(),
        seeds_beside=10, length=0.6, cells="8 32 40", seconds={0: 5, 40: 5, 80: 6},
        points=ALL_POINTS, section_levels=(), methods=method_study.Size(inclinations=(0, 80), seeds=5, seconds=4.0, finest=True)),
}
SCENES = (*dry.SCENES, "section")
PILOT, MOST_SEEDS = 3, 12  # of a shape of the user
# Options of the study of cubes and disks, and those of a shape of the user: (name in the result of argparse, value where it is not given).
OF_THE_STUDY = {"quick": False, "full": False, "parts": None, "bodies": None, "inclinations": None, "velocities": None, "retime": False}
OF_A_SHAPE = {"scene": None, "measure": None, "share": None, "within": None}


def check_shape(parser, words):
    """Refuses what does not go with --shape, and reads its words."""
    for name, default in OF_THE_STUDY.items():
        if getattr(words, name) != default:
            parser.error(f"--{name} belongs to the study of cubes and disks: leave it or --shape out")
    if words.scene is None and words.measure is not None:
        parser.error("--measure belongs to --scene FILE; expected both")
    if words.scene is not None and words.measure is None:
        parser.error("--scene needs --measure: a column of the thermo output of its script, such as f_x[1], v_x or KinEng")
    if words.scene is not None and words.scenes is not None:
        parser.error("--scene and --scenes exclude each other: a script of your own, or scenes of ours")
    if "section" in (words.scenes or ()):
        parser.error(f"--scenes section is not there for --shape; expected {', '.join((*dry.SCENES, *annulus_scene.NAMES))}")
    words.share = 0.5 if words.share is None else words.share
    words.within = level_study.PERCENT if words.within is None else words.within
    if not 0 <= words.share <= 1:
        parser.error(f"--share is {words.share}: give 0 (the last row) to 1 (all rows)")
    if not words.within > 0:
        parser.error(f"--within is {words.within}: give a number of percent above 0")
    words.user_scene = user_scene.read(words.scene.resolve(), words.measure, words.share) if words.scene else None
    words.ladder = shape_levels.read(words.build, words.shape, words.levels, words.rounding)
    if words.user_scene:  # what a script cannot take is refused where the user named it, and left out of the default
        kinds = {"eccentric": "is there for our scenes alone; expected it left out with --scene"}
        if not words.user_scene.takes_friction():
            kinds["friction"] = f"needs the index variables rolling and mu_shape in {words.scene}; add them, or leave it out"
        for level in [level for level in words.ladder.levels if level.kind in kinds]:
            if words.levels:
                parser.error(f"--levels: '{level.name}' {kinds[level.kind]}")
            words.ladder.levels.remove(level)


def answer(words):
    """The study of a user's shape."""
    names = [words.user_scene.script.name] if words.user_scene else words.scenes or ["drum"]
    seeds = (words.seeds, words.seeds) if words.seeds else (PILOT, words.most_seeds or MOST_SEEDS)
    study = user_study.UserStudy(words.store, words.build, words.ladder, words.user_scene, names, seeds, words.within)
    failed = study.run()
    if words.plan:
        return 1 if failed else 0
    return tables.finish(words, study.write(words.out), failed, f"{words.jobs} runs at a time, one core each", "times are CPU seconds of a run")


def main():
    parser = options.Parser("accuracy-cost", __doc__ + " docs/accuracy-cost.md says what comes out.", sizes=("quick", "full"))
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true", help="cubes, few levels, two points of the annulus")
    size.add_argument("--full", action="store_true", help="all levels, ten seeds or more, 0.6 m of annulus: for a cluster")
    parser.add_argument("--parts", action=options.Words, choices=("levels", "methods"),
                        help="levels of detail; methods of the coupling (default: both)")
    parser.add_argument("--bodies", action=options.Words, choices=("cube", "disk"), help="what the levels stand for")
    parser.add_argument("--scenes", action=options.Words, choices=(*SCENES, *annulus_scene.NAMES),
                        help="of the levels (default: heap, drum, hopper and section); with --shape: heap, drum (default), hopper, annulus-0, 40, 80")
    parser.add_argument("--inclinations", nargs="+", type=int, choices=(0, 40, 80), help="of the annulus (default: all)")
    parser.add_argument("--velocities", nargs="+", type=float, choices=(0.58, 0.72, 1.165), help="in the annulus [m/s] (default: all)")
    parser.add_argument("--levels", nargs="+", metavar="NAME", help="of the levels' names, such as S1 C8 (the reference is always run); "
                        f"with --shape: {shape_levels.KNOWN}".replace("%", "%%"))
    parser.add_argument("--shape", metavar="WORDS",
                        help="a shape of your own, such as 'stl stone.stl' or 'smooth box 1 2 3 rounding 0.2': which level it needs")
    parser.add_argument("--scene", type=pathlib.Path, metavar="FILE",
                        help="with --shape: a LIGGGHTS script of your own, with the index variables shape and seed")
    parser.add_argument("--measure", metavar="COLUMN", help="of --scene: f_x, v_x or another column of its thermo output")
    parser.add_argument("--share", type=float,
                        help="of --scene: part of the rows of the last run, at their end, whose mean is the result (default: 0.5; 0: the last row)")
    parser.add_argument("--within", type=float, metavar="PERCENT", help=f"with --shape: error that a level may have (default: {level_study.PERCENT:g})")
    parser.add_argument("--retime", action="store_true", help="repeat the first run of each level in each scene for its times, best on an idle "
                        "machine: tables and charts use these times then")
    parser.add_argument("--seeds", type=int, help=f"runs of each level in each scene, 1 to {len(section.SEEDS)} (default: by size; the standard "
                        "and the full size add seeds in dry scenes until the errors are small enough)")
    parser.add_argument("--most-seeds", type=int, metavar="N", help="up to which seeds are added in dry scenes, "
                        f"{PILOT} to {len(dry.SEEDS)}, with --full from {SIZES['full'].seeds} on (default: 10; --full 20; --shape {MOST_SEEDS})")
    parser.add_argument("--rounding", type=float, help="of the body with true faces, the reference: radius of its corners over half its smallest "
                        f"extent (default: {levels.ROUNDING['cube']} of the cube, {levels.ROUNDING['disk']} of the disk)")

    def check(words):
        if words.seeds is not None and not 1 <= words.seeds <= len(section.SEEDS):
            parser.error(f"--seeds is {words.seeds}: give 1 to {len(section.SEEDS)}")
        fewest = SIZES["full"].seeds if words.full else PILOT  # each level has so many before any is added
        if words.most_seeds is not None and not fewest <= words.most_seeds <= len(dry.SEEDS):
            parser.error(f"--most-seeds is {words.most_seeds}: give {fewest} to {len(dry.SEEDS)}")
        if words.most_seeds is not None and words.seeds is not None:
            parser.error("--seeds and --most-seeds exclude each other: a number of runs, or as many as the errors need")
        if words.most_seeds is not None and words.quick:
            parser.error("--most-seeds is not for --quick, which adds no seeds: leave one of them out")
        if words.rounding is not None and not levels.MIN_ROUNDING <= words.rounding <= levels.MAX_ROUNDING:
            parser.error(f"--rounding is {words.rounding}: give {levels.MIN_ROUNDING} to {levels.MAX_ROUNDING:g}")
        if words.shape is not None:
            check_shape(parser, words)
            parser.name = "accuracy-cost-shape"  # tables and charts beside those of the study
            return
        for name, default in OF_A_SHAPE.items():
            if getattr(words, name) != default:
                parser.error(f"--{name} belongs to --shape: give the words of a shape, or leave it out")
        if unknown := set(words.scenes or ()) - set(SCENES):
            parser.error(f"--scenes {' '.join(sorted(unknown))} belongs to --shape; expected section, and --inclinations")
        words.scenes, words.parts = words.scenes or SCENES, words.parts or ("levels", "methods")
        words.size = SIZES["quick" if words.quick else "full" if words.full else "standard"]
        words.bodies = tuple(words.bodies or words.size.bodies)
        known = {n for body in words.bodies for n in level_study.names_of(words.build, body)} if words.levels else {}
        for level in words.levels or ():
            if level not in known:
                parser.error(f"--levels names '{level}': there are {', '.join(sorted(known))}")

    annulus = ("annulusMesh", "annulusFoam", "annulusReport")
    coupled = lambda w: set(annulus_scene.NAMES) & set(w.scenes or ()) if w.shape is not None else (
        "section" in (w.scenes or SCENES) or "methods" in (w.parts or ("methods",)))
    words = parser.settle(lambda w: ("eccentra-dem", "clusterShape") + (annulus if coupled(w) else ()), check)
    if words.shape is not None:
        return answer(words)
    chosen = words.size
    if words.most_seeds:
        chosen = dataclasses.replace(chosen, most_seeds=words.most_seeds)
    if words.inclinations:
        chosen = dataclasses.replace(chosen, points=tuple(p for p in chosen.points if p[0] in words.inclinations))
    if words.velocities:
        chosen = dataclasses.replace(chosen, points=tuple(p for p in chosen.points if p[1] in words.velocities))

    studies = {}
    if "levels" in words.parts:
        studies["levels"] = level_study.Study(words.store, words.build, chosen, words.bodies, words.scenes, words.levels, words.seeds,
                                              words.out, words.retime, words.rounding)
    if "methods" in words.parts:
        studies["methods"] = method_study.Study(words.store, words.build, chosen, words.out)
    failed, page = [], {}
    for part, study in studies.items():
        failed += study.run()
        page[part] = [] if words.plan else study.write()
    if words.plan:
        return 1 if failed else 0
    return tables.finish(words, page, failed, f"{words.jobs} runs at a time, one core each", "times are CPU seconds of a run")
