# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program eccentra: hands its first word's command the rest of the line."""
import os
import pathlib
import re
import sys

from . import programs
from .options import start

# Programs of the build that a word of ours stands for.
PROGRAMS = {"run": "eccentra-run", "report": "annulusReport", "shape": "clusterShape"}
# Studies that need tests or pages of the source tree.
OF_THE_SOURCE_TREE = {"closure-cost", "hard-cases", "link-cost", "results", "solver-cost"}
HEAD = """usage: eccentra COMMAND [options]     eccentra COMMAND --help
  eccentra --version
"""


def studies():
    """The commands of the package study by name, each with the first line of its module."""
    found = {}
    for module in sorted((pathlib.Path(__file__).parent / "commands").glob("[a-z]*.py")):
        name = module.stem.replace("_", "-")
        if programs.INSTALLED and name in OF_THE_SOURCE_TREE:
            continue
        said = re.search(r'^"""(.*?)(?:"""|$)', module.read_text(), re.MULTILINE)
        found[name] = said.group(1).strip() if said else ""
    return found


def usage():
    """What --help prints."""
    lines = [HEAD, "Cases and shapes"]
    lines += [f"  {name:18} {program} ..." for name, program in PROGRAMS.items()]
    lines += ["", "Studies and tools"]
    lines += [f"  {name:18} {said}" for name, said in studies().items()]
    return "\n".join(lines) + "\n"


def main(words, version):
    """Runs the command that the first word names, and ends the program."""
    programs.said_version = version
    if not words or words[0] in ("-h", "--help", "help"):
        sys.stdout.write(usage())
        sys.exit(0 if words else 2)
    name, rest = words[0], words[1:]
    if name == "--version":
        sys.stdout.write(f"eccentra {version}\n")
        sys.exit(0)
    if name in PROGRAMS:
        program = programs.BUILD / "bin" / PROGRAMS[name]
        try:
            os.execve(program, [str(program), *rest], programs.environment())
        except OSError as error:
            sys.exit(f"eccentra: error: {program}: {error.strerror}: build it with scripts/setup, or install the package again")
    if name not in studies():
        sys.exit(f"eccentra: error: '{name}' is not a command; expected one of {', '.join([*PROGRAMS, *studies()])}")
    sys.argv = [f"eccentra {name}", *rest]
    start(name)
