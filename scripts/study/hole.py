# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What bodies in the annulus of Tomren do along the hole: concentration, height of the bed and front, from pictures of the bodies."""
import csv
import math
import re

from . import section, vtp

HOLE, PIPE, OFFSET = 0.0635, 0.02413, 0.019685  # radii, and how far the pipe's axis lies below that of the hole [m]
BIN = 0.1  # along the hole [m]
LAYERS = 40  # across the hole, from the low side
DENSE = 0.275  # concentration that bounds a bed, as in annulusReport: half of random loose packing
FRONT = 0.99  # of the solid is behind the front
FIRST_SHARE = 0.3  # of the time until the front is at the outlet, or of the run, that its speed leaves out
AT_OUTLET = 0.9  # of the hole: what leaves is missing from the solid behind a front that is farther


def below(radius, height):
    """Area of a circle below a height above its centre."""
    height = min(max(height, -radius), radius)
    half = math.sqrt(radius**2 - height**2)
    return radius**2 * math.atan2(half, -height) + height * half


def layer_areas():
    """Of the annulus, of each layer across it [m2]."""
    edges = [-HOLE + 2 * HOLE * k / LAYERS for k in range(LAYERS + 1)]
    cumulated = [below(HOLE, y) - below(PIPE, y + OFFSET) for y in edges]
    return [b - a for a, b in zip(cumulated, cumulated[1:])]


def bed_height(profile):
    """[m]: where the concentration, from below, falls through DENSE; 0 where no layer is that dense."""
    thick = 2 * HOLE / len(profile)
    first = next((k for k, c in enumerate(profile) if c >= DENSE), None)
    if first is None:
        return 0.0
    for k in range(first, len(profile) - 1):
        if profile[k + 1] < DENSE:
            return (k + 0.5 + (profile[k] - DENSE) / (profile[k] - profile[k + 1])) * thick
    return 2 * HOLE


def along(points, length):
    """Of bodies at points (x, y, z): [(z of the middle [m], solid concentration, height of the bed [m])] of each bin. Each body is the sphere of
    its volume, cut at the bounds of the layers; its centre chooses the bin."""
    import numpy
    bins = max(1, round(length / BIN))
    size = length / bins
    radius = section.DIAMETER / 2
    volume = numpy.zeros((bins, LAYERS + 1))  # below each bound
    place = numpy.clip((points[:, 2] / size).astype(int), 0, bins - 1)
    for k in range(1, LAYERS + 1):
        depth = numpy.clip(-HOLE + 2 * HOLE * k / LAYERS - points[:, 1] + radius, 0, 2 * radius) if k < LAYERS else numpy.full(len(points), 2 * radius)
        volume[:, k] = numpy.bincount(place, math.pi * depth**2 * (3 * radius - depth) / 3, bins)
    profile = numpy.diff(volume, axis=1) / (numpy.array(layer_areas()) * size)
    mean = volume[:, LAYERS] / (section.AREA * size)
    return [((k + 0.5) * size, float(mean[k]), bed_height(list(profile[k]))) for k in range(bins)]


def front_of(points):
    """[m]: where FRONT of the solid is behind; 0 without bodies."""
    places = sorted(points[:, 2])
    return float(places[min(len(places) - 1, math.floor(FRONT * len(places)))]) if places else 0.0


def pictures(case):
    """[(step, path)] of dump cluster/vtk, in time."""
    found = [(int(re.search(r"(\d+)\.vtp$", path.name)[1]), path) for path in (case / "postProcessing" / "eccentra").glob("grains_*.vtp")]
    return sorted(found)


def history(case, step, length):
    """[{time, front, along}] of all pictures of a run with steps of `step` seconds."""
    rows = []
    for number, path in pictures(case):
        points = vtp.arrays_of(path)["Points"]
        rows.append({"time": number * step, "front": front_of(points), "along": along(points, length)})
    return rows


def slope(points):
    """Of the least-squares line through (x, y)."""
    if len(points) < 2:
        return math.nan
    x0, y0 = (sum(p[k] for p in points) / len(points) for k in (0, 1))
    spread = sum((x - x0) ** 2 for x, _ in points)
    return sum((x - x0) * (y - y0) for x, y in points) / spread if spread else math.nan


def reached(rows, length):
    """How much of the hole is worth a picture: a third more than the front has come to, but for what is left of the hole [m]."""
    far = 4 / 3 * max((row["front"] for row in rows), default=length)
    return length if far > 0.75 * length else BIN * math.ceil(far / BIN)


def front_speed(rows, length):
    """[m/s] of the line through the places of the front, without FIRST_SHARE, until it is AT_OUTLET."""
    last = next((row["time"] for row in rows if row["front"] > AT_OUTLET * length), rows[-1]["time"] if rows else 0)
    return slope([(row["time"], row["front"]) for row in rows if FIRST_SHARE * last <= row["time"] <= last and row["front"] <= AT_OUTLET * length])


def write_csv(path, rows):
    with open(path, "w", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["time", "z", "concentration", "solid_kg_per_m", "bed_height"])
        for row in rows:
            time = f"{row['time']:.6g}"
            writer.writerows([time, f"{z:.4g}", f"{c:.6g}", f"{c * section.AREA * section.DENSITY:.6g}", f"{h:.5g}"] for z, c, h in row["along"])
