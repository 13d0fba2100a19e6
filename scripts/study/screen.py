# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Effects of fix fluid/force as a user types them, and what the fix prints about them."""
import re

EVERYTHING = {"drag": "drag chien", "shear_lift": "shear_lift saffman_mei", "rotational_lift": "rotational_lift oesterle_bui_dinh",
              "drag_torque": "drag_torque dennis", "pressure_gradient": "pressure_gradient on", "viscous_stress": "viscous_stress on",
              "buoyancy": "buoyancy on"}


def all_but(*without):
    """Words that switch on every effect but some."""
    return " ".join(words for name, words in EVERYTHING.items() if name not in without)


def nanoseconds(text):
    """Sum over the effects of the last line 'ns per particle and step', 0 if there is none."""
    lines = re.findall(r"ns per particle and step:(.*);", text)
    return sum(float(number) for number in re.findall(r" ([0-9.]+)(?:,|$)", lines[-1])) if lines else 0.0


def closures(text):
    """How many closures each particle and step evaluates at the end of a run."""
    return int(re.findall(r"evaluates (\d+) closures", text)[-1])


def verdicts(text):
    """Of the last table of a screen: {effect: (mean of weight, 95 % of weight, 95 % of drag, share that decides, ns, stays on)}."""
    table = text[text.rindex("screen: "):]
    rows = re.findall(r"^  (\w+)(?: \w+)? +((?:[0-9.e+-]+ +){8})(stays on|switched off)", table, re.M)
    return {name: (n[0], n[1], n[4], n[6], n[7], verdict == "stays on")
            for name, numbers, verdict in rows for n in [[float(word) for word in numbers.split()]]}


def mean_velocity(text):
    """What the scenes of cases/effects print at their end."""
    return [float(word) for word in re.search(r"^MEAN VELOCITY (.*)$", text, re.M).group(1).split()]
