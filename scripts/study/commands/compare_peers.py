# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same settled bed and the same flat drop in LAMMPS, Yade, stock LIGGGHTS (fix multisphere) and with our clusters."""
import json
import math
import os
import pathlib
import shutil
import subprocess
import tempfile

from .. import frames, levels, options, peer_bed, peer_heap, programs, runs, tables
from ..programs import SCENES, Failure, digest_of, run

DIAMETER = 6.35e-3
DENSITY = 2619.0
YOUNGS, POISSON, FRICTION = 5e6, 0.3, 0.5
BED_RESTITUTION, DROP_RESTITUTION = 0.5, 0.9
SIDE, TOP = 0.05, 0.40  # of the bed, periodic across [m]
BED_STEP, DROP_STEP = 2e-5, 1e-6  # [s]
DROP_SPEED, DROP_GAP, DROP_STEPS = 0.3, 1e-4, 5000
# Steps before the clock starts (contacts and lists form) and while it runs.
WARM_UP = 400
TIMED = {"ours": 4000, "stock": 800, "lammps-hertz": 800, "lammps-granular": 800, "yade": 200}
SHAPES = ("sphere 1", "cube 8", "cube 27", "disk 48", "cube 64")
REQUIRED = {"cube 64": 13.0, "cube 8": 3.0}  # times as fast as the better of the two LAMMPS styles
CODES = {"ours": "eccentra-dem, one body one atom", "stock": "LIGGGHTS, fix multisphere",
         "lammps-hertz": "LAMMPS gran/hertz/history + rigid/small", "lammps-granular": "LAMMPS granular + rigid/small",
         "yade": "Yade clumps, one thread"}
PROGRAMS = {"lammps-hertz": ("lmp", "lammps"), "lammps-granular": ("lmp", "lammps"), "yade": ("yade", "yade")}
SCRIPTS = {"ours": SCENES / "peers.in", "stock": SCENES / "peers.in", "yade": SCENES / "peers_yade.py"}
LAMMPS = SCENES / "peers.lammps"


def install(packages):
    as_root = [] if os.geteuid() == 0 else ["sudo"]
    environment = dict(os.environ, DEBIAN_FRONTEND="noninteractive")
    print(f"installing {', '.join(packages)} with apt-get ...", flush=True)
    for words in (["apt-get", "update", "-q"], ["apt-get", "install", "-q", "-y", "--no-install-recommends", *packages]):
        try:
            done = subprocess.run(as_root + words, env=environment, capture_output=True, text=True, check=False)
        except FileNotFoundError as missing:
            raise Failure(f"{missing.filename} is not on this machine: install {' and '.join(packages)} by hand") from None
        if done.returncode:
            said = [line for line in (done.stderr + done.stdout).splitlines() if line.startswith("E:")] or ["no reason given"]
            raise Failure(f"'{' '.join(words)}' failed: {said[0]}")


class Shape:
    """Sub-spheres about the centre of mass along the principal axes, and the exact mass of the union."""

    def __init__(self, words, chosen):
        self.words = words
        with tempfile.TemporaryDirectory() as folder:  # of this call alone: others may read the same shape
            file = pathlib.Path(folder) / "body.clump"
            measured = levels.measured(chosen.build, words, "--diameter", DIAMETER, "-o", file)
            self.spheres = [tuple(map(float, line.split())) for line in file.read_text().splitlines() if line.strip() and line[0] != "#"]
        self.mass = DENSITY * measured["volume"]
        self.inertia = [self.mass * k for k in measured["inertia"]]
        # A disk lies on its face when its axis, about which its inertia is largest, points up.
        axis = max(range(3), key=lambda k: self.inertia[k])
        half = math.sqrt(0.5)
        flat = max(self.inertia) / min(self.inertia) > 1.5
        self.face_on = (1, 0, 0, 0) if not flat or axis == 2 else (half, half, 0, 0) if axis == 1 else (half, 0, -half, 0)
        self.depth = max(radius - turned(self.face_on, (x, y, z))[2] for x, y, z, radius in self.spheres)


def turned(q, p):
    """A point turned by a quaternion w x y z."""
    w, x, y, z = q
    return tuple(row[0] * p[0] + row[1] * p[1] + row[2] * p[2] for row in (
        (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z)))


