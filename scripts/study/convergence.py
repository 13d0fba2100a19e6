# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the deviation of a ladder of clusters goes to zero as a power of the number of spheres: weighted fits, pure formulas."""
import dataclasses
import math

from . import least_squares

STEEPEST = 3.0  # power that is looked for
SURE = 2.0  # standard errors by which something must differ from zero


@dataclasses.dataclass(frozen=True)
class Fit:
    """deviation = rest + factor N^-power with standard errors. `misfit`: chi^2 per degree of freedom, 1 where the errors explain what is
    left; errors are widened by its root above 1. rest is 0 +- 0 where it was not fitted."""
    power: float
    power_error: float
    factor: float
    rest: float
    rest_error: float
    misfit: float


def _at(power, points, weights, with_rest):
    """(chi^2, factor, rest) at a power."""
    falling = [n ** -power for n, *_ in points]
    columns = [falling, [1.0] * len(points)] if with_rest else [falling]
    found, _ = least_squares.fit(columns, [d for _, d, _ in points], weights)
    if found is None:
        return math.inf, math.nan, math.nan
    factor, rest = found[0], found[1] if with_rest else 0.0
    return sum(w * (d - rest - factor * f) ** 2 for w, f, (_, d, _) in zip(weights, falling, points)), factor, rest


def fit(points, with_rest=False):
    """Fit of points (N, deviation, standard error), or None without a degree of freedom or where a point has no
    error."""
    unknowns = 3 if with_rest else 2
    if len(points) < unknowns + 1 or any(not e > 0 or math.isnan(d) for _, d, e in points):
        return None
    weights = [e ** -2 for _, _, e in points]
    steps = [STEEPEST * k / 300 for k in range(1, 301)]
    best = min(steps, key=lambda p: _at(p, points, weights, with_rest)[0])
    low, high = max(1e-3, best - STEEPEST / 300), min(STEEPEST, best + STEEPEST / 300)
    for _ in range(60):
        a, b = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, b) if _at(a, points, weights, with_rest)[0] < _at(b, points, weights, with_rest)[0] else (a, high)
    power = (low + high) / 2
    chi2, factor, rest = _at(power, points, weights, with_rest)
    falling = [n ** -power for n, *_ in points]
    columns = [falling, [-factor * math.log(n) * f for f, (n, *_) in zip(falling, points)]] + ([[1.0] * len(points)] if with_rest else [])
    _, matrix = least_squares.fit(columns, [0.0] * len(points), weights)
    misfit = chi2 / (len(points) - unknowns)
    widened = math.sqrt(max(1.0, misfit))
    spread = least_squares.variances(matrix) or [math.nan] * len(columns)
    errors = [math.sqrt(v) * widened if v >= 0 else math.nan for v in spread]
    return Fit(power, errors[1], factor, rest, errors[2] if with_rest else 0.0, misfit)


def power_told(points, plain):
    """Whether a power can be told: of points some of which differ from zero, by a fit that knows its power."""
    return (plain is not None and any(abs(d) >= SURE * e for _, d, e in points) and not math.isnan(plain.power_error)
            and plain.power_error <= plain.power / SURE and plain.power <= 0.99 * STEEPEST)


def rest_told(with_rest):
    """Whether the rest is known to less than the reference itself."""
    return with_rest is not None and with_rest.rest_error <= 1


def words_of(points):
    """One or two sentences on a ladder of points (N, deviation, standard error); empty where there is too little to say anything."""
    plain, with_rest = fit(points), fit(points, True)
    if plain is None:
        return ""
    finest = max(points)
    text = f"Of {len(points)} clusters the finest, N = {finest[0]}, deviates by {100 * finest[1]:+.0f} +- {100 * finest[2]:.0f} %."
    if all(abs(d) < SURE * e for _, d, e in points):
        return text + " None differs from zero by two standard errors, so that no power can be told."
    if not power_told(points, plain):
        text += " The deviation does not fall as a power of N that these errors can tell from zero."
    else:
        text += f" If the deviation goes to zero, it falls as N^-p with p = {plain.power:.2f} +- {plain.power_error:.2f}."
    if with_rest and with_rest.rest_error > 1:  # more than the reference itself
        text += " These errors do not determine a rest."
    elif with_rest and not math.isnan(with_rest.rest_error):
        sure = abs(with_rest.rest) > SURE * with_rest.rest_error
        text += (f" With a rest, the rest is {100 * with_rest.rest:+.0f} +- {100 * with_rest.rest_error:.0f} %: "
                 + ("more spheres do not remove it." if sure else "no rest can be told from zero."))
    return text
