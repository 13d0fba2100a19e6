# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of cases/tomren-section: the annulus of Tomren, Iyoho and Azar (1986), periodic along the hole."""
import csv
import math
import re
import shutil

from . import measures, programs, runs, timing
from .levels import dividing_step, shape_key
from .programs import CASES, Failure, digest_of, run

CASE = CASES / "tomren-section"
AREA = math.pi * (0.0635**2 - 0.02413**2)  # of the annulus across the hole [m2]
DIAMETER = 6.35e-3
DENSITY = 2619  # of the cuttings [kg/m3]
BODY_VOLUME = math.pi * DIAMETER**3 / 6
INJECTED = 0.1512 / DENSITY  # the paper's injection as a volume flux [m3/s]
FLUID_STEP = 5e-3
# Of where the cuttings are at the start: primes, none that in.cuttings uses for something else.
SEEDS = (49979687, 67867967, 86028121, 15485867, 32452867, 49979693, 67867979, 86028157, 15485917, 32452883)
# Name of a quantity in annulusReport's summary.csv, with what turns it into SI units.
QUANTITIES = {"flux": ("solid flux", 1e-6), "gradient": ("pressure gradient", 1.0), "height": ("height of the solid's centre", 1e-3),
              "concentration": ("solid concentration", 1e-2), "bed": ("bed height (profile)", 1e-3)}

REPORT = 4  # coupling steps from one row of coupling.csv to the next: with the case's 20 half a second has too few to tell a drift by
DRIFTS = {"flux": "solids_flux", "gradient": "pressure_gradient", "height": "com_y"}  # columns of coupling.csv whose change tells that of a quantity
# Arguments of fix fluid/force: forces of the sphere of equal volume, and of the real shape.
FORCES = {"sphere": "drag chien pressure_gradient on drag_torque dennis",
          "oriented": "drag chien pressure_gradient on drag_torque dennis oriented on strain_torque jeffery pitching_torque dabade"}
FORMS = ("additive", "cross")  # of yield_form


def effects_of(forces, form=FORMS[0]):
    """The arguments of fix fluid/force; the additive form is its default."""
    return FORCES[forces] + (f" yield_form {form}" if form != FORMS[0] else "")


def bodies_at(concentration, length):
    """Bodies that fill a share of the section."""
    return round(concentration * AREA * length / BODY_VOLUME)


def rows_of(case):
    """coupling.csv of a run as rows of numbers."""
    with open(case / "postProcessing" / "eccentra" / "coupling.csv", newline="") as rows:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(rows)]


def run_case(build, folder, words, case="case", source=CASE):
    """Runs a case with options of its `run` (without --); the folder in which it ran, CPU and wall seconds."""
    ran = folder / case
    shutil.rmtree(ran, ignore_errors=True)
    cpu, wall, _ = run([programs.RUN_CASE, source, "--bin", build / "bin", "--output", ran, *programs.options(**words)], folder, folder / "out.txt")
    return ran, cpu, wall


def level_words(level):
    """Options of the case's run for a level of detail."""
    if level.has_shape():
        return {"shape": level.shape}
    if level.kind == "friction":
        return {"mu_shape": level.mu}
    if level.kind == "eccentric":
        return {"shape": level.shape, "clusters": 0, "eccentric": 1}  # in this order: shape alone asks for clusters
    return {}


def steps_per_fluid_step(critical, fluid_step=FLUID_STEP):
    return dividing_step(fluid_step, critical)[1]


def read_summary(path):
    """{quantity: (mean, standard error)} of annulusReport's summary.csv, SI units."""
    with open(path, newline="") as rows:
        found = {row["quantity"]: (float(row["mean"]), float(row["standard_error"])) for row in csv.DictReader(rows)}
    return {name: tuple(v * scale for v in found[title]) for name, (title, scale) in QUANTITIES.items() if title in found}


def estimate_of(words, spheres):
    """CPU seconds that a run may take; rough, for the time left alone."""
    cells = math.prod(int(n) for n in str(words.get("cells", "8 32 20")).split())
    fluid_steps = float(words["seconds"]) / float(words.get("fluid_step", FLUID_STEP)) + 100
    dem_steps = float(words["seconds"]) / float(words.get("fluid_step", FLUID_STEP)) * int(words["interval"])
    return fluid_steps * cells * 2.2e-6 + dem_steps * int(words["count"]) * 2.5e-7 * (1 + 0.7 * (spheres > 1) + 0.03 * spheres) + 1


def case_digest(case=CASE):
    """Of all that the case's files say but to a reader, and of the program that runs them."""
    says = lambda file: file.is_file() and file.suffix not in (".md", ".png") and not file.name.startswith(".")
    files = sorted(file for file in case.rglob("*") if says(file) and not file.relative_to(case).parts[0].startswith("results"))
    return digest_of(programs.RUN_CASE, *files)


def with_tolerances(folder, tolerances):
    """A copy of the case whose last correction of a step solves pressure and velocity to these relTol."""
    copy = folder / "source"
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(CASE, copy)
    file = copy / "system" / "fvSolution"
    text = file.read_text()
    for field, tolerance in zip(("p", "U"), tolerances):
        text, found = re.subn(rf"({field}Final +{{ \${field}; relTol )[^;]+;", rf"\g<1>{tolerance};", text)
        if found != 1:
            raise Failure(f"{file} has no entry {field}Final with one relTol: expected that of {CASE.name}")
    file.write_text(text)
    return copy


def section_job(build, name, words, share=0.5, spheres=1, keep=None, tolerances=None):
    """A run with options of the case's `run` (without --); the result: means over the last `share` of it with their standard
    errors in time and how they drift within it, SI units, the end of the run, time and its parts. `keep`: name under which the case stays in the job's folder;
    `tolerances`: relTol of pressure and velocity in place of the case's."""
    words = {"report": REPORT, **words}
    described = {key: shape_key(value) if key == "shape" else str(value) for key, value in words.items()}
    inputs = {"what": "section", "case": case_digest(), **described, "share": share, **({"keep": keep} if keep else {}),
              **({"tolerances": tolerances} if tolerances else {})}

    def work(folder):
        source = with_tolerances(folder, tolerances) if tolerances else CASE
        case, cpu, wall = run_case(build, folder, words, keep or "case", source)
        run([build / "bin" / "annulusReport", case, "-o", folder, "--share", share, "--no-pictures"], folder, folder / "report.txt")
        rows = rows_of(case)
        last, late = rows[-1], rows[-max(1, round(share * len(rows))):]
        parts = timing.parts_of((case / "log.liggghts").read_text(errors="replace"))
        parts["fluid"] += last["fluid_seconds"]
        parts["link"] = last["exchange_seconds"] + last["link_seconds"]
        drifts = {name: measures.drift([row[column] for row in late]) for name, column in DRIFTS.items()}
        result = {"mean": read_summary(folder / "summary.csv"), "drift": drifts, "bodies": int(last["particles"]),
                  "fastest": last["fastest_particle"], "cpu": cpu, "wall": wall, "parts": timing.scaled(parts, cpu)}
        if not keep:
            shutil.rmtree(case)  # tens of MB; inputs and result stay
        return result

    return runs.Job(name, inputs, work, estimate_of(words, spheres))
