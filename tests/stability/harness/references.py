# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed forms that the criteria of the hard cases rest on, written independently of the plug-in. SI units."""
import math

GRAVITY = 9.81
ANSLEY_SMITH = 7 * math.pi / 24  # effective stress on a sphere in a yield-stress fluid


def chien_resistance(speed, diameter, density, tau0, consistency, index):
    """Drag [N] of Chien (1994), C_D = 30/Re + 67.289 exp(-5.03), with the effective viscosity of a Herschel-Bulkley
    fluid, Re = rho U^2 / (K (U/d)^n + 7 pi/24 tau0). Finite at speed 0: the yield force."""
    stress = ANSLEY_SMITH * tau0 + (consistency * (speed / diameter) ** index if speed > 0 else 0.0)
    area = math.pi / 8 * diameter**2
    return area * (30 * stress + density * 67.289 * math.exp(-5.03) * speed**2)


def terminal_speed(diameter, solid, density, tau0, consistency, index):
    """Speed at which chien_resistance balances the submerged weight (or lift); 0 where the yield stress holds."""
    weight = math.pi / 6 * diameter**3 * abs(solid - density) * GRAVITY
    if chien_resistance(0, diameter, density, tau0, consistency, index) >= weight:
        return 0.0
    low, high = 0.0, 1e3
    for _ in range(200):
        middle = (low + high) / 2
        if chien_resistance(middle, diameter, density, tau0, consistency, index) < weight:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def holding_yield_stress(diameter, solid, density):
    """Smallest tau0 [Pa] that holds a sphere in a fluid at rest (chien)."""
    weight = math.pi / 6 * diameter**3 * abs(solid - density) * GRAVITY
    return weight / (math.pi / 8 * diameter**2 * 30 * ANSLEY_SMITH)


def hertz_energy(youngs, poisson, reduced_radius, overlap):
    """Energy stored in a Hertz contact of two like materials, 8/15 E* sqrt(R*) overlap^2.5 [J]."""
    effective = youngs / (2 * (1 - poisson**2))
    return 8 / 15 * effective * math.sqrt(reduced_radius) * overlap**2.5


CUBE8_SPACING, CUBE8_RADIUS = 0.305741, 0.297801  # of cube 8, over its diameter


def cubes_apart(diameter, overlap):
    """Half the distance of two cubes of 8 spheres, face on, whose facing spheres overlap by a part of their diameter."""
    return (CUBE8_SPACING / 2 + CUBE8_RADIUS * (1 - overlap)) * diameter


def cubes_energy(spheres, youngs, poisson, apart):
    """Hertz's energy [J] of all contacts of two like bodies (rows x y z r) that are `apart` along x."""
    energy = 0.0
    for x, y, z, r in spheres:
        for a, b, c, s in spheres:
            overlap = r + s - math.dist((x, y, z), (a + apart, b, c))
            if overlap > 0:
                energy += hertz_energy(youngs, poisson, r * s / (r + s), overlap)
    return energy


def spread(values, line=True):
    """(largest - smallest) / |mean| of the last half of a series; `line`: about its straight line of least squares."""
    late = values[len(values) // 2:]
    mean, middle = sum(late) / len(late), (len(late) - 1) / 2
    slope = sum((i - middle) * (y - mean) for i, y in enumerate(late)) / sum((i - middle) ** 2 for i in range(len(late)))
    flat = [y - slope * (i - middle) for i, y in enumerate(late)] if line else late
    return (max(flat) - min(flat)) / abs(mean)


def sphere_mass(diameter, density):
    return math.pi / 6 * diameter**3 * density


def settled(particle, viscosity, elapsed):
    """Whether a dumped particle has had 12 viscous relaxation times since it was let go. The relaxation time is bounded
    from above by m / (viscous part of the drag / speed)."""
    diameter = 2 * particle["radius"]
    time = sphere_mass(diameter, particle["density"]) / (math.pi / 8 * diameter * 30 * viscosity)
    return elapsed > 12 * time


def kinetic_gain(run, table=-1):
    """Change of the kinetic energy (f_move[1] + f_move[2]) over a table [J]."""
    both = [a + b for a, b in zip(run.column("f_move[1]", table), run.column("f_move[2]", table))]
    return both[-1] - both[0]


def gravity_work(run, mass, degrees, table=-1):
    """Work of gravity on a slope that descends along +x by `degrees`, from the centre of mass v_x, v_z [J]."""
    angle = math.radians(degrees)
    dx, dz = (run.last(k, table) - run.first(k, table) for k in ("v_x", "v_z"))
    return mass * GRAVITY * (math.sin(angle) * dx - math.cos(angle) * dz)


def energy(run, mass, table=-1):
    """Kinetic plus potential energy of one body over the lines of a table that has f_move[1], f_move[2] and v_z [J]."""
    columns = (run.column(name, table) for name in ("f_move[1]", "f_move[2]", "v_z"))
    return [translation + rotation + mass * GRAVITY * z for translation, rotation, z in zip(*columns)]


def annulus_gradient(velocity, hole, pipe, eccentricity, viscosity):
    """Pressure gradient [Pa/m] of a Newtonian fluid at a mean velocity in an eccentric annulus (Piercy, Hooper & Winny 1933)."""
    offset = max(eccentricity, 1e-4) * (hole - pipe)
    f = (hole**2 - pipe**2 + offset**2) / (2 * offset)
    m = math.sqrt(f**2 - hole**2)
    a = 0.5 * math.log((f + m) / (f - m))
    b = 0.5 * math.log((f - offset + m) / (f - offset - m))
    terms = 0.0
    for n in range(1, 400):
        if n * (b + a) > 600:
            break
        terms += n * math.exp(-n * (b + a)) / math.sinh(n * (b - a))
    conductance = math.pi / (8 * viscosity) * (hole**4 - pipe**4 - 4 * offset**2 * m**2 / (b - a) - 8 * offset**2 * m**2 * terms)
    return velocity * math.pi * (hole**2 - pipe**2) / conductance


def channel_velocity(gradient, gap, tau0, consistency, index):
    """Mean velocity [m/s] of a Herschel-Bulkley fluid between parallel plates."""
    wall = gradient * gap / 2
    if wall <= tau0:
        return 0.0
    rest = 1 - tau0 / wall
    return (index / (index + 1) * gap / 2 * (wall / consistency) ** (1 / index) * rest ** (1 + 1 / index)
            * (1 - index / (2 * index + 1) * rest))


def gradient(run):
    """The driving gradient [Pa/m] that annulusFoam printed last."""
    return run.number(r" G ([-+0-9.e]+) Pa/m")


def flow(run):
    """The mean velocity [m/s] that annulusFoam printed last."""
    return run.number(r"<alpha U> ([-+0-9.e]+) m/s")
