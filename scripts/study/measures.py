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


def deviation(value, error, reference, reference_error):
    """(value - reference) / reference and its standard error to first order; the two are independent. An error that is
    not known (nan) counts as none; a reference of zero gives nan."""
    if not reference:
        return math.nan, math.nan
    own = 0.0 if math.isnan(error) else error
    other = 0.0 if math.isnan(reference_error) else reference_error
    return value / reference - 1, math.hypot(own / reference, value * other / reference**2)


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


def rank_correlation(a, b):
    """Spearman's, with mean ranks for equal values; nan where one side does not vary."""
    def ranks(values):
        order = sorted(values)
        return [order.index(v) + (order.count(v) - 1) / 2 for v in values]
    x, y = ranks(a), ranks(b)
    if len(set(x)) < 2 or len(set(y)) < 2:
        return math.nan
    return statistics.correlation(x, y)
