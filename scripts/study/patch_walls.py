# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Walls of the DEM from the triangles of a mesh's patches: planes and cylinders where they are exact, else triangle meshes. Pure geometry, lengths in m."""
import math
import re
import typing

FLAT = 1e-6  # of the size of the mesh, by which a plane's or cylinder's points may be off
SEEN_FROM = 1e-5  # of that size, by which the rest of the mesh may lie behind a plane

MOST_PLANES = 8  # that a patch is divided into


class Surface(typing.NamedTuple):
    """A patch: corners of its triangles."""
    name: str
    triangles: list  # of three points (x, y, z)

    def points(self):
        return [p for triangle in self.triangles for p in triangle]


class Plane(typing.NamedTuple):
    """A point of it, and its unit normal."""
    point: tuple
    normal: tuple


class Cylinder(typing.NamedTuple):
    """About the direction 0, 1 or 2; centre: the two other coordinates in cyclic order."""
    direction: int
    radius: float
    centre: tuple


class Meshed(typing.NamedTuple):
    """Triangles as they are."""
    triangles: list


def read_stl(text):
    """Surfaces of an ASCII STL file, one for each solid."""
    surfaces = []
    for name, body in re.findall(r"^\s*solid\s+(\S+)[^\n]*\n(.*?)^\s*endsolid", text, re.MULTILINE | re.DOTALL):
        numbers = [float(word) for line in re.findall(r"vertex\s+([^\n]+)", body) for word in line.split()]
        points = list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))
        surfaces.append(Surface(name, list(zip(points[0::3], points[1::3], points[2::3]))))
    return surfaces


def stl_text(surface):
    """The surface as an ASCII STL file; triangles without area are left out."""
    lines = [f"solid {surface.name}"]
    for triangle in surface.triangles:
        normal = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]))
        length = norm(normal)
        if length > 0:
            lines.append("facet normal {:.9g} {:.9g} {:.9g}\nouter loop".format(*(c / length for c in normal)))
            lines += ["vertex {:.12g} {:.12g} {:.12g}".format(*p) for p in triangle]
            lines.append("endloop\nendfacet")
    return "\n".join([*lines, f"endsolid {surface.name}"]) + "\n"


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def norm(a):
    return math.sqrt(dot(a, a))


def size_of(surfaces):
    """Diagonal of the box around all points."""
    points = [p for surface in surfaces for p in surface.points()]
    return math.dist([min(p[d] for p in points) for d in range(3)], [max(p[d] for p in points) for d in range(3)])


def planes_of(surface, size):
    """The planes that the triangles lie in, or None where there are more than MOST_PLANES."""
    planes = []
    for triangle in sorted(surface.triangles, key=lambda t: -norm(cross(minus(t[1], t[0]), minus(t[2], t[0])))):
        if any(all(abs(dot(minus(p, plane.point), plane.normal)) <= FLAT * size for p in triangle) for plane in planes):
            continue
        normal = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]))
        if len(planes) == MOST_PLANES or norm(normal) == 0:
            return None
        planes.append(Plane(triangle[0], tuple(c / norm(normal) for c in normal)))
    return planes


def in_front(plane, surfaces, size):
    """Whether all of the mesh lies on one side: a plane without end is then no wall where there was none."""
    heights = [dot(minus(p, plane.point), plane.normal) for surface in surfaces for p in surface.points()]
    return min(heights) > -SEEN_FROM * size or max(heights) < SEEN_FROM * size


def circle_of(points):
    """(x, y, radius) of the circle of least squares, or None where the points lie on a line."""
    n = len(points)
    mx, my = sum(p[0] for p in points) / n, sum(p[1] for p in points) / n
    u, v = [p[0] - mx for p in points], [p[1] - my for p in points]
    suu, suv, svv = sum(a * a for a in u), sum(a * b for a, b in zip(u, v)), sum(b * b for b in v)
    det = suu * svv - suv * suv
    if det <= 1e-12 * (suu + svv)**2:
        return None
    ru = 0.5 * sum(a * (a * a + b * b) for a, b in zip(u, v))
    rv = 0.5 * sum(b * (a * a + b * b) for a, b in zip(u, v))
    cu, cv = (ru * svv - rv * suv) / det, (rv * suu - ru * suv) / det
    return cu + mx, cv + my, math.sqrt(cu * cu + cv * cv + (suu + svv) / n)


def whole_turn(angles):
    """Whether no gap between neighbours is above 60 degrees."""
    ordered = sorted(set(angles))
    gaps = [b - a for a, b in zip(ordered, [*ordered[1:], ordered[0] + 2 * math.pi])]
    return max(gaps) <= math.pi / 3 + 1e-9


def cylinder_of(surface, surfaces, size):
    """The whole cylinder along x, y or z that all corners lie on, with the whole length of the mesh, or None."""
    for direction in range(3):
        i, j = (direction + 1) % 3, (direction + 2) % 3
        across = [(p[i], p[j]) for p in surface.points()]
        found = circle_of(across)
        if not found:
            continue
        x, y, radius = found
        if any(abs(math.hypot(a - x, b - y) - radius) > FLAT * size for a, b in across):
            continue
        # Triangles of a disc's rim would do so far: a wall's are parallel to the axis.
        if any(abs(cross(minus(t[1], t[0]), minus(t[2], t[0]))[direction]) > FLAT * size**2 for t in surface.triangles):
            continue
        own, all_points = [p[direction] for p in surface.points()], [p[direction] for s in surfaces for p in s.points()]
        long = min(own) <= min(all_points) + FLAT * size and max(own) >= max(all_points) - FLAT * size
        if long and whole_turn([math.atan2(b - y, a - x) for a, b in across]):
            return Cylinder(direction, radius, (x, y))
    return None


def walls_of(surface, surfaces, size):
    """The simplest walls that are exact. surfaces: all patches of the mesh."""
    planes = planes_of(surface, size)
    if planes and all(in_front(plane, surfaces, size) for plane in planes):
        return planes
    cylinder = cylinder_of(surface, surfaces, size)
    return [cylinder or Meshed(surface.triangles)]
