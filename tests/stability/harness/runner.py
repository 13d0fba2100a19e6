# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one case and judges it."""
import os
import pathlib
import re
import shutil
import subprocess
import time
from dataclasses import asdict, dataclass, field

from study import programs

from . import checks
from .case import SOURCE, Case, Run, call
from .measured import Measured

TIMEOUT = 3600  # s per run; a case that hangs fails


@dataclass
class Result:
    id: str
    what: str
    criterion: str
    measured: str
    verdict: str  # pass or FAIL
    seconds: float
    values: list = field(default_factory=list)  # [what, value, relation, limit, holds] of every check
    points: list = field(default_factory=list)  # what the case adds to its group's chart

    def as_dict(self):
        return asdict(self)


# Open MPI 4 and 5 have names of their own for the same; each passes over the other's.
MPI = {"OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_smsc": "^cma",
       "OMPI_MCA_rmaps_base_oversubscribe": "1", "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"}


def _watch(command, folder, output, ours):
    """Runs a program; its exit status and its resident memory, pairs of time [s] and bytes. ours: what our tests look for."""
    # Open MPI looks for graphics cards on a display, and dies with the X server.
    process = programs.begin(command, folder, output, **MPI, **ours, PWD=str(folder), DISPLAY="")
    memory, start = [], time.monotonic()
    while process.poll() is None:
        if time.monotonic() - start > TIMEOUT:
            process.kill()
        try:
            with open(f"/proc/{process.pid}/statm") as statm:
                memory.append((time.monotonic() - start, int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")))
        except (OSError, IndexError):
            pass  # it has just ended
        try:
            process.wait(0.05 if len(memory) < 200 else 1)
        except subprocess.TimeoutExpired:
            pass
    programs.end(process)
    return process.returncode, memory


def _execute(run: Run, program, folder: pathlib.Path):
    """One run of a case in a folder of its own."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    build = program.parent.parent
    for name, text in run.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    places = {"ECCENTRA_BIN": str(program.parent), "ECCENTRA_LIB": str(build / "lib"), "ECCENTRA_SOURCE": str(SOURCE)}
    status, memory = 0, []
    with open(folder / "output", "w") as output:
        for command in run.commands:
            serial = command[0] == "serial"  # of a case on several ranks
            command = command[serial:]
            ours = program.parent / command[0]
            if ours.exists():
                command = [str(ours)] + command[1:]
            elif not shutil.which(command[0]):
                print(f"ERROR: there is no program {ours}: build it first", file=output, flush=True)
                status = 127
                break
            if run.ranks > 1 and not serial:
                command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-np", str(run.ranks)] + command
            status, memory = _watch(command, folder, output, places)
            if status:
                break
    text = (folder / "output").read_text(errors="replace")
    if (folder / "log.liggghts").exists():  # of the script that annulusFoam hosts
        text += (folder / "log.liggghts").read_text(errors="replace")
    return Measured(str(folder), text, status, memory)


def _text(value):
    return f"{value:.4g}" if isinstance(value, (int, float)) else str(value)


def run(case: Case, program, folder: pathlib.Path) -> Result:
    start = time.monotonic()
    measured = [_execute(one, program, folder / f"run{i}") for i, one in enumerate(case.runs)]
    values, criteria, found, holds = [], [], [], True
    known = {**case.values, "run": measured[0], "runs": measured}
    judges_status = any(check.measure in (checks.status, checks.statuses) for check in case.checks)
    for i, one in enumerate(measured):
        if one.status != 0 and not judges_status:
            lines = [line for line in one.output.splitlines() if line.strip()]
            error = next((line for line in lines if re.search("ERROR|: error:", line)), lines[-1] if lines else "no output")
            found.append(f"run {i} ended with status {one.status}: {error[:200]}")
            holds = False
    stopped = not holds
    for check in case.checks:
        criteria.append(f"{check.what} {check.relation} {_text(call(check.limit, case.values))}")
        if stopped:
            continue
        try:
            value, limit = check.value(known), call(check.limit, case.values)
        except (KeyError, IndexError, ValueError, ZeroDivisionError, OverflowError) as error:
            found.append(f"{check.what}: not measured ({type(error).__name__} {error})")
            values.append([check.what, None, check.relation, None, False])
            holds = False
            continue
        good = check.holds(value, limit)
        holds = holds and good
        values.append([check.what, value, check.relation, limit, good])
        found.append(f"{check.what} {_text(value)} ({check.relation} {_text(limit)})")
    if case.failing:
        broken = any(limit is not None and not good for _, _, _, limit, good in values)
        said = case.says and any(one.says(case.says) or re.search(case.says, f"ended with status {one.status}") for one in measured)
        as_expected = bool(said) if stopped else broken  # a check that was not made proves nothing
        verdict = "pass" if as_expected else "FAIL"
        criteria = [f"must be seen failing: {case.why}"]
    else:
        verdict = "pass" if holds else "FAIL"
    points = call(case.points, known) if case.points and not stopped else []
    return Result(case.id, case.what, "; ".join(criteria), "; ".join(found), verdict,
                  round(time.monotonic() - start, 2), values, points)
