# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against time: levels as points, the body with true faces at zero, its noise as a band."""
import dataclasses
import math
import statistics

from . import charts

COLOUR = {"sphere": 7, "friction": 4, "eccentric": 3, "cluster": 0, "smooth": 5, "rounding": 2}  # of a kind of level, in charts.COLOURS
WORDS = {"sphere": "sphere", "friction": "sphere with mu_shape", "eccentric": "sphere that cogs", "cluster": "clusters of spheres",
         "smooth": "true faces", "rounding": "true faces, other corners"}
TRUTH = charts.COLOURS[2]  # of the reference, at zero
NO_FORM = ("S6",)  # clusters that are no form of the body
END = 100.0  # deviations beyond [%] stand at the edge, with an arrow and their value


@dataclasses.dataclass
class TruthPanel(charts.Panel):
    """`noise`: half the height of the band about zero [%]; truth: (time, name) of the body at zero."""
    noise: float = 0.0
    truth: tuple = ()
    one_sided: bool = False  # y is a size, so that the band begins at zero

    def draw(self, axes):
        super().draw(axes)
        axes.axhspan(0 if self.one_sided else -self.noise, self.noise, color="#e8efe8", zorder=0)
        axes.axhline(0, color=TRUTH, linewidth=1.4, zorder=1)
        low, high = axes.get_ylim()
        axes.set_ylim(min(low, -0.04 * (high - low)), high)
        axes.plot([self.truth[0]], [0], marker="D", markersize=8, color=TRUTH, linestyle="", clip_on=False, zorder=5)
        noise = f"\nband: its noise, +- {self.noise:.1f} %" if self.noise else ""
        axes.annotate(f"\u25c6 the true body, {self.truth[1]}{noise}", (1, 1), (-4, -4), "axes fraction", "offset points", ha="right", va="top",
                      fontsize=7, color="#006b4f")


def short(name):
    return name.replace("S1 mu", "mu").replace("S1 eccentric", "eccentric")


def clipped(x, y, error, name):
    """A point of the chart; `y` [%] beyond its end is told in words."""
    if abs(y) <= END:
        return charts.Point(x, y, error, short(name))
    return charts.Point(x, math.copysign(END, y), math.nan, f"{short(name)} {y:+.0f} %", bound=1 if y > 0 else -1)


def _series(points):
    """points: [(level, charts.Point)]: a series for each kind; clusters of the body's form are joined."""
    made = []
    for kind in COLOUR:
        of = [(level, point) for level, point in points if level.kind == kind]
        ladder = sorted(((level.spheres, point) for level, point in of if kind == "cluster" and level.name not in NO_FORM), key=lambda at: at[0])
        rest = [point for level, point in of if kind != "cluster" or level.name in NO_FORM]
        name = WORDS[kind]
        if ladder:
            made.append(charts.Series(name, [point for _, point in ladder], charts.COLOURS[COLOUR[kind]], True))
            name = ""
        if rest:
            made.append(charts.Series(name, rest, charts.COLOURS[COLOUR[kind]]))
    return made


def signed(title, rows):
    """Deviations with their sign in one scene. rows: of level_study or user_study, the reference last."""
    reference = rows[-1]
    points = [(row.level, clipped(row.cpu, 100 * row.deviation, 100 * row.deviation_error, row.level.name)) for row in rows[:-1]
              if not math.isnan(row.deviation)]
    noise = 100 * abs(reference.error / reference.value) if reference.value and not math.isnan(reference.error) else 0.0
    return TruthPanel(title, "CPU seconds of a run", f"error: deviation from {reference.level.name} [%]",
                      [*_series(points), charts.Series("", [charts.Point(reference.cpu, 0)], "#ffffff", marks=False)], True, noise=noise,
                      truth=(reference.cpu, reference.level.name))


def overall(groups):
    """Median sizes over scenes of the levels that all of them have. groups: rows of each scene, the reference last."""
    places = []
    for level in dict.fromkeys(row.level for rows in groups for row in rows[:-1]):
        of = [(row, rows[-1]) for rows in groups for row in rows[:-1] if row.level == level and not math.isnan(row.deviation)]
        if len(of) == len(groups):
            places.append((level, charts.Point(statistics.median(row.cpu / reference.cpu for row, reference in of),
                                               100 * statistics.median(abs(row.deviation) for row, _ in of), label=short(level.name))))
    noises = [100 * abs(rows[-1].error / rows[-1].value) for rows in groups if rows[-1].value and not math.isnan(rows[-1].error)]
    name = groups[0][-1].level.name
    return TruthPanel(f"median of {len(groups)} scenes" if len(groups) > 1 else "one scene", f"CPU time over that of {name}",
                      "error: size of the deviation from the true body [%]",
                      [*_series(places), charts.Series("", [charts.Point(1.0, 0)], "#ffffff", marks=False)], True,
                      noise=statistics.median(noises) if noises else 0.0, truth=(1.0, name), one_sided=True)
