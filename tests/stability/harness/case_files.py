# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the case files (tests/stability/cases/*.toml) and unfolds their variations into single cases."""
import itertools
import math
import pathlib
import re
import tomllib
from dataclasses import dataclass, field

from . import drag_map, references, scenes

KEYS = {"name", "what", "scene", "vary", "set", "quick", "full", "check", "fails", "runs", "seconds", "files",
        "commands", "derive", "points"}


class CaseFileError(Exception):
    """A case file that cannot be used; the text names file and key."""


@dataclass
class Case:
    group: str
    name: str
    what: str
    scene: str
    values: dict
    checks: list
    runs: list
    quick: bool
    seconds: float  # a guess, for the time left
    files: dict  # further files of the run: name, text
    commands: list  # instead of eccentra-dem on the scene: lines to execute in turn
    points: str = ""  # expression: rows of numbers that the group's chart shows
    failing: bool = False
    twin: str = "fails"
    why: str = ""
    says: str = ""

    @property
    def id(self):
        return f"{self.group}/{self.name}" + (f"/{self.twin}" if self.failing else "")


@dataclass
class Group:
    name: str
    title: str
    theory: str
    cases: list = field(default_factory=list)


def names_of(values):
    """What expressions may use."""
    known = {"__builtins__": {}}
    known |= {name: getattr(module, name) for module in (math, references, scenes, drag_map) for name in dir(module)
             if not name.startswith("_")}
    known.update(abs=abs, min=min, max=max, sum=sum, len=len, range=range, zip=zip, sorted=sorted, str=str, repr=repr, int=int,
                 float=float, any=any, all=all, round=round, enumerate=enumerate)
    known.update(values)
    return known


IN_SCRIPT = r"(?<!\$)\{([^{}]+)\}"  # {expression}, not ${variable of LIGGGHTS}
IN_FILE = r"@\{([^{}]+)\}"  # @{expression}: dictionaries are full of braces


def fill(text, values, pattern=IN_SCRIPT):
    """Replaces expressions by their values. Numbers keep all their digits."""
    def value(match):
        result = eval(match.group(1), names_of(values))  # our own case files
        return repr(result) if isinstance(result, float) else str(result)
    return re.sub(pattern, value, text)


def _unfold(vary):
    keys = list(vary)
    for combination in itertools.product(*vary.values()):
        yield dict(zip(keys, combination))


def read(path, full):
    try:
        data = tomllib.loads(path.read_text())
    except tomllib.TOMLDecodeError as error:
        raise CaseFileError(f"{path}: {error}")
    group = Group(path.stem.split("-", 1)[-1], data.get("title", path.stem), data.get("theory", "").strip())
    for entry in data.get("case", []):
        unknown = set(entry) - KEYS
        if unknown or not {"name", "what", "check", "fails"} <= set(entry):
            raise CaseFileError(f"{path}: case '{entry.get('name')}' has unknown keys {sorted(unknown)} or lacks one of "
                                "name, what, check, fails")
        for variation in _unfold(entry.get("vary", {})):
            values = {**data.get("set", {}), **entry.get("set", {}), **(entry.get("full", {}) if full else {}),
                      **variation}
            quick = bool(eval(str(entry.get("quick", "False")), names_of(values)))

            def case(extra, **more):
                merged = {**values, **extra}
                for key, expression in {**data.get("derive", {}), **entry.get("derive", {})}.items():
                    merged[key] = eval(expression, names_of(merged))
                return Case(group.name, fill(entry["name"], values).replace(" ", ""), fill(entry["what"], values),
                            entry.get("scene", ""), merged, entry["check"], entry.get("runs", [{}]), quick,
                            entry.get("seconds", 2.0), {**data.get("files", {}), **entry.get("files", {})},
                            entry.get("commands", []), entry.get("points", ""), **more)

            group.cases.append(case({}))
            for failing in entry["fails"]:
                if eval(str(failing.get("when", "True")), names_of(values)):
                    twin = "fails" + ("_" + failing["as"] if "as" in failing else "")
                    group.cases.append(case(failing.get("set", {}), failing=True, twin=twin, why=failing["why"],
                                            says=failing.get("says", "")))
    return group


def read_all(folder, full):
    return [read(path, full) for path in sorted(pathlib.Path(folder).glob("*.toml"))]
