# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured in the frames that scenes of cases/rolling-comparison dump."""
import math
import statistics

DIAMETER = 6.35e-3
RADIUS = DIAMETER / 2
FRAME = 0.01  # between two frames of the hopper [s]


def last_rows(path):
    """The numbers of the last frame of a dump of any columns."""
    lines = path.read_text().splitlines()
    last = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    return [tuple(map(float, line.split())) for line in lines[last + 1:]]


def read_frames(path):
    """Frames of a dump: a list of {id: (x, y, z, vx, vy, vz)}."""
    frames, lines = [], path.read_text().splitlines()
    at = 0
    while at < len(lines):
        if lines[at].startswith("ITEM: ATOMS"):
            frame = {}
            at += 1
            while at < len(lines) and not lines[at].startswith("ITEM"):
                words = lines[at].split()
                frame[int(words[0])] = tuple(float(w) for w in words[1:7])
                at += 1
            frames.append(frame)
        else:
            at += 1
    return frames


def speed(frame):
    """Root mean square velocity [m/s]."""
    return math.sqrt(sum(b[3] ** 2 + b[4] ** 2 + b[5] ** 2 for b in frame.values()) / len(frame)) if frame else math.nan


def stopping_distance(frames, bodies):
    first, last = frames[0], frames[-1]
    body = next(iter(last))
    return (last[body][0] - first[body][0]) / DIAMETER, speed(last)


def tilting_angle(frames, bodies):
    body = next(iter(frames[0]))
    x0 = frames[0][body][:2]
    for angle, frame in enumerate(frames[1:], start=1):
        if body not in frame or math.dist(frame[body][:2], x0) > RADIUS:
            return angle, speed(frames[0])
    return 45, speed(frames[0])


def heap_angle(frames, bodies):
    """A cone of base B and height H has mean radius B/2 and mean height H/4; bodies that rolled out of the heap do not count."""
    frame = frames[-1]
    x0 = statistics.median(b[0] for b in frame.values())
    y0 = statistics.median(b[1] for b in frame.values())
    near = sorted((math.hypot(b[0] - x0, b[1] - y0), k) for k, b in frame.items())[: int(0.9 * len(frame))]
    radius = sum(r for r, _ in near) / len(near)
    height = sum(max(0.0, frame[k][2] - RADIUS) for _, k in near) / len(near)
    return math.degrees(math.atan2(2 * height, radius)), speed({k: frame[k] for _, k in near})


def drum_angle(frames, bodies):
    """Direction of the centre of mass, from the vertical, mean over the second half of the run."""
    angles = []
    for frame in frames:
        x = sum(b[0] for b in frame.values())
        y = sum(b[1] for b in frame.values())
        angles.append(abs(math.degrees(math.atan2(x, -y))))
    return sum(angles) / len(angles), math.nan


def discharge_rate(frames, bodies):
    """Bodies per second between 10 and 50 % of those that were there."""
    inside = [sum(1 for b in frame.values() if b[2] > 0) for frame in frames]
    if inside[-1] > 0.5 * inside[0]:
        return (inside[0] - inside[-1]) / (len(inside) * FRAME), math.nan
    start = next(k for k, n in enumerate(inside) if n <= 0.9 * inside[0])
    end = next(k for k, n in enumerate(inside) if n <= 0.5 * inside[0])
    return (inside[start] - inside[end]) / (max(1, end - start) * FRAME), math.nan


def steady_discharge(frames, bodies):
    """Bodies per second, by least squares from 90 to 60 % of those that were there: on a flat bottom some 40 % stay."""
    inside = [sum(1 for b in frame.values() if b[2] > 0) for frame in frames]
    span = [k for k, n in enumerate(inside) if 0.6 * inside[0] <= n <= 0.9 * inside[0]]
    if len(span) < 3:
        return discharge_rate(frames, bodies)
    return -statistics.linear_regression([k * FRAME for k in span], [inside[k] for k in span]).slope, math.nan
