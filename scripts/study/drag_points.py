# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured drag coefficients of free falling bodies: the file, the sets that laws are judged on, and how far a law is off."""
import csv
import math
import typing

from .programs import ROOT, Failure, output_of

DEFAULT = ROOT.parent / "shared" / "data" / "drag_test_points.csv"
COLUMNS = ("sphericity", "Re", "Cd", "source", "flag", "shape", "crosswise")
GOOD, COARSE = 0, 5  # flags: to be used; to be used, with a sphericity that is good to 20 % only
LAWS = ("chien", "haider_levenspiel", "ganser", "holzer_sommerfeld", "schiller_naumann", "di_felice")
NEAR = 0.25  # |law/measured - 1| that the share counts
CREEP, SLOW = 0.1, 20.0  # Re
ROUND = 0.5  # sphericity above which a fragment counts as compact
# Bands of trust: (bias, rms) up to which a law is trusted, or may serve.
TRUSTED, SERVES = (0.10, 0.20), (0.20, 0.35)


class Point(typing.NamedTuple):
    """crosswise: pi d^2/4 over the area across the fall, the sphericity where the file has none; Re and Cd on the sphere of equal volume."""
    sphericity: float
    re: float
    cd: float
    source: str
    flag: int
    shape: str
    crosswise: float


def read(path):
    """All points; Failure, one sentence, where the file is not as it should be."""
    try:
        with open(path, newline="") as lines:
            kept = [(number, line) for number, line in enumerate(lines, 1) if line.strip() and not line.startswith("#")]
    except OSError as error:
        raise Failure(f"--data {path}: {error.strerror}; name a file with the columns {', '.join(COLUMNS)}") from None
    table = csv.DictReader(line for _, line in kept)
    missing = [name for name in COLUMNS if name not in (table.fieldnames or ())]
    if missing:
        raise Failure(f"--data {path}: there is no column '{missing[0]}'; expected {', '.join(COLUMNS)}")
    points = []
    for (number, _), row in zip(kept[1:], table):
        values = {}
        for name in ("sphericity", "Re", "Cd", "flag", "crosswise"):
            text = (row[name] or "").strip()
            try:
                values[name] = float(text or "nan")
            except ValueError:
                raise Failure(f"--data {path}, line {number}: {name} '{text}' is not a number; correct the line") from None
        # A point whose sphericity is not known is kept out of all sets by its flag.
        if values["flag"] in (GOOD, COARSE) and not (0 < values["sphericity"] <= 1 and 0 < values["Re"] < math.inf and 0 < values["Cd"] < math.inf):
            raise Failure(f"--data {path}, line {number}: sphericity, Re and Cd are not all positive; correct the line, or give it a flag other than 0 and 5")
        crosswise = values["sphericity"] if math.isnan(values["crosswise"]) else values["crosswise"]
        points.append(Point(values["sphericity"], values["Re"], values["Cd"], row["source"], int(values["flag"]), row["shape"], crosswise))
    return points


SETS = {
    f"isometric, Re < {SLOW:g}": lambda p: p.flag == GOOD and p.shape.startswith("isometric") and p.re < SLOW,
    f"isometric, Re < {CREEP:g}": lambda p: p.flag == GOOD and p.shape.startswith("isometric") and p.re < CREEP,
    f"fragments, phi >= {ROUND:g}": lambda p: p.flag == GOOD and p.shape.startswith("fragment") and p.sphericity >= ROUND,
    f"fragments, phi < {ROUND:g}": lambda p: p.flag == GOOD and p.shape.startswith("fragment") and p.sphericity < ROUND,
    "films": lambda p: p.flag == COARSE and p.shape.startswith("film"),
    "fibres": lambda p: p.flag == GOOD and p.shape.startswith("fib"),
    "spheres in air": lambda p: p.flag == GOOD and p.shape.startswith("sphere"),
}


class Off(typing.NamedTuple):
    """Of law over measured: geometric mean less 1, exp of the root mean square of the logarithm less 1, share within 25 %."""
    count: int
    bias: float
    rms: float
    share: float

    def trust(self):
        for name, (bias, rms) in (("trusted", TRUSTED), ("serves", SERVES)):
            if abs(self.bias) <= bias and self.rms <= rms:
                return name
        return "not trusted"


def off(ratios):
    """Of the ratios law/measured of some points."""
    logs = [math.log(ratio) for ratio in ratios]
    mean = sum(logs) / len(logs)
    return Off(len(logs), math.expm1(mean), math.expm1(math.sqrt(sum(v * v for v in logs) / len(logs))),
               sum(abs(ratio - 1) <= NEAR for ratio in ratios) / len(ratios))


def coefficients(build, points, laws, folder):
    """{law: [C_D of each point]} by the closures themselves (the tool dragLaw)."""
    file = folder / "points.txt"
    file.write_text("".join(f"{p.sphericity!r} {p.re!r} {p.crosswise!r}\n" for p in points))
    rows = list(csv.DictReader(output_of([build / "bin" / "dragLaw", ",".join(laws), "--points", file]).splitlines()))
    return {law: [float(row[law]) for row in rows] for law in laws}
