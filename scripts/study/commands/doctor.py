# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks this installation: programs, hosts, MPI, a short DEM run, a mesh, a picture; exit status 1 if something is missing."""
import argparse
import os
import pathlib
import shutil
import subprocess
import tempfile

from .. import programs

OURS = ("eccentra-dem", "annulusMesh", "annulusFoam", "annulusReport", "clusterShape", "eccentra-run")
OF_OPENFOAM = ("decomposePar", "reconstructPar", "foamDictionary")
FALL = """atom_style granular
boundary f f f
newton off
communicate single vel yes
units si
region box block 0 1 0 1 0 1 units box
create_box 1 box
neighbor 0.01 bin
fix m1 all property/global youngsModulus peratomtype 5e6
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.9
fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
pair_style gran/cluster model hertz tangential history
pair_coeff * *
timestep 1e-5
create_atoms 1 single 0.5 0.5 0.9 units box
set group all diameter 0.01 density 2500
fix move all nve/cluster
run 10
"""


class Trouble(Exception):
    """What is wrong, and what to do."""


def said(words, folder):
    """What a program prints; Trouble with its last words if it fails or is not there."""
    try:
        done = subprocess.run([str(word) for word in words], cwd=folder, env=programs.environment(), capture_output=True, text=True, check=False, timeout=120)
    except OSError as error:
        raise Trouble(f"{words[0]}: {error.strerror}") from None
    except subprocess.TimeoutExpired:
        raise Trouble(f"{words[0]} has not ended after two minutes") from None
    if done.returncode:
        last = (done.stderr.strip() or done.stdout.strip() or "without a word").splitlines()[-1]
        raise Trouble(f"{pathlib.Path(str(words[0])).name} ended with status {done.returncode}: {last}")
    return done.stdout


def our_programs(folder):
    """Our programs are there and start."""
    for name in OURS:
        said([programs.BUILD / "bin" / name, "--help"], folder)
    return f"{said([programs.BUILD / 'bin' / 'eccentra-dem', '--version'], folder).splitlines()[0]} in {programs.BUILD}"


def openfoam(_folder):
    """OpenFOAM's tools and its folder."""
    place = programs.environment()["WM_PROJECT_DIR"]
    if not (pathlib.Path(place) / "etc" / "controlDict").is_file():
        raise Trouble(f"WM_PROJECT_DIR '{place}' has no etc/controlDict: unset it, or install OpenFOAM (Debian: openfoam)")
    missing = [name for name in OF_OPENFOAM if not shutil.which(name)]
    if missing:
        raise Trouble(f"{missing[0]} is not in the PATH: install OpenFOAM (Debian: openfoam)")
    return place


def mpi(folder):
    """Two ranks start and end."""
    said(["mpirun", "--oversubscribe", "--bind-to", "none", "-np", "2", "true"], folder)
    return said(["mpirun", "--version"], folder).splitlines()[0]


def dem(folder):
    """A sphere falls for ten steps under gran/cluster, on two ranks."""
    (folder / "in.fall").write_text(FALL)
    said(["mpirun", "--oversubscribe", "--bind-to", "none", "-np", "2", programs.BUILD / "bin" / "eccentra-dem", "-in", "in.fall", "-log", "none"], folder)
    return "10 steps on 2 ranks"


def mesh(folder):
    """annulusMesh makes the mesh of the shipped section."""
    for part in ("system", "constant", "0"):
        shutil.copytree(programs.CASES / "tomren-section" / part, folder / part)
    said([programs.BUILD / "bin" / "annulusMesh"], folder)
    return "cases/tomren-section"


def picture(folder):
    """A shape is drawn off screen."""
    said([programs.BUILD / "bin" / "clusterShape", "cube", "8", "--diameter", "1e-3", "--png", folder / "cube.png"], folder)
    size = (folder / "cube.png").stat().st_size
    return f"clusterShape --png, {size} bytes"


def charts(_folder):
    """matplotlib, which draws charts."""
    try:
        import matplotlib
    except ImportError:
        raise Trouble("python3 has no matplotlib: install it (Debian: python3-matplotlib)") from None
    return f"matplotlib {matplotlib.__version__}"


def room(_folder):
    """Space where results go."""
    free = shutil.disk_usage(pathlib.Path.cwd()).free / 1e9
    if free < 1:
        raise Trouble(f"{os.getcwd()} has {free:.1f} GB free: a run of the demo takes some 0.2 GB, a study 1 GB or more")
    return f"{free:.0f} GB free in {os.getcwd()}"


CHECKS = {"programs": our_programs, "OpenFOAM": openfoam, "MPI": mpi, "DEM": dem, "mesh": mesh, "picture": picture, "charts": charts, "space": room}


def main():
    """Runs all checks; 1 if one of them failed."""
    argparse.ArgumentParser(prog="eccentra doctor", description=__doc__).parse_args()
    failed = 0
    for name, check in CHECKS.items():
        with tempfile.TemporaryDirectory(prefix="eccentra-doctor-") as folder:
            try:
                print(f"{name:10} ok      {check(pathlib.Path(folder))}", flush=True)
            except (Trouble, programs.Failure, OSError) as problem:
                failed += 1
                print(f"{name:10} FAILED  {problem}", flush=True)
    return 1 if failed else 0
