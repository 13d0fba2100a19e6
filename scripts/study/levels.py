# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Levels of detail at which a body can be modelled, from the plain sphere over clusters to the body with true faces."""
import dataclasses
import json
import math
import os
import pathlib
import re

from . import programs, runs
from .programs import CASES, digest_of, run

SAFETY = 0.3  # of the critical time step, the default of fix timestep/limit
DISK_RATIO = 0.4476  # radius over that of the outer ring, as in disk 48 (docs/shapes.md)
# The most detailed cluster of the paper, whose eccentricity gives mu_shape.
PAPER_REFERENCE = {"cube": "cube 64", "disk": "disk 48"}
CUBES = (8, 27, 64, 125, 216, 512)
DISKS = (7, 19, 48)  # built in
RINGS = {80: 4, 120: 5, 224: 7}  # of finer disks
# The body with true faces. Rounding, radius of the corners over half the smallest outer extent, is Wadell's roundness: 0.12 to 0.17 is "very
# angular" in Powers' classes (1953), as fresh fragments are taken to be. The disk's is the smallest whose radius bears the impacts as the cube's does.
ROUNDING = {"cube": 0.15, "disk": 0.3}
OTHER_ROUNDINGS = {"cube": (0.5, 0.3), "disk": (1.0, 0.6)}  # that show what the choice of the rounding does
MIN_ROUNDING, MAX_ROUNDING = 0.01, 1.0  # that `shape smooth` takes
DISK_ASPECT = DISK_RATIO / (1 + DISK_RATIO)  # thickness over diameter of disk 48 and of all finer disks
SMOOTH_COST = 30  # spheres of the cluster that costs as much, for the time left alone


@dataclasses.dataclass(frozen=True)
class Level:
    """kind: sphere, friction (sphere with mu_shape), eccentric (sphere that cogs), cluster, smooth (true faces)
    or rounding (true faces and other corners: another body); shape: words of a shape;
    mu: mu_shape; slide: coefficient of sliding friction, None for that of the scene; damping: rockingDamping of an eccentric sphere."""
    name: str
    kind: str
    shape: str = "sphere 1"
    mu: float = 0.0
    spheres: int = 1
    slide: float = None
    damping: float = 1.0

    def has_shape(self):
        """Whether the particle itself has the shape, and is no sphere that stands for it."""
        return self.kind in ("cluster", "smooth", "rounding")


def fine_disk(path, rings=4):
    """A disk like disk 48 with more rings: 8 k spheres in ring k, 4 n (n + 1) in all, radius over outer ring as there. So its rim and its
    thickness are those of disk 48, and its faces have lower bumps."""
    part = path.with_name(f"{path.name}.{os.getpid()}")  # another call may read the file now
    with open(part, "w") as out:
        for ring in range(1, rings + 1):
            for k in range(8 * ring):
                angle = 2 * math.pi * k / (8 * ring)
                out.write(f"{ring / rings * math.cos(angle):.9f} {ring / rings * math.sin(angle):.9f} 0 {DISK_RATIO}\n")
    part.replace(path)


def fine_disks(folder):
    """Writes all finer disks; the path of the first, as levels_of takes it."""
    for spheres, rings in RINGS.items():
        fine_disk(folder / f"disk{spheres}.clump", rings)
    return folder / "disk80.clump"


def measured(build, shape, *words):
    """What clusterShape says of a shape."""
    return json.loads(programs.output_of([build / "bin" / "clusterShape", *shape.split(), *words, "--json"]))


def eccentricities(build, body):
    """Four estimates of mu_shape from small to large: the 5 and 25 % quantiles, the mean and the largest value of
    delta_e/R_eq on a plane, every orientation equally likely."""
    plane = measured(build, PAPER_REFERENCE[body])["eccentricity"]["plane"]
    return {"5 %": plane["quantiles"]["0.05"], "25 %": plane["quantiles"]["0.25"], "mean": plane["mean"], "largest": plane["max"]}


def levels_of(body, estimates, fine_file):
    """Spheres and clusters of a body from the cheapest. fine_file: a finer disk in the folder where fine_disks wrote them."""
    spheres = [Level("S1", "sphere")]
    spheres += [Level(f"S1 mu {mu:.2f}", "friction", mu=round(mu, 4)) for mu in estimates.values()]
    spheres.append(Level("S1 eccentric", "eccentric", PAPER_REFERENCE[body]))
    cluster = lambda name, shape: Level(name, "cluster", shape, spheres=int(re.search(r"\d+", name).group()))
    if body == "cube":
        clusters = [cluster(f"C{n}", f"cube {n}") for n in CUBES]
    else:
        clusters = [cluster(f"D{n}", f"disk {n}") for n in DISKS]
        clusters += [cluster(f"D{n}", f"file {pathlib.Path(fine_file).with_name(f'disk{n}.clump') if fine_file else ''}") for n in RINGS]
    return spheres + [cluster("S6", "sphere 6")] + clusters


def smooth(body, rounding):
    """The body with true faces; equal diameter, so equal volume and mass as its clusters."""
    form = "cube" if body == "cube" else f"disk aspect {DISK_ASPECT:.4f}"
    return Level(f"smooth {rounding:g}", "smooth", f"smooth {form} rounding {rounding:g}", spheres=SMOOTH_COST)


def ladder_of(body, estimates, fine_file, rounding=None):
    """All levels of a body: spheres, clusters, smooth bodies of other roundings, and last the reference, smooth with `rounding`."""
    wanted = rounding or ROUNDING[body]
    others = [dataclasses.replace(smooth(body, other), kind="rounding") for other in OTHER_ROUNDINGS[body] if other != wanted]
    return levels_of(body, estimates, fine_file) + others + [smooth(body, wanted)]


def step_job(build, level, restitution):
    """The critical time step of a level: the smallest that fix timestep/limit meets while bodies fall and come to rest."""
    scene = CASES / "accuracy-cost" / "in.step"
    clusters = level.has_shape()
    shape = level.shape if clusters else "sphere 1"
    inputs = {"what": "step", "scene": digest_of(scene), "shape": shape_key(shape), "restitution": restitution}

    def work(folder):
        line = [build / "bin" / "eccentra-dem", "-in", scene, "-log", "none",
                *programs.variables(clusters=int(clusters), shape=shape, restitution=restitution)]
        cpu, wall, _ = run(line, folder, folder / "out.txt")
        rows = re.findall(r"^ +\d+ +\d+ +([\d.e+-]+) +([\d.e+-]+)\s*$", (folder / "out.txt").read_text(), re.M)
        critical, contacts = min((float(step), float(n)) for step, n in rows if float(step) > 0)  # 0: not evaluated yet
        return {"critical": critical, "contacts": int(contacts), "cpu": cpu, "wall": wall}

    return runs.Job(f"time step of {level.name}", inputs, work, 1.0, first=True)


def shape_key(shape):
    """What identifies a shape: its words, with the contents of files in place of their names."""
    return " ".join(digest_of(path) if (path := pathlib.Path(word)).is_file() else word for word in shape.split())


def dividing_step(period, critical):
    """The largest step that divides a period and stays within SAFETY of the critical step; and how many make a period."""
    parts = math.ceil(period / (SAFETY * critical) - 1e-9)
    return period / parts, parts
