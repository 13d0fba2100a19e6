# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Statistics of the studies: pure formulas."""
import math
import statistics


def mean_and_error(values):
    """Mean of independent values and its standard error (nan for one value, both nan for none)."""
    if not values:
        return math.nan, math.nan
    if len(values) == 1:
        return values[0], math.nan
    return statistics.fmean(values), statistics.stdev(values) / math.sqrt(len(values))


def mean_of_measured(pairs):
    """Mean of independent (value, standard error), and its standard error."""
    return statistics.fmean(value for value, _ in pairs), math.hypot(*(error for _, error in pairs)) / len(pairs)


def deviation(value, error, reference, reference_error):
    """(value - reference) / reference and its standard error to first order; the two are independent. An error that is
    not known (nan) counts as none; a reference of zero gives nan."""
    if not reference:
        return math.nan, math.nan
    own = 0.0 if math.isnan(error) else error
    other = 0.0 if math.isnan(reference_error) else reference_error
    return value / reference - 1, math.hypot(own / reference, value * other / reference**2)


def paired_deviation(pairs):
    """sum(value)/sum(reference) - 1 over pairs (value, reference) that one seed gives, and its standard error by the estimator of a ratio:
    of value_i - ratio * reference_i. What a seed does to both leaves the error. nan without pairs or with a reference of zero; the error
    is nan for one pair."""
    total = sum(reference for _, reference in pairs)
    if not pairs or not total:
        return math.nan, math.nan
    ratio = sum(value for value, _ in pairs) / total
    if len(pairs) == 1:
        return ratio - 1, math.nan
    square = sum((value - ratio * reference) ** 2 for value, reference in pairs) / (len(pairs) - 1)
    return ratio - 1, math.sqrt(square * len(pairs)) / abs(total)


BLOCKS = 5  # of neighbours, in each half of a series


def drift(values):
    """Mean of the second half of a series in time less that of the first, and its standard error from the spread of blocks of neighbours, which are
    taken as independent; nan for a series that is too short for blocks."""
    half = len(values) // 2
    size = half // BLOCKS
    if size < 1:
        return math.nan, math.nan
    halves = [mean_and_error([statistics.fmean(part[k * size:(k + 1) * size]) for k in range(BLOCKS)])
              for part in (values[len(values) - 2 * half:][:half], values[-half:])]
    (before, e), (after, f) = halves
    return after - before, math.hypot(e, f)


def runs_for(error, runs, wanted):
    """How many runs bring a standard error that `runs` of them have down to `wanted`: it falls as 1/sqrt(runs). Not fewer than there are."""
    if math.isnan(error) or not wanted > 0:
        return runs
    return max(runs, math.ceil(runs * (error / wanted) ** 2 * (1 - 1e-12)))


def cone_angle(points):
    """Slope of a heap [degrees] from all of it. points: (distance from the axis, height above the centres of the layer on the floor), one
    for each body. A uniform cone of radius R holds the part 3 (r/R)^2 - 2 (r/R)^3 within r: R is fitted to all distances by least
    squares, so that the far runners count once each and not by their distance. Its mean height is a quarter of its height."""
    if len(points) < 3:
        return math.nan
    distances = sorted(r for r, _ in points)
    number = len(distances)

    def misfit(radius):
        within = ((min(1.0, r / radius), (k + 0.5) / number) for k, r in enumerate(distances))
        return sum((3 * x**2 - 2 * x**3 - part) ** 2 for x, part in within)

    radii = [1.5 * statistics.fmean(distances) * 1.03**k for k in range(-40, 41)]  # the mean distance of a cone is R/2
    best = min(range(len(radii)), key=lambda k: misfit(radii[k]))
    low, high = radii[max(0, best - 1)], radii[min(len(radii) - 1, best + 1)]
    for _ in range(30):
        a, b = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, b) if misfit(a) < misfit(b) else (a, high)
    return math.degrees(math.atan(8 * max(0.0, statistics.fmean(h for _, h in points)) / (low + high)))


def pareto_front(points):
    """Indices, by rising cost, of the points (cost, error) that no other point beats in one and equals in the other."""
    front, least = [], math.inf
    for index in sorted(range(len(points)), key=lambda i: points[i]):
        if points[index][1] < least:
            front.append(index)
            least = points[index][1]
    return front


def knee(points):
    """Index, in a front of (cost, error) by rising cost, of the point farthest below the chord of its ends, both axes
    logarithmic; None where no point lies below it, as with fewer than three points."""
    if len(points) < 3:
        return None
    x = [math.log(cost) for cost, _ in points]
    y = [math.log(error) for _, error in points]
    if x[-1] == x[0] or y[-1] == y[0]:
        return None
    # Each axis from 0 to 1: the chord falls from (0, 1) to (1, 0), and a point below it has x + y < 1.
    below = [1 - (a - x[0]) / (x[-1] - x[0]) - (b - y[-1]) / (y[0] - y[-1]) for a, b in zip(x, y)]
    best = max(range(len(points)), key=below.__getitem__)
    return best if below[best] > 1e-9 else None


def crossing(ladder, wanted):
    """The x at which y, a polygon through (x, y, standard error of y), first reaches `wanted` from below, and the
    standard error of x. ("below", nan) where the first point is above already, ("above", nan) where none reaches it."""
    if ladder[0][1] >= wanted:
        return "below", math.nan
    for (x0, y0, e0), (x1, y1, e1) in zip(ladder, ladder[1:]):
        if y1 >= wanted:
            share = (wanted - y0) / (y1 - y0)
            spread = math.hypot((1 - share) * (0 if math.isnan(e0) else e0), share * (0 if math.isnan(e1) else e1))
            return x0 + share * (x1 - x0), spread * (x1 - x0) / (y1 - y0)
    return "above", math.nan
