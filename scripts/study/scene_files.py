# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the files of a case that was laid out: the scene, and what reads it."""
import contextlib
import os
import pathlib
import shutil

from .programs import BUILD, CASES, SCENES, Failure
from .scene_grains import sizes_row

HEADER = """// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// All numbers of this case: the DEM script and, with a fluid, the mesh and the boundary conditions read them here. SI units.
"""
CYCLIC = ("inlet  { type cyclic; }", "outlet { type cyclic; }")
ENDS = {"section": {"U": CYCLIC, "p": CYCLIC},
        "well": {"U": ("inlet  { type interstitialInletVelocity; inletVelocity uniform (0 0 $:scene.velocity); value uniform (0 0 $:scene.velocity); }",
                       "outlet { type inletOutlet; inletValue uniform (0 0 0); value uniform (0 0 $:scene.velocity); }"),
                 "p": ("inlet  { type zeroGradient; }", "outlet { type fixedValue; value uniform 0; }")}}
TITLES = {"section": "Cuttings in a periodic section of an annulus.", "well": "Cuttings injected into an annulus.",
          "heap": "Grains poured on a floor.", "drum": "Grains in a drum that turns about its horizontal axis.",
          "bed": "Grains on a porous floor, through which a fluid rises."}


def entries(layout):
    """(name, value, what it is) of the scene; None for an empty line."""
    wish = layout.wishes
    rows = [("holeRadius", wish.hole, "[m]"), ("pipeRadius", wish.pipe, "[m]"), ("eccentricity", wish.eccentricity, "offset of the pipe's axis over the gap"),
            ("length", wish.length, "[m]"), ("inclination", wish.inclination, "from the vertical [degrees]"), ("rpm", wish.rpm, "of the pipe"),
            ("ends", "periodic" if wish.kind == "section" else "inletOutlet", "of the mesh"), None,
            ("velocity", wish.velocity, "mean [m/s]"), ("tau0", wish.tau0, "yield stress [Pa]"), ("k", wish.k, "consistency [Pa s^n]"), ("n", wish.n, "index"),
            ("mudDensity", wish.mud_density, "[kg/m3]"), ("largestViscosity", largest_viscosity(layout), "of mud at rest [Pa s] (docs/rheology.md)"), None,
            ("clusters", 0 if wish.shape == "sphere" else 1, "1: clusters of the shape; 0: spheres"),
            ("shape", f'"{"cube 8" if wish.shape == "sphere" else wish.shape}"', "as in fix particletemplate/cluster"),
            ("diameter", wish.diameter, "of the sphere of equal volume [m]"), *sizes_row(wish.spread), ("solidDensity", wish.solid_density, "[kg/m3]"),
            ("youngsModulus", wish.stiffness, "[Pa]"), ("friction", wish.friction, ""), ("restitution", wish.restitution, ""),
            ("rolling", wish.rolling, "rolling friction (cdt)"), ("effects", '"drag chien pressure_gradient on"', "docs/fix_fluid_force.md"),
            ("seed", wish.seed, "of where grains appear: a prime above 10000")]
    if wish.kind == "section":
        rows += [("count", layout.count, "grains in the section"), ("pouring", 0.5 if wish.solid > 0.12 else 0, "time to pour in what has no room at once [s]"),
                 ("initialGradient", layout.gradient, "first guess of the pressure gradient [Pa/m]")]
    else:
        rows += [("rate", wish.rate, "injected solid [kg/s]"),
                 ("entryLength", round(max(10 * wish.diameter, 0.05), 4), "where grains appear, from the inlet on [m]")]
    rows += [None, ("seconds", wish.seconds, "of the coupled run"), ("fluid_step", layout.fluid_step, "[s]"),
             ("interval", layout.interval, "DEM steps in a fluid step"),
             ("runInStep", 0.05, "step of the fluid alone, before the grains come [s]"), ("snapshots", 0.1, "time between two pictures [s]"),
             ("safety", 0.9, "part of the critical DEM step beyond which a run stops"),
             ("cellsAcross", layout.cells[0], ""), ("cellsAround", layout.cells[1], ""), ("cellsAlong", layout.cells[2], "")]
    return rows


def largest_viscosity(layout):
    """1000 times that of the mean flow at the wall: below, creeping plugs; above, slow solvers (docs/rheology.md)."""
    wish = layout.wishes
    rate = 8 * wish.velocity / layout.annulus.hydraulic_diameter
    return float(f"{max(1000 * (wish.tau0 / rate + wish.k * rate**(wish.n - 1)), 10):.1g}")


