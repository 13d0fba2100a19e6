# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The map of coupled drag as a chart: what is stable over Stokes number and interval, measured and in theory."""
from study import charts

from .drag_map import explicit_factor, explicit_limit, held_limit

TITLES = {"held": "drag held over the interval, particles alone", "explicit": "drag every DEM step, explicit in the fluid",
          "semiImplicit": "drag every DEM step, semi-implicit in the fluid"}
STEPS = [10 ** (k / 10) for k in range(31)]  # of the lines
APART = 1.22  # between the marks of two suspensions at one interval
HIGHEST = 2000.0  # Stokes number of the chart


def _line(name, limit, colour):
    points = [charts.Point(steps, limit(steps)) for steps in STEPS if limit(steps) < HIGHEST]
    return charts.Series(name, points, colour, line=True, marks=False, dashed=True)


def _panel(scheme, rows):
    """rows: [scheme, kind, load, DEM steps, St, factor per interval]."""
    kinds = sorted({(load, kind) for _, kind, load, *_ in rows})
    series = []
    for lost, name, colour in ((False, "stable", charts.COLOURS[0]), (True, "lost", charts.COLOURS[1])):
        points = [charts.Point(steps * APART ** (kinds.index((load, kind)) - (len(kinds) - 1) / 2), stokes)
                  for _, kind, load, steps, stokes, factor in rows if (not factor < 1) == lost]
        if points:
            series.append(charts.Series(f"{name} ({len(points)})", points, colour))
    if scheme == "held":
        series.append(_line("limit in theory, about 2", held_limit, charts.COLOURS[6]))
    if scheme == "explicit":
        heavy = sorted({round(load, 4) for load, _ in kinds if load > 1})
        series += [_line(f"limit in theory, r = {load:.3g}", lambda steps, load=load: explicit_limit(steps, load), colour)
                   for load, colour in zip(heavy, (charts.COLOURS[6], charts.COLOURS[2], charts.COLOURS[3]))]
    order = ", ".join(f"{load:.2g}" for load, _ in kinds)
    return charts.Panel(TITLES[scheme], f"DEM steps per interval (side by side: r = {order})", "interval / response time", series,
                        log_x=True, log_y=True)


def _factors(rows):
    """Explicit: what an interval makes of a deviation, against theory."""
    pairs = [(abs(explicit_factor(stokes, steps, load)), factor) for _, _, load, steps, stokes, factor in rows if factor > 1e-3]
    low, high = min(theory for theory, _ in pairs), max(theory for theory, _ in pairs)
    return charts.Panel("explicit in the fluid: factor of a deviation", "theory |E - r (1 - E)|", "measured",
                        [charts.Series("runs", [charts.Point(*pair) for pair in pairs], charts.COLOURS[0]),
                         charts.Series("equal", [charts.Point(low, low), charts.Point(high, high)], charts.COLOURS[6], line=True,
                                       marks=False, dashed=True)], log_x=True, log_y=True)


def write(path, rows):
    there = {scheme: [row for row in rows if row[0] == scheme] for scheme in TITLES}
    panels = [_panel(scheme, part) for scheme, part in there.items() if part]
    if there["explicit"]:
        panels.append(_factors(there["explicit"]))
    charts.write(path, "Coupled drag of a suspension: stability over interval and Stokes number", panels, columns=2)
