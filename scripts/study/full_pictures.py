# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the whole hole in time and of a piece of its bed, bodies at their true shape and coloured by their speed."""
import math

from . import hole, programs, section, vtp

TIMES = 6
PIECE = 0.5  # of the hole, in the close picture [m]
SLICE = 0.03  # of the cross-section [m]
DIRECTIONS = 200  # in which a convex body has a point of its outline
WIDE = 18  # of the strip of frames and of the film [inch]
FRAME_TIME = 150  # of the film [ms]
FASTEST = 0.6  # [m/s], of the scale of colours


def form_of(build, level, folder):
    """("spheres", centres, radii) of a cluster or ("hull", points) of a convex body, in the body's frame."""
    import numpy
    if level.kind == "cluster":
        file = folder / "body.clump"
        programs.output_of([build / "bin" / "clusterShape", *level.shape.split(), "--diameter", section.DIAMETER, "-o", file])
        rows = numpy.loadtxt(file)
        file.unlink()
        return "spheres", rows[:, :3], rows[:, 3]
    k = numpy.arange(DIRECTIONS) + 0.5  # even on the sphere
    up, turn = 1 - 2 * k / DIRECTIONS, k * math.pi * (3 - math.sqrt(5))
    across = numpy.sqrt(1 - up**2)
    directions = numpy.stack([across * numpy.cos(turn), across * numpy.sin(turn), up], axis=1)
    if level.kind != "smooth":
        return "hull", directions * section.DIAMETER / 2
    file = folder / "body.vtk"
    programs.output_of([build / "bin" / "clusterShape", *level.shape.split(), "--diameter", section.DIAMETER, "--vtk", file])
    surface = vtp.surface_points(file)
    file.unlink()
    return "hull", surface[numpy.unique(numpy.argmax(directions @ surface.T, axis=1))]


def turned(q, points):
    """Points of a body's frame in the world's; q: quaternion w x y z."""
    import numpy
    w, x, y, z = (float(v) for v in q)
    turn = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    return points @ turn.T


def outline(points):
    """The convex hull of points in a plane, as a polygon (Andrew's monotone chain)."""
    points = sorted(map(tuple, points))
    halves = []
    for row in (points, points[::-1]):
        chain = []
        for p in row:
            while len(chain) > 1 and ((chain[-1][0] - chain[-2][0]) * (p[1] - chain[-2][1]) - (chain[-1][1] - chain[-2][1]) * (p[0] - chain[-2][0])) <= 0:
                chain.pop()
            chain.append(p)
        halves += chain[:-1]
    return halves


def draw_bodies(axes, bodies, chosen, form, across, along, depth):
    """The chosen bodies, far ones first; across, along: coordinates to the right and up; depth: coordinate and sign that grows towards the eye."""
    import numpy
    from matplotlib import cm, collections
    order = sorted(numpy.flatnonzero(chosen), key=lambda i: depth[1] * bodies["Points"][i, depth[0]])
    speed = numpy.linalg.norm(bodies["velocity"], axis=1)
    colours = cm.viridis(numpy.clip(speed / FASTEST, 0, 1))
    polygons, places, sizes, faces = [], [], [], []
    for i in order:
        centre, q = bodies["Points"][i], bodies["orientation"][i]
        points = centre + turned(q, form[1])
        if form[0] == "hull":
            polygons.append(outline(points[:, [across, along]]))
            faces.append(colours[i])
            continue
        for k in numpy.argsort(depth[1] * points[:, depth[0]]):
            places.append(points[k, [across, along]])
            sizes.append(2 * form[2][k])
            faces.append(colours[i])
    if polygons:
        axes.add_collection(collections.PolyCollection(polygons, facecolors=faces, edgecolors="black", linewidths=0.3))
    elif places:
        axes.add_collection(collections.EllipseCollection(sizes, sizes, numpy.zeros(len(sizes)), units="xy", offsets=places, offset_transform=axes.transData,
                                                          facecolors=faces, edgecolors="black", linewidths=0.15))


def frame(axes, left, right, title):
    """Walls in a side view: the flow goes to the right, the low side is below."""
    from matplotlib.patches import Rectangle
    axes.set(xlim=(left, right), ylim=(-1.1 * hole.HOLE, 1.1 * hole.HOLE), aspect="equal", yticks=[])
    axes.set_title(title, loc="left", fontsize=8)
    axes.add_patch(Rectangle((left, -hole.OFFSET - hole.PIPE), right - left, 2 * hole.PIPE, facecolor="#cccccc"))
    axes.hlines([-hole.HOLE, hole.HOLE], left, right, color="#555555")


