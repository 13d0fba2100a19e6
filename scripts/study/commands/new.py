# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a case of one's own, whose script, mesh and boundary conditions take every number from one file, and says how it was laid out."""
import argparse
import math
import pathlib
import shutil
import sys
import tempfile

from .. import grain_shapes, scene_bed, scene_dry, scene_files, scene_grains, scene_layout, scene_words
from ..annulus_flow import Mud
from ..programs import Failure
from ..scene_words import read
from ..spread import spread_of
from ..units import FLOW, PENETRATION, both

EPILOG = """lengths take m, mm, in, ft; the flow m/s, ft/min (mean velocity) or l/min, gpm, m3/h (volume); densities kg/m3, sg, ppg;
stresses Pa, lbf/100ft2; a number without a unit is SI. Everything can be changed afterwards in the file scene of the case, or for one run
by its options (run --help)."""


KINDS = {"section": "annulus, periodic, filled once", "well": "annulus with cuttings injected at the inlet", "bed": "fluidised bed in a column",
         "heap": "poured on a floor, without a fluid", "drum": "turning drum, without a fluid"}
# What differs between kinds: (diameter, restitution, seconds).
DEFAULTS = {"section": ("6.35mm", "0.9", "3"), "well": ("6.35mm", "0.9", "3"), "bed": ("4mm", "0.9", "1"), "heap": ("6.35mm", "0.4", None),
            "drum": ("6.35mm", "0.6", None)}


