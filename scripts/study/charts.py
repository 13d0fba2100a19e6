# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Charts of the studies as SVG, all in one look: panels of points and lines, of bars, and side views of bodies."""
import dataclasses
import io
import math
import re

from .programs import Failure

# Okabe and Ito's colours, which colour-blind readers tell apart.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999")
LOOK = {"font.size": 8, "axes.titlesize": 8.5, "axes.titleweight": "bold", "axes.edgecolor": "#888888", "axes.grid": True, "axes.axisbelow": True,
        "grid.color": "#dddddd", "grid.linewidth": 0.6, "axes.linewidth": 0.7, "lines.linewidth": 1.2, "lines.markersize": 5,
        "legend.fontsize": 7, "legend.framealpha": 0.8, "xtick.color": "#444444", "ytick.color": "#444444", "xtick.minor.visible": False,
        "svg.fonttype": "none", "svg.hashsalt": "eccentra"}  # text stays text; the same data give the same file
SIZE = (4.6, 3.3)  # of a panel [inch]
LETTER, LINE = 4.1, 8.5  # mean width of a letter and height of a line of a label [points]
LEGEND = 0.058  # height of a line of the legend over that of a panel
CLOUD = 100  # points of a panel from which on each series is one path of dots: as marks they would take 125 bytes each
NEAR = 9  # distance of a label that needs no line to its point [points]


@dataclasses.dataclass
class Point:
    """error: standard error of y (nan: not known); bound: +1 (-1) where y is only known to be larger (smaller)."""
    x: float
    y: float
    error: float = math.nan
    label: str = ""
    ring: bool = False
    bound: int = 0


@dataclasses.dataclass
class Series:
    name: str
    points: list
    colour: str = COLOURS[0]
    line: bool = False
    marks: bool = True
    dashed: bool = False


def _range(values, log, floor=None):
    values = [v for v in values if math.isfinite(v) and (v > 0 or not log)]
    if not values:
        return (0.1, 1.0) if log else (0.0, 1.0)
    low, high = min(values), max(values)
    if log:
        widen = max((high / low) ** 0.08, 1.35)
        return low / widen, high * widen
    margin = 0.08 * (high - low) or 0.1 * abs(high) or 1.0
    return (floor if floor is not None else low - margin), high + margin


def _numbered(axis, low, high):
    """A logarithmic axis whose ticks are plain numbers."""
    from matplotlib import ticker
    parts = (1, 2, 5) if high / low < 500 else (1,)
    axis.set_major_locator(ticker.LogLocator(subs=parts) if high / low > 6 else ticker.MaxNLocator(6, steps=(1, 2, 5, 10)))
    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(ticker.NullLocator())