def side_view(axes, name, file, time, shown):
    """The bodies of one picture in front of the middle plane, as balls of their volume; the first `shown` metres of the hole."""
    from matplotlib import cm, collections
    import numpy
    bodies = vtp.arrays_of(file)
    frame(axes, 0, shown, f"{name}, {time:.1f} s, {len(bodies['Points'])} bodies; bodies in front of the middle plane")
    front = bodies["Points"][:, 0] < 0
    speed = numpy.linalg.norm(bodies["velocity"][front], axis=1)
    size = numpy.full(front.sum(), section.DIAMETER)
    axes.add_collection(collections.EllipseCollection(size, size, 0 * size, units="xy", offsets=bodies["Points"][front][:, [2, 1]],
                                                      offset_transform=axes.transData, facecolors=cm.viridis(numpy.clip(speed / FASTEST, 0, 1))))


def high_of(shown):
    """Height of a side view with its title [inch]."""
    return 0.45 + WIDE * 2.2 * hole.HOLE / shown


def whole_hole(path, name, case, step, length):
    """Side views of the hole, as far as bodies have come, to scale at several times: a strip of frames."""
    from matplotlib.figure import Figure
    found = hole.pictures(case)
    shown = hole.reached(hole.history(case, step, length), length)
    chosen = [found[round(k * (len(found) - 1) / TIMES)] for k in range(1, TIMES + 1)] if len(found) > TIMES else found
    figure = Figure(figsize=(WIDE, high_of(shown) * len(chosen) + 0.3), dpi=100, layout="constrained")
    for axes, (number, file) in zip(figure.subplots(len(chosen), 1, squeeze=False).flat, chosen):
        side_view(axes, name, file, number * step, shown)
    figure.savefig(path, metadata={"Software": None})


def film(path, name, case, step, length):
    """All pictures as an animated PNG, which browsers play: the side view, and below it the height of the bed along the hole."""
    import io
    from PIL import Image
    from matplotlib.figure import Figure
    found, rows = hole.pictures(case), hole.history(case, step, length)
    shown = hole.reached(rows, length)
    highest = 1e3 * max(h for row in rows for _, _, h in row["along"])
    wide, low, side, top = WIDE - 1.2, 1.2, (WIDE - 1.2) * 2.2 * hole.HOLE / shown, 0.4  # of the axes and the title: one scale along the hole [inch]
    high = 0.6 + low + 0.3 + side + top
    images = []
    for (number, file), row in zip(found, rows):
        figure = Figure(figsize=(WIDE, high), dpi=60)
        below = figure.add_axes((0.8 / WIDE, 0.6 / high, wide / WIDE, low / high))
        above = figure.add_axes((0.8 / WIDE, (0.9 + low) / high, wide / WIDE, side / high))
        side_view(above, name, file, number * step, shown)
        below.fill_between([z for z, _, _ in row["along"]], [1e3 * h for _, _, h in row["along"]], color="#0072b2")
        below.set(xlim=(0, shown), ylim=(0, 1.05 * highest or 1), xlabel="along the hole [m]", ylabel="bed [mm]")
        drawn = io.BytesIO()
        figure.savefig(drawn, format="png")
        images.append(Image.open(drawn).convert("RGB"))
    images[0].save(path, format="PNG", save_all=True, append_images=images[1:], duration=FRAME_TIME, loop=0)


def piece(path, name, case, step, length, form):
    """The densest piece of the hole at the end, from the side and against the flow."""
    from matplotlib import cm, colors
    from matplotlib.figure import Figure
    from matplotlib.patches import Circle
    number, file = hole.pictures(case)[-1]
    bodies = vtp.arrays_of(file)
    points = bodies["Points"]
    rows = hole.along(points, length)
    middle = max(rows, key=lambda row: row[1])[0]
    left = min(max(0.0, middle - PIECE / 2), max(0.0, length - PIECE))
    right = min(length, left + PIECE)
    figure = Figure(figsize=(14, 3.4), dpi=150, layout="constrained")
    side, cross = figure.subplots(1, 2, width_ratios=(4, 1))
    frame(side, left, right, f"{name}, {number * step:.1f} s: bodies in front of the middle plane")
    draw_bodies(side, bodies, (points[:, 0] < 0) & (points[:, 2] > left - 0.01) & (points[:, 2] < right + 0.01), form, 2, 1, (0, -1))
    cross.set(xlim=(-1.1 * hole.HOLE, 1.1 * hole.HOLE), ylim=(-1.1 * hole.HOLE, 1.1 * hole.HOLE), aspect="equal", xticks=[], yticks=[])
    cross.set_title(f"against the flow, {1e3 * SLICE:g} mm at z = {middle:.2f} m", loc="left", fontsize=8)
    cross.add_patch(Circle((0, 0), hole.HOLE, fill=False, edgecolor="#555555"))
    draw_bodies(cross, bodies, abs(points[:, 2] - middle) < SLICE / 2, form, 0, 1, (2, 1))
    cross.add_patch(Circle((0, -hole.OFFSET), hole.PIPE, facecolor="#cccccc"))
    figure.colorbar(cm.ScalarMappable(colors.Normalize(0, FASTEST), "viridis"), ax=cross, label="speed [m/s]")
    figure.savefig(path, metadata={"Software": None})
