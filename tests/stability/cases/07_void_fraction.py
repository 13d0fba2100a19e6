# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Particles on meshes that are finer and coarser than they are."""
from math import sqrt

from harness import checks, checks_flow
from harness.case import Check, Fails, Group
from harness.scenes import box, material, plug, spheres, spheres_at, weight, weight_along

GROUP = Group("void_fraction", "7. Void fraction", """
A particle does not know of cells: dragged at a steady speed it feels a steady force, whatever cells it crosses (a straight line is taken
off, as the wake in the periodic box still grows). In a steady periodic flow without walls the forces on all particles balance the driving gradient,
G V, and like neighbours feel alike (within a factor of 1.2: at the faces of a bed cells count). What is inserted at once pushes the fluid out within one step: its inertia bounds the pressure by
rho L dU/dt with dU = V/(A dt), between the spheres 1/alpha times that (factor 2: the second-order scheme); afterwards, and after the removal, the pressure is that of the drag again.""",
              {
                  "d": 6.35e-3,
                  "viscosity": 0.1,
                  "density": 1000.0,
                  "ranks": 1,
                  "method": "diffusion",
                  "drive": "type meanVelocity; Ubar 0; direction (0 0 1); initialGradient 0;",
                  "fluid_step": 0.0025,
                  "extra": "",
                  "top": "cyclic; neighbourPatch inlet",
                  "bottom": "cyclic; neighbourPatch outlet",
                  "inlet_U": "type cyclic;",
                  "outlet_U": "type cyclic;",
                  "inlet_p": "type cyclic;",
                  "outlet_p": "type cyclic;",
                  "shift": 0.0,
              })


def cells_and_fluid(viscosity, density, wide, cell, high):
    """What the dictionaries of the box read."""
    return {"cells_across": round(wide / cell), "cells_along": round(high / cell), "nu": viscosity / density}


BOX = {"files": ["void_fraction"], "settings": cells_and_fluid, "commands": ["blockMesh", "annulusFoam"]}


def coupled(viscosity, density, every):
    """Drag and pressure gradient of a flow that is computed every so many steps."""
    return (f"fix mud all fluid/force rheology newtonian {viscosity} density {density} drag chien pressure_gradient on buoyancy off\n"
            f"fix flow all fluid/couple link solver every {every}\n")


def dragged(wide, high, x, d, fluid_step, viscosity, density, seconds, processors="* * *"):
    """A heavy sphere at a steady speed through the box."""
    return f'''{box("0 %r 0 %r 0 %r" % (wide, wide, high), "p p p", skin=2e-3, processors=processors)}
{material()}
{spheres()}
create_atoms 1 single {x} {0.4 * wide} {0.1 * high} units box
set group all diameter {d} density 1e9
velocity all set 0.013 0.007 0.1
timestep {fluid_step / 25}
fix move all nve/sphere
{coupled(viscosity, density, 25)}
thermo 5
thermo_style custom step f_mud[1] f_mud[3] f_mud[12]
run {25 * round(seconds / fluid_step)}
'''


def crossing_cells(wide, high, d, fluid_step, viscosity, density, cells):
    return dragged(wide, high, 0.3 * wide, d, fluid_step, viscosity, density, 2.2 * max(high / 3, 2 * cells * d) / 0.1)


GROUP.case(
    "crossing_cells_{cells:g}d_mu{viscosity}",
    "sphere dragged through cells of {cells:g} d at 0.1 m/s in {viscosity} Pa s",
    scene=crossing_cells,
    quick=lambda cells, viscosity: cells == 1.0 and viscosity < 1,
    seconds=10,
    vary={"cells": [0.25, 0.5, 1.0, 2.0, 4.0], "viscosity": [0.1, 1.0, 10.0]},
    derive=lambda cells, d: {"cell": cells * d, "wide": max(6, 4 * cells) * d, "high": max(6, 4 * cells) * d},
    **BOX,
    checks=[
        Check("spread of the force on the sphere about its straight line, (largest - smallest) / mean", checks_flow.spread_of_force, below=0.02),
        Check("error of the solid volume on the mesh", checks_flow.volume_error, below=1e-12),
    ],
    fails=[
        Fails("volume and force in the cell of the centre alone", set={"method": "centre"},
              says="the fluid fraction of a closed or periodic section changed|has blown up"),
    ])


