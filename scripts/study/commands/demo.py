# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs drill cuttings in an eccentric annulus of mud, several scenes at a time, and shows what came out."""
import os
import subprocess
import sys

from .. import options, programs, runs, section
from ..programs import ROOT

# Options of cases/tomren-section/run for each scene, and its estimated seconds of one core.
SLOW = {"seconds": 4, "velocity": 1.165, "count": 242}  # 1 % of solid
SCENES = {
    "vertical": ({"inclination": 0, "seconds": 2}, 20),
    "spheres": ({"seconds": 3}, 25),
    "cubes": ({"seconds": 3, "clusters": 1}, 45),  # of eight spheres: the default shape
    **{f"rolling-{mu}": ({**SLOW, "mu_shape": mu}, 25) for mu in ("0", "0.32", "0.95")},  # sphere, cube and disk
}
REPORTS = {
    "beds": ("Cuttings carried in a vertical hole, and the beds that spheres and cubes form at 80 degrees", ("vertical", "spheres", "cubes")),
    "rolling": ("What shape carried as rolling friction changes in a dilute stream: mu_shape 0, 0.32 (cubes), 0.95 (disks)",
                ("rolling-0", "rolling-0.32", "rolling-0.95")),
}


def scene_job(build, name, quick):
    """A scene; it stays in the folder of its run."""
    words, estimate = SCENES[name]
    if quick:
        words = {**words, "seconds": 0.05, "snapshots": 0.05, "count": 50, "run-in": 2}

    def work(folder):
        case, cpu, wall = section.run_case(build, folder, words, name)
        (case / f"{name}.foam").touch()  # ParaView opens it
        return {"cpu": cpu, "wall": wall}

    return runs.Job(name, {"what": "demo", "name": name, "case": section.case_digest(), **words}, work, estimate)


def main():
    parser = options.Parser("demo", "Sets up (scripts/setup), builds, runs drill cuttings in an eccentric annulus of mud, some scenes at a time, and "
                            "prints tables; pictures, charts and CSV go to the folders beds and rolling among the results.",
                            "a twentieth of a second of few cuttings: whether all of it works")
    parser.add_argument("--scenes", action=options.Words, choices=list(SCENES), default=list(SCENES), metavar="NAME",
                        help=f"some of: {', '.join(SCENES)} (default: all)")
    parser.add_argument("--skip-setup", action="store_true", help="the build is there and up to date")

    def check(chosen):
        if not programs.INSTALLED and not chosen.skip_setup and not chosen.show and not chosen.plan:
            targets = [word for name in ("eccentra", "annulusMesh", "annulusFoam", "annulusReport") for word in ("--target", name)]
            if subprocess.run([ROOT / "scripts" / "setup", *targets], check=False).returncode:
                raise programs.Failure("the setup failed: see above")
        programs.need(chosen.build, "bin/annulusFoam", "bin/annulusMesh", "bin/annulusReport")

    chosen = parser.settle((), check)
    jobs = {name: scene_job(chosen.build, name, chosen.quick) for name in chosen.scenes}
    found = chosen.store.run_all("demo", jobs.values())
    if chosen.plan:
        return 0
    runs.needed(found, jobs)
    for name, job in jobs.items():
        link = chosen.out / name
        link.unlink(missing_ok=True)
        link.symlink_to(os.path.relpath(chosen.store.folder_of(job) / name, chosen.out))
    for folder, (title, names) in REPORTS.items():
        cases = [chosen.out / name for name in names if name in jobs]
        if cases:
            print(f"\n{title}", flush=True)
            line = [chosen.build / "bin" / "annulusReport", *cases, "-o", chosen.out / folder, "--html"]
            if subprocess.run([str(word) for word in line], env=programs.environment(), check=False).returncode:
                raise programs.Failure(f"annulusReport failed on {folder}: see above")
    sys.stdout.write(f"""
Pictures: {chosen.out}/beds/beds.png, {chosen.out}/rolling/beds.png; charts: charts.png beside them; one page each: report.html.
ParaView opens the mesh and flow of a scene (any of {chosen.out}/*/*.foam) and its particles (postProcessing/eccentra/*.vtk, *.vtp).
""")
    return 0
