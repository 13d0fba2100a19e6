# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The map of coupled drag over Stokes number and interval: its scales, its theory and what a run of it measured. SI units."""
import math

FLUID = 1000.0  # density
SOLID = 0.4  # volume fraction of the suspension
LOAD = SOLID / (1 - SOLID)  # times the ratio of densities: the ratio of inertia
SINKS = 1e-9  # cells by which a sphere sinks in one interval, so that what grows a thousandfold thrice is still a number
KICK = 0.5  # of the terminal slip, in the fluid, once all is steady


def response_time(diameter, density, viscosity):
    """m / (drag / slip) of a suspension in the viscous limit of Chien (1994), model A: F = 15/4 pi mu d u (1 - SOLID)^-1.65."""
    return density * diameter**2 / (22.5 * viscosity) * (1 - SOLID) ** 1.65


def held_limit(steps):
    """Largest stable St of a drag that is held over an interval of `steps` velocity-Verlet steps: v' = v - St ((1 - 1/2N) v + 1/2N
    v_before), as the half step before a coupling step still has the force of the interval before. 2 for 1 and for many steps."""
    return 2 * steps if steps <= 2 else 2 / (1 - 1 / steps)


def explicit_limit(steps, load):
    """Largest stable St with explicit momentum in the fluid; infinite for load <= 1."""
    if load <= 1:
        return math.inf
    return steps * ((1 - 2 / (1 + load)) ** (-1 / steps) - 1)


def explicit_factor(stokes, steps, load):
    """By which an interval multiplies a deviation of the slip where drag is implicit in each of its DEM steps and the fluid
    receives the impulse explicitly. load: ratio of inertia, particles to fluid."""
    kept = (1 + stokes / steps) ** -steps
    return kept - load * (1 - kept)


def map_gravity(kind, stokes, cell):
    """Gravity that lets a sphere sink by SINKS cells per interval. kind: name, diameter, density ratio, viscosity."""
    _, diameter, ratio, viscosity = kind
    time = response_time(diameter, FLUID * ratio, viscosity)
    return SINKS * cell / (stokes * time) / (time * abs(ratio - 1) / ratio)


def map_terminal(kind, stokes, cell):
    """Terminal slip, upward positive."""
    _, diameter, ratio, viscosity = kind
    return -map_gravity(kind, stokes, cell) * response_time(diameter, FLUID * ratio, viscosity) * (ratio - 1) / ratio


def map_settles(stokes, scheme, every):
    """Coupling steps before the kick, and after it. Semi-implicit momentum may return what it holds back long after (docs/couplingProperties.md);
    the slip in the flow that the particles feel does not wait for that, but with one DEM step per interval: there half of each kick is
    still that of the interval before, and what this starts dies away over some 300 coupling steps. What is explicit shows at once what becomes of it."""
    if scheme != "semiImplicit":
        return 3
    return max(400 if every == 1 else 100, math.ceil(9 / stokes))


def map_drive(kind, stokes, cell, scheme, every):
    """Gradient that carries the submerged weight, with one kick of the fluid after the first half of the run, as a table over time."""
    _, diameter, ratio, viscosity = kind
    interval = stokes * response_time(diameter, FLUID * ratio, viscosity)
    steady = LOAD * FLUID * (ratio - 1) * map_gravity(kind, stokes, cell)
    kick = steady - KICK * map_terminal(kind, stokes, cell) * -FLUID / interval
    at = map_settles(stokes, scheme, every) + 1
    times = ((0, steady), (at - 0.6, steady), (at - 0.5, kick), (at + 0.5, kick), (at + 0.6, steady), (1e6, steady))
    return "table (" + " ".join(f"({time * interval!r} {value!r})" for time, value in times) + ")"


def map_slip(run, kind, stokes, cell, scheme, late=0):
    """Slip over terminal slip at the coupling steps; late=1: in the flow of the coupling step before, which the particles have felt since."""
    particles = run.column("v_w")
    fluid = [0.0] * len(particles) if scheme == "held" else [u / (1 - SOLID) for u in run.csv("mean_velocity")]
    return [(v - u) / map_terminal(kind, stokes, cell) for v, u in zip(particles[late:], fluid)]


def map_factor(slip, scheme):
    """Factor per coupling step of the deviation from the terminal slip: at the end, or, semi-implicit, on the mean since the kick."""
    if scheme != "semiImplicit":
        return math.sqrt(abs((slip[-1] - 1) / (slip[-3] - 1))) if abs(slip[-1] - 1) > 1e-6 else 0.0
    kicked = [abs(s - 1) for s in slip[len(slip) // 2 + 1:]]
    return (max(kicked[-1], 1e-9) / max(kicked)) ** (1 / len(kicked))
