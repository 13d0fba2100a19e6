# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces of LIGGGHTS scripts that the cases share."""
import itertools
import math

_numbers = itertools.count(1)


def restart():
    """Of the numbers in names: the texts of a case do not depend on the cases before it."""
    global _numbers
    _numbers = itertools.count(1)


def box(size, boundary="f f f", skin=1e-3, processors="* * *"):
    """Settings and simulation box; size: six numbers in one string [m]."""
    return f"""atom_style granular
atom_modify map array
boundary {boundary}
newton off
communicate single vel yes
units si
processors {processors}
region box block {size} units box
create_box 1 box
neighbor {skin:g} bin
neigh_modify delay 0
"""


def material(youngs=5e6, e=0.9, friction=0.5, poisson=0.25, mu_r=0.0, mu_shape=0.0):
    """Coefficients of the only material."""
    hard = "hard_particles yes\n" if youngs > 1e9 else ""
    return hard + f"""fix m1 all property/global youngsModulus peratomtype {youngs!r}
fix m2 all property/global poissonsRatio peratomtype {poisson!r}
fix m3 all property/global coefficientRestitution peratomtypepair 1 {e!r}
fix m4 all property/global coefficientFriction peratomtypepair 1 {friction!r}
fix m5 all property/global coefficientRollingFriction peratomtypepair 1 {mu_r!r}
fix m6 all property/global shapeRollingFriction peratomtypepair 1 {mu_shape!r}
"""


def clusters(words=""):
    """Contact model and motion of clusters."""
    return f"pair_style gran/cluster model hertz tangential history {words}\npair_coeff * *\n"


def spheres(words=""):
    """Contact model of plain spheres."""
    return f"pair_style gran model hertz tangential history{' ' if words else ''}{words}\npair_coeff * *\n"


def weight(angle=0.0):
    """Gravity; angle [degrees] of a slope that descends along +x."""
    a = math.radians(angle)
    return f"fix weight all gravity 9.81 vector {math.sin(a)!r} 0 {-math.cos(a)!r}\n"


def weight_along(direction):
    return f"fix weight all gravity 9.81 vector {direction}\n"


def floor(words=""):
    return f"fix floor all wall/gran/cluster model hertz tangential history {words} primitive type 1 zplane 0.0\n"


def template(name, shape, diameter, density=2619.0, orientation=None):
    """A template `name` and its distribution d_name. Orientations are those of place(), and random where pour() draws places."""
    words = f"shape {shape} diameter {diameter!r}" + (f" orientation {orientation}" if orientation else "")
    return f"""fix {name} all particletemplate/cluster 15485863 atom_type 1 volume_limit 1e-25 density constant {density!r} {words}
fix d_{name} all particledistribution/discrete 32452843 1 {name} 1.0
"""


def place(name, at, velocity="0 0 0", omega="0 0 0", orientation="1 0 0 0"):
    """One body of template `name` at a point (three numbers in one string [m]), to within 1e-13 m."""
    number = next(_numbers)
    x, y, z = (float(word) for word in at.split())
    half = 1e-13  # insertion draws a place in this block; the draw must not matter
    sides = " ".join(f"{c + s * half:.17g}" for c in (x, y, z) for s in (-1, 1))
    return f"""region spot{number} block {sides} volume_limit 1e-45 units box
fix put{number} all insert/pack seed 49979687 distributiontemplate d_{name} insert_every once overlapcheck no &
    all_in no vel constant {velocity} omega constant {omega} orientation constant {orientation} &
    region spot{number} particles_in_region 1
run 1
unfix put{number}
"""


def pour(name, count, region):
    """`count` bodies of template `name` at random places in a block (six numbers in one string)."""
    number = next(_numbers)
    return f"""region fill{number} block {region} units box
fix pour{number} all insert/pack seed 49979687 distributiontemplate d_{name} insert_every once overlapcheck yes &
    maxattempt 500 all_in no vel constant 0 0 0 region fill{number} particles_in_region {count}
run 1
unfix pour{number}
"""


def about(axis, degrees):
    """Quaternion of a turn about x, y or z, as four words."""
    half = math.radians(degrees) / 2
    parts = [math.cos(half), 0.0, 0.0, 0.0]
    parts[1 + "xyz".index(axis)] = math.sin(half)
    return " ".join(repr(part) for part in parts)


