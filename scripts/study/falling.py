# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured bodies let go with a tilt in a still fluid, with forces of their real shape: terminal speed and how they lie at the end."""
import math
import re
import typing

from . import programs, runs
from .programs import SCENES, digest_of, run

SCRIPT = SCENES / "falling.in"
DIAMETER, FLUID_DENSITY, BODY_DENSITY, GRAVITY = 6.35e-3, 1000.0, 1200.0, 9.81
WEIGHT = math.pi / 6 * DIAMETER ** 3 * (BODY_DENSITY - FLUID_DENSITY) * GRAVITY  # submerged [N]
TILT = (50.0, 20.0)  # degrees from broadside about y, then about x
STEP = 0.02  # in units of d/U
FRAMES = 50
ROUNDING = 0.05  # of cubes and ellipsoids: the radius of corners over half the thickness
AROUND, RINGS = 12, (90, 60, 30, 0, -30, -60, -90)  # vertices of an ellipsoid: longitudes, latitudes
TORQUES = "oriented on drag_torque dennis pitching_torque dabade"
BROADSIDE = 5.0  # degrees
ATTITUDES = ("broadside", "flutters", "inclined")


class Body(typing.NamedTuple):
    """shape: words of a shape without its diameter; axes: of the ellipsoid that the shape is the hull of, or None; turns: whether pitching turns it."""
    shape: str
    axes: typing.Optional[tuple]
    turns: bool


def body_of(point):
    """What stands for a measured body: cubes for isometric ones, ellipsoids of the three axes for fragments and fibres; None for films, which are
    hundreds of times as wide as thick."""
    if point.shape.startswith("sphere"):
        return Body("sphere 1", None, False)
    if point.shape.startswith("isometric"):
        return Body(f"smooth cube rounding {ROUNDING}", None, False)
    found = re.match(r"(?:fragment|fib\w+)\b.*\baxes ([\d.]+) ([\d.]+) ([\d.]+)", point.shape)
    return Body(f"hull body.stl rounding {ROUNDING}", tuple(map(float, found.groups())), True) if found else None


def viscosity_of(point):
    """In which a body of d and density of this module falls as the measured one: with its (weight, inertia, viscosity) in C_D Re^2. The measured
    speed is then Re mu/(rho d)."""
    return math.sqrt(WEIGHT * FLUID_DENSITY * 8 / (math.pi * point.cd * point.re ** 2))


def speed_of(point):
    """Measured, in the units of the scene [m/s]."""
    return point.re * viscosity_of(point) / (FLUID_DENSITY * DIAMETER)


def write_ellipsoid(axes, path):
    """Its inscribed polyhedron with vertices on circles of latitude about the last axis."""
    ring = lambda latitude: [(math.cos(math.radians(latitude)) * math.cos(2 * math.pi * k / AROUND),
                              math.cos(math.radians(latitude)) * math.sin(2 * math.pi * k / AROUND), math.sin(math.radians(latitude)))
                             for k in range(AROUND)]
    circles, facets = [ring(latitude) for latitude in RINGS], []
    for top, bottom in zip(circles, circles[1:]):
        for k in range(AROUND):
            after = (k + 1) % AROUND
            if top is not circles[0]:
                facets.append((top[k], bottom[after], top[after]))
            if bottom is not circles[-1]:
                facets.append((top[k], bottom[k], bottom[after]))
    place = lambda point: "vertex " + " ".join(f"{x * a / 2:.9g}" for x, a in zip(point, axes))
    text = "".join("facet normal 0 0 0\nouter loop\n" + "\n".join(map(place, facet)) + "\nendloop\nendfacet\n" for facet in facets)
    path.write_text(f"solid ellipsoid\n{text}endsolid ellipsoid\n")


def product(p, q):
    """Of two quaternions w x y z."""
    a, b, c, d = p
    e, f, g, h = q
    return a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e


