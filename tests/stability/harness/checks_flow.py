# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the hard cases are judged by: of the flow and of coupled runs. Parameters as in checks.py."""
import math

from .drag_map import LOAD, map_factor, map_slip
from .references import annulus_gradient, channel_velocity, flow, gradient, spread
from .scenes import consistency, wall_stress

MEAN_FLOW = r" <alpha U> ([-+0-9.e]+) m/s"
BEFORE_THE_STOP = 298  # line of the mean velocity


# --- coupled drag over Stokes number and interval -----------------------------------------------------------------------
def slips(runs, kind, stokes, cell, scheme, late=0):
    """Slip over terminal slip at the coupling steps of each run; late=1: as particles feel it."""
    return [map_slip(one, kind, stokes[i], cell, scheme, late) for i, one in enumerate(runs)]


def growing_stokes(runs, kind, stokes, cell, scheme):
    """Stokes numbers at which a deviation grows."""
    return sum(not map_factor(slip, scheme) < 1 for slip in slips(runs, kind, stokes, cell, scheme))


def slip_error_before_the_half_step(runs, kind, stokes, cell, scheme):
    middle = [len(one.column("v_w")) // 2 - 1 for one in runs]
    return max(abs(slip[at] - 1) for slip, at in zip(slips(runs, kind, stokes, cell, scheme, 1), middle))


def slips_after(runs, kind, stokes, cell, scheme):
    return [slip[len(one.column("v_w")) // 2:] for one, slip in zip(runs, slips(runs, kind, stokes, cell, scheme))]


def least_slip_after(runs, kind, stokes, cell, scheme):
    return min(min(slip) for slip in slips_after(runs, kind, stokes, cell, scheme))


def largest_slip_after(runs, kind, stokes, cell, scheme):
    return max(max(slip) for slip in slips_after(runs, kind, stokes, cell, scheme))


def slip_error_at_the_end(runs, kind, stokes, cell, scheme):
    return max(abs(slip[-1] - 1) for slip in slips(runs, kind, stokes, cell, scheme, 1))


def map_points(runs, kind, stokes, cell, scheme, every):
    """What the chart of the map shows."""
    return [[scheme, kind[0], kind[2] * LOAD, every, stokes[i], map_factor(slip, scheme)]
            for i, slip in enumerate(slips(runs, kind, stokes, cell, scheme))]


# --- Herschel-Bulkley fluids between plates -----------------------------------------------------------------------------
def channel_reference(drive, tau0, rate, n, k, gap):
    """Mean velocity in closed form."""
    thickness = consistency(tau0, rate, n, k)
    return channel_velocity(wall_stress(drive, tau0, thickness, rate, n) / (gap / 2), gap, tau0, thickness, n)


def channel_error(run, drive, tau0, rate, n, k, gap):
    return abs(flow(run) / channel_reference(drive, tau0, rate, n, k, gap) - 1)


def reversed_channel_error(run, drive, tau0, rate, n, k, gap):
    return abs(run.field_mean("U", 2) / channel_reference(drive, tau0, rate, n, k, gap) + 1)


def rise_after_the_stop(run):
    """Largest rise of the mean velocity, over the velocity before the stop."""
    flows = run.numbers(MEAN_FLOW)
    return max(b - a for a, b in zip(flows[300:-1], flows[301:])) / flows[BEFORE_THE_STOP]


def decay_after_the_stop(run, drive, tau0, rate, n, k, gap, step):
    """Mean velocity at the end over 1.3 U exp(-pi2 nu t / h2) + 1e-9 m/s, nu that of the wall before."""
    flows = run.numbers(MEAN_FLOW)
    nu = wall_stress(drive, tau0, consistency(tau0, rate, n, k), rate, n) / rate / 1000
    return flows[-1] / (1.3 * flows[BEFORE_THE_STOP] * math.exp(-min(500, math.pi ** 2 * nu * 298 * step / gap ** 2)) + 1e-9)


def plug_creep(run, tau0, gap, ratio, rate, n, k):
    """Over G h^2 / (12 muY)."""
    return flow(run) / (0.9 * tau0 / (gap / 2) * gap ** 2 / (12 * ratio * consistency(tau0, rate, n, k)))


# --- particles on meshes ------------------------------------------------------------------------------------------------
def spread_of_force(runs, which=0):
    """Of drag and pressure force on the particles along z, about its straight line."""
    both = zip(runs[which].column("f_mud[3]"), runs[which].column("f_mud[12]"))
    return spread([a + b for a, b in both])


def force_difference(runs):
    """The largest of the drag between two ranks and one, relative."""
    return max(abs(a / b - 1) for a, b in zip(runs[1].column("f_mud[3]")[10:], runs[0].column("f_mud[3]")[10:]))


def volume_error(run):
    return max(abs(error) for error in run.csv("volume_error"))


def least_fraction(run):
    return min(run.csv("least_fraction"))


def force_balance_error(run, wide, high):
    """Drag and pressure forces on the bed over G V, - 1."""
    return abs((run.last("f_mud[1]", 0) + run.last("f_mud[10]", 0)) / (1000 * wide * wide * high) - 1)


def unlike_drag(run, d):
    """Largest over smallest drag among the like spheres of a layer."""
    layers = ([p["f_mud[1]"] for p in run.frames()[-1] if abs(p["x"] - (i + 0.6) * d) < 1e-9] for i in range(4))
    return max(max(forces) / max(min(forces), 1e-300) for forces in layers)


def pressure_range(run, density, high):
    """Of p_rgh in the box without its gradient, over G L."""
    return run.field_range("p") * density / (1000 * high)


def inserted_volume(d):
    return 64 * math.pi / 6 * d ** 3


def insertion_pressure(run, density, d, wide, fluid_step):
    """Largest pressure gradient over 2 rho dU/dt / least fraction, dU = V/(A dt)."""
    bound = 2 * density * inserted_volume(d) / (wide * wide * fluid_step ** 2)
    return max(abs(g) for g in run.csv("pressure_gradient")) * least_fraction(run) / bound


def unsteady_gradient(run):
    """With the spheres: that at the end of the second part over its mean of the last 40 steps, - 1."""
    gradients = run.csv("pressure_gradient")
    return abs(gradients[199] * 40 / sum(gradients[160:200]) - 1)


def gradient_left(run):
    """After the removal over before the insertion, - 1."""
    gradients = run.csv("pressure_gradient")
    return abs(gradients[-1] / gradients[99] - 1)


def fastest_while_inserting(run, d, wide, fluid_step):
    """Over 0.05 m/s + 2 dU."""
    return max(run.csv("fastest_fluid")) / (0.05 + 2 * inserted_volume(d) / (wide * wide * fluid_step))


def solid_share(run):
    return run.csv("solid_concentration")[-1]


def force_on_plug(run, hole, pipe, length):
    """Over G V of the annulus."""
    return (run.last("f_mud[3]") + run.last("f_mud[12]")) / (run.csv("pressure_gradient")[-1] * math.pi * (hole ** 2 - pipe ** 2) * length)


def spread_of_gradient(run):
    return spread(run.csv("pressure_gradient"), line=False)


def fastest_in_plug(run):
    """Over 4 Ubar / least fraction."""
    return run.csv("fastest_fluid")[-1] / (0.4 / least_fraction(run))


def fastest_at_the_end(run, push):
    return run.csv("fastest_particle")[-1] / (push / 20)


def growth_of_the_fastest(run, push):
    """Fastest sphere of the last quarter over the fastest of the quarter before, or over a thousandth of the push."""
    fastest = run.csv("fastest_particle")
    return max(fastest[150:]) / max(push / 1000, *fastest[100:150])


def fastest_fluid_late(run, push):
    return max(run.csv("fastest_fluid")[150:]) / push


# --- annuli -------------------------------------------------------------------------------------------------------------
def annulus_error(run, Ubar, hole, pipe, e, viscosity):
    return abs(gradient(run) / annulus_gradient(Ubar, hole, pipe, e, viscosity) - 1)


def deepest_overlap(run, d, hole, pipe, e):
    """With bore or pipe, in diameters."""
    return max(max(math.hypot(p["x"], p["y"]) + d / 2 - hole, pipe + d / 2 - math.hypot(p["x"], p["y"] + e * (hole - pipe)))
               for p in run.frames()[-1]) / d


def below_the_pipe(run, hole, pipe, e):
    return sum(abs(p["x"]) < 0.005 and p["y"] < -pipe - e * (hole - pipe) for p in run.frames()[-1])


def fastest_across(run):
    return max(math.hypot(p["vx"], p["vy"]) for p in run.frames()[-1])
