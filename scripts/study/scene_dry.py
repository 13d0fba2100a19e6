# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes without a fluid, from what a user wants to numbers with their reasons: a heap and a drum."""
import math
import typing

from . import scene_grains
from .programs import Failure
from .scene_grains import GRAVITY
from .scene_layout import SAFETY, critical_step
from .units import INCH, both

PACKING = 0.55  # of a heap or a filling at rest
HEAP_ANGLE = 25.0  # degrees; what cubes and disks of friction 0.5 come to within some degrees
POURING_SHARE = 0.07  # of the spout's volume that falling grains take
# Froude numbers omega^2 R/g at which a drum changes its way to move (Mellmann 2001).
REGIMES = ((1e-4, "slips or slumps"), (1e-2, "rolls"), (0.1, "cascades"), (1.0, "cataracts"), (math.inf, "centrifuges"))


class Plan(typing.NamedTuple):
    """A case before it is written. entries: (name, value, what it is) or None; rows: (name, value, reason)."""
    kind: str
    entries: list
    rows: list
    warnings: list


def grain_rows(grain, form):
    """What is said of the grains of any scene."""
    rows = [("grain", f"{1e3 * grain.diameter:.4g} mm ({grain.diameter / INCH:.3g} in), {1e3 * grain.mass():.3g} g",
             f"{both('density', grain.solid_density, 'kg/m3')}, sphericity {form.sphericity:.3f}, {2e3 * form.bounding_radius:.3g} mm over all")]
    if grain.spread:
        rows.append(("sizes", f"{1e3 * grain.spread.smallest:.3g} to {1e3 * grain.spread.largest:.3g} mm",
                     f"{grain.spread.classes} classes; the mass is that of the mean grain, the rest of the largest"))
    return rows


def step_rows(grain, critical, step, speed, seconds, count):
    """The DEM step and the time of the run."""
    return [("critical DEM step", f"{critical:.3g} s", f"in a bed of such grains that meet at {speed:.3g} m/s"),
            ("DEM step", f"{step:.3g} s", f"{step / critical:.2f} of the critical one (at most {SAFETY})"),
            ("expected run time", scene_grains.said_time(scene_grains.run_time(grain, count, seconds / step)),
             f"one core, {count} grains in {seconds / step:.3g} steps; within a factor of three")]


def step_of(wish, grain, speed):
    """(critical step, DEM step): the user's step, or SAFETY of the critical one in two digits."""
    critical = critical_step(grain, speed)
    if wish.step is None:
        return critical, scene_grains.two_digits_down(SAFETY * critical)
    try:
        step = float(wish.step)
    except ValueError:
        step = 0
    if not 0 < step < 0.9 * critical:
        raise Failure(f"--step: '{wish.step}' is not a DEM step; expected seconds below 0.9 of the critical one, which is {critical:.3g} s")
    return critical, step


def spheres_roll(grain):
    """Spheres without rolling friction form no slope."""
    if (grain.is_sphere or grain.shape == "sphere 1") and grain.rolling == 0:
        return ["spheres without rolling friction roll apart: a slope needs --rolling 0.1 or another shape"]
    return []


