# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Estimates of a Herschel-Bulkley flow in an eccentric annulus before a mesh is made: the annulus as slots of its local width."""
import math
import typing


class Mud(typing.NamedTuple):
    """tau0 [Pa], k [Pa s^n], n, density [kg/m3]."""
    tau0: float
    k: float
    n: float
    density: float


class Annulus(typing.NamedTuple):
    """Radii [m] and eccentricity (offset of the pipe's axis over the difference of the radii)."""
    hole: float
    pipe: float
    eccentricity: float

    @property
    def area(self):
        return math.pi * (self.hole**2 - self.pipe**2)

    @property
    def widest(self):
        return (self.hole - self.pipe) * (1 + self.eccentricity)

    @property
    def narrowest(self):
        return (self.hole - self.pipe) * (1 - self.eccentricity)

    @property
    def hydraulic_diameter(self):
        return 2 * (self.hole - self.pipe)


def slot_speed(mud, width, gradient):
    """Mean velocity [m/s] between parallel plates under a pressure gradient [Pa/m] (Herschel-Bulkley, exact)."""
    wall = 0.5 * gradient * width
    if wall <= mud.tau0:
        return 0.0
    m = 1 / mud.n
    plug = mud.tau0 / wall
    return 0.5 * width * (wall / mud.k)**m * (1 - plug)**(m + 1) * (1 + plug / (m + 1)) / (m + 2)


def bisect(function, low, high):
    """The root of a rising function between low and high, by halving in the logarithm."""
    for _ in range(200):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return math.sqrt(low * high)


def pressure_gradient(mud, annulus, speed, parts=90):
    """[Pa/m] that drives the mean velocity through slots of the local widths side by side. The pipe does not turn."""
    angles = [math.pi * (i + 0.5) / parts for i in range(parts)]
    widths = [(annulus.hole - annulus.pipe) * (1 + annulus.eccentricity * math.cos(a)) for a in angles]

    def mean(gradient):
        return sum(slot_speed(mud, w, gradient) * w for w in widths) / sum(widths)

    return bisect(lambda g: mean(g) - speed, 1e-9, 1e9)


def metzner_reed(mud, hydraulic_diameter, speed):
    """Generalised Reynolds number (Metzner and Reed) as runs state it (openfoam-coupling/rheology/slot_flow.h): 12 rho U2 / wall stress of a slot of
    half the hydraulic diameter with this mean speed, rho U D_h / mu of a Newtonian fluid. The eccentricity does not enter that of the mean flow."""
    width = 0.5 * hydraulic_diameter
    wall = bisect(lambda stress: slot_speed(mud, width, 2 * stress / width) - speed, 1e-9, 1e9)
    return 12 * mud.density * speed**2 / wall


def laminar_limit(n):
    """Of the generalised Reynolds number (Dodge and Metzner): 3470 - 1370 n."""
    return 3470 - 1370 * n
