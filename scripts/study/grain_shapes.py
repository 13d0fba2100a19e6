# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ten grains by name: convex polyhedra cut out of an ellipsoid by planes, always the same ones. Lengths relative to the middle axis."""
import itertools
import math
import random
import typing

CORNER = 1e-9  # by which corners of three planes may be outside of another one


class Grain(typing.NamedTuple):
    """axes: half axes of the ellipsoid; planes that touch it, at random; `spread`: by which they move inwards and outwards."""
    axes: tuple
    planes: int
    spread: float
    seed: int
    what: str


GRAINS = {
    "pebble": Grain((1.25, 1.0, 0.85), 26, 0.03, 11, "a rounded stone"),
    "stone": Grain((1.2, 1.0, 0.9), 22, 0.08, 12, "a stone with blunt edges"),
    "rubble": Grain((1.15, 1.0, 0.9), 12, 0.12, 13, "broken rock with sharp edges"),
    "wedge": Grain((1.4, 1.0, 0.7), 9, 0.2, 14, "a splinter with few faces"),
    "sand": Grain((1.3, 1.0, 0.75), 18, 0.1, 15, "an angular grain of sand"),
    "cutting": Grain((1.6, 1.0, 0.45), 16, 0.08, 16, "a drilled cutting"),
    "flake": Grain((1.2, 1.0, 0.22), 16, 0.06, 17, "a flake of shale"),
    "blade": Grain((2.0, 1.0, 0.35), 16, 0.08, 18, "long and flat"),
    "needle": Grain((3.5, 1.0, 0.9), 20, 0.05, 19, "a needle"),
    "column": Grain((2.0, 1.0, 1.0), 14, 0.04, 20, "a column of a crystal"),
}


def direction(source):
    """A unit vector, evenly over the sphere."""
    z = source.uniform(-1, 1)
    angle = source.uniform(0, 2 * math.pi)
    return (math.sqrt(1 - z * z) * math.cos(angle), math.sqrt(1 - z * z) * math.sin(angle), z)


def spread_directions(count, source):
    """Directions that keep apart from each other: of twenty tries the one farthest from those that are there."""
    found = []
    for _ in range(count):
        tries = [direction(source) for _ in range(20)]
        found.append(max(tries, key=lambda n: min((math.dist(n, other) for other in found), default=0)))
    return found


def planes_of(grain):
    """(normal, distance) of the half spaces n x <= distance whose common part the grain is."""
    source = random.Random(grain.seed)
    planes = []
    for u in spread_directions(grain.planes, source):
        normal = tuple(c / a for c, a in zip(u, grain.axes))  # of the ellipsoid at a u
        length = math.sqrt(sum(c * c for c in normal))
        planes.append((tuple(c / length for c in normal), (1 + source.uniform(-grain.spread, grain.spread)) / length))
    # Planes at the tips close the grain whatever the others are.
    for d in range(3):
        for sign in (-1, 1):
            planes.append((tuple(float(sign) if e == d else 0.0 for e in range(3)), 1.05 * grain.axes[d]))
    return planes


def corner(a, b, c):
    """Where three planes meet, or None."""
    (n, p), (m, q), (k, r) = a, b, c
    mk = (m[1] * k[2] - m[2] * k[1], m[2] * k[0] - m[0] * k[2], m[0] * k[1] - m[1] * k[0])
    kn = (k[1] * n[2] - k[2] * n[1], k[2] * n[0] - k[0] * n[2], k[0] * n[1] - k[1] * n[0])
    nm = (n[1] * m[2] - n[2] * m[1], n[2] * m[0] - n[0] * m[2], n[0] * m[1] - n[1] * m[0])
    det = sum(x * y for x, y in zip(n, mk))
    return tuple((p * mk[d] + q * kn[d] + r * nm[d]) / det for d in range(3)) if abs(det) > 1e-9 else None


def faces_of(planes):
    """Corners of each face, counter-clockwise from outside."""
    corners = {}
    for i, j, k in itertools.combinations(range(len(planes)), 3):
        p = corner(planes[i], planes[j], planes[k])
        if p and all(sum(x * y for x, y in zip(n, p)) <= d + CORNER for n, d in planes):
            for face in (i, j, k):
                corners.setdefault(face, []).append(p)
    faces = []
    for face, points in corners.items():
        points = [p for i, p in enumerate(points) if all(math.dist(p, q) > 1e-7 for q in points[:i])]
        if len(points) < 3:
            continue
        n = planes[face][0]
        centre = tuple(sum(p[d] for p in points) / len(points) for d in range(3))
        first = tuple(points[0][d] - centre[d] for d in range(3))
        second = (n[1] * first[2] - n[2] * first[1], n[2] * first[0] - n[0] * first[2], n[0] * first[1] - n[1] * first[0])
        faces.append((n, sorted(points, key=lambda p: math.atan2(sum((p[d] - centre[d]) * second[d] for d in range(3)),
                                                                 sum((p[d] - centre[d]) * first[d] for d in range(3))))))
    return faces


def triangles_of(name):
    """(normal, three corners) of each triangle of a grain."""
    return [(n, (points[0], points[i], points[i + 1])) for n, points in faces_of(planes_of(GRAINS[name])) for i in range(1, len(points) - 1)]


def volume_of(triangles):
    """Of a closed surface whose triangles turn counter-clockwise from outside."""
    total = 0.0
    for _, (a, b, c) in triangles:
        total += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    return total / 6


def stl_of(name, diameter):
    """ASCII STL of the grain with the volume of a sphere of this diameter [m]."""
    triangles = triangles_of(name)
    scale = (math.pi / 6 * diameter**3 / volume_of(triangles)) ** (1 / 3)
    lines = [f"solid {name}"]
    for n, points in triangles:
        lines.append("facet normal {:.9g} {:.9g} {:.9g}\nouter loop".format(*n))
        lines += ["vertex {:.9g} {:.9g} {:.9g}".format(*(c * scale for c in p)) for p in points]
        lines.append("endloop\nendfacet")
    return "\n".join([*lines, f"endsolid {name}"]) + "\n"
