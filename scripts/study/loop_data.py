# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured concentrations of a flow loop: sign and size of the effect of flow rate, rotation and inclination."""
import csv
import math
import statistics

SOURCE = "116 flow-loop runs of Yu et al., University of Tulsa (awojinrin/ML-Workflow-for-the-Determination-of-Hole-Cleaning-Conditions)"
RESULT = "Concentration"
EFFECTS = {"Flow rate": "flow rate", "Pipe rotation": "rotation", "Inclination": "inclination"}
IGNORED = ("Test No.", RESULT)


def read(path):
    """Rows as numbers; ValueError, one sentence, where a column or a number is missing."""
    with open(path, newline="") as rows:
        table = list(csv.DictReader(rows))
    missing = [name for name in (*EFFECTS, RESULT) if not table or name not in table[0]]
    if missing:
        raise ValueError(f"has no column '{missing[0]}': give the runs with {', '.join((*EFFECTS, RESULT))}")
    for number, row in enumerate(table, 2):
        for name, value in row.items():
            try:
                row[name] = float(value)
            except (TypeError, ValueError):
                raise ValueError(f"line {number}, column '{name}': '{value}' is no number") from None
    return table


def effect(rows, name):
    """All pairs of runs that differ in one column alone: (pairs, those whose concentration falls as it rises, those where it
    rises, median of the ratio of the concentrations, larger over smaller setting)."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(sorted((k, v) for k, v in row.items() if k not in (*IGNORED, name))), []).append(row)
    changes, ratios = [], []
    for group in groups.values():
        for low in group:
            for high in group:
                if high[name] > low[name]:
                    changes.append(high[RESULT] - low[RESULT])
                    if low[RESULT] > 0:
                        ratios.append(high[RESULT] / low[RESULT])
    return len(changes), sum(c < 0 for c in changes), sum(c > 0 for c in changes), statistics.median(ratios) if ratios else math.nan


def compare(rows, values, drawn):
    """Lines of the page: measured effects beside ours."""
    lines = [f"## Measured: {SOURCE}\n",
             "Pairs of runs that differ in one setting alone. Size and density of the cuttings are not in the file, so only sign and order of "
             "the effects can be compared.\n",
             "| effect of | pairs | C falls | C rises | median ratio of C |", "|---|---|---|---|---|"]
    for name, word in EFFECTS.items():
        pairs, falls, rises, ratio = effect(rows, name)
        lines.append(f"| more {word} | {pairs} | {falls} | {rises} | {'-' if math.isnan(ratio) else f'{ratio:.2f}'} |")
    ours = {"flow rate": lambda p: (p.level.name, p.inclination, p.rpm, p.sphericity),
            "rotation": lambda p: (p.level.name, p.inclination, p.velocity, p.sphericity),
            "inclination": lambda p: (p.level.name, p.velocity, p.rpm, p.sphericity)}
    by = {"flow rate": lambda p: p.velocity, "rotation": lambda p: p.rpm, "inclination": lambda p: p.inclination}
    from .figures import pairs as neighbours  # here: figures need no measured data
    lines += ["", "Ours, over all points above that differ in one setting alone:\n",
              "| effect of | pairs | C falls | C rises | not told apart |", "|---|---|---|---|---|"]
    inclined = {p: v for p, v in values.items() if p.inclination >= 40}
    for word, of in ours.items():
        told = [t for t in neighbours(inclined if word != "inclination" else values, of, by[word]) if t[3] is not None]
        falls, rises, same = (sum(t[3] == sign for t in told) for sign in (-1, 1, 0))
        lines.append(f"| more {word} | {len(told)} | {falls} | {rises} | {same} |")
    return lines + [""]
