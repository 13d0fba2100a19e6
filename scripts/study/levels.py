# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Levels of detail at which a body can be modelled, from the plain sphere to clusters finer than the paper's."""
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


@dataclasses.dataclass(frozen=True)
class Level:
    """kind: sphere, friction (sphere with mu_shape), eccentric (sphere that cogs) or cluster; shape: words of a shape."""
    name: str
    kind: str
    shape: str = "sphere 1"
    mu: float = 0.0
    spheres: int = 1


def fine_disk(path):
    """A disk like disk 48 with one ring more, 80 spheres: rings of 8, 16, 24 and 32, radius over outer ring as there."""
    part = path.with_name(f"{path.name}.{os.getpid()}")  # another call may read the file now
    with open(part, "w") as out:
        for ring in range(1, 5):
            for k in range(8 * ring):
                angle = 2 * math.pi * k / (8 * ring)
                out.write(f"{ring / 4 * math.cos(angle):.9f} {ring / 4 * math.sin(angle):.9f} 0 {DISK_RATIO}\n")
    part.replace(path)


def measured(build, shape, *words):
    """What clusterShape says of a shape."""
    return json.loads(programs.output_of([build / "bin" / "clusterShape", *shape.split(), *words, "--json"]))


def eccentricities(build, body):
    """Four estimates of mu_shape from small to large: the 5 and 25 % quantiles, the mean and the largest value of
    delta_e/R_eq on a plane, every orientation equally likely."""
    plane = measured(build, PAPER_REFERENCE[body])["eccentricity"]["plane"]
    return {"5 %": plane["quantiles"]["0.05"], "25 %": plane["quantiles"]["0.25"], "mean": plane["mean"], "largest": plane["max"]}


def levels_of(body, estimates, fine_file):
    """All levels of a body from the cheapest; the last is the reference. fine_file: where fine_disk was written."""
    spheres = [Level("S1", "sphere")]
    spheres += [Level(f"S1 mu {mu:.2f}", "friction", mu=round(mu, 4)) for mu in estimates.values()]
    spheres.append(Level("S1 eccentric", "eccentric", PAPER_REFERENCE[body]))
    cluster = lambda name, shape: Level(name, "cluster", shape, spheres=int(re.search(r"\d+", name).group()))
    if body == "cube":
        clusters = [cluster(f"C{n}", f"cube {n}") for n in (8, 27, 64, 125)]
    else:
        clusters = [cluster(f"D{n}", f"disk {n}") for n in (7, 19, 48)] + [cluster("D80", f"file {fine_file}")]
    return spheres + [cluster("S6", "sphere 6")] + clusters


def step_job(build, level, restitution):
    """The critical time step of a level: the smallest that fix timestep/limit meets while bodies fall and come to rest."""
    scene = CASES / "accuracy-cost" / "in.step"
    clusters = level.kind == "cluster"
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
