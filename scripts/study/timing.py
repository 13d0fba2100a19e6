# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the time of a LIGGGHTS run went, from the breakdown that it prints after each `run` (modify_timing on)."""
import re

PARTS = ("contact", "integration", "neighbours", "fluid", "link", "other")
# Which part a line of the breakdown, or a fix by its style, belongs to; fix fluid/couple is the solver's own account.
_LINES = {"Pair": "contact", "Neigh": "neighbours", "Comm": "other", "Outpt": "other", "Other": "other"}
_STYLES = (("wall", "contact"), ("rolling", "contact"), ("history", "contact"), ("nve", "integration"), ("cluster/bodies", "integration"),
           ("fluid/force", "fluid"), ("fluid/couple", None))


def parts_of(text):
    """Wall seconds by part, summed over all `run`s of a log."""
    parts = dict.fromkeys(PARTS, 0.0)
    for word, seconds in re.findall(r"^(Pair|Neigh|Comm|Outpt|Other)\s+time \(%\) = ([\d.e+-]+)", text, re.M):
        parts[_LINES[word]] += float(seconds)
    for style, seconds in re.findall(r"^Fix \S+ (\S+) time \(%\) = ([\d.e+-]+)", text, re.M):
        part = next((part for word, part in _STYLES if word in style), "other")
        if part:
            parts[part] += float(seconds)
    return parts


def scaled(parts, total):
    """The parts in proportion, so that they sum to `total`: wall seconds of a busy machine become CPU seconds."""
    whole = sum(parts.values())
    return {name: seconds * total / whole if whole else 0.0 for name, seconds in parts.items()}
