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

from .case_files import IN_FILE, Case, fill, names_of
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
    digest: str
    values: list = field(default_factory=list)  # [what, value, relation, limit, holds] of every check
    points: list = field(default_factory=list)  # what the case adds to its group's chart

    def as_dict(self):
        return asdict(self)


ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_mpi_yield_when_idle": "1",
               "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "WM_PROJECT_DIR": "/usr/share/openfoam"}


def _watch(command, folder, output, ours):
    """Runs a program; its exit status and its resident memory, pairs of time [s] and bytes. ours: what our tests look for."""
    environment = {**ENVIRONMENT, **os.environ, **ours, "PWD": str(folder)}
    environment.pop("DISPLAY", None)  # Open MPI looks for graphics cards there, and dies with the X server
    process = subprocess.Popen(command, cwd=folder, stdout=output, stderr=subprocess.STDOUT, env=environment)
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
    return process.returncode, memory


def _execute(case: Case, run: dict, program, folder: pathlib.Path):
    """One run of the case in a folder of its own."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    build, source = program.parent.parent, pathlib.Path(__file__).resolve().parents[3]
    values = {"tests": build / "tests", "build": build, "source": source, **case.values, **run}
    for name, text in case.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(fill(text, values, IN_FILE))
    (folder / "in.case").write_text(fill(case.scene, values))
    ranks = int(values.get("ranks", 1))
    commands = [fill(line, values).split() for line in case.commands] or [[program.name, "-in", "in.case", "-log", "none"]]
    places = {"ECCENTRA_BIN": str(program.parent), "ECCENTRA_LIB": str(build / "lib"), "ECCENTRA_SOURCE": str(source)}
    status, memory = 0, []
    with open(folder / "output", "w") as output:
        for command in commands:
            serial = command[0] == "serial"  # of a case on several ranks
            command = command[serial:]
            ours = program.parent / command[0]
            if ours.exists():
                command = [str(ours)] + command[1:]
            elif not shutil.which(command[0]):
                print(f"ERROR: there is no program {ours}: build it first", file=output, flush=True)
                status = 127
                break
            if ranks > 1 and not serial:
                command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-np", str(ranks)] + command
            status, memory = _watch(command, folder, output, places)
            if status:
                break
    text = (folder / "output").read_text(errors="replace")
    if (folder / "log.liggghts").exists():  # of the script that annulusFoam hosts
        text += (folder / "log.liggghts").read_text(errors="replace")
    return Measured(str(folder), text, status, memory)


def _text(value):
    return f"{value:.4g}" if isinstance(value, (int, float)) else str(value)


def run(case: Case, program, folder: pathlib.Path, digest: str) -> Result:
    start = time.monotonic()
    measured = [_execute(case, one, program, folder / f"run{i}") for i, one in enumerate(case.runs)]
    values, criteria, found, holds = [], [], [], True
    known = {"run": measured, **case.values}
    for name in ("column", "first", "last", "largest", "early", "late", "says", "frames",
                 "number"):
        known[name] = getattr(measured[0], name)
    known["status"], known["memory_growth"] = measured[0].status, measured[0].memory_growth
    for i, one in enumerate(measured):
        if one.status != 0 and "status" not in str(case.checks):
            lines = [line for line in one.output.splitlines() if line.strip()]
            error = next((line for line in lines if re.search("ERROR|: error:", line)), lines[-1] if lines else "no output")
            found.append(f"run {i} ended with status {one.status}: {error[:200]}")
            holds = False
    stopped = not holds
    for check in case.checks:
        relation = next(word for word in ("below", "above", "equals") if word in check)
        criterion = f"{check['what']} {relation} {_text(check[relation])}"
        criteria.append(criterion)
        if stopped:
            continue
        try:
            names = names_of(known)
            value = eval(check["value"], {"__builtins__": {}, **names})
            limit = eval(str(check[relation]), {"__builtins__": {}, **names})
        except (KeyError, IndexError, ValueError, ZeroDivisionError, OverflowError) as error:
            found.append(f"{check['what']}: not measured ({type(error).__name__} {error})")
            values.append([check["what"], None, relation, None, False])
            holds = False
            continue
        good = {"below": value < limit, "above": value > limit, "equals": value == limit}[relation]
        holds = holds and good  # NaN compares false: not a number never passes
        values.append([check["what"], value, relation, limit, bool(good)])
        found.append(f"{check['what']} {_text(value)} ({relation} {_text(limit)})")
    if case.failing:
        broken = any(limit is not None and not good for _, _, _, limit, good in values)
        said = case.says and any(one.says(case.says) or re.search(case.says, f"ended with status {one.status}") for one in measured)
        as_expected = bool(said) if stopped else broken  # a check that was not made proves nothing
        verdict = "pass" if as_expected else "FAIL"
        criteria = [f"must be seen failing: {case.why}"]
    else:
        verdict = "pass" if holds else "FAIL"
    points = eval(case.points, {"__builtins__": {}, **names_of(known)}) if case.points and not stopped else []
    return Result(case.id, case.what, "; ".join(criteria), "; ".join(found), verdict,
                  round(time.monotonic() - start, 2), digest, values, points)
