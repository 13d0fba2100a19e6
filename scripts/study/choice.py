# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which level of detail to take, one row for each scene: the sentences of level_study.Group as a table."""
import math

from . import convergence, tables

NONE = "-"
DRIFT, SURE = 0.02, 3.0  # of the value, and standard errors, above which a result is not steady


def _signed(value, error):
    return f"{100 * value:+.1f} +- {100 * error:.1f}"


def _clusters(group):
    """Power and rest of the ladder of clusters, as far as the errors tell them."""
    points = group.ladder()
    plain, with_rest = convergence.fit(points), convergence.fit(points, True)
    return (f"{plain.power:.2f} +- {plain.power_error:.2f}" if convergence.power_told(points, plain) else NONE,
            f"{100 * with_rest.rest:+.0f} +- {100 * with_rest.rest_error:.0f}" if convergence.rest_told(with_rest) else NONE)


def _row(group):
    reference, rows = group.rows[-1], group.models()
    near = min((row for row in rows if abs(row.deviation) * 100 <= group.percent), key=lambda row: row.cpu, default=None)
    plain = next((row for row in rows if row.level.kind == "sphere"), None)
    knee = group.front()[1]
    errors = [row.deviation_error for row in rows if not math.isnan(row.deviation_error)]
    known = not math.isnan(reference.error)
    value = f"{tables.number(reference.value)}{f' +- {tables.number(reference.error, 2)}' if known else ''} {group.unit}".rstrip()
    return [group.title, value, reference.cpu,
            *((near.level.name, _signed(near.deviation, near.deviation_error), tables.number(reference.cpu / near.cpu, 2)) if near else ("none", NONE, NONE)),
            *((f"{100 * plain.deviation:+.0f}", tables.number(plain.cpu / reference.cpu, 2)) if plain else (NONE, NONE)),
            knee.level.name if knee else NONE, *_clusters(group), f"{100 * abs(reference.error / reference.value):.1f}" if reference.value and known else NONE,
            f"{100 * max(errors):.0f}" if errors else NONE]


def not_steady(groups):
    """What still changed while means were taken, as a paragraph; nothing where all are steady, or where no run says it."""
    text = [f"{group.title}: " + ", ".join(f"{row.level.name} {_signed(*row.drift)} %" for row in moving)
            for group in groups if (moving := [row for row in group.rows if abs(row.drift[0]) > max(DRIFT, SURE * row.drift[1])])]
    return [f"Not steady: from the first to the second half of the time over which means were taken, results changed by more than {100 * DRIFT:g} % and "
            f"{SURE:g} standard errors. {'; '.join(text)}.\n"] if text else []


def page_of(groups):
    """Table of the groups that have a reference and another level; nothing where there is none. groups: level_study.Group of one body."""
    shown = [group for group in groups if group.models() and not math.isnan(group.rows[-1].value)]
    if not shown:
        return []
    header = ["scene", "true body", "CPU s", f"cheapest within {shown[0].percent:g} %", "deviation %", "times as fast", "plain sphere: deviation %",
              "at of the time", "knee", "clusters: p of N^-p", "clusters: rest %", "true body known to %", "deviations known to points"]
    return [f"Which level to take for the {shown[0].body} (a power or rest that the errors do not determine is left out):\n",
            tables.markdown(header, [_row(group) for group in shown])]