@dataclasses.dataclass
class Panel:
    """Points and lines. band: (y, words), everything below y is shaded."""
    title: str
    x: str
    y: str
    series: list
    log_x: bool = False
    log_y: bool = False
    band: tuple = ()
    legend: bool = True
    floor: float = None
    numbered: bool = True  # the x axis

    def seen(self, series):
        return [p for p in series.points if math.isfinite(p.y) and math.isfinite(p.x) and (p.y > 0 or not self.log_y)]

    def draw(self, axes):
        points = [p for s in self.series for p in self.seen(s)]
        ends = [p.y + sign * p.error for p in points if not math.isnan(p.error) for sign in (1, -1)
                if sign > 0 or not self.log_y or p.y - p.error > 0.3 * p.y]
        x = _range([p.x for p in points], self.log_x)
        y = _range([p.y for p in points] + ends + list(self.band[:1]), self.log_y, self.floor)
        named = sum(bool(s.name and self.seen(s)) for s in self.series) if self.legend else 0
        if named:  # room above the points
            free = 1 - LEGEND * (named + 0.6)
            y = y[0], y[0] * (y[1] / y[0]) ** (1 / free) if self.log_y else y[0] + (y[1] - y[0]) / free
        for name, log, (low, high) in (("x", self.log_x, x), ("y", self.log_y, y)):
            if log:
                axes.set(**{f"{name}scale": "log"})
                _numbered(getattr(axes, f"{name}axis"), low, high)
        axes.set(title=self.title, xlabel=self.x, ylabel=self.y, xlim=x, ylim=y)
        if not self.numbered:
            axes.set_xticks([])
        if self.band:
            axes.axhspan(y[0], self.band[0], color="#eeeeee", zorder=0)
            axes.annotate(self.band[1], (1, 0), (-4, 4), "axes fraction", "offset points", ha="right", va="bottom", fontsize=7, color="#666666")
        for s in self.series:
            shown = self.seen(s)
            if not shown:
                continue
            cloud = s.marks and not s.line and len(points) >= CLOUD
            if cloud:  # lines of no length with round ends
                axes.plot([v for p in shown for v in (p.x, p.x, math.nan)], [v for p in shown for v in (p.y, p.y, math.nan)],
                          color=s.colour, linewidth=LOOK["lines.markersize"], solid_capstyle="round")
            axes.plot([] if cloud else [p.x for p in shown], [] if cloud else [p.y for p in shown], color=s.colour, label=s.name or None,
                      marker="o" if s.marks else "", linestyle=("--" if s.dashed else "-") if s.line else "")
            told = [p for p in shown if s.marks and not math.isnan(p.error)]
            # Below a logarithmic axis there is no end: the bar goes as far as the axis does.
            axes.errorbar([p.x for p in told], [p.y for p in told], fmt="none", ecolor=s.colour, elinewidth=0.9, capsize=2,
                          yerr=[[min(p.error, p.y * (1 - 1e-9)) if self.log_y else p.error for p in told], [p.error for p in told]])
            rings = [p for p in shown if p.ring and s.marks]
            axes.plot([p.x for p in rings], [p.y for p in rings], "o", markersize=11, markerfacecolor="none", markeredgecolor="black")
            for p in shown:
                if p.bound:
                    axes.annotate("", (p.x, p.y), (0, 14 * p.bound), textcoords="offset points",
                                  arrowprops={"arrowstyle": "<-", "color": s.colour, "shrinkA": 0, "shrinkB": 0})
        if named:
            axes.legend(loc="upper left")

    def finish(self, axes):
        """Words beside points, where they cover neither each other nor points nor lines; after the layout is known."""
        to_points = 72 / axes.figure.dpi
        place = lambda p: tuple(v * to_points for v in axes.transData.transform((p.x, p.y)))
        frame = [v * to_points for v in axes.get_window_extent().extents]
        taken = []
        for s in self.series:
            spots = [place(p) for p in self.seen(s)]
            taken += [(x - 4, y - 4, x + 4, y + 4) for x, y in spots] if s.marks else []
            for (x0, y0), (x1, y1) in zip(spots, spots[1:]) if s.line else ():
                parts = max(1, int(math.dist((x0, y0), (x1, y1)) / 5))
                middles = [(x0 + (x1 - x0) * k / parts, y0 + (y1 - y0) * k / parts) for k in range(parts)]
                taken += [(x - 2, y - 2, x + 2, y + 2) for x, y in middles]
        for s in self.series if frame[2] > frame[0] else ():
            for p in self.seen(s):
                if p.label and s.marks:
                    self._label(axes, p, place(p), s.colour, taken, frame)

    @staticmethod
    def _label(axes, p, spot, colour, taken, frame):
        wide = LETTER * len(p.label) + 2
        offsets = [(6, 3), (-6 - wide, 3), (-wide / 2, 7), (-wide / 2, -7 - LINE), (5, 8), (5, -5 - LINE), (-5 - wide, 8), (-5 - wide, -5 - LINE)]
        offsets += [(dx, 3 + dy) for dx in (6, -6 - wide) for dy in (-20, 20, -30, 30)]

        def box(offset):
            left, low = spot[0] + offset[0], spot[1] + offset[1]
            return left, low, left + wide, low + LINE

        def covered(offset):
            a = box(offset)
            outside = a[0] < frame[0] or a[1] < frame[1] or a[2] > frame[2] or a[3] > frame[3]
            return 1000 * outside + sum(max(0, min(a[2], b[2]) - max(a[0], b[0])) * max(0, min(a[3], b[3]) - max(a[1], b[1])) for b in taken)

        best = min(offsets, key=covered)
        chosen = box(best)
        taken.append(chosen)
        nearest = min(max(spot[0], chosen[0]), chosen[2]), min(max(spot[1], chosen[1]), chosen[3])
        line = {"arrowstyle": "-", "color": colour, "linewidth": 0.5} if math.dist(nearest, spot) > NEAR else None
        axes.annotate(p.label, (p.x, p.y), best, textcoords="offset points", fontsize=7, color=colour, arrowprops=line)


@dataclasses.dataclass
class Bars:
    """Horizontal bars side by side for each name. groups: {what: [(value, standard error)]} in the order of the names; reference: a value that
    a dashed line shows."""
    title: str
    x: str
    names: list
    groups: dict
    log_x: bool = False
    reference: float = math.nan
    first: int = 0  # of the colours

    def draw(self, axes):
        values = [v for group in self.groups.values() for v, _ in group if not math.isnan(v)]
        thick = 0.8 / len(self.groups)
        for k, (what, group) in enumerate(self.groups.items()):
            places = [i + thick * (k + 0.5) - 0.4 for i in range(len(group))]
            shown = [max(v, 0) if math.isfinite(v) and (v > 0 or not self.log_x) else 0 for v, _ in group]
            errors = [0 if math.isnan(e) else e for _, e in group]
            axes.barh(places, shown, thick * 0.9, color=COLOURS[(self.first + k) % len(COLOURS)], label=what)
            if any(errors):
                axes.errorbar(shown, places, xerr=errors, fmt="none", ecolor="black", elinewidth=0.9, capsize=2)
            if len(self.groups) == 1:
                for place, value, error in zip(places, shown, errors):
                    axes.annotate(f"{value:.3g}", (value + error, place), (4, 0), textcoords="offset points", va="center", fontsize=7)
        if not math.isnan(self.reference):
            axes.axvline(self.reference, color="black", linestyle="--", linewidth=0.8)
        if self.log_x:
            low, high = _range(values, True)
            axes.set(xscale="log", xlim=(10 ** math.floor(math.log10(low)), high))
        else:
            axes.set_xlim(0, 1.15 * max([v + (0 if math.isnan(e) else e) for group in self.groups.values() for v, e in group if not math.isnan(v)],
                                        default=1) or 1)
        axes.set(title=self.title, xlabel=self.x, yticks=range(len(self.names)), yticklabels=self.names)
        axes.invert_yaxis()
        axes.grid(False, axis="y")
        if len(self.groups) > 1:
            axes.legend(loc="best")

    def finish(self, axes):
        """Nothing to place."""


