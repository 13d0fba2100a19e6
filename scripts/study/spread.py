# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Distributions of the size of grains, as the layout of a scene needs them: the range of the classes and the mean grain. The classes are those of fix
particletemplate/cluster (liggghts-plugins/shape/size_classes.h), with equal parts of the mass."""
import math
import pathlib
import typing

from .programs import Failure

CLASSES, STEPS, CUT = 8, 4000, 3.0
EXPECTED = "expected 'uniform PART', 'gaussian PART' or 'lognormal PART', such as \"lognormal 0.3\", or 'sieve FILE'"


class Spread(typing.NamedTuple):
    """words: behind `diameter` in the script; diameters [m] of the smallest and the largest class; mean volume of a grain [m3]; the middle diameter [m];
    the file of a sieve analysis; the number of classes."""
    words: str
    smallest: float
    largest: float
    volume: float
    middle: float
    file: typing.Optional[pathlib.Path] = None
    classes: int = CLASSES


def summed(parts):
    """Of (mass, mean of 1/d3) of the classes: (smallest, largest, mean volume)."""
    sizes = [inverse ** (-1 / 3) for _, inverse in parts]
    return min(sizes), max(sizes), math.pi / 6 * sum(mass for mass, _ in parts) / sum(mass * inverse for mass, inverse in parts)


def of_law(weight, diameter, low, high):
    """Classes of equal mass of a law over a coordinate."""
    step = (high - low) / STEPS
    places = [low + (i + 0.5) * step for i in range(STEPS)]
    total = sum(map(weight, places))
    masses, inverses, below = [0.0] * CLASSES, [0.0] * CLASSES, 0.0
    for place in places:
        part = weight(place) / total
        k = min(int((below + 0.5 * part) * CLASSES), CLASSES - 1)
        masses[k] += part
        inverses[k] += part / diameter(place)**3
        below += part
    return summed([(mass, inverse / mass) for mass, inverse in zip(masses, inverses)])


def of_sieve(name):
    """Of a file with rows of an aperture [m] and the part of the mass that passes it [%]."""
    try:
        lines = [line.split("#")[0].split() for line in pathlib.Path(name).read_text().splitlines()]
        rows = [tuple(map(float, line)) for line in lines if line]
        good = len(rows) > 1 and all(len(row) == 2 for row in rows) and rows[0][1] == 0 and rows[-1][1] == 100 and rows[0][0] > 0
        good = good and all(a[0] < b[0] and a[1] <= b[1] for a, b in zip(rows, rows[1:]))
    except (OSError, ValueError):
        good = False
    if not good:
        raise Failure(f"--spread: sieve '{name}' is not a sieve analysis; expected a file with rows of an aperture in m and the part of the mass that passes "
                      "it in %, both rising, from 0 to 100 %")
    parts = [(high[1] - low[1], (low[0]**-3 - high[0]**-3) / (3 * math.log(high[0] / low[0]))) for low, high in zip(rows, rows[1:]) if high[1] > low[1]]
    at = next(k for k, row in enumerate(rows) if row[1] >= 50)
    (low, below), (high, above) = rows[at - 1], rows[at]
    middle = low * (high / low) ** ((50 - below) / (above - below))
    return Spread(f"sieve {pathlib.Path(name).resolve()}", *summed(parts), middle, pathlib.Path(name).resolve(), len(parts))


def spread_of(text, diameter):
    """The distribution that a user wants about a diameter [m]."""
    law, _, rest = text.strip().partition(" ")
    if law == "sieve" and rest.strip():
        return of_sieve(rest.strip())
    try:
        part = float(rest)
    except ValueError:
        part = -1.0
    limit = {"uniform": 1.0, "gaussian": 1 / CUT, "lognormal": 1.0}.get(law, 0.0)
    if not 0 < part < limit:
        raise Failure(f"--spread: '{text}' is not a distribution{f' with a part above 0 and below {limit:.2g}' if limit else ''}; {EXPECTED}")

    def bell(z):
        return math.exp(-0.5 * z * z)

    if law == "uniform":
        ends = diameter * (1 - part), diameter * (1 + part)
        return Spread(f"uniform mass {ends[0]:.6g} {ends[1]:.6g}", *of_law(lambda d: 1.0, lambda d: d, *ends), diameter)
    if law == "gaussian":
        return Spread(f"gaussian mass {diameter:.6g} {part * diameter:.6g}", *of_law(bell, lambda z: diameter * (1 + z * part), -CUT, CUT), diameter)
    return Spread(f"lognormal mass {diameter:.6g} {part:.6g}", *of_law(bell, lambda z: diameter * math.exp(z * part), -CUT, CUT), diameter)