def scene_text(rows):
    """The file scene, of its rows (name, value, what it is)."""
    lines = [HEADER]
    for row in rows:
        if row is None:
            lines.append("")
            continue
        name, value, what = row
        shown = f"{value:.10g}" if isinstance(value, float) else str(value)
        lines.append(f"{name:18}{shown + ';':32} {'// ' + what if what else ''}".rstrip())
    return "\n".join(lines) + "\n"


def part(name):
    """A part of the DEM script; the licence stands in its head alone."""
    text = (SCENES / "new" / f"{name}.in").read_text()
    return text if name in ("head", "dry_head") else "".join(line for line in text.splitlines(keepends=True) if not line.startswith("# SPDX-"))


def with_sizes(text, spread):
    """The script whose template reads the distribution of the scene."""
    return text.replace("diameter ${diameter}", "diameter ${sizes}") if spread else text


def script_text(kind):
    """The DEM script, put together from its parts."""
    text = part("head").replace("@TITLE@", TITLES[kind]).replace("@END@", "p" if kind == "section" else "f") + part(kind)
    return text.replace("@WALLS@\n", part("walls") + "\n").replace("@GRAINS@\n", part("grains")) + part("tail")


@contextlib.contextmanager
def draft_of(folder):
    """A folder to fill, which gets its name when it is whole."""
    folder = pathlib.Path(folder)
    if os.path.lexists(folder):
        raise Failure(f"'{folder}' exists already: give another name")
    draft = folder.with_name(f"{folder.name}.draft-{os.getpid()}")
    try:
        yield draft
        shutil.copy(CASES / "tomren-section" / "run", draft)
        (draft / ".eccentra-bin").write_text(f"{BUILD / 'bin'}\n")
        os.rename(draft, folder)
    except OSError as problem:
        raise Failure(f"'{folder}' cannot be made ({problem.strerror}): give another folder") from None
    finally:
        shutil.rmtree(draft, ignore_errors=True)


def write_scene(rows, files, draft):
    """The file scene, and beside it the files that the shape names."""
    text = scene_text(rows)
    for file in files:
        shutil.copy(file, draft)
        text = text.replace(str(file), file.name)
    (draft / "scene").write_text(text)


def copy_system(case, draft):
    """Schemes and solvers of a case that is shipped."""
    for name in ("fvSchemes", "fvSolution", "decomposeParDict"):
        shutil.copy(CASES / case / "system" / name, draft / "system")


def write(layout, folder, files=()):
    """Makes the folder of a section or a well; files: that the shape names, by absolute paths."""
    kind = layout.wishes.kind
    with draft_of(folder) as draft:
        shutil.copytree(SCENES / "new" / "fluid", draft)
        for field, lines in ENDS[kind].items():
            path = draft / "0" / field
            path.write_text(path.read_text().replace("@ENDS@", "\n    ".join(lines)))
        copy_system("tomren-section" if kind == "section" else "tomren-injection", draft)
        if kind == "well":
            (draft / "constant" / "flowProperties").unlink()
            coupling = draft / "constant" / "couplingProperties"
            # A hole without grains has no mean diameter to take the length from.
            coupling.write_text(coupling.read_text().replace("diffusion;\n", "diffusion;\nlength          #eval{ 3 * $:scene.diameter };\n"))
        write_scene(entries(layout), files, draft)
        (draft / "in.cuttings").write_text(with_sizes(script_text(kind), layout.wishes.spread))


def plan_script(kind):
    """The DEM script of a heap, a drum or a bed."""
    text = part("dry_head").replace("@TITLE@", TITLES[kind]).replace("@BOUNDARY@", "f p f" if kind == "drum" else "f f f")
    if kind == "bed":
        text = text.replace("scene           scene\n", "scene           scene\nvariable        step equal ${fluid_step}/${interval}\n")
    text = text.replace("@BOX@\n", part(f"{kind}_box")).replace("@MATERIALS@\n", part("materials"))
    return text + part(kind).replace("@GRAINS@\n", part("grains")).replace("@OUTPUT@\n", part("output"))


def write_plan(plan, folder, files=(), spread=None):
    """Makes the folder of a heap, a drum or a bed; files: that shape and spread name, by absolute paths."""
    with draft_of(folder) as draft:
        if plan.kind == "bed":
            shutil.copytree(SCENES / "new" / "bed", draft)
            shutil.copy(SCENES / "new" / "fluid" / "system" / "controlDict", draft / "system")
            copy_system("tomren-section", draft)
        else:
            draft.mkdir()
        write_scene(plan.entries, files, draft)
        (draft / f"in.{plan.kind}").write_text(with_sizes(plan_script(plan.kind), spread))
