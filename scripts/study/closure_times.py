# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nanoseconds of each closure, alone and together, beside a hand-written drag loop, as the benchmark of tests/fluid times them."""
import csv
import io
import math

from . import runs
from .programs import Failure, run

SINGLE = ("drag_chien", "shear_lift", "rotational_lift", "drag_torque", "pressure_gradient", "viscous_stress", "buoyancy")
FLUIDS = ("herschel_bulkley", "newtonian")


def job(build, repetitions):
    """The least of so many interleaved repetitions, which other load disturbs least."""
    def work(folder):
        cpu, *_ = run([build / "tests" / "closures_benchmark", "--benchmark_min_time=0.02", f"--benchmark_repetitions={repetitions}",
                      "--benchmark_enable_random_interleaving=true", "--benchmark_format=console", "--benchmark_out_format=csv",
                      "--benchmark_out=times.csv"], folder, folder / "out.txt")
        text = (folder / "times.csv").read_text()
        least = {}
        for row in csv.DictReader(io.StringIO(text[text.index("name,iterations"):])):
            if not row["name"].endswith(("_mean", "_median", "_stddev", "_cv")):
                name, time = row["name"], next(float(v) for v in reversed(list(row.values())) if v)
                least[name] = min(time, least.get(name, math.inf))
        if "empty" not in least:
            raise Failure(f"the benchmark of closures printed no times: see {folder / 'out.txt'}")
        return {"least": least, "cpu": cpu}

    return runs.Job(f"closures, {repetitions} repetitions", {"what": "closures", "repetitions": repetitions}, work, repetitions)


def of_hand_written(least):
    """Percent by which drag alone exceeds the hand-written loop."""
    return 100 * ((least["drag_chien/herschel_bulkley"] - least["empty"]) / (least["hand_written_drag/herschel_bulkley"] - least["empty"]) - 1)


def rows(least):
    """[closure, rheology, ns per particle and step], without clearing the arrays between two steps."""
    return [[*(f"{name}/".split("/")[:2]), time - least["empty"]] for name, time in sorted(least.items()) if name != "empty"]


def lines(least):
    """The rows and what they say."""
    said = [f"{closure:26s} {rheology:18s} {time:9.1f}" for closure, rheology, time in rows(least)]
    for fluid in FLUIDS:
        together = least[f"all/{fluid}"] - least["empty"]
        single = sum(least[f"{name}/{fluid}"] - least["empty"] for name in SINGLE)
        said.append(f"all seven together in {fluid}: {together:.1f} ns; the sum of each alone: {single:.1f} ({100 * (together / single - 1):+.1f} %)")
    return said + [f"drag alone against the hand-written loop: {of_hand_written(least):+.1f} %"]
