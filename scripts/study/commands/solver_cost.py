# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cost per step of annulusFoam beside stock pimpleFoam: same mesh, rheology, schemes and linear solvers, run in turn."""
import argparse
import re
import statistics

from .. import foam, options, runs, tables
from ..programs import digest_of, run

STEP, SHORT = 0.002, 5  # of the flow [s]; steps of the run that the start-up is taken from
PRESSURE, VISCOSITY = ("gamg", "gamgDefault", "pcg", "pcgGamg"), ("interpolated", "strainRate")
MODELS = ("laminar", "kEpsilon", "realizableKE", "kOmegaSST")
COUPLED = "tests/openfoam_coupled_cost"


def turn_job(chosen, pressure, viscosity, model, turn):
    """CPU seconds of a step of each solver without the start-up: the difference of a long and a short run."""
    mesh = {"cells": f"({chosen.cells})", "length": f"{chosen.length:g}"}
    flow = {"runViscosity": viscosity, "runSimulation": "laminar" if model == "laminar" else "RAS",
            "runModel": "kEpsilon" if model == "laminar" else model}
    solver = {"chosen": f"{{ $..{pressure}; }}"}
    solvers = {"pimpleFoam": "pimpleFoam", "annulusFoam": chosen.build / "bin" / "annulusFoam", "coupled": chosen.build / COUPLED}

    def work(folder):
        case, seconds, spent = folder / "case", {}, 0.0
        foam.set_up(case, "solver-cost", mesh=mesh, pressure=solver, settings={**flow, "runEnd": 0})
        run([chosen.build / "bin" / "annulusMesh"], case, folder / "annulusMesh.txt")
        for name, program in solvers.items():
            if name != "pimpleFoam":  # fvOptions drives stock's flow alone; annulusFoam refuses it
                (case / "constant" / "fvOptions").unlink(missing_ok=True)
            times = []
            for steps in (SHORT, SHORT + chosen.steps):
                foam.put(case / "settings", **flow, runEnd=f"{STEP * steps:g}")
                times.append(run([program], case, folder / f"{name}.txt", LD_LIBRARY_PATH=str(chosen.build / "lib"))[0])
            seconds[name] = (times[1] - times[0]) / chosen.steps
            spent += sum(times)
        solves = [int(n) for n in re.findall(r"Solving for p,.* (\d+)$", (folder / "pimpleFoam.txt").read_text(), re.M)]
        return {"seconds": seconds, "iterations": statistics.fmean(solves), "cpu": spent}

    inputs = {"what": "solver cost", "case": foam.digest("solver-cost"),
              "coupled": digest_of(chosen.build / COUPLED), "steps": chosen.steps, "turn": turn, **mesh,
              "pressure": pressure, "viscosity": viscosity, "model": model}
    return runs.Job(f"{pressure}, {viscosity}, {model}, turn {turn + 1}", inputs, work, 30)


def three_numbers(text):
    if not re.fullmatch(r"[1-9]\d* [1-9]\d* [1-9]\d*", " ".join(text.split())):
        raise argparse.ArgumentTypeError(f"'{text}' is not three whole numbers such as '12 48 24'")
    return " ".join(text.split())


def main():
    parser = options.Parser(
        "solver-cost", "Runs both solvers in turn on a periodic eccentric annulus with a turning pipe (single phase): CPU seconds per step and their "
        "ratio, once with the viscosity averaged between cells as stock does, once with that of each face; `coupled` is the averaged flow with all "
        "fields of the particles (alpha = 0.9). The whole hole of the paper, 139,968 cells: --cells '12 48 243' --length 12 --steps 6 --turns 1 "
        "--pressure gamg pcg pcgGamg gamgDefault", "960 cells, 5 steps, one turn", at_once=1)
    parser.add_argument("--cells", type=three_numbers, metavar="'RADIAL AROUND AXIAL'", help="default: 12 48 24")
    parser.add_argument("--length", type=float, default=0.3, metavar="METRES", help="default: 0.3")
    parser.add_argument("--steps", type=options.at_least_one, metavar="N", help="default: 40")
    parser.add_argument("--turns", type=options.at_least_one, metavar="N", help="default: 3")
    parser.add_argument("--pressure", action=options.Words, choices=PRESSURE, default=["gamg"], help="linear solvers of the pressure, compared in turn: "
                        "gamg (tuned for long thin cells; the default), gamgDefault, pcg (DIC), pcgGamg (PCG preconditioned by the tuned GAMG)")
    parser.add_argument("--turbulence", action=options.Words, choices=MODELS, default=["laminar"], metavar="MODEL", help="flows compared in turn: laminar "
                        "(default), kEpsilon, realizableKE, kOmegaSST")
    parser.add_argument("--viscosity", action=options.Words, choices=VISCOSITY, default=VISCOSITY, help="of faces (default: both)")

    def check(chosen):
        chosen.cells = chosen.cells or ("4 24 10" if chosen.quick else "12 48 24")
        if not chosen.length > 0:
            parser.error(f"--length is {chosen.length:g}: give a number above 0")
        chosen.steps, chosen.turns = chosen.steps or (5 if chosen.quick else 40), chosen.turns or (1 if chosen.quick else 3)

    chosen = parser.settle(("annulusMesh", "annulusFoam", COUPLED), check)
    jobs = {(turn, p, v, m): turn_job(chosen, p, v, m, turn)
            for turn in range(chosen.turns) for p in chosen.pressure for v in chosen.viscosity for m in chosen.turbulence}
    found = chosen.store.run_all("solver cost", jobs.values())
    if chosen.plan:
        return 0
    rows = []
    for (turn, pressure, viscosity, model), r in runs.needed(found, jobs).items():
        stock, ours, averaged = (r["seconds"][name] for name in ("pimpleFoam", "annulusFoam", "coupled"))
        rows.append([turn + 1, pressure, viscosity, model, f"{r['iterations']:.0f}", f"{stock:.4f}", f"{ours:.4f}", f"{ours / stock:.3f}", f"{averaged:.4f}",
                     f"{averaged / stock:.3f}"])
    tables.publish(chosen, "cost", f"CPU s per step, cells {chosen.cells}, length {chosen.length:g} m, {chosen.steps} steps",
                   ["turn", "pressure", "viscosity", "model", "iterations", "pimpleFoam_s", "annulusFoam_s", "ratio", "coupled_s", "coupled_ratio"], rows)
    return 0
