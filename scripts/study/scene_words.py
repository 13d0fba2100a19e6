# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What each option of eccentra new may be, and the questions for those that are missing."""
import re
import shlex
import sys

from . import scene_grains
from .programs import Failure
from .scene_bed import velocity_of
from .spread import spread_of
from .units import (CONSISTENCY, DENSITY, FLOW, LENGTH, MASS_RATE, PENETRATION, SPEED, STIFFNESS, STRESS, VISCOSITY, positive, quantity)


def share(what, text, low, high):
    """A plain number within bounds."""
    try:
        value = float(text)
    except ValueError:
        value = high + 1
    if not low <= value <= high:
        raise Failure(f"--{what}: '{text}' is not a number from {low:g} to {high:g}")
    return value


def whole(what, text, most):
    """A whole number from 1 on."""
    if not (text.isascii() and text.isdigit() and 1 <= int(text) <= most):
        raise Failure(f"--{what}: '{text}' is not a whole number from 1 to {most}")
    return int(text)


def stiffness(what, text):
    """[Pa], within what LIGGGHTS takes without its switches for other materials."""
    value = positive(what, text, STIFFNESS)[0]
    if not 5e6 <= value <= 1e9:
        raise Failure(f"--{what}: '{text}' is not from 5 MPa to 1 GPa; LIGGGHTS asks for soft_particles or hard_particles in the script beyond")
    return value


def yield_stress(what, text):
    """[Pa], 0 or more."""
    value = quantity(what, text, STRESS)[0]
    if value < 0:
        raise Failure(f"--{what}: '{text}' is below 0; expected a yield stress of at least 0")
    return value


def of_units(*kinds):
    """A reader of a positive quantity."""
    return lambda what, text: positive(what, text, *kinds)[0]


def within(low, high):
    """A reader of a plain number within bounds."""
    return lambda what, text: share(what, text, low, high)


# SI value of an option's text, or Failure; flow and rate as (value, kind of unit).
READERS = {**{name: of_units(LENGTH) for name in ("hole", "pipe", "length", "diameter", "drum", "width", "filling", "height")},
           "eccentricity": within(0, 0.95), "inclination": within(0, 90), "rpm": within(-1000, 1000), "n": within(0.1, 1.5), "solid": within(0, 0.3),
           "friction": within(0, 2), "wall-friction": within(0, 2), "restitution": within(0.05, 1), "rolling": within(0, 1), "fill": within(0.01, 0.6),
           "seconds": within(0.01, 1e5), "settling": within(0.01, 1e3), "count": lambda what, text: whole(what, text, 10**7),
           "flow": lambda what, text: positive(what, text, SPEED, FLOW), "rate": lambda what, text: positive(what, text, MASS_RATE, PENETRATION),
           "tau0": yield_stress, "k": of_units(CONSISTENCY), "yp": lambda what, text: quantity(what, text, STRESS)[0],
           "pv": of_units(VISCOSITY), "viscosity": of_units(VISCOSITY), "density": of_units(DENSITY), "solid-density": of_units(DENSITY),
           "stiffness": stiffness}


def read(words, name):
    """The value of an option that has one."""
    return READERS[name](name, getattr(words, name.replace("-", "_")))


ANNULUS = ("hole", "pipe", "eccentricity", "inclination", "length", "rpm", "flow", "tau0", "k", "n", "density")
GRAIN = ("shape", "diameter", "spread", "solid-density")
QUESTIONS = {"section": (*ANNULUS, *GRAIN, "solid", "seconds"), "well": (*ANNULUS, *GRAIN, "rate", "seconds"),
             "bed": ("width", "filling", "fluid", "velocity", *GRAIN, "seconds"), "heap": (*GRAIN, "count"), "drum": ("drum", "length", "fill", "rpm", *GRAIN)}
# What stands for an option that argparse gives no default.
BY_DEFAULT = {"tau0": "0", "k": "0.28", "n": "0.65", "rate": "0.1512 kg/s", "spread": "one size"}
LENGTHS = {"section": "0.3", "well": "1.2"}  # [m]


def default_of(words, name):
    """The text that is taken without the option."""
    return getattr(words, name.replace("-", "_")) or (LENGTHS[words.kind] if name == "length" else BY_DEFAULT.get(name))


def given(arguments):
    """Names of the options of a command line."""
    return {word[2:].partition("=")[0] for word in arguments if word.startswith("--")}


def missing(words, arguments):
    """Main options of the kind that the command line does not have."""
    names = given(arguments)
    mud = ("tau0", "k", "n") if "pv" in names else ()
    return [name for name in QUESTIONS[words.kind] if name not in names and name not in mud]


def check(words, name, text):
    """Failure where an answer is none."""
    if name in ("hole", "pipe"):
        hole, pipe = (READERS["pipe"](other, text if name == other else default_of(words, other)) for other in ("hole", "pipe"))
        if name == "pipe" and pipe >= hole:
            raise Failure(f"--pipe: '{text}' does not fit into the hole of '{words.hole}'; expected a smaller diameter")
    elif name == "spread":
        spread_of(text, read(words, "diameter"))
    elif name == "velocity":
        velocity_of(name, text, 1.0)
    elif name == "shape":
        if text.split()[:1] != ["grain"]:
            scene_grains.form_of(scene_grains.Grain(text, 1e-3, 2619.0, 5e6, 0.5, 0.9, 0.0))
    elif name in READERS:
        READERS[name](name, text)


def ask(words, parser, arguments, read_line):
    """Asks for the main options that are missing, as often as an answer is wrong; the words of a command line that has the answers."""
    told = {word[2:]: action for action in parser._actions for word in action.option_strings if word.startswith("--")}  # pylint: disable=protected-access
    answers = []
    for name in missing(words, arguments):
        action, default = told[name], default_of(words, name)
        said = re.sub(r"\s*\(default.*", "", action.help or "")
        if action.choices:
            said = f"{' or '.join(action.choices)}: {said}"
        while True:
            text = read_line(f"{name}{f' ({said})' if said else ''} [{default}]: ").strip()
            if not text:
                break
            try:
                if action.choices and text not in action.choices:
                    raise Failure(f"--{name}: '{text}' is not known; expected {' or '.join(action.choices)}")
                check(words, name, text)
            except Failure as failure:
                sys.stdout.write(f"  {failure}\n")
                continue
            setattr(words, action.dest, text)
            answers += [f"--{name}", text]
            break
    line = " ".join(shlex.quote(word) for word in ["eccentra", "new", *arguments, *answers])
    sys.stdout.write(f"the same without questions: {line}\n")
    return answers
