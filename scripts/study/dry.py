# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of cases/rolling-comparison: how a level of detail is run in them."""
import math
import statistics

from . import frames, measures, programs, runs, timing
from .levels import shape_key
from .programs import CASES, digest_of, run

FRAME = frames.FRAME


def write_ring(path, inner, outer, parts=48):
    """The bottom of the silo: a plane ring as STL."""
    point = lambda r, k: f"vertex {r * math.cos(2 * math.pi * k / parts):.9g} {r * math.sin(2 * math.pi * k / parts):.9g} 0"
    with open(path, "w") as out:
        out.write("solid ring\n")
        for k in range(parts):
            for corners in ((point(inner, k), point(outer, k), point(outer, k + 1)),
                            (point(inner, k), point(outer, k + 1), point(inner, k + 1))):
                out.write("facet normal 0 0 1\nouter loop\n" + "\n".join(corners) + "\nendloop\nendfacet\n")
        out.write("endsolid ring\n")


def heap_slope(dumped, bodies):
    """Angle of the cone through all bodies of the last frame, about their median place; and their residual speed."""
    frame = dumped[-1]
    x0, y0 = (statistics.median(body[k] for body in frame.values()) for k in (0, 1))
    return measures.cone_angle([(math.hypot(b[0] - x0, b[1] - y0), b[2] - frames.RADIUS) for b in frame.values()]), frames.speed(frame)


# name: (what, unit, measure, bodies, bodies with --quick); the first two are those of cases/rolling-comparison
SCENES = {
    "heap": ("slope of a heap", "degrees", heap_slope, 600, 220),
    "drum": ("angle of the bed in a drum at 30 rpm", "degrees", frames.drum_angle, 160, 110),
    "hopper": ("discharge of a hopper", "bodies/s", frames.steady_discharge, 1000, 700),
}
# Through an orifice of nine diameters cubes flow without jams; through the five of cases/rolling-comparison, which takes fewer bodies, and through
# seven the rate of one seed is twice that of another.
MANY = {"heap": 220, "hopper": 400}  # with more bodies a scene is larger than that of the case
RING = {False: (0.016, 0.03), True: (0.028, 0.047)}  # radii of the orifice and of the bottom around it, by whether there are many [m]
SILO = {"silo": 0.042, "tall": 0.45, "settling": 7, "flowing": 5}  # variables of in.hopper for many
SCENE = CASES / "rolling-comparison"
# Where bodies are poured; primes, which LIGGGHTS asks for, and none that the scenes use for something else.
SEEDS = (15485863, 32452843, 49979687, 67867967, 86028121, 15485867, 32452867, 49979693, 67867979, 86028157,
         15485917, 86028221, 86028223, 86028259, 86028269, 86028277, 86028301, 86028323, 86028329, 86028343,
         86028353, 86028389, 86028401, 86028419, 86028433, 86028451, 86028479, 86028511, 86028539, 86028563,
         86028581, 86028583, 86028611, 86028643, 86028673, 86028697, 86028731, 86028743, 86028773, 86028779)


def size_words(scene, bodies):
    """Variables of the scene's script that give room to many bodies; a column of a heap keeps its proportions."""
    if bodies <= MANY.get(scene, bodies):
        return {}
    if scene == "hopper":
        return SILO
    tube = 0.02 * (bodies / MANY["heap"]) ** (1 / 3)
    return {"tube": f"{tube:.6g}", "tall": 0.45, "wide": f"{7.5 * tube:.6g}", "settling": 5}


def dry_job(build, scene, level, seed, bodies, step):
    """A run of a scene at a level of detail (levels.Level); the result: value, residual speed, bodies, time and its parts."""
    clusters = level.has_shape()
    variables = {"seed": seed, "bodies": bodies, "shape": level.shape, "clusters": int(clusters), "step": f"{step:.9g}",
                 "mu_r": 0, "mu_shape": level.mu, "rolling": "off", "words": "tangential_damping on",
                 "wall_words": "tangential_damping on"}
    larger = size_words(scene, bodies)
    variables |= larger
    ring = RING[bool(larger)] if scene == "hopper" else ()
    if level.kind == "friction":
        variables |= {"rolling": "shape", "words": "form limited", "wall_words": "form limited"}
    if level.slide is not None:
        variables["mu_s"] = level.slide
    if level.kind == "eccentric":
        damped = f"rockingDamping {level.damping:g}"
        variables |= {"rolling": "eccentric", "words": f"shape {level.shape} {damped}", "wall_words": f"{variables['wall_words']} {damped}"}
    inputs = {"what": "dry", "scene": digest_of(SCENE / f"in.{scene}", SCENE / "bodies.in"),
              **variables, "shape": shape_key(level.shape), "ring": ring}

    def work(folder):
        if ring:
            write_ring(folder / "ring.stl", *ring)
        line = [build / "bin" / "eccentra-dem", "-in", SCENE / f"in.{scene}", "-log", "none", *programs.variables(here=SCENE, **variables)]
        cpu, wall, _ = run(line, folder, folder / "out.txt")
        dumped = frames.read_frames(folder / "frames.dump")
        value, residual = SCENES[scene][2](dumped, bodies)
        parts = timing.scaled(timing.parts_of((folder / "out.txt").read_text()), cpu)
        return {"value": value, "residual": residual, "bodies": len(dumped[0]), "cpu": cpu, "wall": wall, "parts": parts}

    return runs.Job(f"{scene} {level.name} seed {seed}", inputs, work,
                    1e-7 * bodies / step * 2.4 * (1 + 0.7 * (level.spheres > 1) + 0.03 * level.spheres))
