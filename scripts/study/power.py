# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How many seeds a comparison needs, from those that have been run: pure formulas."""
import math

from . import measures

REFERENCE_ERROR = 0.03  # standard error of the reference over its value
DEVIATION_ERROR = 0.05  # standard error of each deviation, which is a share of the reference


def widened(error, runs):
    """A standard error from few runs as the 68 % interval of Student's distribution (to 2 % from three runs on): a pilot whose values lie
    close to each other by chance would end the study too early."""
    return error * (1 + 0.6 / (runs - 1)) if runs > 1 else error


def seeds_wanted(values, reference, most, reference_error=REFERENCE_ERROR, deviation_error=DEVIATION_ERROR):
    """{level: number of seeds}, at most `most`, that bring the standard error of the reference below reference_error and those of the
    deviations below deviation_error. values: {level: {seed: value}}. Deviations are of pairs, so the reference has the seeds of all levels.
    A level without two values stays as it is."""
    of = values[reference]
    mean, error = measures.mean_and_error(list(of.values()))
    wanted = {name: len(found) for name, found in values.items()}
    if len(of) < 2 or not mean:
        return wanted
    for name, found in values.items():
        if name == reference:
            wanted[name] = measures.runs_for(widened(error, len(of)), len(of), reference_error * abs(mean))
            continue
        pairs = [(value, of[seed]) for seed, value in found.items() if seed in of]
        _, spread = measures.paired_deviation(pairs)
        wanted[name] = max(len(found), measures.runs_for(widened(spread, len(pairs)), len(pairs), deviation_error))
    wanted[reference] = max(wanted.values())
    return {name: min(most, number) for name, number in wanted.items()}


def reached(rows, reference):
    """What of the wanted errors is not reached, as a sentence; empty where all are. rows: with level, value, error, deviation_error."""
    left = [f"{row.level.name} (+- {100 * row.deviation_error:.0f} points)" for row in rows
            if row is not reference and row.runs and row.deviation_error > DEVIATION_ERROR]
    share = abs(reference.error / reference.value) if reference.value else math.nan
    text = []
    if share > REFERENCE_ERROR:
        text.append(f"the reference is known to {100 * share:.0f} %, not to {100 * REFERENCE_ERROR:g} %")
    if left:
        text.append(f"deviations known to more than {100 * DEVIATION_ERROR:g} points: {', '.join(left)}")
    return f"More seeds are needed: {'; '.join(text)}." if text else ""