def crossing_ranks(wide, high, shift, ranks, d, fluid_step, viscosity, density):
    return dragged(wide, high, 0.3 * wide + (shift if ranks > 1 else 0), d, fluid_step, viscosity, density, 0.8 * high / 0.1, "1 1 *")


GROUP.case(
    "crossing_ranks",
    "sphere dragged through cells of d, on 1 and 2 ranks: it crosses from rank to rank",
    scene=crossing_ranks,
    seconds=10,
    derive=lambda d: {"cell": d, "wide": 6 * d, "high": 6 * d},
    runs=[{"ranks": 1}, {"ranks": 2}],
    files=["void_fraction"],
    settings=cells_and_fluid,
    commands=lambda ranks: ["serial blockMesh", f"serial {'decomposePar' if ranks > 1 else 'true'}",
                            f"annulusFoam {'-parallel' if ranks > 1 else ''}"],
    checks=[
        Check("spread of the force on 2 ranks about its straight line", checks_flow.spread_of_force, below=0.02, which=1),
        Check("largest difference of the force, 2 ranks against 1, relative", checks_flow.force_difference, below=1e-6),
    ],
    fails=[
        Fails("a start that is a tenth of a millimetre off on two ranks", set={"shift": 0.0001}),
    ])


def bed_beside_clear_fluid(wide, high, d, fluid_step, viscosity, density):
    atoms = spheres_at(((i + 0.6) * d, (j + 0.6) * d,
    (k + 0.6) * d) for i in range(4) for j in range(8) for k in range(8))
    return f'''{box("0 %r 0 %r 0 %r" % (wide, wide, high), "p p p", skin=2e-3)}
{material()}
{spheres()}
{atoms}
set group all diameter {d} density 2619
timestep {fluid_step / 5}
fix hold all freeze
{coupled(viscosity, density, 5)}
thermo 50
thermo_style custom step atoms f_mud[1] f_mud[10]
run 2000
dump 1 all custom 5 dump id x z f_mud[1]
dump_modify 1 format "%d %.9g %.9g %.9g"
run 5
'''


GROUP.case(
    "bed_beside_clear_fluid_{cells:g}d",
    "packed bed (256 spheres held) beside clear fluid that flows through both, cells of {cells:g} d",
    scene=bed_beside_clear_fluid,
    seconds=10,
    vary={"cells": [0.4, 0.8, 2.0]},
    values={"viscosity": 1.0, "drive": "type pressureGradient; direction (1 0 0); gradient 1000;"},
    derive=lambda cells, d: {"cell": cells * d, "wide": 8 * d, "high": 8 * d},
    **BOX,
    checks=[
        Check("drag and pressure forces on the bed / (G V) - 1", checks_flow.force_balance_error, below=0.01),
        Check("largest / smallest drag among the like spheres of a layer", checks_flow.unlike_drag, below=1.2),
        Check("largest difference of p_rgh in the box without its gradient / (G L)", checks_flow.pressure_range, below=1.0),
        Check("least fluid fraction", checks_flow.least_fraction, above=0.25),
    ],
    fails=[
        Fails("volume and force in the cell of the centre alone", set={"method": "centre"}, when=lambda cells: cells < 1,
              says="ended with status -8|has blown up"),
        # there the cells of the centres happen to share alike
        Fails("explicit momentum in the fluid, coupled every 20 ms", set={"extra": "momentum explicit;", "fluid_step": 0.02},
              when=lambda cells: cells > 1, says="the fluid fraction of a closed or periodic section changed|has blown up|ended with status -8"),
    ])


