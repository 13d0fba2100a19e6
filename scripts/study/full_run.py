# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the whole scene from the empty hole, or goes on with it; what is measured in it is in hole.py."""
import json
import os
import pathlib
import shutil
import sys
import time

from . import levels, programs, runs, section

CASE = section.CASES / "tomren-injection"
CELL_LENGTH = 12 / 243  # of the paper's mesh along the hole [m]
ACROSS, AROUND = 12, 48
FLUID_STEP = 20e-3
PORTIONS = 20e-3  # time between two insertions [s]: rarer ones push the fluid out in jerks
REPORT = 0.1  # [s] between two rows of a long run; where steps are compared each step has a row, or all rows would be those after an insertion
BALANCE = 200  # DEM steps between two looks at the load of the ranks: bodies are at one end of the hole
MOST_PICTURES = 60  # of a run: they bound what it takes on the disk
TELL = 60  # seconds from one line of progress to the next
NOTE = "note.json"  # beside the case: the builds that computed it and the CPU time that they took
COARSEST = 16  # cells of the coarsest level for each cell along the hole: cells that are long are merged across the hole alone
TOLERANCES = {"loose": ("1e-3", "1e-4"), "tight": ("1e-6", "0")}  # relTol of pFinal and of UFinal
SOLVERS = """// Written by scripts/full-scene: solvers for long cells (docs/annulusFoam.md)
FoamFile {{ version 2.0; format ascii; class dictionary; object fvSolution; }}

solvers
{{
    p
    {{
        solver                  PCG;
        preconditioner
        {{
            preconditioner          GAMG;
            smoother                DIC;
            nPreSweeps              0;
            nPostSweeps             1;
            nCellsInCoarsestLevel   {coarsest};
            coarsestLevelCorr       {{ solver sparseCholesky; }}
            tolerance               1e-9;
            relTol                  0.01;
        }}
        tolerance               1e-8;
        relTol                  0.01;
    }}
    pFinal  {{ $p; relTol {pressure}; }}
    U
    {{
        solver      PBiCGStab;
        preconditioner DILU;
        tolerance   1e-9;
        relTol      0.01;
    }}
    UFinal  {{ $U; relTol {velocity}; }}
}}
PIMPLE
{{
    nOuterCorrectors    1;
    nCorrectors         2;
    momentumPredictor   yes;
    consistent          yes;
}}
"""


def cells_of(length):
    return f"{ACROSS} {AROUND} {max(1, round(length / CELL_LENGTH))}"


def interval_of(chosen, critical):
    """DEM steps in a step of the fluid: as chosen, or by the rule of docs/choosing-steps.md."""
    return chosen.interval or section.steps_per_fluid_step(critical, chosen.fluid_step)


def options_of(chosen, level, critical):
    """Of the case's `run`, without --."""
    interval = interval_of(chosen, critical)
    return {"length": chosen.length, "cells": cells_of(chosen.length), "inclination": chosen.angle, "velocity": chosen.velocity,
            "entry": chosen.velocity, "rpm": chosen.rpm, "portions": PORTIONS, "fluid_step": chosen.fluid_step, "interval": interval,
            "seconds": chosen.end, "ranks": chosen.ranks, "balance": BALANCE if chosen.ranks > 1 else 0, "bodies": 1, "snapshots": snapshots_of(chosen),
            "report": 1 if chosen.accuracy else max(1, round(REPORT / chosen.fluid_step)), **section.level_words(level),
            **({"safety": chosen.safety} if chosen.safety else {})}


def snapshots_of(chosen):
    """[s] from one picture to the next: whole fluid steps."""
    return chosen.fluid_step * max(1, round(max(chosen.end / MOST_PICTURES, 0.1) / chosen.fluid_step))


def solvers_of(length, tolerances):
    """system/fvSolution."""
    pressure, velocity = TOLERANCES[tolerances]
    return SOLVERS.format(coarsest=COARSEST * int(cells_of(length).split()[2]), pressure=pressure, velocity=velocity)


def source_of(folder, solvers, case=CASE):
    """A copy of the case with these solvers."""
    copy = folder / "source"
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(case, copy)
    (copy / "system" / "fvSolution").write_text(solvers)
    return copy


def size_of(folder):
    """Bytes of all files."""
    total = 0
    for path in folder.rglob("*"):
        try:
            total += path.lstat().st_size
        except FileNotFoundError:  # a checkpoint that was just replaced
            pass
    return total


def last_row(case):
    """Of coupling.csv; {} before there is one."""
    try:
        rows = section.rows_of(case)
    except (OSError, TypeError, ValueError):  # not there, or its last line is being written
        return {}
    return rows[-1] if rows else {}