@dataclasses.dataclass
class Map:
    """Values over x and y as colours. values: a row of all y for each x."""
    title: str
    x: str
    y: str
    xs: list
    ys: list
    values: list

    def draw(self, axes):
        half = [(v[-1] - v[0]) / max(1, len(v) - 1) / 2 or 0.5 for v in (self.xs, self.ys)]
        extent = (self.xs[0] - half[0], self.xs[-1] + half[0], self.ys[0] - half[1], self.ys[-1] + half[1])
        drawn = axes.imshow(list(zip(*self.values)), origin="lower", aspect="auto", extent=extent, cmap="viridis", vmin=0, interpolation="nearest")
        axes.set(title=self.title, xlabel=self.x, ylabel=self.y)
        axes.grid(False)
        axes.figure.colorbar(drawn, ax=axes)

    def finish(self, axes):
        """Nothing to place."""


@dataclasses.dataclass
class Bodies:
    """A side view, far bodies first: circles at (x, y, z), `up` the coordinate that points up. view: left, right, low, high. walls: lines
    [(x, ...), (y, ...)] and circles (x, y, radius)."""
    title: str
    bodies: list
    radius: float
    view: tuple
    up: int
    walls: list

    def draw(self, axes):
        from matplotlib.patches import Circle
        left, right, low, high = self.view
        axes.set(xlim=(left, right), ylim=(low, high), aspect="equal", xticks=[], yticks=[])
        axes.set_title(self.title, fontweight="normal", loc="left")
        for wall in self.walls:
            if len(wall) == 3:
                axes.add_patch(Circle(wall[:2], wall[2], fill=False, edgecolor="#888888"))
            else:
                axes.plot(*wall, color="#888888", linewidth=1)

    def finish(self, axes):
        """Marks as large as the bodies are, now that the scale is known: one symbol, many places."""
        if not self.bodies:
            return
        towards = 1 if self.up == 2 else -1  # y points away from the eye, z towards it
        order = sorted(self.bodies, key=lambda b: towards * -b[3 - self.up])
        depth = [towards * b[3 - self.up] for b in order]
        span = max(depth) - min(depth)
        light = [(d - min(depth)) / span if span else 0.5 for d in depth]
        colours = [((50 + 110 * part) / 255, (90 + 110 * part) / 255, (140 + 100 * part) / 255) for part in light]
        frame = axes.get_window_extent()
        across = 2 * self.radius * frame.width * 72 / axes.figure.dpi / (self.view[1] - self.view[0])
        axes.scatter([b[0] for b in order], [b[self.up] for b in order], s=across**2, c=colours, edgecolors="black", linewidths=0.3)


def write(path, title, panels, columns=3, size=SIZE):
    """Writes panels row by row."""
    try:
        import matplotlib
        from matplotlib.figure import Figure
    except ImportError:
        raise Failure("there is no matplotlib, which draws the charts: run scripts/setup (Debian's python3-matplotlib)") from None
    columns = min(columns, len(panels))
    rows = math.ceil(len(panels) / columns)
    with matplotlib.rc_context(LOOK):
        figure = Figure(figsize=(size[0] * columns, size[1] * rows + 0.35), layout="constrained")
        figure.suptitle(title, fontsize=min(10.5, 125 * size[0] * columns / len(title)))
        places = list(figure.subplots(rows, columns, squeeze=False).flat)
        for axes in places[len(panels):]:
            axes.set_axis_off()
        for axes, panel in zip(places, panels):
            panel.draw(axes)
        figure.draw_without_rendering()  # lays out
        for axes, panel in zip(places, panels):
            panel.finish(axes)
        drawn = io.StringIO()
        figure.savefig(drawn, format="svg", metadata={"Date": None, "Creator": None})
        # Places to a hundredth of a point, without indentation: a third of the size less. What is written keeps its digits.
        shorter = lambda tag: re.sub(r"(\d+\.\d\d)\d+", r"\1", tag.group())
        path.write_text(re.sub(r"<[^>]*>", shorter, re.sub(r"(?m)^ +", "", drawn.getvalue())))
