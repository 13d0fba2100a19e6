# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A spheroid that creeps along its axis at the centre of a large sphere, as a wedge of one cell: mesh, run, drag."""
import csv
import math
import re
import typing

from . import foam, runs
from .programs import RunFailed, run

HALF = math.radians(1.0)  # of the wedge's angle
SPEED = DIAMETER = 2.0  # of scenes/creeping-drag: U/d = 1/s, and a sphere has the radius 1
CHUNK, SHORT = 250, 50  # steps from one look at the drag to the next; of each lower cap at the start
CAPS = (3.0, 30.0, 300.0)  # a first step at the full cap diverges where n < 1: each cap begins with the flow of the one before
STEADY = 2e-4  # relative change of the drag over two chunks
LONGEST = 32  # chunks


class Case(typing.NamedTuple):
    """aspect: axis over diameter across; index: n; bingham: (tau0/k)(d/U)^n; radial, polar: cells; outer: radius over that of the sphere of equal
    volume; cap: largest viscosity over k + tau0 d/U."""
    aspect: float = 1.0
    index: float = 1.0
    bingham: float = 0.0
    radial: int = 72
    polar: int = 48
    outer: float = 50.0
    cap: float = 300.0


def surfaces(aspect, outer, stretch=2.0):
    """Semi-axes along and across the flow of the confocal surface at 0 <= s <= 1: the body at 0, all but a sphere of radius `outer` at 1. Cells at
    the body are exp(stretch) times as thin, in the logarithm of the radius, as those outside."""
    along, across = aspect ** (2 / 3), aspect ** (-1 / 3)
    graded = lambda s: math.expm1(stretch * s) / math.expm1(stretch)
    if aspect == 1:
        return lambda s: (outer ** graded(s),) * 2
    focus = math.sqrt(abs(along ** 2 - across ** 2))
    longer, shorter = (math.cosh, math.sinh)
    body, far = math.atanh(min(along, across) / max(along, across)), math.asinh(outer / focus)

    def at(s):
        place = body + (far - body) * graded(s)
        pair = focus * longer(place), focus * shorter(place)
        return pair if aspect > 1 else pair[::-1]
    return at


def move_points(case, folder):
    """From the coordinates of scenes/creeping-drag/system/blockMeshDict to the wedge; its sides become wedge patches."""
    semi_axes = surfaces(case.aspect, case.outer)

    def moved(point):
        s, quarter, side = map(float, point[1].split())
        along, across = semi_axes(s)
        off = across * math.sin(quarter * math.pi / 2) if side else 0.0
        return f"({along * math.cos(quarter * math.pi / 2):.17g} {off * math.cos(HALF):.17g} {math.copysign(off * math.sin(HALF), side):.17g})"

    points, boundary = folder / "points", folder / "boundary"
    head, brace, rest = points.read_text().partition("(")
    points.write_text(head + brace + re.sub(r"\(([^()]+)\)", moved, rest))
    boundary.write_text(re.sub(r"\b(back|front)(\s*\{\s*type\s+)patch", r"\1\2wedge", boundary.read_text()))


def set_up(case, folder):
    foam.set_up(folder, "creeping-drag", end={"runEnd": 0, "runFormat": "ascii", "runMuY": 1}, settings={
        "runRadial": case.radial, "runQuarter": case.polar // 2, "runBingham": case.bingham, "runIndex": case.index})
    run(["blockMesh"], folder, folder / "blockMesh.txt")
    move_points(case, folder / "constant" / "polyMesh")
    (folder / "ready").touch()


def drag_of(folder):
    """[(time, C_s, momentum residual)]: C_s = F/(3 pi k (U/d)^n d^2) of the whole body, from all reports of a case."""
    rows = {}
    for file in sorted(folder.glob("postProcessing/eccentra/*/flow.csv"), key=lambda f: float(f.parent.name)):
        with open(file, newline="") as table:
            for row in csv.DictReader(table):
                rows[float(row["time"])] = float(row["body_force_x"]) * math.pi / HALF / (3 * math.pi * DIAMETER ** 2), float(row["momentum_residual"])
    return [(time, *values) for time, values in sorted(rows.items())]


def stages(case):
    """(last step, cap) of each run of annulusFoam, one after the other: those at lower caps, those whose drag counts."""
    low = [cap for cap in CAPS if cap < case.cap]
    starts = [(SHORT * (k + 1), cap) for k, cap in enumerate(low)]
    return starts, [(SHORT * len(low) + CHUNK * (k + 1), case.cap) for k in range(LONGEST)]


def change_of(drags):
    """Largest relative change of the drag over the last two chunks."""
    return max(abs(value / drags[-1] - 1) for value in drags[-3:]) if len(drags) > 2 else math.inf


def solve(build, case, folder):
    """Marches until the drag is steady; goes on where an earlier call stopped. Drag, its change over the last chunks, steps, CPU seconds."""
    if not (folder / "ready").is_file():
        set_up(case, folder)
    cpu, drags = 0.0, []
    starts, chunks = stages(case)
    for last, cap in starts + chunks:
        reached = max((int(time.name) for time in folder.glob("[1-9]*") if (time / "p").is_file()), default=0)
        if reached < last:
            foam.put(folder / "end", runEnd=last, runFormat="binary", runMuY=cap * (1.0 + case.bingham))
            cpu += run([build / "bin" / "annulusFoam"], folder, folder / "out.txt").cpu
        reports = {time: (drag, residual) for time, drag, residual in drag_of(folder)}
        if last not in reports or not math.isfinite(reports[last][0]):
            raise RunFailed(f"there is no drag at step {last}: see {folder / 'out.txt'}")
        if (last, cap) in chunks:
            drags.append(reports[last][0])
        if change_of(drags) < STEADY:
            break
    return {"drag": drags[-1], "change": change_of(drags), "steps": last, "residual": reports[last][1], "cpu": cpu}


def job(build, case, name):
    def work(folder):
        return solve(build, case, folder / "case")

    inputs = {"what": "creeping drag", "scene": foam.digest("creeping-drag"), **case._asdict()}
    return runs.Job(name, inputs, work, 5e-6 * case.radial * case.polar * (300 + 900 * min(case.bingham, 1.0)))
