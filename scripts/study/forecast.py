# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of a page that predicts the error of a level in a scene that was not run, and checks that by leaving out each scene."""
import math

from . import levels, prediction, tables
from .shape_levels import DIAMETER

HEADER = ["level", "scene", "predicted", "error", "measured", "noise"]


def defects_of(build, chosen):
    """{level name: defect} of levels of detail, the last of which is the true body."""
    eccentricity = {}
    for level in chosen:
        if level.kind == "friction":
            eccentricity[level.name] = level.mu
        elif level.kind == "sphere":
            eccentricity[level.name] = 0.0
        else:
            eccentricity[level.name] = levels.measured(build, level.shape, "--diameter", DIAMETER)["eccentricity"]["plane"]["mean"]
    true = eccentricity[chosen[-1].name]
    return {name: prediction.defect(value, true) for name, value in eccentricity.items()} if true else {}


def sensitivity_of(group, defects):
    """S of a scene (prediction.py) from its runs with spheres; None where one of them is not there. Of several mu_shape the one nearest to the
    true body counts."""
    there = [row for row in group.rows if row.runs and not math.isnan(row.value) and row.level.name in defects]
    sphere = next((row for row in there if row.level.kind == "sphere"), None)
    friction = min((row for row in there if row.level.kind == "friction"), key=lambda row: defects[row.level.name], default=None)
    return prediction.sensitivity(sphere.value, friction.value) if sphere and friction else None


def page_of(build, groups, output, name):
    """Paragraphs and table, and the rows as CSV in output/name.csv; nothing where there are too few scenes. groups: level_study.Group of one
    body, one for each scene."""
    shown = [group for group in groups if group.models()]
    if len(shown) < prediction.MIN_SCENES:
        return []
    chosen = list(dict.fromkeys(row.level for group in shown for row in group.models()))
    defects = defects_of(build, [*chosen, shown[0].rows[-1].level])
    found = {group.title: sensitivity_of(group, defects) for group in shown}
    shown = [group for group in shown if found[group.title]]
    sizes = {group.title: {row.level.name: abs(row.deviation) for row in group.models()} for group in shown}
    noises = {group.title: {row.level.name: 0.0 if math.isnan(row.deviation_error) else row.deviation_error for row in group.models()} for group in shown}
    made = prediction.leave_one_out(sizes, noises, defects, found)
    if not made:
        return []
    tables.write_csv(output / f"{name}.csv", HEADER, [[f.level, f.scene, f.predicted, f.error, f.measured, f.noise] for f in made])
    other = prediction.elsewhere(sizes, defects, found)
    of = {(f.level, f.scene): f for f in made}
    cell = lambda f: "-" if f is None else f"{100 * f.predicted:.0f} +- {100 * f.error:.0f} ({100 * f.measured:.0f} +- {100 * f.noise:.0f})"
    rows = [["S", "", *(f"{found[scene]:.2f}" for scene in sizes), "yours"]]
    rows += [[level.name, f"{defects[level.name]:.2f}", *(cell(of.get((level.name, scene))) for scene in sizes),
              f"({100 * other[level.name][0]:.0f} +- {100 * other[level.name][1]:.0f}) S" if level.name in other else "-"] for level in chosen]
    header = ["level", "lacks of delta_e", *sizes, "another scene"]
    return ["Size of the error [%], predicted from the geometry, the other scenes and S (in brackets: measured). S, how much a scene asks for shape, is the "
            "difference of its results for the sphere without and with mu_shape over their mean: run these two in your scene, and the last column "
            "is the prediction for it:\n", tables.markdown(header, rows), f"{prediction.words_of(made)}\n"]
