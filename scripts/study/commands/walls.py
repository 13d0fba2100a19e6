# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the walls of a DEM script from the patches of an OpenFOAM mesh: planes, cylinders, or triangle meshes with their STL files."""
import argparse
import pathlib
import re
import sys
import tempfile

from .. import patch_walls, programs
from ..programs import Failure

MODEL = "model hertz tangential history"


def parser():
    """The command line."""
    words = argparse.ArgumentParser(prog="eccentra walls", description=__doc__, allow_abbrev=False,
                                    epilog="In the script: include walls.in, behind pair_coeff and before the first run.")
    words.add_argument("case", type=pathlib.Path, help="folder of a case whose mesh is made (constant/polyMesh)")
    words.add_argument("-o", "--output", type=pathlib.Path, metavar="FILE", help="lines for the script (default: CASE/walls.in); the STL files lie beside it")
    words.add_argument("--patches", nargs="+", metavar="NAME", help="these alone (default: all of type wall)")
    words.add_argument("--type", default="1", metavar="T", help="atom type of the walls' material (default: %(default)s)")
    words.add_argument("--model", default=MODEL, help="contact model, as in fix wall/gran/cluster (default: '%(default)s')")
    words.add_argument("--stl", action="store_true", help="triangle meshes for planes and cylinders, too")
    return words


def patches_of(case):
    """{name: type} of the mesh."""
    file = case / "constant" / "polyMesh" / "boundary"
    try:
        text = file.read_text(errors="replace")
    except OSError:
        raise Failure(f"{file}: cannot be read: make the mesh first (blockMesh, snappyHexMesh), or give the folder of a case") from None
    found = dict(re.findall(r"^\s*(\w[\w.:-]*)\s*\{[^}]*?\btype\s+(\w+)\s*;", text.partition("(")[2], re.MULTILINE))
    if not found:
        raise Failure(f"{file}: no patches in it; expected those of a mesh")
    return found


def chosen(case, names):
    """The patches that become walls."""
    patches = patches_of(case)
    if not names:
        walls = [name for name, kind in patches.items() if kind == "wall"]
        if not walls:
            raise Failure(f"'{case}' has no patch of type wall, but {', '.join(patches)}: name some by --patches")
        return walls
    for name in names:
        if name not in patches:
            raise Failure(f"--patches: '{name}' is not a patch of '{case}'; expected some of {', '.join(patches)}")
    return names


def surfaces_of(case):
    """All patches of the mesh as triangles, by surfaceMeshExtract of OpenFOAM."""
    with tempfile.TemporaryDirectory(prefix="eccentra-walls-") as folder:
        file = pathlib.Path(folder) / "all.stl"
        log = pathlib.Path(folder) / "log"
        try:
            programs.run(["surfaceMeshExtract", "-case", case.resolve(), "-constant", file], case, log)
        except programs.RunFailed as failure:
            raise Failure(f"surfaceMeshExtract cannot read the mesh of '{case}': {failure}") from None
        # The name has the time where the case has a folder 0.
        written = sorted(pathlib.Path(folder).glob("all*.stl"))
        if not written:
            raise Failure(f"surfaceMeshExtract has written nothing of the mesh of '{case}': make the mesh first (blockMesh, snappyHexMesh)")
        return patch_walls.read_stl(written[0].read_text())


def lines_of(word, wall, options, stl):
    """What stands in the script for a wall, and what is said of it."""
    head = f"fix {word} all wall/gran/cluster {options.model}"
    if isinstance(wall, patch_walls.Plane):
        numbers = " ".join(f"{round(c, 12) + 0.0:.10g}" for c in (*wall.point, *wall.normal))
        return [f"{head} primitive type {options.type} plane {numbers}"], "plane"
    if isinstance(wall, patch_walls.Cylinder):
        centre = " ".join(f"{round(c, 12) + 0.0:.10g}" for c in wall.centre)
        return [f"{head} primitive type {options.type} {'xyz'[wall.direction]}cylinder {wall.radius:.10g} {centre}"], \
            f"cylinder along {'xyz'[wall.direction]}, radius {wall.radius:.6g} m"
    return [f"fix {word}_mesh all mesh/surface file {stl} type {options.type}", f"{head} mesh n_meshes 1 meshes {word}_mesh"], \
        f"mesh of {len(wall.triangles)} triangles, {stl}"


def main():
    """Writes the lines and the STL files."""
    options = parser().parse_args()
    if not re.fullmatch("[1-9][0-9]*", options.type):
        raise Failure(f"--type: '{options.type}' is not an atom type; expected a whole number from 1 on")
    names = chosen(options.case, options.patches)
    surfaces = surfaces_of(options.case)
    size = patch_walls.size_of(surfaces)
    file = options.output or options.case / "walls.in"
    lines = ["# SPDX-FileCopyrightText: Eccentra contributors", "# SPDX-License-Identifier: GPL-3.0-or-later",
             "# Walls of the mesh's patches, by eccentra walls"]
    meshes = {}
    for name in names:
        surface = next((s for s in surfaces if s.name == name and s.triangles), None)
        if surface is None:
            sys.stdout.write(f"  {name:20} no faces\n")
            continue
        walls = [patch_walls.Meshed(surface.triangles)] if options.stl else patch_walls.walls_of(surface, surfaces, size)
        stl, word = f"{name}.stl", re.sub(r"\W", "_", name)
        for number, wall in enumerate(walls, 1):
            more, said = lines_of(word if len(walls) == 1 else f"{word}_{number}", wall, options, stl)
            lines += more
            if isinstance(wall, patch_walls.Meshed):
                meshes[file.parent / stl] = patch_walls.stl_text(surface)
            sys.stdout.write(f"  {name:20} {said}\n")
    programs.write_output({file: "\n".join(lines) + "\n", **meshes})
    return 0
