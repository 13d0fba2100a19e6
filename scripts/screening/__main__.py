# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 -m screening scenes|annulus|off ROOT BUILD OUT: called by scripts/effects."""
import pathlib
import sys

from . import annulus, off, runs, scenes

PARTS = {"scenes": scenes.run, "annulus": annulus.run, "off": off.run}


def main():
    part, root, build, out = sys.argv[1], *map(pathlib.Path, sys.argv[2:5])
    try:
        wrong = PARTS[part](root, build, out)
    except runs.RunFailed as problem:
        print(f"effects: error: {problem}", file=sys.stderr)
        return 1
    if wrong:
        print(f"effects: error: {wrong} of them are not as they must be", file=sys.stderr)
    return 1 if wrong else 0


sys.exit(main())