def heap(wish, grain):
    """Grains poured on a floor. wish: count, height (of the spout, or None), seconds (or None), step, seed."""
    form = scene_grains.form_of(grain)
    bulk = wish.count * grain.volume / PACKING
    slope = math.tan(math.radians(HEAP_ANGLE))
    radius = (3 * bulk / (math.pi * slope)) ** (1 / 3)
    height = radius * slope
    reach = form.bounding_radius
    spout = 3 * max(grain.diameter, 1.2 * reach)
    low = wish.height if wish.height is not None else height + 3 * grain.diameter
    if low < height + 2 * reach:
        raise Failure(f"--height: {low:.4g} m is not above the heap, which will be {height:.3g} m high; expected at least {height + 2 * reach:.3g} m")
    length = 4 * spout
    pouring = math.sqrt(GRAVITY * spout)
    rate = POURING_SHARE * math.pi * spout**2 * pouring / grain.volume
    fall = math.sqrt(pouring**2 + 2 * GRAVITY * (low + length))
    seconds = wish.seconds if wish.seconds is not None else math.ceil(10 * (wish.count / rate + 2 * math.sqrt(2 * (low + length) / GRAVITY) + 0.5)) / 10
    critical, step = step_of(wish, grain, fall)
    half = 2 * radius + 6 * grain.diameter
    entries = [("count", wish.count, "grains"), ("halfWidth", round(half, 4), "of the floor; grains that roll over its edge are gone [m]"),
               ("spoutRadius", round(spout, 5), "grains appear in a cylinder of this radius [m]"),
               ("spoutLow", round(low, 5), "from this height [m]"), ("spoutHigh", round(low + length, 5), "to this one [m]"),
               ("pouringSpeed", round(pouring, 3), "downwards [m/s]"), ("pouringRate", round(rate), "grains per second"), None,
               *scene_grains.entries(grain), ("wallFriction", grain.friction, "on the floor"), None,
               ("seconds", seconds, "of the run"), ("step", step, "[s]"), ("snapshots", 0.05, "time between two pictures [s]"),
               ("safety", 0.9, "part of the critical DEM step beyond which a run stops"), ("seed", wish.seed, "a prime above 10000")]
    rows = [*grain_rows(grain, form), ("grains", f"{wish.count}", f"{1e6 * bulk:.3g} cm3 in bulk, {100 * PACKING:.0f} % solid"),
            ("heap", f"{1e3 * height:.3g} mm high, {2e3 * radius:.3g} mm wide", f"a cone of {HEAP_ANGLE:.0f} degrees, to place the spout"),
            ("pouring", f"{rate:.3g} grains per second at {pouring:.3g} m/s", f"{100 * POURING_SHARE:.0f} % of the spout's volume is solid"),
            ("impact on the floor", f"{fall:.3g} m/s", f"from {1e3 * (low + length):.3g} mm"),
            ("time of the run", f"{seconds:g} s", f"{wish.count / rate:.2g} s of pouring, and rest" if wish.seconds is None else "as you gave it"),
            *step_rows(grain, critical, step, fall, seconds, wish.count)]
    warnings = spheres_roll(grain)
    if seconds < wish.count / rate:
        warnings.append(f"the run ends before the last grain falls, which is at {wish.count / rate:.2g} s: give a longer --seconds")
    return Plan("heap", entries, rows, warnings)


def drum(wish, grain):
    """A drum that turns about a horizontal axis. wish: radius, length, fill, rpm, seconds (or None), step, seed."""
    form = scene_grains.form_of(grain)
    if wish.radius < 4 * form.bounding_radius:
        raise Failure(f"--drum: a diameter of {2 * wish.radius:.4g} m does not hold grains of {2 * form.bounding_radius:.3g} m; "
                      f"expected at least {8 * form.bounding_radius:.3g} m")
    if wish.length < 6 * form.bounding_radius:
        raise Failure(f"--length: {wish.length:.4g} m is not a slice of a drum of such grains; expected at least {6 * form.bounding_radius:.3g} m")
    volume = math.pi * wish.radius**2 * wish.length
    count = max(round(wish.fill * volume * PACKING / grain.volume), 1)
    omega = abs(wish.rpm) * math.pi / 30
    froude = omega**2 * wish.radius / GRAVITY
    regime = next(name for limit, name in REGIMES if froude < limit)
    filling = round(2.5 * math.sqrt(4 * wish.radius / GRAVITY), 2)
    turns = 2.0
    seconds = wish.seconds if wish.seconds is not None else (round(turns / (omega / (2 * math.pi)), 2) if omega > 0 else 1.0)
    speed = max(math.sqrt(4 * GRAVITY * wish.radius), omega * wish.radius)
    critical, step = step_of(wish, grain, speed)
    entries = [("drumRadius", wish.radius, "[m]"), ("length", wish.length, "of the slice, which repeats itself along the axis [m]"),
               ("rpm", wish.rpm, "turns per minute"), ("count", count, "grains"),
               ("filling", filling, "time to fall and settle before the drum turns [s]"), None,
               *scene_grains.entries(grain), ("wallFriction", grain.friction, "on the drum"), None,
               ("seconds", seconds, "of the turning drum"), ("step", step, "[s]"), ("snapshots", 0.05, "time between two pictures [s]"),
               ("safety", 0.9, "part of the critical DEM step beyond which a run stops"), ("seed", wish.seed, "a prime above 10000")]
    rows = [*grain_rows(grain, form), ("grains", f"{count}", f"{100 * wish.fill:.3g} % of {1e6 * volume:.3g} cm3 filled, {100 * PACKING:.0f} % solid"),
            ("Froude number", f"{froude:.3g}", f"omega^2 R/g: the filling {regime} (Mellmann 2001)"),
            ("drum over grain", f"{wish.radius / form.bounding_radius:.3g}", "diameters; wall effects are small above 20"),
            ("time of the run", f"{seconds:g} s", f"after {filling:g} s of filling: {seconds * omega / (2 * math.pi):.3g} turns"),
            *step_rows(grain, critical, step, speed, seconds + filling, count)]
    warnings = spheres_roll(grain)
    if wish.radius < 10 * form.bounding_radius:
        warnings.append(f"the drum is {wish.radius / form.bounding_radius:.2g} grains wide: its wall orders the grains")
    if froude >= 1:
        warnings.append("the drum turns so fast that grains stay at its wall")
    return Plan("drum", entries, rows, warnings)
