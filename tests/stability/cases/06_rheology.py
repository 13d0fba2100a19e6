# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Herschel-Bulkley fluids of all kinds between parallel plates."""
from harness import checks_flow
from harness.case import Check, Fails, Group
from harness.scenes import consistency, drive_words, wall_stress

GROUP = Group("rheology", "6. Rheology", """
The mean velocity of a Herschel-Bulkley fluid between plates at a given gradient is known in closed form. From rest, with steps so long that each is
a Picard iteration, and after the gradient has turned round, it must be reached for every index and every cap of the viscosity. A plug that fills the
gap moves no faster than its cap of viscosity lets it creep, G h^2/(12 muY). A cap of 3.6 k in eq (4) is known to be wrong by tens of percent.""",
              {
                  "gap": 0.02,
                  "k": 0.28,  # without yield stress; with one, the k that gives a plug of half the gap at this rate
                  "rate": 10.0,  # shear rate at the wall without yield stress, 1/s
                  "model": "HerschelBulkleyCapped",
                  "step": 1000.0,
                  "steps": 400,
                  "sign": 1,
                  "cells": 80,  # n = 0.2 shears a layer of a twelfth of the gap only
                  "cap": 0.0,  # 0: ratio k
                  "progress": 2,  # s of wall time between two lines; 0: a line for each step
              })


def channel(steps, step, tau0, rate, n, k, cap, drive, ratio, gap):
    """What the dictionaries of the channel read."""
    sheared = consistency(tau0, rate, n, k)
    gradient = wall_stress(drive, tau0, sheared, rate, n) / (gap / 2)
    return {"end": steps * step, "consistency_": sheared, "muY": cap or ratio * sheared, "gradient": drive_words(drive, gradient, steps * step)}


CHANNEL = {"files": ["rheology"], "settings": channel, "commands": ["blockMesh", "annulusFoam"]}


GROUP.case(
    "n{n}_tau0{tau0}_ratio{ratio}",
    "channel, n = {n}, tau0 = {tau0} Pa, muY/k = {ratio}, from rest by steps of 1000 s",
    quick=lambda n, tau0, ratio: n == 0.5 and tau0 == 2.0 and ratio == 1e4,
    seconds=1,
    vary={"n": [0.2, 0.5, 1.0, 1.5], "tau0": [0.0, 2.0], "ratio": [100.0, 10000.0, 1e6]},
    values={"drive": "steady"},
    **CHANNEL,
    checks=[
        Check("mean velocity against the closed form, relative error", checks_flow.channel_error, below=0.03),
    ],
    fails=[
        Fails("eq (4) with a cap of 3.6 k", set={"model": "HerschelBulkleyRegularised", "cap": 1.0},
              when=lambda tau0, n, ratio: tau0 == 2.0 and n in (0.2, 0.5) and ratio == 1e4),
        Fails("two cells across the gap", set={"cells": 2}, when=lambda tau0, n, ratio: not (tau0 == 2.0 and n in (0.2, 0.5) and ratio == 1e4)),
    ])


GROUP.case(
    "fast_n{n}",
    "channel, n = {n}, tau0 = 2 Pa, k = 0.28, wall stress 4 Pa: 18,600 1/s at the wall, 14 m/s, from rest by steps of 1000 s",
    seconds=1,
    vary={"n": [0.2]},
    values={"drive": "steady", "tau0": 2.0, "ratio": 10000.0, "rate": 18593.4},
    **CHANNEL,
    checks=[
        Check("mean velocity against the closed form, relative error", checks_flow.channel_error, below=0.03),
    ],
    fails=[
        Fails("eq (4) with a cap of 3.6 k, at a rate that is no trouble", set={"model": "HerschelBulkleyRegularised", "cap": 1.0, "rate": 10.0}),
    ])


GROUP.case(
    "reversal_n{n}_tau0{tau0}",
    "channel, n = {n}, tau0 = {tau0} Pa, muY/k = {ratio}: the gradient turns round half-way, steps of {step} s",
    seconds=1,
    vary={"n": [0.2, 0.5, 1.5], "tau0": [0.0, 2.0]},
    values={"ratio": 10000.0, "drive": "turns", "step": 0.5, "steps": 1200, "sign": -1},
    **CHANNEL,
    checks=[
        Check("mean velocity against minus the closed form, relative error", checks_flow.reversed_channel_error, below=0.03),
    ],
    fails=[
        Fails("the gradient does not turn", set={"drive": "steady"}),
    ])


GROUP.case(
    "stop_n{n}_tau0{tau0}",
    "channel, n = {n}, tau0 = {tau0} Pa: the gradient ends at once, steps of {step} s",
    quick=lambda n, tau0: n == 0.5 and tau0 == 2.0,
    seconds=3,
    vary={"n": [0.5, 1.0], "tau0": [0.0, 2.0]},
    values={"ratio": 10000.0, "drive": "stops", "step": 0.02, "steps": 600, "progress": 0},
    **CHANNEL,
    checks=[
        Check("largest rise of the mean velocity after the stop / velocity before it", checks_flow.rise_after_the_stop, below=1e-9),
        Check("mean velocity at the end / (1.3 U exp(-pi2 nu t/h2) + 1e-9 m/s), nu that of the wall before", checks_flow.decay_after_the_stop,
              below=1),
    ],
    fails=[
        Fails("the gradient goes on", set={"drive": "steady"}),
    ])


GROUP.case(
    "plug_ratio{ratio}",
    "channel whose wall stress is 0.9 of tau0 = 2 Pa, muY/k = {ratio}: the plug fills the gap",
    seconds=1,
    vary={"ratio": [100.0, 10000.0, 1e6]},
    values={"n": 0.65, "tau0": 2.0, "drive": "plug"},
    **CHANNEL,
    checks=[
        Check("creep / (G h^2 / (12 muY))", checks_flow.plug_creep, below=1.02),
        Check("creep / (G h^2 / (12 muY)), from below", checks_flow.plug_creep, above=0.98),
    ],
    fails=[
        Fails("a wall stress above the yield stress breaks the plug", set={"model": "HerschelBulkleyCapped", "drive": "steady"}),
    ])
