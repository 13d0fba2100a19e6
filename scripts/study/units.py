# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers with the units of the laboratory and of the oil field, read into SI and printed back."""
import math
import re

from .programs import Failure

INCH, FOOT, POUND, GALLON = 0.0254, 0.3048, 0.45359237, 3.785411784e-3
POUND_FORCE = POUND * 9.80665
LENGTH = {"m": 1, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "in": INCH, "ft": FOOT}
DENSITY = {"kg/m3": 1, "g/cm3": 1e3, "sg": 1e3, "ppg": POUND / GALLON, "lb/ft3": POUND / FOOT**3}
STRESS = {"Pa": 1, "lbf/100ft2": POUND_FORCE / (100 * FOOT**2), "dyn/cm2": 0.1}
VISCOSITY = {"Pas": 1, "mPas": 1e-3, "cP": 1e-3}
# Of k: with the exponent n of the same mud; lbf s^n/100ft2 is that of a six-speed viscometer's reading.
CONSISTENCY = {"Pasn": 1, "lbfsn/100ft2": STRESS["lbf/100ft2"], "cPeq": 1e-3}
SPEED = {"m/s": 1, "ft/s": FOOT, "ft/min": FOOT / 60}
FLOW = {"m3/s": 1, "l/s": 1e-3, "l/min": 1e-3 / 60, "m3/h": 1 / 3600, "gpm": GALLON / 60, "bbl/min": 42 * GALLON / 60}
PENETRATION = {"m/h": 1 / 3600, "ft/h": FOOT / 3600}
MASS_RATE = {"kg/s": 1, "kg/min": 1 / 60, "lb/min": POUND / 60}
STIFFNESS = {"Pa": 1, "MPa": 1e6, "GPa": 1e9}
SHOWN = {"length": ("in", LENGTH), "density": ("ppg", DENSITY), "stress": ("lbf/100ft2", STRESS), "flow": ("gpm", FLOW), "speed": ("ft/min", SPEED)}


def number_and_unit(text):
    """(number, unit or ''); None where the text is no number with a unit."""
    match = re.fullmatch(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-z%][\w/^%]*)?\s*", text)
    return (float(match.group(1)), match.group(2) or "") if match else None


def quantity(what, text, *kinds):
    """The value in SI, and the kind (one of the dictionaries) whose unit it had: without a unit it is the first kind's SI unit."""
    known = [unit for kind in kinds for unit in kind]
    found = number_and_unit(text)
    if found and math.isfinite(found[0]):
        number, unit = found
        if not unit:
            return number, kinds[0]
        for kind in kinds:
            if unit in kind:
                return number * kind[unit], kind
    raise Failure(f"--{what}: '{text}' is not a number with a unit; expected one such as 0.2 with one of {', '.join(known)} behind it")


def positive(what, text, *kinds):
    """A quantity above 0."""
    value, kind = quantity(what, text, *kinds)
    if not value > 0:
        raise Failure(f"--{what}: '{text}' is not above 0; expected a positive number")
    return value, kind


def both(kind, value, si):
    """A value in SI and in the oil field's unit, for a table."""
    unit, factors = SHOWN[kind]
    return f"{value:.4g} {si} ({value / factors[unit]:.4g} {unit})"
