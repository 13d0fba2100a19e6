# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From what a user wants to a scene that can be computed: cells, steps, number of grains, each with its reason (docs/choosing-steps.md)."""
import math
import pathlib
import re
import tempfile
import typing

from . import programs
from .annulus_flow import Annulus, Mud, laminar_limit, metzner_reed, pressure_gradient, slot_speed
from .programs import BUILD, Failure
from .spread import Spread
from .units import PENETRATION

PI, GRAVITY = math.pi, 9.81
YIELD_NUMBER = 0.0476667  # of a sphere that a yield stress just holds: tau0 / ((rho_p - rho_f) g d), Beris et al. 1985
SAFETY = 0.3  # of the critical DEM step
# A bed's critical step over that of one contact at an impact: bodies of a bed have several contacts at once (docs/benchmarks/steps.md has S1, C8 to
# C64, D7 to D48: 0.43, 0.29 to 0.25, 0.31 to 0.19).
IN_A_BED = {"sphere": 0.43, "cluster": 0.25}
LARGEST_STEP = 5e-3  # [s], of the fluid: measured in docs/choosing-steps.md
COURANT = 0.5  # of the wide side
PACKING = 0.55  # what random pouring reaches
TEMPLATE = """atom_style granular
boundary f f f
newton off
communicate single vel yes
units si
region box block -{side} {side} -{side} {side} -{side} {side} units box
create_box 1 box
neighbor {skin} bin
fix m1 all property/global youngsModulus peratomtype {stiffness}
fix m2 all property/global poissonsRatio peratomtype 0.25
fix m3 all property/global coefficientRestitution peratomtypepair 1 {restitution}
fix m4 all property/global coefficientFriction peratomtypepair 1 {friction}
pair_style {pair} model hertz tangential history
pair_coeff * *
timestep 1e-9
{template}
fix mixture all particledistribution/discrete 32452843 1 grain 1.0
region middle sphere 0 0 0 {reach} units box
fix pour all insert/pack seed 86028121 distributiontemplate mixture insert_every once overlapcheck yes all_in no vel constant 0 0 0 region middle &
  particles_in_region 1 ntry_mc 1000
fix move all {move}
fix limit all timestep/limit safety 0.3 every 1 speed {speed}
thermo_style custom step atoms f_limit
thermo 1
thermo_modify format float %.10g
run 2
"""


class Wishes(typing.NamedTuple):
    """In SI; radii of hole and pipe; texts where the user may leave the choice to us."""
    kind: str
    hole: float
    pipe: float
    eccentricity: float
    inclination: float
    rpm: float
    length: float
    velocity: float
    tau0: float
    k: float
    n: float
    mud_density: float
    shape: str
    diameter: float
    solid_density: float
    solid: float
    rate: float
    stiffness: float
    friction: float
    restitution: float
    rolling: float
    seconds: float
    cells: typing.Optional[str]
    fluid_step: typing.Optional[str]
    interval: typing.Optional[str]
    seed: str
    spread: typing.Optional[Spread] = None  # of the diameter

    @property
    def smallest(self):
        """Diameter of the smallest grains [m]."""
        return self.spread.smallest if self.spread else self.diameter


class Layout(typing.NamedTuple):
    """A scene: what the wishes come to."""
    wishes: Wishes
    annulus: Annulus
    gradient: float
    wide_speed: float
    reynolds_mean: float
    reynolds_wide: float
    laminar_limit: float
    held_diameter: float
    cells: tuple
    why_cells: str
    fluid_step: float
    why_fluid_step: str
    critical_step: float
    interval: int
    count: int
    why_count: str
    warnings: list

    @property
    def number_of_cells(self):
        return math.prod(self.cells)


def critical_step(wish, speed):
    """[s] in a bed, from that of an impact at `speed` [m/s] by fix timestep/limit in a scene of one such grain."""
    spheres = wish.shape == "sphere"
    # A grain's longest extent is not known yet: a disk of aspect 0.1 has 1.9 times the radius of its equal sphere, a needle more.
    diameter = wish.smallest
    reach = 4 * diameter
    words = {"side": 4 * reach, "reach": reach, "skin": 0.3 * diameter, "stiffness": wish.stiffness, "restitution": wish.restitution,
             "friction": wish.friction, "speed": speed, "pair": "gran" if spheres else "gran/cluster", "move": "nve/sphere" if spheres else "nve/cluster",
             "template": f"fix grain all particletemplate/sphere 15485863 atom_type 1 density constant {wish.solid_density} radius constant {diameter / 2}"
             if spheres else f"fix grain all particletemplate/cluster 15485863 atom_type 1 density constant {wish.solid_density} shape {wish.shape} "
             f"diameter {diameter}"}
    with tempfile.TemporaryDirectory(prefix="eccentra-new-") as folder:
        script = pathlib.Path(folder) / "in.grain"
        script.write_text(TEMPLATE.format(**words))
        log = pathlib.Path(folder) / "log"
        try:
            programs.run([BUILD / "bin" / "eccentra-dem", "-in", script, "-log", "none"], pathlib.Path.cwd(), log)
        except programs.RunFailed as failure:
            raise Failure(f"a grain '{wish.shape}' cannot be made: {failure}") from None
        rows = re.findall(r"^ *2 +1 +([0-9.eE+-]+) *$", log.read_text(), re.MULTILINE)
    if not rows:
        raise Failure(f"a grain '{wish.shape}' of {wish.diameter} m was not placed: give another shape or diameter")
    return float(rows[-1]) * IN_A_BED["sphere" if spheres else "cluster"]


