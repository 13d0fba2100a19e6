# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The coefficient at which a noisy result takes a wanted value: where to look next, and what is known then. Pure formulas.

A point is (coefficient, value, standard error of the value)."""
import dataclasses
import math

from . import least_squares

MARGIN = 0.15  # of an interval at its ends that a step keeps away from
BESIDE, FAR = 2.0, 5.0  # standard errors of the root: where points are set on both sides of it, and from where on an end is too far
SURE = 2.0  # standard errors by which the ends must differ from the wanted value


@dataclasses.dataclass(frozen=True)
class Root:
    """side: "" where a root was found, "below" or "above" where the wanted value lies outside of all that was found on the side of the least
    or the largest coefficient, "flat" where the result does not depend on the coefficient beyond its errors."""
    value: float
    error: float
    side: str = ""

    def words(self):
        if self.side == "flat":
            return "not determined: the result does not depend on it beyond its noise"
        return f"{self.value:.3f} +- {self.error:.3f}" if not self.side else f"{'at most' if self.side == 'below' else 'at least'} {self.value:g}"


def bracket(points, wanted):
    """The neighbours between which the value passes the wanted one, or None."""
    ordered = sorted(points)
    return next(((a, b) for a, b in zip(ordered, ordered[1:]) if (a[1] - wanted) * (b[1] - wanted) <= 0), None)


def next_coefficient(points, wanted, wanted_error, finest):
    """Where to look next, so that the root lies between two points BESIDE its standard error from it: near enough for a straight line, far
    enough for its slope. None where that is reached, where the interval is below `finest`, or where there is no bracket."""
    ends = bracket(points, wanted)
    if ends is None:
        return None
    (x0, y0, e0), (x1, y1, e1) = ends
    wide = x1 - x0
    if wide <= finest or y0 == y1:
        return None
    share = (wanted - y0) / (y1 - y0)
    spread = math.hypot(wanted_error, (1 - share) * e0, share * e1) * wide / abs(y1 - y0)
    at = x0 + share * wide
    if at - x0 > max(FAR * spread, finest):
        at -= BESIDE * spread
    elif x1 - at > max(FAR * spread, finest):
        at += BESIDE * spread
    else:
        return None
    return min(x1 - MARGIN * wide, max(x0 + MARGIN * wide, at))


def root(points, wanted, wanted_error):
    """The coefficient of the wanted value by a straight line through the bracket and its nearest neighbours, weighted by their errors, and
    its standard error from those of the line and of the wanted value."""
    ordered = sorted(points)
    low, high = ordered[0], ordered[-1]
    ends = bracket(points, wanted)
    if ends is None:
        if abs(high[1] - low[1]) <= SURE * math.hypot(low[2], high[2]):
            return Root(math.nan, math.nan, "flat")
        return Root(low[0], math.nan, "below") if (wanted < low[1]) == (low[1] < high[1]) else Root(high[0], math.nan, "above")
    first = ordered.index(ends[0])
    near = ordered[first: first + 2]
    for beside in (first - 1, first + 2):  # a neighbour as near as the bracket is wide
        if 0 <= beside < len(ordered) and min(abs(ordered[beside][0] - end[0]) for end in ends) <= ends[1][0] - ends[0][0]:
            near.append(ordered[beside])
    middle = sum(x for x, *_ in near) / len(near)
    columns, weights = [[1.0] * len(near), [x - middle for x, *_ in near]], [max(e, 1e-12) ** -2 for *_, e in near]
    line, matrix = least_squares.fit(columns, [y for _, y, _ in near], weights)
    if not line[1]:
        return Root(math.nan, math.nan, "flat")
    away = (wanted - line[0]) / line[1]
    inverse = [least_squares.solve(matrix, [1.0, 0.0]), least_squares.solve(matrix, [0.0, 1.0])]
    variance = inverse[0][0] + 2 * away * inverse[0][1] + away**2 * inverse[1][1] + wanted_error**2
    found = min(max(middle + away, ends[0][0]), ends[1][0])
    error = math.sqrt(variance) / abs(line[1])
    # An error as wide as all that was looked at says that nothing is known.
    return Root(math.nan, math.nan, "flat") if error > high[0] - low[0] else Root(found, error)
