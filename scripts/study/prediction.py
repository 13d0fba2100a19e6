# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The size of the error of a level in a scene where it was not run, from its geometry, its errors in other scenes, and two runs with spheres; pure
formulas.

The model is |error| = S (a m + b g). S says how much the scene asks for shape: the difference of the results of the sphere without and with
mu_shape over their mean. m is the mean of |error|/S of the level in the other scenes; g is the part of the eccentricity of the true body that the
level lacks. a and b follow from the other scenes alone, each predicted in turn from the rest; what this misses there, in units of S, is the
standard error of the prediction."""
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


def sensitivity(sphere, friction):
    """S of a scene from the results of the sphere without and with mu_shape: 0 to 2 where both have one sign; 0 where neither is anything."""
    mean = (abs(sphere) + abs(friction)) / 2
    return abs(sphere - friction) / mean if mean else 0.0


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
    """(a, b, standard error of a prediction) from scenes {scene: {level: size of the error over S}}; None with fewer than two scenes that
    share levels, or with too few of them. Each scene is predicted from the others."""
    rows = [(*_features(level, scene, sizes, defects), size) for scene, of in sizes.items() for level, size in of.items()
            if level in defects and any(level in other for name, other in sizes.items() if name != scene)]
    if len(rows) < 3:
        return None
    means, lacks, values = zip(*rows)
    a, b = _weights([list(means), list(lacks)], list(values))
    return a, b, math.sqrt(sum((a * m + b * g - y) ** 2 for m, g, y in rows) / (len(rows) - 2))


def _over(sizes, sensitivities):
    """Sizes of errors in units of S, of the scenes that react at all."""
    return {scene: {level: size / sensitivities[scene] for level, size in of.items()} for scene, of in sizes.items() if sensitivities[scene] > 0}


def leave_one_out(sizes, noises, defects, sensitivities):
    """Forecasts of every level in every scene, each from the other scenes and S of its own. sizes, noises: {scene: {level: ...}}; defects:
    {level: defect}; sensitivities: {scene: S}. Empty with fewer than MIN_SCENES scenes whose S is above 0."""
    shares = _over(sizes, sensitivities)
    if len(shares) < MIN_SCENES:
        return []
    made = []
    for scene in shares:
        others = {name: found for name, found in shares.items() if name != scene}
        learned = learn(others, defects)
        if learned is None:
            continue
        a, b, error = learned
        scale = sensitivities[scene]
        for level, measured in sizes[scene].items():
            known = [found[level] for found in others.values() if level in found]
            if known and level in defects:
                made.append(Forecast(level, scene, scale * (a * statistics.fmean(known) + b * defects[level]), scale * error, measured, noises[scene][level]))
    return made


def elsewhere(sizes, defects, sensitivities):
    """{level: (size of the error over S in a scene that was not run, its standard error)}, from all scenes that were."""
    shares = _over(sizes, sensitivities)
    learned = learn(shares, defects) if len(shares) >= MIN_SCENES else None
    if learned is None:
        return {}
    a, b, error = learned
    known = {level: [of[level] for of in shares.values() if level in of] for level in defects}
    return {level: (a * statistics.fmean(found) + b * defects[level], error) for level, found in known.items() if found}


def words_of(forecasts):
    """What the table says, in two sentences."""
    miss = math.sqrt(statistics.fmean((f.predicted - f.measured) ** 2 for f in forecasts))
    spread = statistics.pstdev([f.measured for f in forecasts])
    within = sum(f.holds() for f in forecasts)
    far = sorted(abs(f.predicted - f.measured) for f in forecasts)
    text = (f"Predicted from the other scenes, half of the sizes are off by less than {100 * statistics.median(far):.0f} points, and the root mean square "
            f"is {100 * miss:.0f} points; {within} of {len(forecasts)} lie within two standard errors. The mean of all sizes would be off by "
            f"{100 * spread:.0f} points")
    return text + (", so that the prediction is of no use here." if miss >= spread else ".")
