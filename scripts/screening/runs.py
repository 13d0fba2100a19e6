# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Starts programs for scripts/effects and reads what fix fluid/force prints."""
import os
import pathlib
import re
import resource
import subprocess

EVERYTHING = {"drag": "drag chien", "shear_lift": "shear_lift saffman_mei", "rotational_lift": "rotational_lift oesterle_bui_dinh",
              "drag_torque": "drag_torque dennis", "pressure_gradient": "pressure_gradient on", "viscous_stress": "viscous_stress on",
              "buoyancy": "buoyancy on"}
ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "WM_PROJECT_DIR": "/usr/share/openfoam"}


class RunFailed(Exception):
    """A program that ended with an error; the text says which and why."""


def run(command, log, folder=None):
    """Output of a program, also kept in `log`, and its CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(word) for word in command], cwd=folder, env={**ENVIRONMENT, **os.environ}, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    pathlib.Path(log).write_text(done.stdout)
    if done.returncode:
        last = [line for line in done.stdout.splitlines() if line.strip()][-1:]
        raise RunFailed(f"{pathlib.Path(str(command[0])).name} ended with status {done.returncode}: {' '.join(last)} (see {log})")
    return done.stdout, after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def nanoseconds(text):
    """Sum over the effects of the last line 'ns per particle and step', 0 if there is none."""
    lines = re.findall(r"ns per particle and step:(.*);", text)
    return sum(float(number) for number in re.findall(r" ([0-9.]+)(?:,|$)", lines[-1])) if lines else 0.0


def closures(text):
    """How many closures each particle and step evaluates at the end of a run."""
    return int(re.findall(r"evaluates (\d+) closures", text)[-1])


def verdicts(text):
    """{effect: (share that decides, ns, stays on)} of the last table of a screen."""
    table = text[text.rindex("screen: "):]
    rows = re.findall(r"^  (\w+)(?: \w+)? +(?:[0-9.e+-]+ +){6}([0-9.e+-]+) +([0-9.]+) +(stays on|switched off)", table, re.M)
    return {name: (float(share), float(ns), verdict == "stays on") for name, share, ns, verdict in rows}


def left(done, all_of_them, began, now):
    """' , about N s left' after the first run."""
    return f", about {(now - began) * (all_of_them - done) / done:.0f} s left" if done else ""
