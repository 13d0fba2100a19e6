# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the hard cases are judged by: of particles and clusters. `run` is the first run of a case (measured.Measured), `runs` are all of them;
the other parameters are values of the case, or what its check gives."""
import math

from .references import (GRAVITY, cubes_apart, cubes_energy, energy, gravity_work, hertz_energy, holding_yield_stress, kinetic_gain, settled,
                         sphere_mass, terminal_speed)

GTEST_PASSED = r"\[  PASSED  \] (\d+) test"
FUZZ_ACCEPTED, FUZZ_REFUSED = r"(\d+) accepted, ", r"(\d+) refused with one sentence"
IMPACT_PAIRS = r"(\d+) pairs,"
IMPACT_GAIN = r"largest relative change of energy ([-+0-9.e]+)"
OF_CLUSTERS = ("f_move[1]", "f_move[2]")  # kinetic energy of translation and of rotation
DENSITY = 2619


def status(run):
    return run.status


def statuses(runs):
    return sum(abs(one.status) for one in runs)


def bodies(run):
    return run.last("atoms")


def bodies_lost(run, since=-1):
    return run.first("atoms", since) - run.last("atoms")


def bodies_in_frame(run):
    return len(run.frames()[-1])


def fewest_bodies(runs):
    return min(len(one.frames()[-1]) for one in runs)


def last_step(runs):
    return min(one.last("step") for one in runs)


def says_step_and_limit(run):
    return run.says("ERROR: fix limit timestep/limit.*critical step")


def memory_growth(run):
    """MB in the second half of the run."""
    return run.memory_growth() / 1e6


def late_motion(run, d, count, part=1e-9, columns=OF_CLUSTERS, table=-1):
    """Kinetic energy, mean of the last quarter, over what the bodies win by falling a part of their diameter."""
    return sum(run.late(column, table) for column in columns) / (count * sphere_mass(d, DENSITY) * GRAVITY * part * d)


def last_motion(run, d, part=1e-9):
    """The same of one body at the end."""
    return sum(run.last(column) for column in OF_CLUSTERS) / (sphere_mass(d, DENSITY) * GRAVITY * part * d)


def largest_energy(runs):
    return max(one.last("f_move[1]") for one in runs)


def gain_over_gravity(run, d, count, table=-1):
    """Gain of kinetic energy over the work of gravity on the slope of 35 degrees."""
    return kinetic_gain(run, table) / gravity_work(run, count * sphere_mass(d, DENSITY), 35, table)


def fastest_along(run, column):
    return max(abs(speed) for speed in run.column(column))


def displacement(run, d):
    """The largest between the first frame and the last, in diameters."""
    place = lambda body: (body["x"], body["y"], body["z"])
    return max(math.dist(place(b), place(a)) for a, b in zip(run.frames()[0], run.frames()[-1])) / d


def drop_error(run):
    return abs(run.last("v_u") / 0.3 - 0.9)


def impact_error(run):
    """Of the restitution of two bodies that met at 0.2 m/s with e = 0.9."""
    first, second = run.frames()[-1][:2]
    return abs((second["vx"] - first["vx"]) / 0.2 - 0.9)


def energy_gain(run, d):
    """The largest between two lines, over m g d."""
    mass = sphere_mass(d, DENSITY)
    total = energy(run, mass)
    return max(b - a for a, b in zip(total, total[1:])) / (mass * GRAVITY * d)


def energy_kept(run):
    return sum(run.last(column) for column in OF_CLUSTERS) / sum(run.first(column) for column in OF_CLUSTERS)


def momentum_change(run):
    return abs(run.last("f_move[5]") / run.first("f_move[5]") - 1)


def hertz_error(run, E, d, overlap):
    return abs(run.last("f_move[1]") / hertz_energy(E, 0.25, d / 4, overlap * d) - 1)


def hertz_error_of_cubes(run, E, d, overlap):
    stored = cubes_energy(run.spheres("cube.clump"), E, 0.25, 2 * cubes_apart(d, overlap))
    return abs(sum(run.last(column) for column in OF_CLUSTERS) / stored - 1)


def impact_pairs(run):
    return min(run.numbers(IMPACT_PAIRS))


def impact_gain(run):
    return max(run.numbers(IMPACT_GAIN))


def rotation_change(run):
    return max(abs(e / run.first("v_rotation") - 1) for e in run.column("v_rotation"))


def rotation_drift(run):
    return abs(run.late("v_rotation") / run.early("v_rotation") - 1)


def angular_momentum_change(run):
    columns = [f"f_move[{k}]" for k in (6, 7, 8)]
    change = sum((run.last(column) - run.first(column)) ** 2 for column in columns)
    return math.sqrt(change / sum(run.first(column) ** 2 for column in columns))


def terminal_of(particle, viscosity):
    return terminal_speed(2 * particle["radius"], particle["density"], 1000, 0, viscosity, 1)


def beyond_terminal(run, viscosity):
    """Particles that ever pass 1.001 terminal speeds or move against their weight."""
    def along(p):
        return p["vz"] * (1 if p["density"] < 1000 else -1)
    return sum(any(not -1e-12 <= along(p) <= 1.001 * terminal_of(p, viscosity) + 1e-12 for p in history) for history in zip(*run.frames()))


def turned_back(run):
    """Particles whose sideways velocity ever turns back or grows."""
    return sum(any(not -1e-15 <= b["vx"] <= a["vx"] * (1 + 1e-12) + 1e-15 for a, b in zip(history, history[1:])) for history in zip(*run.frames()))


def terminal_error(run, viscosity, step, implicit):
    elapsed = 400 * step + step * min(20000, max(600, int(3.0 / step)))
    return max(abs(abs(p["vz"]) / terminal_of(p, viscosity) - 1) for p in run.frames()[-1] if implicit and settled(p, viscosity, elapsed))


def yield_speed_error(run, d, tau0):
    """Speed against the terminal speed, over max(2e-3 terminal, 1e-15 m/s)."""
    terminal = terminal_speed(d, DENSITY, 1000, tau0, 0.28, 0.65)
    return max(abs(-frame[0]["vz"] - terminal) for frame in run.frames()) / max(terminal * 2e-3, 1e-15)


def sideways_left(run, d, tau0):
    """Over 1e-15 m/s where the yield stress holds the sphere, else over 1e-6 m/s."""
    held = tau0 > holding_yield_stress(d, DENSITY, 1000)
    return max(abs(frame[0]["vx"]) + abs(frame[0]["vy"]) for frame in run.frames()) / (1e-15 if held else 1e-6)


def late_slip(run):
    """The largest after the first quarter period."""
    return max(abs(slip) for slip in run.column("v_slip")[1000:])


def against_weight(run):
    return max(-w for w in run.column("v_w", 1))


def step_back(run):
    """The largest of the speed on the way, over the speed."""
    speeds = run.column("v_w", 1)
    return max(a - b for a, b in zip(speeds, speeds[1:])) / (run.last("v_w") + 1e-9)


def speed_change(run):
    """In the last 100 steps, over 1e-9 m/s."""
    return abs(run.last("v_w") - run.first("v_w")) / 1e-9


def difference_from_one_rank(runs, which):
    """The largest of a coordinate between the first run and another."""
    return max(abs(a[k] - b[k]) for a, b in zip(runs[0].frames()[-1], runs[which].frames()[-1]) for k in ("x", "y", "z"))


def fastest_sideways(run):
    return max(abs(p["vx"]) for p in run.frames()[-1])


def height_drift(run, d):
    return abs(run.last("v_z") - run.first("v_z")) / d


def momentum_left(run, d, count):
    """Over N m sqrt(g 1e-9 d)."""
    scale = count * sphere_mass(d, DENSITY) * math.sqrt(GRAVITY * 1e-9 * d)
    return max(run.largest(f"f_move[{k}]") for k in (3, 4, 5)) / scale


def mean_velocity_left(run, d):
    return max(run.largest(k) for k in ("v_px", "v_py", "v_pz")) / math.sqrt(GRAVITY * 1e-9 * d)


def tests_passed(run):
    return run.number(GTEST_PASSED)


def readers(run):
    return len(run.numbers(FUZZ_REFUSED))


def inputs_refused(run):
    return sum(run.numbers(FUZZ_REFUSED))


def inputs_accepted(run):
    return sum(run.numbers(FUZZ_ACCEPTED))
