# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What every kind of scene says of its grains: their shape, how fast they settle, how long a run of them takes."""
import json
import math
import pathlib
import subprocess
import tempfile
import typing

from . import programs
from .programs import BUILD, Failure
from .spread import Spread

GRAVITY = 9.81
YIELD_WEIGHT = 7 * math.pi / 24  # of tau0 in the stress scale around a particle (Ansley and Smith 1967, docs/closures.md)
# Measured seconds of one core (docs/eccentra.md): per grain and DEM step, and per cell and fluid step.
GRAIN_STEP = {"sphere": 3e-7, "cluster": 5e-7, "rounded": 2e-5}
CELL_STEP = 8e-6


class Grain(typing.NamedTuple):
    """In SI; the diameter is that of the sphere of equal volume."""
    shape: str
    diameter: float
    solid_density: float
    stiffness: float
    friction: float
    restitution: float
    rolling: float
    spread: typing.Optional[Spread] = None  # of the diameter

    @property
    def is_sphere(self):
        return self.shape == "sphere"

    @property
    def volume(self):
        """Mean volume [m3]."""
        return self.spread.volume if self.spread else math.pi / 6 * self.diameter**3

    @property
    def smallest(self):
        """Diameter of the smallest grains [m]."""
        return self.spread.smallest if self.spread else self.diameter

    def mass(self):
        return self.solid_density * self.volume


class Form(typing.NamedTuple):
    """Of a shape: surface of the sphere of equal volume over its own; bounding radius [m]."""
    sphericity: float
    bounding_radius: float


def form_of(grain):
    """Of the largest grains, by clusterShape; Failure, in its words, where there is no such shape."""
    diameter = grain.spread.largest if grain.spread else grain.diameter
    if grain.is_sphere:
        return Form(1.0, 0.5 * diameter)
    words = [str(BUILD / "bin" / "clusterShape"), *grain.shape.split(), "--diameter", f"{diameter!r}", "--json"]
    done = subprocess.run(words, capture_output=True, text=True, check=False, env=programs.environment())
    if done.returncode:
        said = (done.stderr.strip() or f"clusterShape ended with {done.returncode}").splitlines()[-1]
        raise Failure(f"--shape: {said.removeprefix('clusterShape: error: ')}")
    values = json.loads(done.stdout)
    return Form(values["sphericity"], values["bounding_radius"])


def drag_table(law, sphericity, fraction=1.0):
    """(Re, C_D Re) of a drag law in logarithmic steps, from the closures themselves (dragLaw)."""
    numbers = [10 ** (0.05 * i) for i in range(-120, 121)]
    with tempfile.TemporaryDirectory(prefix="eccentra-new-") as folder:
        file = pathlib.Path(folder) / "points.txt"
        file.write_text("".join(f"{sphericity!r} {re!r}\n" for re in numbers))
        rows = programs.output_of([BUILD / "bin" / "dragLaw", law, "--points", file, "--fraction", f"{fraction!r}"]).splitlines()[1:]
    return [(re, float(row.split(",")[3]) * re) for re, row in zip(numbers, rows)]


def interpolated(table, re):
    """C_D Re at a Reynolds number: linear in the logarithms, and constant below the table."""
    if re <= table[0][0]:
        return table[0][1]
    for (low, first), (high, second) in zip(table, table[1:]):
        if re <= high:
            part = math.log(re / low) / math.log(high / low)
            return math.exp(math.log(first) + part * math.log(second / first))
    return table[-1][1] * re / table[-1][0]


def stress_about(grain, mud, speed):
    """[Pa] of the fluid around a grain that moves through it."""
    return mud.k * (abs(speed) / grain.diameter)**mud.n + YIELD_WEIGHT * mud.tau0


def said_settling(grain, sphericity, mud, law, source):
    """(value, reason) of the settling velocity, for a table."""
    speed = settling_speed(grain, sphericity, mud, law)
    if speed == 0:
        return "0 m/s", f"the yield stress holds a grain in mud at rest ({source}), sphericity {sphericity:.3f}"
    number = mud.density * speed**2 / stress_about(grain, mud, speed)
    return f"{speed:.4g} m/s, particle Reynolds number {number:.3g}", f"of one grain in fluid at rest ({source}), sphericity {sphericity:.3f}"


def settling_speed(grain, sphericity, mud, law):
    """[m/s], signed: above 0 falls, 0 where the yield stress holds the grain. One grain in unbounded mud at rest, (pi/8) d^2 X C_D Re = weight."""
    excess = grain.solid_density - mud.density
    weight = math.pi / 6 * grain.diameter**3 * abs(excess) * GRAVITY
    table = drag_table(law, sphericity)

    def drag(speed):
        stress = stress_about(grain, mud, speed)
        return math.pi / 8 * grain.diameter**2 * stress * interpolated(table, mud.density * speed**2 / stress)

    low, high = 1e-9, 1e3
    if weight == 0 or drag(low) >= weight:
        return 0.0
    for _ in range(100):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if drag(middle) < weight else (low, middle)
    return math.copysign(low, excess)


def two_digits_down(value):
    """The largest number of two digits that is not above a positive value."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{math.floor(value / digit * (1 + 1e-12)) * digit:.2g}")


def run_time(grain, count, dem_steps, cells=0, fluid_steps=0):
    """Seconds of one core."""
    kind = {"sphere": "sphere", "smooth": "rounded", "hull": "rounded"}.get(grain.shape.split()[0], "cluster")
    return count * dem_steps * GRAIN_STEP[kind] + cells * fluid_steps * CELL_STEP


def said_time(seconds):
    """A rough time in words."""
    for unit, length in (("days", 86400), ("h", 3600), ("min", 60)):
        if seconds >= 1.5 * length:
            return f"about {seconds / length:.2g} {unit}"
    return f"about {max(seconds, 1):.0f} s"


def sizes_row(spread):
    """The row of the file scene that a distribution needs."""
    return [("sizes", f'"{spread.words}"', "diameters, as in fix particletemplate/cluster; diameter is their middle")] if spread else []


def entries(grain):
    """Rows (name, value, what it is) of the file scene."""
    return [("clusters", 0 if grain.is_sphere else 1, "1: clusters or rounded bodies of the shape; 0: spheres"),
            ("shape", f'"{"cube 8" if grain.is_sphere else grain.shape}"', "as in fix particletemplate/cluster"),
            ("diameter", grain.diameter, "of the sphere of equal volume [m]"), *sizes_row(grain.spread), ("solidDensity", grain.solid_density, "[kg/m3]"),
            ("youngsModulus", grain.stiffness, "[Pa]"), ("friction", grain.friction, "between grains"),
            ("restitution", grain.restitution, ""), ("rolling", grain.rolling, "rolling friction (cdt)")]
