# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a case file (tests/stability/cases/*.py) says: a group of cases, each unfolded over its variations and its configurations that fail.

Functions of a case (scene, checks, limits, predicates) name the values that they need as parameters; `values_of` gives them."""
import dataclasses
import importlib.util
import inspect
import itertools
import pathlib
import re
import sys
import typing

from . import scenes

CASES = pathlib.Path(__file__).resolve().parent.parent / "cases"
SOURCE = CASES.parent.parent.parent
PLACEHOLDER = r"@\{(\w+)\}"  # in further files of a run
RELATIONS = {"below": lambda value, limit: value < limit, "above": lambda value, limit: value > limit, "equals": lambda value, limit: value == limit}


class CaseFileError(Exception):
    """A case file that cannot be used; the text names file and reason."""


def call(function, values):
    """Calls a function with those of the values that it names; whatever is no function is itself."""
    if not callable(function):
        return function
    wanted = inspect.signature(function).parameters
    return function(**{name: values[name] for name in wanted if name in values})


class Check:
    """A criterion: what is measured, by which function, and one of below, above and equals; `fixed`: parameters of the function."""

    def __init__(self, what, measure, **fixed):
        self.what, self.measure = what, measure
        (self.relation,) = set(fixed) & set(RELATIONS)
        self.limit = fixed.pop(self.relation)
        self.fixed = fixed

    def value(self, values):
        return call(self.measure, {**values, **self.fixed})

    def holds(self, value, limit):
        return bool(RELATIONS[self.relation](value, limit))  # NaN compares false: not a number never passes


@dataclasses.dataclass
class Fails:
    """A configuration in which a case must be seen failing: by a check, or, where it stops, with `says`."""
    why: str
    set: dict = dataclasses.field(default_factory=dict)
    when: typing.Callable = None
    says: str = ""
    twin: str = "fails"


@dataclasses.dataclass
class Run:
    """Texts of one run: its files by name, its commands, its ranks."""
    files: dict
    commands: list
    ranks: int
    values: dict


@dataclasses.dataclass
class Case:
    group: str
    name: str
    what: str
    values: dict
    checks: list
    runs: list
    quick: bool
    seconds: float  # a guess, for the time left
    points: typing.Callable  # rows of numbers that the group's chart shows
    failing: bool = False
    twin: str = "fails"
    why: str = ""
    says: str = ""

    @property
    def id(self):
        return f"{self.group}/{self.name}" + (f"/{self.twin}" if self.failing else "")


def _unfold(vary):
    for combination in itertools.product(*vary.values()):
        yield dict(zip(vary, combination))


def _filled(text, values):
    return re.sub(PLACEHOLDER, lambda match: str(values[match.group(1)]), text)


def _files(folders):
    """{name: text} of folders beside the case files, later ones before earlier ones; a folder in a folder named too is not its part."""
    found = {}
    for folder in folders:
        for path in sorted((CASES / folder).rglob("*")):
            inner = [other for other in folders if other != folder and (CASES / other).is_relative_to(CASES / folder)]
            if path.is_file() and not any(path.is_relative_to(CASES / other) for other in _nested(folder) + inner):
                found[str(path.relative_to(CASES / folder))] = path.read_text()
    return found


def _nested(folder):
    """Folders of single cases inside the folder of a group: none of the names that OpenFOAM uses."""
    return [path.relative_to(CASES) for path in (CASES / folder).iterdir() if path.is_dir() and "/" not in folder
            and path.name not in ("0", "constant", "system", "crashing", "harmless")]


class Group:
    def __init__(self, name, title, theory, values=None):
        self.name, self.title, self.theory, self.values = name, title, theory.strip(), values or {}
        self.entries, self.cases = [], []

    def case(self, name, what, checks, fails, scene=None, quick=False, seconds=2.0, vary=None, values=None, full=None, derive=None, runs=None,
             files=(), settings=None, commands=(), points=None):
        """vary: lists of values to combine; full: values of --full; derive: further values, of the others; runs: values of each run; files:
        folders of further files, in which @{name} stands for a value or a setting; commands: instead of eccentra-dem on the scene."""
        self.entries.append(dict(name=name, what=what, checks=checks, fails=fails, scene=scene, quick=quick, seconds=seconds, vary=vary or {},
                                 values=values or {}, full=full or {}, derive=derive, runs=runs or [{}], files=files, settings=settings,
                                 commands=commands, points=points))

    def unfold(self, build, full):
        """All cases, each with its configurations that fail."""
        places = {"tests": build / "tests", "build": build, "source": SOURCE}
        for entry in self.entries:
            for variation in _unfold(entry["vary"]):
                values = {**self.values, **entry["values"], **(entry["full"] if full else {}), **variation}
                self.cases.append(self._case(entry, values, {}, places))
                for failing in entry["fails"]:
                    if failing.when is None or call(failing.when, values):
                        self.cases.append(self._case(entry, values, failing.set, places, failing=True, twin=failing.twin, why=failing.why,
                                                     says=failing.says))
        return self

    def _case(self, entry, values, extra, places, **more):
        merged = {**values, **extra}
        merged |= call(entry["derive"], merged) or {}
        shown = {**values, **(call(entry["derive"], values) or {})}
        return Case(self.name, entry["name"].format(**shown).replace(" ", ""), entry["what"].format(**shown), merged, entry["checks"],
                    [self._run(entry, {**places, **merged, **one}) for one in entry["runs"]], bool(call(entry["quick"], values)),
                    entry["seconds"], entry["points"], **more)

    @staticmethod
    def _run(entry, values):
        scenes.restart()
        settings = {**values, **(call(entry["settings"], values) or {})}
        files = {name: _filled(text, settings) for name, text in _files(entry["files"]).items()}
        files["in.case"] = call(entry["scene"], values) or ""
        commands = [line.format(**values).split() for line in call(entry["commands"], values)]
        return Run(files, commands or [["eccentra-dem", "-in", "in.case", "-log", "none"]], int(values.get("ranks", 1)), values)


def read(path, build, full):
    """The group of a case file."""
    spec = importlib.util.spec_from_file_location(f"hard_cases_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    try:
        spec.loader.exec_module(module)
        return module.GROUP.unfold(build, full)
    except (KeyError, TypeError, ValueError, AttributeError, SyntaxError) as error:
        raise CaseFileError(f"{path}: {type(error).__name__} {error}") from error


def read_all(build, full):
    return [read(path, build, full) for path in sorted(CASES.glob("*.py"))]