def world_inertia(shape, q):
    """xx yy zz xy xz yz of a body with this orientation."""
    axes = [turned(q, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    return [sum(moment * a[i] * a[j] for moment, a in zip(shape.inertia, axes)) for i, j in
            ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]


def of_liggghts(code, shape, drop=False):
    """Variables of scenes/peers.in."""
    ours, sphere = code == "ours", shape.words == "sphere 1"
    given = {"restitution": DROP_RESTITUTION if drop else BED_RESTITUTION, "step": DROP_STEP if drop else BED_STEP, "bodies": shape.bodies,
             "fill": f"block 0 {SIDE} 0 {SIDE} 0.005 {shape.fill_top}"}
    body = f"15485863 atom_type 1 density constant {DENSITY}"
    turned_as_given = " orientation given" if ours and drop else ""
    if ours:
        given |= {"body": f"particletemplate/cluster {body} shape {shape.words} diameter {DIAMETER}{turned_as_given}",
                  "columns": "id x y z " + " ".join(f"f_cluster_bodies[{k}]" for k in (1, 2, 3, 4)), "format": f'"%d{7 * " %.16g"}"'}
    else:  # a one-sphere body is a plain sphere for stock, which has no cluster of one
        template = f"sphere {body} radius constant {DIAMETER / 2}" if sphere else f"multisphere/shape {body} shape {shape.words} diameter {DIAMETER}"
        given |= {"format": '"%d %.16g %.16g %.16g"', "wall": "wall/gran", "pair": "gran model hertz tangential history",
                  "skin": 0.001 if sphere else 0.0006, "named": int(not sphere),
                  "move": "nve/sphere" if sphere else "multisphere", "body": f"particletemplate/{template}"}
    if drop:
        z, half = shape.depth + DROP_GAP, SIDE / 2
        given |= {"fill": f"block {half - 1e-6} {half + 1e-6} {half - 1e-6} {half + 1e-6} {z} {z + 1e-9} volume_limit 1e-24",
                  "velocity": f"0 0 {-DROP_SPEED}", "turn": " ".join(map(str, shape.face_on)), "steps": DROP_STEPS}
    return given


def liggghts(build, folder, log, **given):
    script = SCRIPTS["ours"]
    return run([build / "bin" / "eccentra-dem", "-in", script, "-log", "none", *programs.variables(script=script, **given)], folder, folder / log).cpu


def write_lammps(folder, shape, bodies, velocity, periodic):
    """The files `data` and `masses` of a run: sub-spheres, and the exact mass and inertia of the bodies."""
    atoms, molecules, velocities, masses = [], [], [], []
    for body, (centre, q) in enumerate(bodies, start=1):
        masses.append(f"{body} {shape.mass:.12g} {centre[0]:.12g} {centre[1]:.12g} {centre[2]:.12g} "
                      + " ".join(f"{moment:.12g}" for moment in world_inertia(shape, q)) + f" 0 0 {velocity:.12g} 0 0 0 0 0 0")
        for x, y, z, radius in shape.spheres:
            number = len(atoms) + 1
            place = [c + p for c, p in zip(centre, turned(q, (x, y, z)))]
            turns = [math.floor(p / SIDE) if periodic else 0 for p in place[:2]]
            place = [place[0] - turns[0] * SIDE, place[1] - turns[1] * SIDE, place[2]]
            atoms.append(f"{number} 1 {2 * radius:.12g} {DENSITY:.12g} " + " ".join(f"{p:.15g}" for p in place) + f" {turns[0]} {turns[1]} 0")
            molecules.append(f"{number} {body}")
            velocities.append(f"{number} 0 0 {velocity:.12g} 0 0 0")
    (folder / "data").write_text(
        f"bodies as spheres\n\n{len(atoms)} atoms\n1 atom types\n0 {SIDE} xlo xhi\n0 {SIDE} ylo yhi\n-0.01 {TOP} zlo zhi\n\n"
        "Atoms # sphere\n\n" + "\n".join(atoms) + "\n\nVelocities\n\n" + "\n".join(velocities) + "\n\nMolecules\n\n"
        + "\n".join(molecules) + "\n")
    (folder / "masses").write_text(f"{len(bodies)}\n" + "\n".join(masses) + "\n")


def of_lammps(code, shape, drop):
    """Variables of scenes/peers.lammps."""
    e = DROP_RESTITUTION if drop else BED_RESTITUTION
    shear = YOUNGS / (2 * (1 + POISSON))
    kn, kt = 4 * shear / (3 * (1 - POISSON)), 4 * shear / (2 - POISSON)
    # gran/hertz/history has no restitution; this damping is about that of e = 0.5 at the bed's overlaps.
    hertz = f"{kn} {kt} 5e6 NULL {FRICTION} 1"
    material = f"hertz/material {YOUNGS} {e} {POISSON} tangential mindlin NULL 1.0 {FRICTION} damping tsuji"
    styles = {"pair": f"gran/hertz/history {hertz}", "coefficients": "", "wall": f"hertz/history {hertz}"} if code == "lammps-hertz" else \
        {"pair": "granular", "coefficients": material, "wall": f"granular {material}"}
    return {"drop": int(drop), "rigid": int(len(shape.spheres) > 1), **styles}


def lammps(folder, log, **given):
    return run(["lmp", "-in", LAMMPS, "-log", "none", *programs.variables(**given)], folder, folder / log, OMP_NUM_THREADS="1").cpu


def yade(folder, shape, drop, bodies, velocity, steps):
    """Processor seconds of these steps, and the mean upward velocity at the end."""
    (folder / "scene.json").write_text(json.dumps({
        "name": "drop" if drop else "bed", "youngs": YOUNGS, "poisson": POISSON, "friction": FRICTION, "density": DENSITY, "side": SIDE, "top": TOP,
        "floor": 0.0 if drop else 0.05, "spheres": shape.spheres, "bodies": bodies, "velocity": velocity, "skin": 0.0006,
        "restitution": DROP_RESTITUTION if drop else BED_RESTITUTION, "gravity": 0.0 if drop else -9.81,
        "step": DROP_STEP if drop else BED_STEP, "warm_up": 0 if drop else WARM_UP, "steps": steps}))
    (folder / "result.json.yade").unlink(missing_ok=True)
    run(["yade", "-n", "-x", "-j", "1", SCRIPTS["yade"]], folder, folder / "out.txt")
    if not (folder / "result.json.yade").is_file():
        raise programs.RunFailed(f"yade ended without a result (see {folder / 'out.txt'})")
    result = json.loads((folder / "result.json.yade").read_text())
    return result["seconds"], result["vz"]


def inputs_of(what, code, shape, **more):
    return {"what": f"peers, {what}", "scene": digest_of(SCRIPTS.get(code, LAMMPS)), "code": code, "shape": shape.words, **more}


def drop_job(build, code, shape):
    """Restitution of a body that falls flat on a floor."""
    def work(folder):
        bodies = [((SIDE / 2, SIDE / 2, shape.depth + DROP_GAP), shape.face_on)]
        if code == "yade":
            seconds, vz = yade(folder, shape, True, bodies, -DROP_SPEED, DROP_STEPS)
            return {"restitution": vz / DROP_SPEED, "cpu": seconds}
        if code in ("ours", "stock"):
            cpu = liggghts(build, folder, "out.txt", phase=2, **of_liggghts(code, shape, True))
        else:
            write_lammps(folder, shape, bodies, -DROP_SPEED, False)
            cpu = lammps(folder, "out.txt", **of_lammps(code, shape, True), steps=DROP_STEPS)
        rows = frames.last_rows(folder / "drop.dump")
        return {"restitution": sum(row[1] for row in rows) / len(rows) / DROP_SPEED, "cpu": cpu}

    return runs.Job(f"drop of {shape.words}: {code}", inputs_of("drop", code, shape), work, 5)


def settled_job(build, code, shape):
    """A bed that has come to rest; restart and dump stay in the job's folder."""
    def work(folder):
        cpu = liggghts(build, folder, "out.txt", phase=0, **of_liggghts(code, shape))
        return {"bodies": len(frames.last_rows(folder / "bed.dump")), "cpu": cpu}

    return runs.Job(f"settling {shape.bodies} {shape.words}: {code}", inputs_of("settled", code, shape, bodies=shape.bodies), work, 30)


def bed_job(build, code, shape, steps, turn, settled):
    """Milliseconds of processor time per body and 1000 steps. settled: folders of settled beds by code."""
    def work(folder):
        if code in ("ours", "stock"):
            shutil.copy(settled[code] / "bed.restart", folder / "bed.restart")
            given = of_liggghts(code, shape)
            times = [liggghts(build, folder, "out.txt", phase=1, **given, steps=n) for n in (WARM_UP, WARM_UP + steps)]
        else:  # they start from our settled bed: places and orientations
            bodies = [(row[1:4], row[4:8]) for row in sorted(frames.last_rows(settled["ours"] / "bed.dump"))]
            if code == "yade":
                times = [0.0, yade(folder, shape, False, bodies, 0.0, steps)[0]]
            else:
                write_lammps(folder, shape, bodies, 0.0, True)
                times = [lammps(folder, "out.txt", **of_lammps(code, shape, False), steps=n) for n in (WARM_UP, WARM_UP + steps)]
        return {"ms": (times[1] - times[0]) / steps / shape.bodies * 1e6, "cpu": sum(times)}

    inputs = inputs_of("bed", code, shape, bodies=shape.bodies, steps=steps, turn=turn, bed=digest_of(SCRIPTS["ours"]))
    return runs.Job(f"bed of {shape.words}: {code}, turn {turn + 1}", inputs, work, 20)


def main():
    parser = options.Parser(
        "compare-peers", "Runs a settled bed (periodic, on a floor; E 5e6, 6.35 mm) and a flat drop (material with e = 0.9) with our clusters, stock LIGGGHTS "
        "fix multisphere, LAMMPS and Yade, all with one core, and prints cost and restitution side by side. LAMMPS and Yade start from our settled bed, stock "
        "from one of its own.", "30 bodies, a tenth of the steps, once", at_once=1,
        epilog="Exit code 1 if ours is less than 13 times as fast as the faster LAMMPS style on cube 64, or less than 3 times on cube 8.")
    parser.add_argument("--install", action="store_true", help="installs the Debian packages lammps and yade if they are missing (1 GB)")
    parser.add_argument("--codes", action=options.Words, choices=list(CODES), default=list(CODES), help="default: all")
    parser.add_argument("--shapes", nargs="+", choices=SHAPES, default=list(SHAPES), metavar="SHAPE", help="of: " + ", ".join(SHAPES))
    parser.add_argument("--scenes", action=options.Words, choices=("drop", "bed", "heap", "coupled"), default=["drop", "bed"],
                        help="heap: a column of cubes with true faces that collapses, ours and yade alone; coupled: a fluidised bed of spheres beside "
                        "OpenFOAM's DPMFoam, whatever codes and shapes (default: drop bed)")
    parser.add_argument("--bodies", type=options.at_least_one, metavar="N", help="in the bed (default 300)")
    parser.add_argument("--repeat", type=options.at_least_one, metavar="N", help="the least of so many times, in turn; heaps (default 2)")

    def check(chosen):
        chosen.dry = [scene for scene in chosen.scenes if scene in ("drop", "bed")]
        taking_part = chosen.codes if chosen.dry else [code for code in chosen.codes if code == "yade"] if "heap" in chosen.scenes else []
        missing = sorted({PROGRAMS[code][1] for code in taking_part if code in PROGRAMS and not shutil.which(PROGRAMS[code][0])})
        if missing and not chosen.install and not chosen.plan:
            parser.error(f"{' and '.join(missing)} not found: add --install, or leave them out with --codes ours stock")
        chosen.bodies, chosen.repeat = chosen.bodies or (30 if chosen.quick else 300), chosen.repeat or (1 if chosen.quick else 2)
        chosen.fill_top = 0.005 + max(0.02, math.pi / 6 * DIAMETER ** 3 * chosen.bodies / 0.12 / SIDE ** 2)
        if chosen.fill_top > TOP - 0.01:
            parser.error(f"--bodies is {chosen.bodies}, which do not fit the scene: give {int(chosen.bodies * TOP / chosen.fill_top)} or fewer")
        if missing and not chosen.plan:
            install(missing)

    chosen = parser.settle(("eccentra-dem", "clusterShape", "annulusFoam"), check)
    codes, store = chosen.codes, chosen.store
    restitution, cost = {}, {}
    coupled = peer_bed.run(chosen, 0.04 if chosen.quick else 0.2) if "coupled" in chosen.scenes else []
    heap = peer_heap.rows(chosen) if "heap" in chosen.scenes else []
    for words in chosen.shapes if chosen.dry else []:
        shape = Shape(words, chosen)
        shape.bodies, shape.fill_top = chosen.bodies, chosen.fill_top
        if "drop" in chosen.scenes:
            jobs = {code: drop_job(chosen.build, code, shape) for code in codes}
            found = store.run_all("drop", jobs.values())
            restitution |= {} if chosen.plan else {(code, words): r["restitution"] for code, r in runs.needed(found, jobs).items()}
        if "bed" in chosen.scenes:
            settled = {code: settled_job(chosen.build, code, shape) for code in dict.fromkeys(["ours"] + ["stock"] * ("stock" in codes))}
            found = store.run_all("settling", settled.values())
            there = chosen.bodies if chosen.plan else runs.needed(found, settled)["ours"]["bodies"]
            if there != chosen.bodies:
                raise Failure(f"only {there} of {chosen.bodies} bodies could be placed: give fewer --bodies")
            folders = {code: store.folder_of(job) for code, job in settled.items()}
            for turn in range(chosen.repeat):
                for code in codes:
                    steps = TIMED[code] // (10 if chosen.quick else 1)
                    jobs = {"": bed_job(chosen.build, code, shape, steps, turn, folders)}
                    found = store.run_all("bed", jobs.values())
                    if not chosen.plan:
                        cost[code, words] = min(cost.get((code, words), math.inf), runs.needed(found, jobs)[""]["ms"])
    if chosen.plan:
        return 0

    lines, below = [], False
    if coupled:
        lines.append("A bed of spheres that water fluidises, one core\n\n" + tables.text(peer_bed.HEADER, coupled))
        tables.write_csv(chosen.out / "compare-peers-coupled.csv", peer_bed.HEADER, coupled)
    if heap:
        lines.append(f"A column of {peer_heap.BODIES[chosen.quick]} cubes that collapses for {peer_heap.SECONDS[chosen.quick]:g} s, one core\n\n"
                     + tables.text(peer_heap.HEADER, heap))
        tables.write_csv(chosen.out / "compare-peers-heap.csv", peer_heap.HEADER, heap)
    table = lambda title, of: f"{title}\n\n" + tables.text(["", *chosen.shapes], [[CODES[code], *(
        f"{of[code, shape]:.3f}" if (code, shape) in of else None for shape in chosen.shapes)] for code in codes])
    if restitution:
        lines.append(table(f"Restitution of a flat drop at {DROP_SPEED} m/s, material with {DROP_RESTITUTION} (gran/hertz/history has no restitution)",
                           restitution))
    if cost:
        lines.append(table(f"Settled bed of {chosen.bodies} bodies, ms of processor time per body and 1000 steps", cost))
        peers = [code for code in codes if code.startswith("lammps")]
        for words in chosen.shapes if peers and "ours" in codes else []:
            ratio = min(cost[code, words] for code in peers) / cost["ours", words]
            required = REQUIRED.get(words)
            below |= required is not None and ratio < required
            verdict = "" if required is None else f" (required: {required:g})"
            lines.append(f"{words}: {ratio:.1f} times as fast as the faster LAMMPS style{verdict}")
    text = "\n".join(lines) + "\n"
    (chosen.out / "compare-peers.txt").write_text(text)
    if chosen.dry:
        tables.write_csv(chosen.out / "compare-peers.csv", ["code", "shape", "restitution_of_0.9", "ms_per_body_per_1000_steps"],
                         [[code, words, restitution.get((code, words), ""), cost.get((code, words), "")] for code in codes for words in chosen.shapes])
    print(text, end="")
    return 1 if below else 0