def inserted_and_removed(wide, high, d, fluid_step, viscosity, density, remove):
    atoms = spheres_at(((1.4 * i + 1) * d, (1.4 * j + 1) * d,
    (1.4 * k + 5) * d) for i in range(4) for j in range(4) for k in range(4))
    return f'''{box("0 %r 0 %r 0 %r" % (wide, wide, high), "p p f", skin=2e-3)}
{material()}
{spheres()}
create_atoms 1 single {0.3 * wide} {0.4 * wide} {2 * d} units box
set group all diameter {d} density 2619
timestep {fluid_step / 5}
fix hold all freeze
{coupled(viscosity, density, 5)}
run 500
{atoms}
set group all diameter {d} density 2619
run 500
region block block INF INF INF INF {4 * d} {11 * d} units box
{"delete_atoms region block" if remove else ""}
run 500
'''


GROUP.case(
    "inserted_and_removed",
    "64 spheres appear at once in a stream of 0.05 m/s and vanish again",
    scene=inserted_and_removed,
    quick=True,
    seconds=6,
    values={"viscosity": 1.0, "remove": True, "drive": "type none;", "top": "patch", "bottom": "patch",
            "inlet_U": "type fixedValue; value uniform (0 0 0.05);", "outlet_U": "type pressureInletOutletVelocity; value uniform (0 0 0);",
            "inlet_p": "type zeroGradient;", "outlet_p": "type fixedValue; value uniform 0;", "extra": "length 0.019;"},
    derive=lambda d: {"cell": d, "wide": 6 * d, "high": 16 * d},
    **BOX,
    checks=[
        Check("largest pressure gradient / (2 rho dU/dt / least fraction), dU = V/(A dt)", checks_flow.insertion_pressure, below=1),
        Check("pressure gradient with the spheres at the end of the second part / its mean over the last 40 steps, - 1",
              checks_flow.unsteady_gradient, below=0.02),
        Check("gradient after the removal / before the insertion - 1", checks_flow.gradient_left, below=0.05),
        Check("fastest fluid ever / (0.05 m/s + 2 dU)", checks_flow.fastest_while_inserting, below=1),
    ],
    fails=[
        Fails("the spheres stay", set={"remove": False}),
    ])


def blocked_annulus(hole, length, pipe, offset, d, part, fluid_step, viscosity, density):
    return f'''{box("%r %r %r %r 0 %r" % (-hole, hole, -hole, hole, length), "f f p", skin=2e-3)}
{material()}
{spheres()}
{weight_along("0 0 -1")}
{plug(hole, pipe, offset, d, part * length)}
set group all diameter {d} density 2619
timestep {fluid_step / 5}
fix hold all freeze
{coupled(viscosity, density, 5)}
thermo 50
thermo_style custom step atoms f_mud[3] f_mud[12]
run 500
'''


GROUP.case(
    "blocked_annulus_{method}",
    "annulus (e = 0.5) with 30 % of solid in a plug of spheres that fills its whole cross-section, flow of 0.1 m/s",
    scene=blocked_annulus,
    seconds=40,
    vary={"method": ["diffusion"]},
    values={"hole": 0.0635, "pipe": 0.02413, "offset": 0.019685, "length": 0.0635, "viscosity": 0.5,
            "drive": "type meanVelocity; Ubar 0.1; direction (0 0 1); initialGradient 1000;", "fluid_step": 5e-3, "cell": 1.0, "wide": 1.0,
            "high": 1.0, "parts": "(8 32 8)", "part": 0.76},
    files=["void_fraction", "void_fraction/blocked_annulus"],
    settings=cells_and_fluid,
    commands=["annulusMesh", "annulusFoam"],
    checks=[
        Check("solid volume / volume", checks_flow.solid_share, above=0.28),
        Check("forces on the plug / (G V)", checks_flow.force_on_plug, below=1.0),
        Check("forces on the plug / (G V), from below: walls take little", checks_flow.force_on_plug, above=0.8),
        Check("spread of the pressure gradient over the last half", checks_flow.spread_of_gradient, below=0.02),
        Check("fastest fluid / (4 Ubar / least fraction)", checks_flow.fastest_in_plug, below=1),
        Check("least fluid fraction", checks_flow.least_fraction, above=0.25),
    ],
    fails=[
        Fails("with a third of the spheres the section stays open", set={"part": 0.25}),
    ])


