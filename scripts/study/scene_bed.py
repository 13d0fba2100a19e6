# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A fluidised bed, from what a user wants to numbers with their reasons: a square column, a porous floor, water or air from below."""
import math
import re
import typing

from . import scene_grains
from .annulus_flow import Mud, bisect
from .programs import Failure
from .scene_dry import PACKING, Plan, grain_rows
from .scene_grains import GRAVITY
from .scene_layout import COURANT, SAFETY, critical_step
from .units import SPEED, positive

FLUIDS = {"water": (998.0, 1.0e-3), "air": (1.2, 1.8e-5)}  # density [kg/m3], viscosity [Pa s], at 20 degrees Celsius
LARGEST_STEP = 2e-3  # [s], of the fluid
CELL = 1.6  # grains across a cell, about: wider cells smear the floor and the top of the bed
ENTRY = 4  # cells of fluid alone below the floor


class Packed(typing.NamedTuple):
    """A bed at rest: fluid fraction, grain diameter (equal volume) [m], sphericity, viscosity [Pa s], density [kg/m3]."""
    fraction: float
    diameter: float
    sphericity: float
    viscosity: float
    density: float

    def gradient(self, speed):
        """Pressure gradient [Pa/m] at a superficial velocity [m/s] (Ergun 1952)."""
        solid, size = 1 - self.fraction, self.sphericity * self.diameter
        return 150 * self.viscosity * solid**2 * speed / (self.fraction**3 * size**2) + 1.75 * self.density * solid * speed**2 / (self.fraction**3 * size)

    def onset(self, solid_density):
        """Superficial velocity [m/s] at which Ergun's gradient carries the bed."""
        weight = (1 - self.fraction) * (solid_density - self.density) * GRAVITY
        return bisect(lambda speed: self.gradient(speed) - weight, 1e-9, 1e3)


def velocity_of(what, text, onset):
    """A superficial velocity [m/s]: with a unit, or as a multiple of the onset, such as 1.5umf."""
    match = re.fullmatch(r"\s*(\d+\.?\d*|\.\d+)\s*umf\s*", text)
    if match and float(match.group(1)) > 0:
        return float(match.group(1)) * onset
    return positive(what, text, SPEED)[0]


def cells_of(wish, diameter):
    """(across, along, height of a cell): along counts the whole column, from below the floor."""
    across = max(round(wish.width / (CELL * diameter)), 3)
    size = wish.width / across
    along = ENTRY + math.ceil(max(3 * wish.filling, wish.filling + 12 * diameter) / size)
    return across, along, size


def fluid_step_of(speed, size):
    """[s]: COURANT at the velocity between the grains of a packed bed, in 1, 2, 5; and the Courant number."""
    between = speed / (1 - PACKING)
    step = min(LARGEST_STEP, COURANT * size / between)
    digit = 10.0 ** math.floor(math.log10(step))
    step = next(m * digit for m in (5, 2, 1) if m * digit <= step * (1 + 1e-9))
    return step, step * between / size


