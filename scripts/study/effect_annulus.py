# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which effects matter at each inclination and velocity of the annulus section of Table 2, by a screen of all effects."""
from . import runs, screen, section, tables

TOLERANCE = 0.01
INCLINATIONS, VELOCITIES = (0, 40, 80), (0.58, 0.72, 1.165)
SECONDS, LENGTH, CUTTINGS = 1.5, 0.1, 404  # 5 % of a third of the paper's section
STEPS = round(SECONDS / 5e-3) * 64  # of the DEM: cases/tomren-section


def cell(share, stays):
    """A share in percent, bold where the screen keeps it."""
    text = "alone" if share > 1e6 else f"{100 * share:.0f}" if share > 0.0995 else f"{100 * share:.1f}"
    return f"**{text}**" if stays else text


def annulus_job(build, inclination, velocity, seconds):
    words = {"velocity": f"{velocity:g}", "inclination": inclination, "length": LENGTH, "count": CUTTINGS, "cells": "8 32 7", "seconds": seconds,
             "snapshots": seconds, "effects": f'"screen {TOLERANCE:g} screen_steps {round(seconds / 5e-3) * 64 - 1} screen_recheck 0"'}

    def work(folder):
        case, cpu, _ = section.run_case(build, folder, words)
        found = screen.verdicts((case / "log.liggghts").read_text(errors="replace"))
        return {"cpu": cpu, "verdicts": {effect: (share, stays) for effect, (*_, share, _, stays) in found.items()}}

    return runs.Job(f"{inclination} degrees, {velocity:g} m/s", {"what": "effects in the annulus", "case": section.case_digest(), **words}, work, 15)


def study(chosen):
    """Runs the nine points that are not there yet and writes their table."""
    points = [(i, v) for i in INCLINATIONS for v in VELOCITIES] if not chosen.quick else [(INCLINATIONS[0], VELOCITIES[0])]
    jobs = {point: annulus_job(chosen.build, *point, SECONDS if not chosen.quick else 0.1) for point in points}
    found = chosen.store.run_all("annulus", jobs.values())
    if chosen.plan:
        return 0
    shares = {point: result["verdicts"] for point, result in runs.needed(found, jobs).items()}
    names = list(screen.EVERYTHING)
    tables.write_csv(chosen.out / "annulus.csv", ["inclination", "velocity"] + [word for n in names for word in (n, f"{n}_verdict")],
                     [[i, f"{v:g}"] + [word for n in names for word in (f"{row[n][0]:.3e}", "on" if row[n][1] else "off")]
                      for (i, v), row in shares.items()])
    page = tables.markdown(["inclination", "velocity", *(name.replace("_", " ") for name in names)],
                           [[i, f"{v:g} m/s", *(cell(*row[n]) for n in names)] for (i, v), row in shares.items()])
    page += ("\n95 % of all observations lie below this share [%] of the larger of submerged weight and drag (a torque: of all other torques on the "
             f"particle);\nbold: a screen at {100 * TOLERANCE:g} % keeps it. 'alone': no other torque acted.\n")
    (chosen.out / "annulus.md").write_text(page)
    print(page)
    return 0