def cells_of(wish, annulus):
    """(across, around, along) and why."""
    if wish.cells:
        numbers = wish.cells.split()
        if len(numbers) != 3 or not all(re.fullmatch("[1-9][0-9]*", number) for number in numbers):
            raise Failure(f"--cells: '{wish.cells}' is not three whole numbers; expected three such as \"8 32 20\"")
        return tuple(map(int, numbers)), "as you gave them"
    gap = wish.hole - wish.pipe
    across = min(max(round(gap / (1.5 * wish.diameter)), 6), 12)
    width = gap / across
    around = 4 * max(round(PI * (wish.hole + wish.pipe) / (1.75 * width) / 4), 6)
    along = max(round(wish.length / (3 * width)), 4)
    return (across, around, along), "a mean cell is 1.5 grains across (6 to 12 cells), 1.75 times as long around, 3 times along"


def fluid_step_of(wish, cells, wide_speed):
    """[s] and why."""
    if wish.fluid_step:
        try:
            step = float(wish.fluid_step)
        except ValueError:
            step = 0
        if not 0 < step < 1:
            raise Failure(f"--fluid-step: '{wish.fluid_step}' is not a step; expected seconds such as 5e-3")
        return step, "as you gave it"
    longest = COURANT * wish.length / cells[2] / wide_speed
    step = min(LARGEST_STEP, longest)
    digit = 10.0 ** math.floor(math.log10(step))
    step = next(m * digit for m in (5, 2, 1) if m * digit <= step * (1 + 1e-9))
    courant = step * wide_speed * cells[2] / wish.length
    return step, f"Courant number {courant:.2f} on the wide side (at most {COURANT}), at most 5 ms"


def interval_of(wish, fluid_step, critical):
    """DEM steps in a fluid step."""
    if wish.interval:
        if not re.fullmatch("[1-9][0-9]*", wish.interval):
            raise Failure(f"--interval: '{wish.interval}' is not a whole number from 1 on")
        return int(wish.interval)
    return math.ceil(fluid_step / (SAFETY * critical))


def lay_out(wish):
    """The whole scene; Failure where it cannot be one."""
    annulus, mud = Annulus(wish.hole, wish.pipe, wish.eccentricity), Mud(wish.tau0, wish.k, wish.n, wish.mud_density)
    if wish.diameter > annulus.widest:
        raise Failure(f"--diameter: {wish.diameter:.4g} m does not fit into the gap, which is {annulus.widest:.4g} m at its widest")
    gradient = pressure_gradient(mud, annulus, wish.velocity)
    wide = slot_speed(mud, annulus.widest, gradient)
    cells, why_cells = cells_of(wish, annulus)
    fluid_step, why_fluid_step = fluid_step_of(wish, cells, wide)
    critical = critical_step(wish, max(1.0, 2 * wide))
    grain = wish.spread.volume if wish.spread else PI / 6 * wish.diameter**3
    if wish.kind == "section":
        count = round(wish.solid * annulus.area * wish.length / grain)
        why_count = f"{100 * wish.solid:.3g} % of {annulus.area * wish.length:.4g} m3"
    else:
        per_second = wish.rate / (wish.solid_density * grain)
        count = round(per_second * wish.seconds)
        speed = wish.rate / (wish.solid_density * PI * wish.hole**2)  # of the bit that makes them
        why_count = f"{per_second:.4g} per second ({wish.rate:.4g} kg/s, {speed / PENETRATION['ft/h']:.3g} ft/h of the hole) in {wish.seconds:g} s"
    layout = Layout(wish, annulus, gradient, wide, metzner_reed(mud, annulus.hydraulic_diameter, wish.velocity), metzner_reed(mud, 2 * annulus.widest, wide),
                    laminar_limit(wish.n), wish.tau0 / (YIELD_NUMBER * GRAVITY * abs(wish.solid_density - wish.mud_density) or math.inf), cells, why_cells,
                    fluid_step, why_fluid_step, critical, interval_of(wish, fluid_step, critical), count, why_count, [])
    layout.warnings.extend(warnings_of(layout))
    return layout


def warnings_of(layout):
    """Where cells, gaps, grains and steps do not fit each other."""
    wish, annulus, cells = layout.wishes, layout.annulus, layout.cells
    said = []
    largest = wish.spread.largest if wish.spread else wish.diameter
    if largest > annulus.narrowest:
        said.append(f"the narrow side ({1e3 * annulus.narrowest:.3g} mm) lets no grain of {1e3 * largest:.3g} mm through: grains wedge there")
    if max(layout.reynolds_mean, layout.reynolds_wide) > layout.laminar_limit:
        said.append(f"the flow is turbulent where Re is above {layout.laminar_limit:.4g}, and is computed as laminar: "
                    "pressure drop and transport come out too low; run --turbulence kEpsilon computes it with a model (docs/turbulence.md)")
    smallest = annulus.narrowest / cells[0]
    if smallest < 0.1 * wish.diameter:
        said.append(f"cells of the narrow side are {1e3 * smallest:.2g} mm, a tenth of a grain or less: void fractions there are spread over three grains")
    if wish.kind == "section" and wish.solid > 0.12:
        said.append("so many grains find no room at random at once: they are poured across the hole for half a second first (pouring in the file scene)")
    if layout.fluid_step / layout.interval > 0.9 * layout.critical_step:
        said.append("the DEM step is above 0.9 of the critical one: the run will refuse it; give a larger --interval")
    if wish.solid_density <= wish.mud_density:
        said.append("the grains are lighter than the mud: they rise")
    return said
