#!/usr/bin/env python3
# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which sources can stand side by side in one unit of the compiler, because their unnamed namespaces share no name.

The object that registers a style is called `registered` everywhere: who compiles a unit gives it another name in each file.
usage: units.py FILE... prints FILE=UNIT for each, files of one folder together, for CMake."""
import itertools
import json
import os
import pathlib
import re
import sys

LARGEST = 12  # files of a unit: two processors share the work


def names_of(text):
    """Names that a source declares at the margin, outside classes: those of its unnamed namespace are among them."""
    types = re.findall(r"^(?:struct|class|enum|enum class|using|union) (?!namespace)(\w+)(?= |;|$)", text, re.M)
    values = re.findall(r"^(?!using |namespace |return |template|static_assert)(?:[\w:<>,&*]+ )+[&*]*(\w+)(?=[({=\[;]| =)", text, re.M)
    return {*types, *values} - {"registered"}


def units_of(files):
    """Files side by side whose names differ, in the order given."""
    units = []
    for file in files:
        names = names_of(pathlib.Path(file).read_text())
        unit = next((u for u in units if not names & u[0] and len(u[1]) < LARGEST), None)
        if unit is None:
            unit = (set(), [])
            units.append(unit)
        unit[0].update(names)
        unit[1].append(file)
    return [unit[1] for unit in units]


def entries_of(database):
    """The compile database with each file by itself: those of a unit that CMake wrote have its flags."""
    entries = []
    for entry in json.loads(pathlib.Path(database).read_text()):
        files = [entry["file"]]
        if re.search(r"/unity_\w+\.cxx$", entry["file"]):
            files = re.findall(r'^#include "(.+)"', pathlib.Path(entry["file"]).read_text(), re.M)
        entries += [{**entry, "file": file} for file in files]
    return entries


if __name__ == "__main__":
    for folder, files in itertools.groupby(sorted(sys.argv[1:], key=lambda f: (os.path.dirname(f), f)), os.path.dirname):
        for number, unit in enumerate(units_of(list(files))):
            for name in unit:
                print(f"{name}={os.path.basename(folder) or 'room'}_{number}")