def progress(case, end, began, first):
    """A line: time, bodies, cost, time left, what is on the disk. first: the time that the run had when this call began."""
    row = last_row(case)
    if not row:
        return "the mesh is made and the fluid runs in"
    wall, gone = time.monotonic() - began, row["time"] - first
    left = f"about {wall * (end - row['time']) / gone / 60:.0f} min left" if gone > 0 else "time left not known yet"
    parts = ", ".join(f"{name} {row[f'{name}_seconds']:.0f}" for name in ("dem", "fluid", "exchange", "link"))
    return (f"t = {row['time']:.2f} of {end:g} s, {row['particles']:.0f} bodies, {wall / 60:.1f} min in this call, {left}; wall seconds since the start: "
            f"{parts}; {size_of(case) / 1e6:.0f} MB on the disk")


def cpu_of(session):
    """Seconds of CPU that the running processes of a session have taken."""
    ticks = 0
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:  # it has just ended
            continue
        if int(fields[3]) == session:
            ticks += int(fields[11]) + int(fields[12])
    return ticks / os.sysconf("SC_CLK_TCK")


def follow(words, folder, end, note, say):
    """Runs the case's program to its end, with lines of progress, and adds the CPU time that it takes to the note."""
    case, log = folder / "case", folder / f"out-{note['calls']}.txt"
    began, first, before = time.monotonic(), last_row(case).get("time", 0.0), note["cpu"]
    told = began
    with open(log, "w") as out:
        process = programs.begin(words, folder, out)
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - told > TELL:
                told = time.monotonic()
                say(progress(case, end, began, first))
                note["cpu"] = before + cpu_of(process.pid)
                write_note(folder, note)
            time.sleep(0.2)
        process.returncode = os.waitstatus_to_exitcode(status)
        programs.end(process)
    note["cpu"] = before + usage.ru_utime + usage.ru_stime
    write_note(folder, note)
    if process.returncode:
        raise programs.RunFailed(f"{programs.sentence_of(log, process.returncode)} (log: {log}); the same command goes on from the last checkpoint")


def write_note(folder, note):
    part = folder / f"{NOTE}.part"
    part.write_text(json.dumps(note))
    part.replace(folder / NOTE)


def read_note(folder):
    try:
        return json.loads((folder / NOTE).read_text())
    except (OSError, ValueError):
        return {"builds": [], "cpu": 0.0, "calls": 0}


def job(chosen, level, critical):
    """The run as a job of the store, which goes on with what an earlier call has left in its folder."""
    words = options_of(chosen, level, critical)
    solvers = solvers_of(chosen.length, chosen.tolerances)
    inputs = {"what": "whole scene", "case": section.case_digest(CASE), "solvers": solvers,
              **{key: levels.shape_key(value) if key == "shape" else str(value) for key, value in words.items()}}
    say = lambda text: print(f"  {level.name}: {text}", file=sys.stderr, flush=True)

    def work(folder):
        case, note, build = folder / "case", read_note(folder), programs.code_of(chosen.build)
        begun = (case / "eccentra-run.json").is_file()
        if begun and (case / "checkpoints" / "finished").exists():  # by another build: else its result would be kept
            shutil.rmtree(case)
            begun, note = False, {"builds": [], "cpu": 0.0, "calls": 0}
        if begun and note["builds"] and note["builds"][-1] != build:
            say(f"goes on with another build ({build}) than the one that computed it so far: its digits are no longer those of one build")
        if build not in note["builds"]:
            note["builds"].append(build)
        note["calls"] += 1
        write_note(folder, note)
        if begun:
            say(f"goes on at t = {last_row(case).get('time', 0.0):.2f} s in {folder}")
            line = [programs.RUN_CASE, CASE, "--resume", case, "--bin", chosen.build / "bin"]
        else:
            say(f"begins in {folder}")
            shutil.rmtree(case, ignore_errors=True)
            line = [programs.RUN_CASE, source_of(folder, solvers), "--bin", chosen.build / "bin", "--output", case, *programs.options(**words)]
        follow(line, folder, chosen.end, note, say)
        row = section.rows_of(case)[-1]
        return {"cpu": note["cpu"], "bodies": int(row["particles"]), "bytes": size_of(case)}

    title = (f"{level.name}, {chosen.length:g} m, {chosen.angle:g} degrees, {chosen.velocity:g} m/s, {chosen.end:g} s, "
             f"steps of {1e3 * chosen.fluid_step:g} ms, {chosen.tolerances}, {chosen.ranks} rank(s)")
    cells = ACROSS * AROUND * chosen.length / CELL_LENGTH
    bodies = 0.5 * section.INJECTED / section.BODY_VOLUME * chosen.end  # the mean over the run, if none leaves
    estimate = chosen.end / chosen.fluid_step * (5e-6 * cells + words["interval"] * bodies * 2.5e-7 * (1 + 0.03 * level.spheres))
    return runs.Job(title, inputs, work, estimate)


def case_of(store, one):
    """Folder of a run's case, finished or not; None if there is none."""
    case = pathlib.Path(store.folder_of(one)) / "case"
    return case if (case / "postProcessing" / "eccentra" / "coupling.csv").is_file() else None
