# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Charts of the studies as SVG: panels of points and lines on linear or logarithmic axes."""
import dataclasses
import html
import math

# Okabe and Ito's colours, which colour-blind readers tell apart.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999")
WIDTH, HEIGHT = 460, 330  # of a panel
LEFT, RIGHT, TOP, BOTTOM = 66, 14, 34, 48
LINE = 14  # height of a line of the legend
NEAR = 11  # distance of a label that needs no line to its point
LETTER = 5.6  # mean width of a letter at the size of labels


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


@dataclasses.dataclass
class Panel:
    """band: (y, words), everything below y is shaded."""
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


def _ticks(low, high, log):
    if log and high / low > 6:  # else those of a linear axis are more
        first, last = math.floor(math.log10(low) + 1e-9), math.ceil(math.log10(high) - 1e-9)
        parts = (1, 2, 5) if high / low < 500 else (1,)
        ticks = [m * 10.0**d for d in range(first, last + 1) for m in parts]
        return [t for t in ticks if low <= t * (1 + 1e-7) and t <= high * (1 + 1e-7)]
    span = high - low
    step = 10 ** math.floor(math.log10(span / 4))
    step = next(step * m for m in (1, 2, 5, 10) if span / (step * m) <= 6)
    return [round(k * step, 12) for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


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


class _Labels:
    """Places words beside points where they cover neither each other nor the points."""

    def __init__(self, width, height):
        self.boxes, self.width, self.height = [], width, height

    def take(self, x, y, wide=9, high=9):
        self.boxes.append((x - wide / 2, y - high / 2, x + wide / 2, y + high / 2))

    def place(self, x, y, text):
        wide, high = LETTER * len(text) + 2, 12
        places = [(x + 8, y - 6), (x - 8 - wide, y - 6), (x - wide / 2, y - 20), (x - wide / 2, y + 8), (x + 7, y - 18),
                  (x + 7, y + 6), (x - 7 - wide, y - 18), (x - 7 - wide, y + 6)]
        places += [(px + dx, py + dy) for px, py in places[:2] for dy in (-26, 26, -38, 38) for dx in (0,)]
        def covered(place):
            left, top = place
            outside = left < LEFT or left + wide > self.width - 2 or top < TOP - 4 or top + high > self.height - BOTTOM
            return 1000 * outside + sum(max(0, min(left + wide, b[2]) - max(left, b[0])) * max(0, min(top + high, b[3]) - max(top, b[1]))
                                        for b in self.boxes)
        left, top = min(places, key=covered)
        self.boxes.append((left, top, left + wide, top + high))
        nearest = min(max(x, left), left + wide), min(max(y, top + 2), top + high - 2)
        return (left, top + high - 3), nearest if math.dist(nearest, (x, y)) > NEAR else None


def _panel(panel, out, left, top):
    points = [p for s in panel.series for p in s.points]
    ys = [p.y for p in points] + [p.y + p.error for p in points if not math.isnan(p.error)]
    ys += [p.y - p.error for p in points if not math.isnan(p.error) and (not panel.log_y or p.y - p.error > 0.3 * p.y)]
    xlow, xhigh = _range([p.x for p in points], panel.log_x)
    ylow, yhigh = _range(ys + ([panel.band[0]] if panel.band else []), panel.log_y, panel.floor)
    inner_w, inner_h = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
    named = [s for s in panel.series if s.name and any(math.isfinite(p.y) for p in s.points)] if panel.legend else []
    if named:  # room above the points
        free = 1 - (LINE * len(named) + 8) / inner_h
        yhigh = ylow * (yhigh / ylow) ** (1 / free) if panel.log_y else ylow + (yhigh - ylow) / free
    scale = lambda v, low, high, log: (math.log(v / low) / math.log(high / low)) if log else (v - low) / (high - low)
    at_x = lambda v: LEFT + inner_w * scale(v, xlow, xhigh, panel.log_x)
    clip = lambda v: min(max(v, ylow), yhigh)
    at_y = lambda v: TOP + inner_h * (1 - scale(clip(v), ylow, yhigh, panel.log_y))
    say = lambda x, y, words, extra="": out.append(f'<text x="{x:.1f}" y="{y:.1f}" {extra}>{html.escape(words)}</text>')
    out.append(f'<g transform="translate({left},{top})">')
    say(WIDTH / 2, 18, panel.title, 'text-anchor="middle" font-weight="bold"')
    if panel.band:
        edge = at_y(panel.band[0])
        out.append(f'<rect x="{LEFT}" y="{edge:.1f}" width="{inner_w}" height="{TOP + inner_h - edge:.1f}" fill="#eeeeee"/>')
        say(LEFT + inner_w - 4, TOP + inner_h - 5, panel.band[1], 'text-anchor="end" font-size="10" fill="#666"')
    for v in _ticks(xlow, xhigh, panel.log_x):
        out.append(f'<line x1="{at_x(v):.1f}" x2="{at_x(v):.1f}" y1="{TOP}" y2="{TOP + inner_h}" stroke="#ddd"/>')
        if panel.numbered:
            say(at_x(v), TOP + inner_h + 15, f"{v:g}", 'text-anchor="middle"')
    for v in _ticks(ylow, yhigh, panel.log_y):
        out.append(f'<line x1="{LEFT}" x2="{LEFT + inner_w}" y1="{at_y(v):.1f}" y2="{at_y(v):.1f}" stroke="#ddd"/>')
        say(LEFT - 5, at_y(v) + 4, f"{v:g}", 'text-anchor="end"')
    out.append(f'<rect x="{LEFT}" y="{TOP}" width="{inner_w}" height="{inner_h}" fill="none" stroke="#888"/>')
    say(LEFT + inner_w / 2, HEIGHT - 14, panel.x, 'text-anchor="middle"')
    say(0, 0, panel.y, f'text-anchor="middle" transform="translate(14,{TOP + inner_h / 2}) rotate(-90)"')
    labels = _Labels(WIDTH, HEIGHT)
    for s in panel.series:
        seen = [(at_x(p.x), at_y(p.y)) for p in s.points if math.isfinite(p.y) and (p.y > 0 or not panel.log_y)]
        for p in s.points if s.marks else []:
            labels.take(at_x(p.x), at_y(p.y), *((20, 20) if p.ring else (9, 9)))
        for (x0, y0), (x1, y1) in zip(seen, seen[1:]) if s.line else []:
            parts = max(1, int(math.dist((x0, y0), (x1, y1)) / 6))
            for k in range(parts):
                labels.take(x0 + (x1 - x0) * k / parts, y0 + (y1 - y0) * k / parts, 5, 5)
    for s in panel.series:
        seen = [p for p in s.points if math.isfinite(p.y) and (p.y > 0 or not panel.log_y)]
        if s.line and len(seen) > 1:
            path = " ".join(f"{at_x(p.x):.1f},{at_y(p.y):.1f}" for p in seen)
            out.append(f'<polyline points="{path}" fill="none" stroke="{s.colour}" stroke-width="1.6"'
                       + (' stroke-dasharray="5 4"' if s.dashed else "") + "/>")
        for p in seen if s.marks else []:
            x, y = at_x(p.x), at_y(p.y)
            if not math.isnan(p.error):
                out.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{at_y(p.y + p.error):.1f}" y2="{at_y(p.y - p.error):.1f}" '
                           f'stroke="{s.colour}"/>')
            if p.bound:
                tip = y - 16 * p.bound
                out.append(f'<path d="M{x:.1f} {y:.1f}V{tip:.1f}m-4 {5 * p.bound}l4 {-5 * p.bound}l4 {5 * p.bound}" fill="none" '
                           f'stroke="{s.colour}" stroke-width="1.5"/>')
            if p.ring:
                out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="9" fill="none" stroke="#000" stroke-width="1.5"/>')
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{s.colour}"/>')
        for p in seen if s.marks else []:
            if p.label:
                (x, y), far = labels.place(at_x(p.x), at_y(p.y), p.label)
                if far:  # a thin line says whose the words are
                    out.append(f'<line x1="{at_x(p.x):.1f}" y1="{at_y(p.y):.1f}" x2="{far[0]:.1f}" y2="{far[1]:.1f}" stroke="{s.colour}" '
                               'stroke-width="0.6"/>')
                say(x, y, p.label, f'font-size="11" fill="{s.colour}"')
    for k, s in enumerate(named):
        y = TOP + LINE * (k + 1)
        out.append(f'<rect x="{LEFT + 8}" y="{y - 8}" width="10" height="8" fill="{s.colour}"/>')
        say(LEFT + 22, y, s.name, 'font-size="11"')
    out.append("</g>")


def write(path, title, panels, columns=3):
    """Writes panels row by row."""
    columns = min(columns, len(panels))
    rows = math.ceil(len(panels) / columns)
    width, height = columns * WIDTH, rows * HEIGHT + 30
    title_size = min(15, 1.7 * width / len(title))
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
           'font-family="DejaVu Sans, Verdana, sans-serif" font-size="12">',
           f'<rect width="{width}" height="{height}" fill="white"/>',
           f'<text x="{width / 2}" y="20" text-anchor="middle" font-size="{title_size:.1f}">{html.escape(title)}</text>']
    for k, panel in enumerate(panels):
        _panel(panel, out, k % columns * WIDTH, 30 + k // columns * HEIGHT)
    out.append("</svg>\n")
    path.write_text("\n".join(out))