def pushed_bed(wide, high, layers, across, d, push, viscosity, density, fluid_step, again):
    atoms = spheres_at(((i + 0.5 + 0.5 * (k % 2)) % across * d, (j + 0.5 + 0.5 * (k % 2)) % across * d,
    (k * sqrt(0.5) + 0.5) * d) for k in range(layers) for i in range(across) for j in range(across))
    return f'''{box("0 %r 0 %r 0 %r" % (wide, wide, high), "p p f", skin=2e-3)}
{material(5e6, 0.5, 0.5)}
{spheres()}
{weight()}
{atoms}
set group all diameter {d} density 2619
region low block INF INF INF INF INF {0.6 * d} units box
group held region low
fix hold held freeze
group free subtract all held
fix move free nve/sphere
velocity free set NULL NULL {push}
timestep 5e-5
fix mud all fluid/force rheology newtonian {viscosity} density {density} drag chien pressure_gradient on
fix flow all fluid/couple link solver every {round(fluid_step / 5e-5)}
thermo {round(fluid_step / 5e-5)}
thermo_style custom step atoms ke
run {round(fluid_step / 5e-5) * 180}
{"velocity free set NULL NULL %r" % push if again else ""}
run {round(fluid_step / 5e-5) * 20}
'''


GROUP.case(
    "pushed_bed_mu{viscosity}_dt{fluid_step}",
    "bed of 74 % solid on a held layer, pushed up by 1 cm/s, cells of d, {viscosity} Pa s, coupled every {fluid_step} s: comes to rest",
    scene=pushed_bed,
    seconds=20,
    vary={"viscosity": [1e-3, 0.1, 10.0], "fluid_step": [2e-3, 0.01]},
    values={"layers": 8, "across": 4, "push": 0.01, "drive": "type none;", "top": "wall", "bottom": "wall", "inlet_U": "type noSlip;",
            "outlet_U": "type noSlip;", "inlet_p": "type zeroGradient;", "outlet_p": "type zeroGradient;", "momentum": "semiImplicit",
            "again": False},
    derive=lambda d, across, momentum: {"cell": d, "wide": across * d, "high": 6 * d, "extra": 'momentum %s;' % momentum},
    **BOX,
    checks=[
        Check("spheres", checks.bodies, equals=lambda layers, across: layers * across ** 2),
        Check("fastest sphere at the end / a twentieth of the push", checks_flow.fastest_at_the_end, below=1),
        Check("fastest sphere of the last quarter / fastest of the quarter before, or a thousandth of the push: it does not grow",
              checks_flow.growth_of_the_fastest, below=1),
        Check("fastest fluid of the last quarter / push", checks_flow.fastest_fluid_late, below=1),
    ],
    fails=[
        # shorter intervals in thin fluids are no trouble
        Fails("explicit momentum in the fluid", set={"momentum": "explicit"},
              when=lambda viscosity, fluid_step: viscosity > 1 or viscosity > 0.01 and fluid_step > 5e-3,
              says="the fluid fraction of a closed or periodic section changed|has blown up|ended with status -8"),
        Fails("the bed is pushed once more before the end", set={"again": True},
              when=lambda viscosity, fluid_step: not (viscosity > 1 or viscosity > 0.01 and fluid_step > 5e-3)),
    ])
