# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A user's LIGGGHTS script as a scene of a study: three lines of it name the shape, the seed and what is measured."""
import dataclasses
import math
import pathlib
import re
import shutil
import statistics

from . import programs, runs
from .levels import shape_key
from .programs import Failure, digest_of, run

# Commands whose words name files that they write.
WRITING = ("dump", "log", "restart", "write_data", "write_restart", "print", "shell", "resumable")
NEEDED = {"shape": "\"cube 8\"", "seed": "15485863"}
FRICTION = {"rolling": "off", "mu_shape": "0"}  # of scripts that take spheres with rolling friction, too


def _lines(text):
    """Lines without comments, continued ones as one."""
    return [line.split("#")[0].strip() for line in re.sub(r"&[ \t]*\n", " ", text).splitlines()]


def files_of(script):
    """Files beside a script, and beneath, that its lines name and do not write: they are inputs of a run. Included scripts are read, too."""
    folder, found, todo = script.parent, [], [script]
    while todo:
        for line in _lines(todo.pop().read_text(errors="replace")):
            words = line.replace('"', " ").split()
            if not words or words[0] in WRITING:
                continue
            for word in words[1:]:
                path = folder / word
                inside = not pathlib.Path(word).is_absolute() and ".." not in pathlib.Path(word).parts
                if inside and path != script and path not in found and path.is_file():
                    found.append(path)
                    todo += [path] if words[0] == "include" else []
    return sorted(found)


def column_of(text, measure):
    """Rows of a column in the last table of thermo output. LIGGGHTS heads f_ID[1] as ID[1], and v_NAME and c_ID so, too."""
    tables, header = [], None
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            header = words
            tables.append([])
        elif line.startswith("Loop time"):
            header = None
        elif header and len(words) == len(header):
            try:
                tables[-1].append(dict(zip(header, map(float, words))))
            except ValueError:
                pass  # a message between the rows
    if not tables or not tables[-1]:
        raise programs.RunFailed("the script prints no table of thermo output: let its last line be a 'run' of some steps")
    name = next((name for name in (measure, re.sub(r"^[fvc]_", "", measure)) if name in tables[-1][0]), None)
    if name is None:
        raise programs.RunFailed(f"--measure: '{measure}' is no column of the last 'run'; expected one of {', '.join(tables[-1][0])}: "
                                 f"name it in thermo_style custom")
    return [row[name] for row in tables[-1]]


@dataclasses.dataclass(frozen=True)
class Scene:
    """script: its path; measure: a column of its thermo output; share: of the rows of the last `run`, at their end, whose mean is the result."""
    script: pathlib.Path
    measure: str
    share: float
    declared: frozenset

    def takes_friction(self):
        return self.declared.issuperset(FRICTION)

    def job(self, build, level, seed):
        """A run of the script at a level of detail (levels.Level)."""
        inputs = files_of(self.script)
        variables = {"shape": level.shape, "seed": seed}
        if self.takes_friction():
            variables |= {"rolling": "shape" if level.kind == "friction" else "off", "mu_shape": level.mu}
        if level.slide is not None:
            variables["mu_s"] = level.slide
        described = {"what": "user's scene", "scene": digest_of(self.script, *inputs), "measure": self.measure, "share": self.share,
                     **variables, "shape": shape_key(level.shape)}

        def work(folder):
            for file in inputs:
                copy = folder / file.relative_to(self.script.parent)
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(file, copy)
            line = [build / "bin" / "eccentra-dem", "-in", self.script, "-log", "none", *programs.variables(**variables)]
            cpu, wall, _ = run(line, folder, folder / "out.txt")
            rows = column_of((folder / "out.txt").read_text(errors="replace"), self.measure)
            value = statistics.fmean(rows[-max(1, math.ceil(self.share * len(rows))):])
            if not math.isfinite(value):
                raise programs.RunFailed(f"'{self.measure}' is {value}: it must be a number at the end of the run")
            return {"value": value, "cpu": cpu, "wall": wall}

        return runs.Job(f"{self.script.name} {level.name} seed {seed}", described, work, 10.0)


def read(script, measure, share):
    """The scene of a script; Failure where a line is missing that the study needs."""
    try:
        text = "\n".join([script.read_text(), *(file.read_text(errors="replace") for file in files_of(script) if file.suffix != ".stl")])
    except (OSError, UnicodeDecodeError) as problem:
        raise Failure(f"--scene {script}: {getattr(problem, 'strerror', None) or 'is no text'}; give the LIGGGHTS script of the scene") from None
    lines = _lines(text)
    declared = {words[1] for words in (line.split() for line in lines) if len(words) > 3 and words[0] == "variable" and words[2] == "index"}
    for name, example in NEEDED.items():
        if name not in declared:
            raise Failure(f"--scene {script}: no line 'variable {name} index ...'; add 'variable {name} index {example}' and use ${{{name}}}")
        if f"${{{name}}}" not in "\n".join(lines):
            raise Failure(f"--scene {script}: the variable '{name}' is declared and not used; write ${{{name}}} where the {name} stands")
    for name, example in FRICTION.items():
        if declared & set(FRICTION) and (name not in declared or f"${{{name}}}" not in "\n".join(lines)):
            raise Failure(f"--scene {script}: spheres with rolling friction need 'variable {name} index {example}' and ${{{name}}}; expected "
                          "rolling_friction ${rolling}, and ${mu_shape} in property/global shapeRollingFriction")
    printed = [line for line in lines if line.startswith("thermo_style")]
    if re.match(r"[fvc]_", measure) and not any(measure in line.split() for line in printed):
        raise Failure(f"--measure: '{measure}' is in no thermo_style of {script}; add it to 'thermo_style custom step ...'")
    return Scene(script, measure, share, frozenset(declared))