def bed(wish, grain):
    """The bed. wish: width, filling, density, viscosity, velocity, first (texts), seconds, settling, wall_friction, seed, law."""
    form = scene_grains.form_of(grain)
    if wish.width < 6 * form.bounding_radius:
        raise Failure(f"--width: a column of {wish.width:.4g} m does not hold grains of {2 * form.bounding_radius:.3g} m; "
                      f"expected at least {6 * form.bounding_radius:.3g} m")
    if grain.solid_density <= wish.density:
        raise Failure(f"--solid-density: '{grain.solid_density:g}' is not above that of the fluid, {wish.density:g} kg/m3; expected grains that sink")
    packed = Packed(1 - PACKING, grain.diameter, form.sphericity, wish.viscosity, wish.density)
    onset = packed.onset(grain.solid_density)
    last = velocity_of("velocity", wish.velocity, onset)
    first = last if wish.first is None else velocity_of("first-velocity", wish.first, onset)
    fluid = Mud(0.0, wish.viscosity, 1.0, wish.density)
    terminal = scene_grains.settling_speed(grain, form.sphericity, fluid, "haider_levenspiel")
    count = max(round(wish.filling * wish.width**2 * PACKING / grain.volume), 1)
    excess = count * grain.volume * (grain.solid_density - wish.density) * GRAVITY / wish.width**2
    across, along, size = cells_of(wish, grain.diameter)
    fluid_step, courant = fluid_step_of(max(first, last), size)
    speed = max(0.5, 2 * max(first, last))
    critical = critical_step(grain, speed)
    interval = math.ceil(fluid_step / (SAFETY * critical))
    settling = wish.settling
    steps = (wish.seconds + settling) / fluid_step * interval
    cells = across * across * along
    seconds = scene_grains.run_time(grain, count, steps, cells, wish.seconds / fluid_step)
    entries = [("width", wish.width, "of the square column [m]"), ("entry", ENTRY * size, "of fluid alone below the floor, which lies at z = 0 [m]"),
               ("height", (along - ENTRY) * size, "of the column above the floor [m]"), None,
               ("fluidDensity", wish.density, "[kg/m3]"), ("fluidViscosity", wish.viscosity, "[Pa s]"),
               ("velocityFirst", float(f"{first:.4g}"), "superficial, at the start [m/s]"),
               ("velocityLast", float(f"{last:.4g}"), "and at the end; in between it changes evenly [m/s]"), None,
               *scene_grains.entries(grain), ("sphericity", float(f"{form.sphericity:.5g}"), "of the shape; only the comparison with Ergun reads it"),
               ("wallFriction", wish.wall_friction, "on the walls and the floor"),
               ("effects", f'"drag {wish.law} pressure_gradient on"', "docs/fix_fluid_force.md"), ("count", count, "grains"),
               ("settling", settling, "time to fall and settle, before the fluid flows [s]"), ("seed", wish.seed, "a prime above 10000"), None,
               ("seconds", wish.seconds, "of the coupled run"), ("fluid_step", fluid_step, "[s]"), ("interval", interval, "DEM steps in a fluid step"),
               ("snapshots", 0.05, "time between two pictures [s]"), ("safety", 0.9, "part of the critical DEM step beyond which a run stops"),
               ("cellsAcross", across, ""), ("cellsAlong", along, "")]
    rows = [*grain_rows(grain, form),
            ("settling velocity", *scene_grains.said_settling(grain, form.sphericity, fluid, "haider_levenspiel", "Haider and Levenspiel 1989")),
            ("onset of fluidisation", f"{onset:.4g} m/s", f"superficial, Ergun 1952 at a fluid fraction of {packed.fraction:.2f}"),
            ("velocity", f"{first:.4g} to {last:.4g} m/s" if first != last else f"{last:.4g} m/s", f"{last / onset:.3g} of the onset"),
            ("grains", f"{count}", f"{1e3 * wish.filling:.4g} mm deep, {100 * PACKING:.0f} % solid"),
            ("pressure drop of the weight", f"{excess:.4g} Pa", "without the weight of the fluid; a fluidised bed has this one"),
            ("cells", f"{across} x {across} x {along} = {cells}", f"{size / grain.diameter:.2g} grains across, {ENTRY} of them below the floor"),
            ("fluid step", f"{fluid_step:.4g} s", f"Courant number {courant:.2f} between the grains (at most {COURANT}), at most {1e3 * LARGEST_STEP:g} ms"),
            ("critical DEM step", f"{critical:.3g} s", f"in a bed of such grains that meet at {speed:.3g} m/s"),
            ("DEM steps in a fluid step", f"{interval}", f"the DEM step is {fluid_step / interval / critical:.2f} of the critical one (at most {SAFETY})"),
            ("expected run time", scene_grains.said_time(seconds), f"one core, {count} grains, {cells} cells; within a factor of three")]
    warnings = []
    if max(first, last) > terminal:
        warnings.append("the fluid is faster than a grain settles: the bed is carried to the screen at the top")
    if max(first, last) < onset:
        warnings.append("the velocity is below the onset: the bed stays packed")
    if wish.width < 20 * form.bounding_radius:
        warnings.append(f"the column is {wish.width / (2 * form.bounding_radius):.2g} grains wide: its walls loosen the packing")
    if size < 1.2 * grain.diameter:
        warnings.append(f"cells are {size / grain.diameter:.2g} grains across: void fractions are spread over three grains")
    return Plan("bed", entries, rows, warnings)