def spheres_at(places):
    """Single spheres at points."""
    return "".join(f"create_atoms 1 single {x!r} {y!r} {z!r} units box\n" for x, y, z in places)


def mud(rheology, velocity="0 0 0", drag="chien"):
    """Fluid of 1000 kg/m3 with drag alone, at a velocity."""
    return f"fix mud all fluid/force rheology {rheology} density 1000 drag {drag}\nfix flow all fluid/uniform velocity {velocity}\n"


def explicit_drag(tau0, consistency, index, density, fluid_velocity="0"):
    """Chien's drag and buoyancy as explicit forces from the velocity of the step's start: what an explicit scheme does."""
    def force(k):
        stress = f"({7 * math.pi / 24 * tau0!r}+{consistency!r}*(v_speed/(2*r))^{index!r})"
        drag = f"-{math.pi / 8!r}*(2*r)^2*(30*{stress}/v_speed+{density * 67.289 * math.exp(-5.03)!r}*v_speed)*v_s{k}"
        lift = f"+{4 * math.pi / 3 * density * 9.81!r}*r^3" if k == "vz" else ""
        return f"variable drag_{k} atom {drag}{lift}\n"
    return (f"variable svx atom vx-{fluid_velocity}\nvariable svy atom vy\nvariable svz atom vz\n"
            "variable speed atom sqrt(v_svx^2+v_svy^2+v_svz^2)+1e-12\n" + force("vx") + force("vy") + force("vz") +
            "fix mud all addforce v_drag_vx v_drag_vy v_drag_vz\n")


def wall_stress(drive, tau0, consistency, rate, index):
    """Stress [Pa] at the plates: 0.9 tau0 for a plug, 2 tau0 for a plug of half the gap, and without yield stress
    that of the shear rate `rate`."""
    if drive == "plug":
        return 0.9 * tau0
    return 2 * tau0 if tau0 > 0 else consistency * rate**index


def drive_words(drive, gradient, end):
    """OpenFOAM's words for a gradient that is steady, or turns round or stops half-way."""
    if drive not in ("turns", "stops"):
        return repr(gradient)
    half, then = end / 2, -gradient if drive == "turns" else 0.0
    return f"table ((0 {gradient!r}) ({half!r} {gradient!r}) ({half * 1.0001!r} {then!r}) ({2 * end!r} {then!r}))"


def consistency(tau0, rate, index, without_yield):
    """K [Pa s^n] for which a wall stress of 2 tau0 shears the wall at `rate`."""
    return tau0 / rate**index if tau0 > 0 else without_yield


def plug(hole, pipe, offset, spacing, height):
    """Spheres at the nodes of a square lattice that lie between a bore and a pipe `offset` below its axis, up to a height."""
    count, lines = int(hole / spacing) + 1, []
    for i, j, k in itertools.product(range(-count, count + 1), range(-count, count + 1), range(int(height / spacing))):
        x, y, z = i * spacing, j * spacing, (k + 0.5) * spacing
        if math.hypot(x, y) < hole - spacing / 2 and math.hypot(x, y + offset) > pipe + spacing / 2:
            lines.append(f"create_atoms 1 single {x!r} {y!r} {z!r} units box")
    return "\n".join(lines)


def held_drag(viscosity, diameter, density, solid, every, gravity):
    """Chien's viscous drag in a suspension from the velocity at a coupling step, held over the DEM steps to the next, and buoyancy: what a coupling
    does whose particles receive a force."""
    drag = f"-{15 * math.pi / 4 * viscosity * diameter * (1 - solid) ** -1.65!r}*v"
    # Without a run before it stock's fix store/state reads a list that is not there yet.
    return ("run 0\n" + "".join(f"variable drag_{k} atom {drag}{k}\n" for k in "xyz") +
            f"variable lift atom {math.pi / 6 * diameter**3 * density * gravity!r}\n"
            f"fix drag all store/state {every} v_drag_x v_drag_y v_drag_z\n"
            "variable held_x atom f_drag[1]\nvariable held_y atom f_drag[2]\nvariable held_z atom f_drag[3]+v_lift\n"
            "fix mud all addforce v_held_x v_held_y v_held_z\n")