FIRST_LOOK = 180  # seconds of computing that a user waits for a first picture


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one sentence."""

    def error(self, message):
        raise Failure(f"{message}; see eccentra new --help")


def parser(kind=None):
    """The command line of a kind of scene, or of all."""
    new = Parser(prog="eccentra new", description=__doc__, epilog=EPILOG, allow_abbrev=False)
    new.add_argument("--ask", action="store_true", help="ask for the main options that are missing; so does a terminal where none is given")
    new.add_argument("kind", choices=KINDS, help="; ".join(f"{name}: {said}" for name, said in KINDS.items()))
    new.add_argument("name", type=pathlib.Path, help="folder of the case; must not exist")
    if kind in (None, "section", "well"):
        annulus_options(new)
    if kind in (None, "bed"):
        bed_options(new, alone=kind is not None)
    if kind in (None, "heap"):
        heap = new.add_argument_group("heap")
        heap.add_argument("--count", default="400", help="grains (default: %(default)s)")
        heap.add_argument("--height", help="of the spout above the floor (default: by the heap)")
    if kind in (None, "drum"):
        drum = new.add_argument_group("drum")
        drum.add_argument("--drum", default="150mm", help="diameter (default: %(default)s)")
        drum.add_argument("--fill", default="0.35", help="part of the drum that is filled, up to 0.6 (default: %(default)s)")
        if kind:
            drum.add_argument("--rpm", default="15", help="(default: %(default)s)")
            drum.add_argument("--length", default="40mm", help="of the slice, which repeats itself along the axis (default: %(default)s)")
    diameter, restitution, seconds = DEFAULTS[kind or "section"]
    grain_options(new, diameter, restitution)
    run = new.add_argument_group("run")
    run.add_argument("--seconds", default=seconds, help="of the run (default: 3 in an annulus, 1 of a bed, else by the scene)")
    if kind in (None, "section", "well"):
        run.add_argument("--cells", help="across the gap, around, along: \"8 32 20\" (default: by the grain and the gap)")
        run.add_argument("--fluid-step", help="[s] (default: by the velocity and the cells)")
        run.add_argument("--interval", help="DEM steps in a fluid step (default: by the critical step)")
    if kind in (None, "heap", "drum"):
        run.add_argument("--step", help="of the DEM [s] (default: by the critical step)")
    run.add_argument("--seed", default="49979687", help="a prime above 10000 (default: %(default)s)")
    run.add_argument("--plan", action="store_true", help="print the layout, write nothing")
    return new


def annulus_options(new):
    """Hole and mud."""
    hole = new.add_argument_group("hole (section, well)")
    hole.add_argument("--hole", default="8.5in", help="diameter (default: %(default)s)")
    hole.add_argument("--pipe", default="5in", help="outer diameter of the pipe (default: %(default)s)")
    hole.add_argument("--eccentricity", default="0.5", help="0 to 0.95 (default: %(default)s)")
    hole.add_argument("--inclination", default="80", help="from the vertical, 0 to 90 degrees (default: %(default)s)")
    hole.add_argument("--rpm", default="50", help="of the pipe (default: %(default)s); of a drum: 15")
    hole.add_argument("--length", help="of the section or the piece of the well (default: 0.3 m, 1.2 m); of a drum: 40mm")
    mud = new.add_argument_group("mud (section, well)")
    mud.add_argument("--flow", default="0.58 m/s", help="mean velocity or volume rate (default: %(default)s)")
    mud.add_argument("--tau0", help="yield stress (default: 0)")
    mud.add_argument("--k", help="consistency, Pa s^n (default: 0.28)")
    mud.add_argument("--n", help="index, 0.1 to 1.5 (default: 0.65)")
    mud.add_argument("--pv", help="plastic viscosity (cP), with --yp, instead of tau0, k and n: a Bingham mud")
    mud.add_argument("--yp", help="yield point (lbf/100ft2)")
    mud.add_argument("--density", default="1000", help="of the mud (default: %(default)s kg/m3); of the fluid of a bed: by --fluid")
    load = new.add_argument_group("cuttings (section, well)")
    load.add_argument("--solid", default="0.05", help="section: part of the volume that cuttings take, up to 0.3 (default: %(default)s)")
    load.add_argument("--rate", help="well: mass rate, or rate of penetration such as 60ft/h (default: 0.1512 kg/s)")


def bed_options(new, alone):
    """Column and fluid of a bed; `alone`: beside no other kind, whose options have the same names."""
    column = new.add_argument_group("bed")
    column.add_argument("--width", default="40mm", help="of the square column (default: %(default)s)")
    column.add_argument("--filling", default="40mm", help="depth of the bed at rest (default: %(default)s)")
    column.add_argument("--fluid", default="water", choices=scene_bed.FLUIDS, help="water or air at 20 degrees (default: %(default)s)")
    if alone:
        column.add_argument("--density", help="of the fluid, instead of that of --fluid")
    column.add_argument("--viscosity", help="of the fluid, instead of that of --fluid")
    column.add_argument("--velocity", default="1.5umf", help="superficial; umf: the onset of fluidisation (default: %(default)s)")
    column.add_argument("--first-velocity", help="superficial at the start; it changes evenly to --velocity (default: the same)")
    column.add_argument("--drag", default="gidaspow", choices=("gidaspow", "di_felice", "wen_yu"), help="law (default: %(default)s)")
    column.add_argument("--wall-friction", help="on walls and floor (default: --friction)")
    column.add_argument("--settling", default="0.4", help="time to pour, without the fluid [s] (default: %(default)s)")


def grain_options(new, diameter, restitution):
    """Of any kind of scene."""
    grain = new.add_argument_group("grains")
    grain.add_argument("--shape", default="sphere",
                       help="sphere, or a shape of clusters or rounded bodies: \"cube 27\", \"disk 19\", \"smooth cube rounding 0.2\", "
                       "\"file grain.clump\", \"grain flake\" (a grain by name, see eccentra grain) (default: %(default)s)")
    grain.add_argument("--diameter", default=diameter, help="of the sphere of equal volume (default: 6.35mm; bed 4mm)")
    grain.add_argument("--spread", help="sizes about --diameter, by mass: \"lognormal 0.3\" (deviation of the logarithm), \"gaussian 0.2\" or "
                       "\"uniform 0.5\" (parts of the diameter), \"sieve FILE\" (default: one size)")
    grain.add_argument("--solid-density", default="2619", help="(default: %(default)s kg/m3)")
    grain.add_argument("--stiffness", default="5e6", help="Young's modulus in the contacts (default: %(default)s Pa)")
    grain.add_argument("--friction", default="0.5", help="0 to 2 (default: %(default)s)")
    grain.add_argument("--restitution", default=restitution, help="0.05 to 1 (default: 0.9; heap 0.4, drum 0.6)")
    grain.add_argument("--rolling", default="0", help="rolling friction (cdt), 0 to 1 (default: %(default)s)")


def mud_of(words):
    """(tau0, k, n) in SI."""
    if (words.pv is None) != (words.yp is None):
        raise Failure("--pv and --yp belong together: give both, or tau0, k and n")
    if words.pv is not None:
        if any(value is not None for value in (words.tau0, words.k, words.n)):
            raise Failure("--pv and --yp stand for tau0, k and n: give the one or the other")
        return read(words, "yp"), read(words, "pv"), 1.0
    for name in ("tau0", "k", "n"):
        setattr(words, name, scene_words.default_of(words, name))
    return read(words, "tau0"), read(words, "k"), read(words, "n")


def wishes(words):
    """What the user wants, in SI, as a Wishes of scene_layout."""
    hole, pipe = read(words, "hole"), read(words, "pipe")
    if pipe >= hole:
        raise Failure(f"--pipe: '{words.pipe}' does not fit into the hole of '{words.hole}'; expected a smaller diameter")
    words.length, words.rate = (scene_words.default_of(words, name) for name in ("length", "rate"))
    speed, kind = read(words, "flow")
    area = 0.25 * scene_layout.PI * (hole**2 - pipe**2)
    density = read(words, "solid-density")
    rate, rate_kind = read(words, "rate")
    tau0, k, n = mud_of(words)
    plain = {name: read(words, name) for name in ("eccentricity", "inclination", "rpm", "length", "diameter", "solid", "stiffness", "friction",
                                                  "restitution", "rolling", "seconds")}
    return scene_layout.Wishes(
        kind=words.kind, hole=0.5 * hole, pipe=0.5 * pipe, velocity=speed / area if kind is FLOW else speed, tau0=tau0, k=k, n=n,
        mud_density=read(words, "density"), shape=words.shape, solid_density=density,
        rate=rate * density * 0.25 * scene_layout.PI * hole**2 if rate_kind is PENETRATION else rate, cells=words.cells, fluid_step=words.fluid_step,
        interval=words.interval, seed=words.seed, spread=words.spread, **plain)


def table(layout):
    """The layout with its reasons, as lines."""
    wish, found = layout.wishes, layout
    lines = [("area of the annulus", f"{found.annulus.area:.4g} m2, {found.annulus.area / 0.3048**2:.4g} ft2", ""),
             ("gap", f"{both('length', found.annulus.widest, 'm')} wide side, {both('length', found.annulus.narrowest, 'm')} narrow side", ""),
             ("mean velocity", both("speed", wish.velocity, "m/s"), f"{both('flow', wish.velocity * found.annulus.area, 'm3/s')}"),
             ("mud", f"tau0 {both('stress', wish.tau0, 'Pa')}, k {wish.k:.4g} Pa s^n, n {wish.n:.4g}",
              f"density {both('density', wish.mud_density, 'kg/m3')}"),
             ("pressure gradient", f"{found.gradient:.4g} Pa/m", "slots of the local width, pipe at rest, no cuttings"),
             ("velocity of the wide side", both("speed", found.wide_speed, "m/s"), f"{found.wide_speed / wish.velocity:.2f} of the mean"),
             ("Reynolds number", f"{found.reynolds_mean:.4g} mean, {found.reynolds_wide:.4g} wide side",
              f"laminar below {found.laminar_limit:.4g} (Dodge and Metzner)")]
    steps = wish.seconds / found.fluid_step
    grain = scene_grains.Grain(wish.shape, wish.diameter, wish.solid_density, wish.stiffness, wish.friction, wish.restitution, wish.rolling, wish.spread)
    form = scene_grains.form_of(grain)
    lines += scene_dry.grain_rows(grain, form)
    mud = Mud(wish.tau0, wish.k, wish.n, wish.mud_density)
    lines.append(("settling velocity", *scene_grains.said_settling(grain, form.sphericity, mud, "chien", "Chien 1994")))
    if wish.tau0 > 0:
        lines.append(("largest grain that the mud holds", f"{1e3 * found.held_diameter:.3g} mm at rest",
                      "Beris et al. 1985: tau0 = 0.0477 (rho_p - rho_f) g d"))
    lines += [("cells", f"{found.cells[0]} x {found.cells[1]} x {found.cells[2]} = {found.number_of_cells}", found.why_cells),
              ("fluid step", f"{found.fluid_step:.4g} s", found.why_fluid_step),
              ("critical DEM step", f"{found.critical_step:.3g} s", "in a bed of such grains that meet at 1 m/s or twice the velocity of the wide side"),
              ("DEM steps in a fluid step", f"{found.interval}",
               f"the DEM step is {found.fluid_step / found.interval / found.critical_step:.2f} of the critical one"),
              ("cuttings", f"{found.count}", found.why_count)]

    settling = scene_grains.settling_speed(grain, form.sphericity, mud, "chien")
    through = wish.length / wish.velocity
    carried = abs(settling) * math.sin(math.radians(wish.inclination)) * through < 0.5 * found.annulus.widest

    def expected(part):
        """Seconds of a part of the run: of a well that fills, cuttings and their time grow with it, until they leave at the other end."""
        count = found.count * (0.5 * part if wish.kind == "well" else 1)
        if wish.kind == "well" and carried:
            count = min(count, found.count / wish.seconds * through)
        return scene_grains.run_time(grain, count, part * steps * found.interval, found.number_of_cells, part * steps)

    lines.append(("expected run time", scene_grains.said_time(expected(1)), f"one core, {steps:.3g} fluid steps; within a factor of three"))
    if expected(1) > 1.5 * FIRST_LOOK:
        parts = [2.0**-k for k in range(1, 20)]
        part = next((part for part in parts if expected(part) <= FIRST_LOOK), parts[-1])
        lines.append(("a first look", f"{scene_grains.said_time(expected(part))} with --seconds {part * wish.seconds:.2g}", "an option of run, too"))
    return lines_of(lines)


def grain_of(words):
    """The grain in SI."""
    plain = {name.replace("-", "_"): read(words, name) for name in ("diameter", "solid-density", "stiffness", "friction", "restitution", "rolling")}
    return scene_grains.Grain(shape=words.shape, spread=words.spread, **plain)


def plan_of(words):
    """The layout of a heap, a drum or a bed."""
    grain = grain_of(words)
    seconds = None if words.seconds is None else read(words, "seconds")
    if words.kind == "heap":
        height = None if words.height is None else read(words, "height")
        return scene_dry.heap(argparse.Namespace(count=read(words, "count"), height=height, seconds=seconds, step=words.step, seed=words.seed), grain)
    if words.kind == "drum":
        return scene_dry.drum(argparse.Namespace(radius=0.5 * read(words, "drum"), length=read(words, "length"), fill=read(words, "fill"),
                                                 rpm=read(words, "rpm"), seconds=seconds, step=words.step, seed=words.seed), grain)
    density, viscosity = scene_bed.FLUIDS[words.fluid]
    if words.density is not None:
        density = read(words, "density")
    if words.viscosity is not None:
        viscosity = read(words, "viscosity")
    return scene_bed.bed(argparse.Namespace(
        width=read(words, "width"), filling=read(words, "filling"), density=density, viscosity=viscosity, velocity=words.velocity,
        first=words.first_velocity, seconds=seconds, settling=read(words, "settling"), law=words.drag,
        wall_friction=grain.friction if words.wall_friction is None else read(words, "wall-friction"), seed=words.seed), grain)


def lines_of(rows):
    """Rows (name, value, reason) as lines; in a narrow terminal the reason has a line of its own."""
    lines = [f"  {name:32} {value:52} {why}".rstrip() for name, value, why in rows]
    if not sys.stdout.isatty() or max(map(len, lines)) <= shutil.get_terminal_size().columns:
        return lines
    return [line for name, value, why in rows for line in (f"  {name:32} {value}", f"      {why}") if line.strip()]


def with_files(shape, folder):
    """The shape with absolute paths of its files, and these files. A grain by name becomes a file in `folder`: grain NAME [rounding R | spheres N]."""
    parts = shape.split()
    if parts[:1] == ["grain"]:
        if len(parts) not in (2, 4) or parts[1] not in grain_shapes.GRAINS or (len(parts) == 4 and parts[2] not in ("rounding", "spheres")):
            raise Failure(f"--shape: '{shape}' is not a grain; expected grain NAME, with 'rounding R' or 'spheres N' behind it, and NAME one of "
                          f"{', '.join(grain_shapes.GRAINS)}")
        file = pathlib.Path(folder) / f"{parts[1]}.stl"
        file.write_text(grain_shapes.stl_of(parts[1], 4e-3))
        parts = ["stl" if parts[2:3] == ["spheres"] else "hull", str(file), *(parts[2:] or ["rounding", "0.1"])]
    if parts[:1] not in (["file"], ["stl"], ["hull"]) or len(parts) < 2 or not pathlib.Path(parts[1]).is_file():
        return shape, []
    file = pathlib.Path(parts[1]).resolve()
    return " ".join([parts[0], str(file), *parts[2:]]), [file]


def main():
    """Lays the scene out, prints it and writes the case."""
    with tempfile.TemporaryDirectory(prefix="eccentra-new-") as folder:
        return new(folder)


def answer(prompt):
    """A line of the user."""
    sys.stdout.write(prompt)
    sys.stdout.flush()
    line = sys.stdin.readline()
    if not line:
        raise Failure("the answers end before the questions; expected one line each, an empty one for what stands in brackets")
    return line


def words_of(arguments):
    """The command line, completed by answers where the user sits at a terminal and gives no option, or wants to be asked."""
    helps = bool({"-h", "--help"} & set(arguments))
    terminal = sys.stdin.isatty() and sys.stdout.isatty() and not helps
    if terminal and not arguments:
        arguments = [answer(f"kind of scene ({', '.join(KINDS)}): ").strip(), answer("folder of the case: ").strip()]
    kind = next((word for word in arguments if word in KINDS), None)
    parsed = parser(None if helps else kind)
    words = parsed.parse_args(arguments)
    asks = words.ask or (terminal and not scene_words.given(arguments) - {"plan"})
    if asks:
        arguments = [word for word in arguments if word != "--ask"]
        arguments += scene_words.ask(words, parsed, arguments, answer)
    return words, [f"--{name} {scene_words.default_of(words, name)}" for name in scene_words.missing(words, arguments)
                   if scene_words.default_of(words, name) and name != "spread"]


def new(folder):
    """With a folder for files of a while."""
    words, defaults = words_of(sys.argv[1:])
    words.shape, files = with_files(words.shape, folder)
    if words.spread is not None:
        words.spread = spread_of(words.spread, read(words, "diameter"))
        words.diameter = f"{words.spread.middle!r}"
        words.shape = "sphere 1" if words.shape == "sphere" else words.shape  # sizes are those of a template of clusters
        if words.spread.file:  # runs copy files of this name
            file = pathlib.Path(shutil.copy(words.spread.file, pathlib.Path(folder) / "sizes.sieve"))
            words.spread = words.spread._replace(words=f"sieve {file}")
            files.append(file)
    if words.kind in ("section", "well"):
        layout = scene_layout.lay_out(wishes(words))
        lines, warnings = table(layout), layout.warnings
    else:
        layout = plan_of(words)
        lines, warnings = lines_of(layout.rows), layout.warnings
    sys.stdout.write("\n".join(lines) + "\n")
    if defaults:
        sys.stdout.write(f"  by default: {', '.join(defaults)}\n")
    for warning in warnings:
        sys.stdout.write(f"warning: {warning}\n")
    if not words.plan:
        if words.kind in ("section", "well"):
            scene_files.write(layout, words.name, files)
        else:
            scene_files.write_plan(layout, words.name, files, words.spread)
        sys.stdout.write(f"the case is in {words.name}; its numbers are in {words.name / 'scene'}. Run it: {words.name / 'run'} --output FOLDER; "
                         "draw it: eccentra report FOLDER\n")
    return 0
