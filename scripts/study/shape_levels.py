# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Levels of detail of any shape, from the words of a user: `spheres 4 12 40`, `hull`, `sphere`, `mu 0.2`, `eccentric`, or words of a shape."""
import dataclasses
import pathlib
import re

from . import levels
from .levels import Level
from .programs import Failure

DIAMETER = "6.35e-3"  # ratios do not depend on it
DEFAULT = {"stl": ("sphere", "mu", "spheres 4 12 40", "hull"), "cube": ("sphere", "mu", "eccentric", "spheres 8 27 64 125"),
           "disk": ("sphere", "mu", "eccentric", "spheres 7 19 48")}
ROUNDING = 0.15  # of hulls; docs/accuracy-cost.md
KNOWN = "sphere, mu [VALUES], eccentric, spheres N ..., hull, or the words of a shape such as \"cube 27\""


@dataclasses.dataclass
class Ladder:
    """levels: the last is the reference; facts: what clusterShape says of those with a shape, by name; remarks: what is not known of the
    reference, as sentences."""
    levels: list
    facts: dict
    remarks: list


def absolute(words):
    """Words of a shape with the whole paths of files: runs have folders of their own."""
    return " ".join(str(pathlib.Path(word).resolve()) if pathlib.Path(word).is_file() else word for word in words.split())


def name_of(words):
    """Words of a shape without folders."""
    return " ".join(pathlib.Path(word).name if "/" in word else word for word in words.split())


def _numbers(word, kind, text):
    found = []
    for part in text:
        try:
            found.append(kind(part))
        except ValueError:
            found.append(-1)
        if found[-1] < 0 or (kind is int and found[-1] < 1):
            raise Failure(f"--levels: '{part}' after '{word}' is not a {'whole number from 1 on' if kind is int else 'number from 0 on'}; "
                          f"expected such as '{word} {'4 12 40' if kind is int else '0.1 0.3'}'")
    return found


def _base(shape):
    """(family, words that name the body, {option: value})."""
    words = shape.split()
    if not words:
        raise Failure("--shape is empty; expected words of a shape such as 'stl stone.stl', 'cube' or 'smooth box 1 2 3 rounding 0.2'")
    if words[0] == "stl":
        if len(words) < 2 or len(words) % 2 or any(option in words[2::2] for option in ("spheres", "error", "diameter", "mass")):
            raise Failure(f"--shape '{shape}' is not 'stl FILE [scale S] [cover inside|balanced] [missing P] [resolution M]': give the numbers of "
                          "spheres as --levels \"spheres 4 12 40\"; the mass is that of the union at one diameter")
        return "stl", " ".join(words[:2]), dict(zip(words[2::2], words[3::2]))
    return words[0] if len(words) == 1 and words[0] in ("cube", "disk") else "", shape, {}


def read(build, shape, wanted, rounding=None):
    """The ladder of a shape. rounding: of hulls and smooth bodies, or None for the default."""
    family, body, options = _base(absolute(shape))
    pairs = lambda chosen: "".join(f" {name} {value}" for name, value in options.items() if name in chosen)
    if family == "stl":
        reference = Level(f"hull {rounding or ROUNDING:g}", "smooth", f"hull {body.split()[1]} rounding {rounding or ROUNDING:g}{pairs(('scale',))}",
                          spheres=levels.SMOOTH_COST)
    elif family:
        reference = levels.smooth(family, rounding or levels.ROUNDING[family])
    else:
        reference = Level(name_of(body), "smooth", body, spheres=levels.SMOOTH_COST)
        if rounding:
            raise Failure(f"--rounding belongs to 'stl FILE', 'cube' and 'disk'; expected it in the words of --shape '{shape}'")
    facts, chosen, frictions, eccentric = {}, [], [], False
    wanted = list(wanted or DEFAULT.get(family, ("sphere", "mu")))
    for text in wanted:
        word, *rest = text.split() or [""]
        if word == "spheres" and family and rest:
            chosen += [Level(f"{family} {n}" if family != "stl" else f"{n} spheres", "cluster",
                             f"{body} spheres {n}{pairs(options)}" if family == "stl" else f"{family} {n}", spheres=n) for n in _numbers(word, int, rest)]
        elif word == "sphere" and not rest:
            chosen.append(Level("sphere", "sphere"))
        elif word == "mu":
            frictions += _numbers(word, float, rest) or [None]
        elif word == "eccentric" and not rest:
            eccentric = True
        elif word == "hull" and not rest and family == "stl":
            pass  # the reference
        elif len(text.split()) > 1 and word not in ("spheres", "sphere", "hull") or (word == "sphere" and rest):
            level = Level(name_of(text), "smooth" if word in ("smooth", "hull") else "cluster", absolute(text))
            chosen.append(level if level.kind == "smooth" else dataclasses.replace(level, spheres=int((re.findall(r"\d+", level.name) or [1])[-1])))
        else:
            raise Failure(f"--levels: '{text}' is unknown for the shape '{name_of(body)}'; expected {KNOWN}")
    if family == "stl" and "hull" not in wanted:
        finest = max((level for level in chosen if level.kind == "cluster"), key=lambda level: level.spheres, default=None)
        if finest is None:
            raise Failure("--levels names no reference; expected hull, or 'spheres N ...', whose finest is the reference then")
        chosen.remove(finest)
        reference = finest
    for level in [*chosen, reference]:
        if level.has_shape():
            facts[level.name] = levels.measured(build, level.shape, "--diameter", DIAMETER)
            level_spheres = facts[level.name].get("touchable_spheres", level.spheres)
            if level.kind == "cluster":
                chosen = [dataclasses.replace(level, spheres=level_spheres) if one is level else one for one in chosen]
    found = [Level("mu", "friction", mu=round(facts[reference.name]["mu_shape"], 4)) if mu is None else Level("mu", "friction", mu=mu) for mu in frictions]
    chosen += [dataclasses.replace(level, name=f"mu {level.mu:g}") for level in found]
    if eccentric:
        clusters = [level for level in chosen if level.kind == "cluster"]
        if not clusters:
            raise Failure("--levels: 'eccentric' takes the spheres of the finest cluster; expected 'spheres N ...' beside it")
        chosen.append(Level("eccentric", "eccentric", max(clusters, key=lambda level: level.spheres).shape))
    chosen = [one for one in dict.fromkeys(chosen) if one.name != reference.name]
    if not chosen:
        raise Failure(f"--levels: nothing to compare with {reference.name}; expected {KNOWN}")
    return Ladder([*chosen, reference], facts, _remarks(family, reference, facts))


def _remarks(family, reference, facts):
    said = [note["text"] if isinstance(note, dict) else str(note) for note in facts[reference.name].get("notes", [])]
    told = [f"Of the reference, clusterShape says: {text}" for text in said]
    if family == "stl" and reference.kind == "smooth":
        told.append("The reference is the convex hull with round edges: what dents and roughness of the stone do is not known.")
    if reference.kind == "cluster":
        told.append("The reference is the finest cluster and not the body itself: how far that one is off is not known.")
    return [text if text.endswith(".") else f"{text}." for text in told]