def start():
    """Orientation of the body's frame when it is let go."""
    about_y, about_x = (math.radians(angle) / 2 for angle in TILT)
    return product((math.cos(about_x), math.sin(about_x), 0.0, 0.0), (math.cos(about_y), 0.0, math.sin(about_y), 0.0))


def frames_of(path):
    """[(velocity, quaternion)] of the only body."""
    rows, lines = [], path.read_text().splitlines()
    for head, line in zip(lines, lines[1:]):
        if head.startswith("ITEM: ATOMS"):
            values = [float(word) for word in line.split()]
            rows.append((values[:3], values[3:]))
    return rows


def outcome(path):
    """Over the last two fifths: mean speed of settling, the largest angle of the path with the vertical, and the largest and least angle with the
    vertical of the body's x and z axes, which are those of its largest and least extent [degrees]."""
    last = frames_of(path)[-2 * FRAMES // 5:]
    upright = lambda cosine: math.degrees(math.acos(min(1.0, abs(cosine))))
    angles = {"path": [upright(velocity[2] / math.hypot(*velocity)) for velocity, _ in last],
              "longest": [upright(2 * (x * z - w * y)) for _, (w, x, y, z) in last],
              "thinnest": [upright(1 - 2 * (x * x + y * y)) for _, (w, x, y, z) in last]}
    return {"speed": -sum(velocity[2] for velocity, _ in last) / len(last), **{name: (min(of), max(of)) for name, of in angles.items()}}


def attitude(result):
    """What a body that pitching turns does at the end."""
    least, largest = result["thinnest"]
    if largest < BROADSIDE:
        return "broadside"
    return "flutters" if largest - least > BROADSIDE else "inclined"


def fall(build, folder, body, fluid, forces, speed, lengths):
    """One body through so many diameters at about this speed; what outcome() says, and CPU seconds."""
    if body.axes:
        write_ellipsoid(body.axes, folder / "body.stl")
    stretch = max(body.axes) / math.prod(body.axes) ** (1 / 3) if body.axes else 2.0
    side = DIAMETER * max(6.0, 2.5 * stretch)
    (folder / "body.txt").write_text(" ".join(f"{value:.12g}" for value in (*3 * [side / 2], *start(), 0, 0, -speed)) + "\n")
    steps = round(lengths / STEP / FRAMES) * FRAMES
    given = {"shape": f"{body.shape} diameter {DIAMETER}", "side": side, "density": BODY_DENSITY, "fluid": fluid, "forces": forces,
             "step": STEP * DIAMETER / speed, "steps": steps, "every": steps // FRAMES}
    cpu, *_ = run([build / "bin" / "eccentra-dem", "-in", SCRIPT, "-log", "none", *programs.variables(**given)], folder, folder / "out.txt")
    result = {**outcome(folder / "path.dump"), "cpu": cpu}
    (folder / "path.dump").unlink()
    return result


def newtonian(point):
    """Words of fix fluid/force for the fluid of a measured point."""
    return f"newtonian {viscosity_of(point):.12g} density {FLUID_DENSITY:g}"


def lengths_of(point, body):
    """Diameters after which the body has its terminal speed and, where pitching turns it, its attitude."""
    return 40.0 + (60.0 + 1000.0 / min(point.re, 20.0) if body.turns else 0.0)


def job(build, point, law):
    """A fall with forces of the real shape under this law."""
    body = body_of(point)
    forces = f"drag {law}" + (f" {TORQUES}" if body.shape != "sphere 1" else "")

    def work(folder):
        return fall(build, folder, body, newtonian(point), forces, speed_of(point), lengths_of(point, body))

    inputs = {"what": "falling body", "scene": digest_of(SCRIPT), "shape": body.shape, "axes": body.axes, "fluid": newtonian(point), "forces": forces,
              "reynolds": point.re}
    return runs.Job(f"{point.shape}, Re {point.re:g}, {law}", inputs, work, 0.5)
