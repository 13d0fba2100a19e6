# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The size of the error of a level in a scene that was not run, from its geometry and its errors in other scenes; pure formulas.

The model is |error| = a m + b g. m is the mean size of the error of the level in the other scenes; g is the part of the eccentricity of
the true body that the level lacks. a and b follow from the other scenes alone, each predicted in turn from the rest; what this misses
there is the standard error of the prediction."""
import dataclasses
import math
import statistics

from . import least_squares

MIN_SCENES = 3  # two to learn from, and one to predict


@dataclasses.dataclass(frozen=True)
class Forecast:
    level: str
    scene: str
    predicted: float
    error: float
    measured: float
    noise: float  # standard error of what was measured

    def holds(self):
        """Whether the measured size lies within two standard errors."""
        return abs(self.predicted - self.measured) <= 2 * math.hypot(self.error, self.noise)


def defect(eccentricity, true_eccentricity):
    """Part of the mean delta_e/R_eq of the true body that a level lacks (or has too much): 1 for a sphere, 0 for the body itself."""
    return abs(1 - eccentricity / true_eccentricity)


def _features(level, scene, sizes, defects):
    return statistics.fmean(of[level] for name, of in sizes.items() if name != scene and level in of), defects[level]


def _weights(columns, values):
    """a and b of least squares, neither negative: an error is not repaired by another one."""
    both, _ = least_squares.fit(columns, values, [1.0] * len(values))
    if both and min(both) >= 0:
        return both
    alone = [least_squares.fit([column], values, [1.0] * len(values))[0] or [0.0] for column in columns]
    alone = [max(0.0, value[0]) for value in alone]
    misfit = lambda k: sum((alone[k] * x - y) ** 2 for x, y in zip(columns[k], values))
    return [alone[0], 0.0] if misfit(0) <= misfit(1) else [0.0, alone[1]]


def learn(sizes, defects):
    """(a, b, standard error of a prediction) from scenes {scene: {level: size of the error}}; None with fewer than two scenes that share
    levels, or with too few of them. Each scene is predicted from the others."""
    rows = [(*_features(level, scene, sizes, defects), size) for scene, of in sizes.items() for level, size in of.items()
            if level in defects and any(level in other for name, other in sizes.items() if name != scene)]
    if len(rows) < 3:
        return None
    means, lacks, values = zip(*rows)
    a, b = _weights([list(means), list(lacks)], list(values))
    return a, b, math.sqrt(sum((a * m + b * g - y) ** 2 for m, g, y in rows) / (len(rows) - 2))


def leave_one_out(sizes, noises, defects):
    """Forecasts of every level in every scene, each from the other scenes alone. sizes, noises: {scene: {level: ...}}; defects: {level:
    defect}. Empty with fewer than MIN_SCENES scenes."""
    if len(sizes) < MIN_SCENES:
        return []
    made = []
    for scene, of in sizes.items():
        others = {name: found for name, found in sizes.items() if name != scene}
        learned = learn(others, defects)
        if learned is None:
            continue
        a, b, error = learned
        for level, measured in of.items():
            known = [found[level] for found in others.values() if level in found]
            if known and level in defects:
                made.append(Forecast(level, scene, a * statistics.fmean(known) + b * defects[level], error, measured, noises[scene][level]))
    return made


def elsewhere(sizes, defects):
    """{level: (size of the error in a scene that was not run, its standard error)}, from all scenes that were."""
    learned = learn(sizes, defects) if len(sizes) >= MIN_SCENES else None
    if learned is None:
        return {}
    a, b, error = learned
    known = {level: [of[level] for of in sizes.values() if level in of] for level in defects}
    return {level: (a * statistics.fmean(found) + b * defects[level], error) for level, found in known.items() if found}


def words_of(forecasts):
    """What the table says, in two sentences."""
    miss = math.sqrt(statistics.fmean((f.predicted - f.measured) ** 2 for f in forecasts))
    spread = statistics.pstdev([f.measured for f in forecasts])
    within = sum(f.holds() for f in forecasts)
    text = (f"Predicted from the other scenes, the size of the error is off by {100 * miss:.0f} points in the root mean square; {within} of "
            f"{len(forecasts)} lie within two standard errors. The mean of all sizes would be off by {100 * spread:.0f} points")
    return text + (", so that the prediction is of no use here." if miss >= spread else ".")
